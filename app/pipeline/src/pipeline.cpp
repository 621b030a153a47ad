// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "bw/core/fingerprint.h"
#include "bw/core/number_text.h"
#include "bw/robotio/program.h"

namespace bw::pipeline {

using Clock = std::chrono::steady_clock;

namespace {

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A stage as it was before, where neither its request nor anything that it stands on changed; else `make`
/// makes it of its request, and its time is added to `seconds`.
template <class Request, class T, class Make>
Result<void> settle(Stage<Request, T>& stage, const Stage<Request, T>* before,
                    const std::type_identity_t<Request>& request, Inputs inputs, double& seconds,
                    const Make& make) {
  if (before && before->value && before->request == request && before->inputs == inputs) {
    stage = *before;
    return {};
  }
  stage.request = request;
  stage.inputs = std::move(inputs);
  const auto start = Clock::now();
  Result<T> made = make(stage.request, stage.issues);
  if (!made) return tl::unexpected<Error>(made.error());
  stage.value = std::make_shared<const T>(std::move(*made));
  seconds += secondsSince(start);
  return {};
}

SourceRequest sourceRequest(const Source& source, const ReadOptions& options) {
  if (source.bytes.empty()) return {FileStamp::of(source.path), {}, options};
  return {{source.path}, source.bytes, options};
}

Result<CadSource> readSource(const SourceRequest& request, const RunContext& context, Issues& issues) {
  const std::filesystem::path& path = request.file.path;
  if (request.bytes.empty() && path.empty())
    return fail(ErrorCode::badInput, "no CAD file is chosen; open one or drag it into the window", "source");
  Result<geometry::CadModel> model =
      request.bytes.empty()
          ? geometry::CadModel::read(path, context, request.options)
          : geometry::CadModel::readBytes(request.bytes, path.string(), context, request.options);
  if (!model) return tl::unexpected<Error>(model.error());
  Result<Fingerprint> content =
      request.bytes.empty() ? fingerprintOfFile(path) : fingerprintOf(request.bytes.str());
  if (!content) return tl::unexpected<Error>(content.error());
  if (request.bytes.empty() && FileStamp::of(path) != request.file)
    return fail(ErrorCode::cannotRead, path.string() + " was changed while it was read; read it again",
                path.string());
  for (const std::string& text : model->info().leftOut)
    issues.push_back({Severity::warning, "left-out", text, {}});
  for (const std::string& text : model->info().healing)
    issues.push_back({Severity::info, "healing", text, {}});
  return CadSource{std::move(*model), *content};
}

Result<SweepResult> checkedSweep(const Sweep& fits, const ResultRequest& request,
                                 const SurfaceSampler& target, const RunContext& context, Issues& issues) {
  SweepResult result{fits, {}, {}};
  Result<SweepAnalysis> analysis = analyzeSweep(result.sweep, request.check, target, context);
  if (!analysis) return tl::unexpected<Error>(analysis.error());
  Result<Motion> motion = buildMotion(result.sweep, request.motion);
  if (!motion) return tl::unexpected<Error>(motion.error());
  result.analysis = std::move(*analysis);
  result.motion = std::move(*motion);
  result.analysis.summary.cuttingTime = result.motion.instants.back().time;
  issues = result.analysis.issues;
  return result;
}

/// What the message of a station says apart from its name, or empty if it is not about one station.
std::string withoutStation(const Issue& issue) {
  if (!issue.where.station) return {};
  const std::string name = stationName(*issue.where.station);
  return issue.message.compare(0, name.size(), name) == 0 ? issue.message.substr(name.size()) : std::string();
}

/// What is said of one station, said of several.
std::string inPlural(std::string text) {
  static constexpr std::pair<const char*, const char*> kPlurals[] = {
      {" is left out", " are left out"},
      {"its plane cuts", "their planes cut"},
      {"its plane meets", "their planes meet"},
      {"its plane does not", "their planes do not"},
      {"in a closed curve", "in closed curves"},
      {"its section is", "their sections are"},
      {" separate curves", " separate curves each"}};
  for (const auto& [one, several] : kPlurals)
    if (const std::size_t at = text.find(one); at != std::string::npos)
      text.replace(at, std::strlen(one), several);
  return text;
}

/// Neighbouring stations that say the same become one finding, placed at the first of them.
Issues grouped(const Issues& issues) {
  Issues result;
  for (std::size_t i = 0; i < issues.size(); ++i) {
    const std::string text = withoutStation(issues[i]);
    std::size_t j = i;
    while (!text.empty() && j + 1 < issues.size() && issues[j + 1].kind == issues[i].kind &&
           issues[j + 1].severity == issues[i].severity && withoutStation(issues[j + 1]) == text &&
           *issues[j + 1].where.station == *issues[j].where.station + 1)
      ++j;
    result.push_back(issues[i]);
    if (j > i) {
      result.back().message = "stations " + std::to_string(*issues[i].where.station + 1) + " to " +
                              std::to_string(*issues[j].where.station + 1) + inPlural(text);
    }
    i = j;
  }
  return result;
}

/// Tells where a linked source that was read is another than when the design was saved.
Issues changedSource(const Source& source, const Fingerprint& read) {
  if (!source.bytes.empty() || !source.saved || read == *source.saved) return {};
  const std::string sizes =
      read.size == source.saved->size
          ? "as many bytes, others"
          : std::to_string(source.saved->size) + " bytes then, " + std::to_string(read.size) + " now";
  return {{Severity::warning,
           kSourceIssue,
           "the CAD file " + source.path.filename().string() + " has changed since the design was saved (" +
               sizes + "); look at the result, then save the design again",
           {}}};
}

}  // namespace

Issues Evaluation::issues() const {
  Issues all;
  for (const Issues* list :
       {&sourceIssues, &source.issues, &target.issues, &placed.issues, &directions.issues, &sections.issues,
        &fits.issues, &sweep.issues, &cell.issues, &programs})
    all.insert(all.end(), list->begin(), list->end());
  return grouped(all);
}

Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context) {
  Outcome outcome;
  Evaluation& e = outcome.evaluation;
  e.design = design;
  const auto start = Clock::now();
  const auto stop = [&](const Error& error) {
    outcome.error = error;
    e.seconds.total = secondsSince(start);
    return outcome;
  };
  const auto before = [&](auto member) { return previous ? &(previous->*member) : nullptr; };
  const Requests ask(design.job);
  RunContext run = context;
  run.threads = context.threads > 0 ? context.threads : design.job.threads;
  Result<void> ok;

  ok = settle(e.source, before(&Evaluation::source), sourceRequest(design.source, ask.read), {},
              e.seconds.read, [&run](const SourceRequest& request, Issues& issues) {
                run.report(0.0, "reading");
                return readSource(request, run.child(0.0, 0.25), issues);
              });
  if (!ok) return stop(ok.error());
  if (run.stopped()) return stop(stoppedError().value());
  const CadSource& source = *e.source.value;
  e.sourceIssues = changedSource(design.source, source.content);

  ok = settle(e.target, before(&Evaluation::target), ask.face, {e.source.value}, e.seconds.read,
              [&source](const FaceChoice& face, Issues& issues) {
                return geometry::Target::make(source.model, face, &issues);
              });
  if (!ok) return stop(ok.error());
  const geometry::Target& target = *e.target.value;

  // Block and direction; where the direction is left to us, the best of some. What the trials hang on does
  // not hold the number of stations: its change is what people drag.
  double none = 0;
  ok = settle(e.placed, before(&Evaluation::placed), ask.setup, {e.target.value}, none,
              [&target](const geometry::SetupRequest& request, Issues& issues) {
                return geometry::resolveSetup(target, request, issues);
              });
  if (!ok) return stop(ok.error());
  e.setup = e.placed.value;
  if (!ask.setup.direction) {
    ok = settle(e.directions, before(&Evaluation::directions), {*e.placed.value, ask.fit}, {e.target.value},
                e.seconds.direction, [&run, &target](const RowRequest& request, Issues& issues) {
                  run.report(0.25, "direction");
                  Result<DirectionSearch> search = searchDirection(target, request, run);
                  if (search) issues = directionFindings(*search);
                  return search;
                });
    if (!ok) return stop(ok.error());
    const DirectionSearch& search = *e.directions.value;
    e.setup = std::make_shared<const geometry::Setup>(
        geometry::Setup{e.placed.value->block, search.trials[search.chosen].direction});
  }
  if (run.stopped()) return stop(stoppedError().value());

  ok = settle(e.sections, before(&Evaluation::sections), {*e.setup, ask.sections}, {e.target.value},
              e.seconds.sections, [&run, &target](const PlanesRequest& request, Issues& issues) {
                run.report(0.3, "sections");
                return geometry::cutSections(target, request.setup, request.sections, run.child(0.3, 0.6),
                                             issues);
              });
  if (!ok) return stop(ok.error());
  if (run.stopped()) return stop(stoppedError().value());

  const std::vector<Section>& sections = *e.sections.value;
  ok = settle(e.fits, before(&Evaluation::fits), {*e.setup, ask.fit}, {e.sections.value}, none,
              [&run, &sections, &seconds = e.seconds](const RowRequest& request, Issues& issues) {
                run.report(0.6, "fitting");
                return buildSweep(sections, request.fit, request.setup.block, request.setup.direction,
                                  run.child(0.6, 0.75), issues, &seconds.fit, &seconds.extend);
              });
  if (!ok) return stop(ok.error());
  if (run.stopped()) return stop(stoppedError().value());

  const Sweep& fits = *e.fits.value;
  ok = settle(e.sweep, before(&Evaluation::sweep), {ask.check, ask.motion}, {e.fits.value, e.target.value},
              e.seconds.check, [&run, &fits, &target](const ResultRequest& request, Issues& issues) {
                run.report(0.75, "checking");
                return checkedSweep(fits, request, *target.sampler(), run.child(0.75, 0.95), issues);
              });
  if (!ok) return stop(ok.error());
  if (run.stopped()) return stop(stoppedError().value());

  // How the programs lie in their cell. A cell that cannot be read is a finding: the surface is judged
  // without it.
  const SweepResult& sweep = *e.sweep.value;
  if (!ask.programs.formats.empty()) {
    ok = settle(e.cell, before(&Evaluation::cell), {ask.programs, FileStamp::of(ask.programs.cell)},
                {e.sweep.value}, none, [&sweep](const CellRequest& request, Issues& issues) {
                  Result<Cell> cell = loadCell(request.programs.cell);
                  if (cell) issues = robotio::checkPlacement(sweep.motion, *cell);
                  return cell;
                });
    if (!ok) e.cell.issues = {{Severity::error, "cell", ok.error().message, {}}};
  }

  ok = settle(e.targetMesh, before(&Evaluation::targetMesh), {}, {e.target.value}, e.seconds.read,
              [&target](const NoRequest&, Issues&) { return target.mesh(); });
  if (!ok) return stop(ok.error());
  run.report(1.0, "done");
  e.seconds.total = secondsSince(start);
  return outcome;
}

}  // namespace bw::pipeline
