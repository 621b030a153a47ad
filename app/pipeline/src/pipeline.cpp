// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

#include <chrono>
#include <cmath>
#include <type_traits>
#include <utility>

#include "bw/core/files/fingerprint.h"
#include "bw/robotio/cell/placement.h"

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
  Result<T> made = make(stage.request, stage.findings);
  if (!made) return tl::unexpected<Error>(made.error());
  stage.value = std::make_shared<const T>(std::move(*made));
  seconds += secondsSince(start);
  return {};
}

SourceRequest sourceRequest(const Source& source, const ReadOptions& options) {
  if (source.bytes.empty()) return {FileStamp::of(source.path), {}, options};
  return {{source.path}, source.bytes, options};
}

Result<CadSource> readSource(const SourceRequest& request, const RunContext& context, Findings& findings) {
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
    findings.push_back({Severity::warning, LeftOutOfFile{text}, {}, {}});
  for (const std::string& text : model->info().healing)
    findings.push_back({Severity::info, Healed{text}, {}, {}});
  return CadSource{std::move(*model), *content};
}

Result<SweepResult> checkedSweep(const Sweep& fits, const ResultRequest& request,
                                 const SurfaceSampler& target, const RunContext& context,
                                 Findings& findings) {
  SweepResult result{fits, {}, {}};
  Result<SweepAnalysis> analysis = analyzeSweep(result.sweep, request.check, target, context);
  if (!analysis) return tl::unexpected<Error>(analysis.error());
  Result<Motion> motion = buildMotion(result.sweep, request.motion);
  if (!motion) return tl::unexpected<Error>(motion.error());
  result.analysis = std::move(*analysis);
  result.motion = std::move(*motion);
  result.analysis.summary.cuttingTime = result.motion.instants.back().time;
  findings = result.analysis.findings;
  return result;
}

/// Tells where a linked source that was read is another than when the design was saved.
Findings changedSource(const Source& source, const Fingerprint& read) {
  if (!source.bytes.empty() || !source.saved || read == *source.saved) return {};
  return {{Severity::warning,
           ChangedSource{source.path.filename().string(), source.saved->size, read.size},
           {},
           {}}};
}

}  // namespace

Findings Evaluation::findings() const {
  Findings all;
  for (const Findings* list :
       {&sourceFindings, &source.findings, &target.findings, &placed.findings, &directions.findings,
        &sections.findings, &fits.findings, &sweep.findings, &cell.findings, &programs})
    all.insert(all.end(), list->begin(), list->end());
  return all;
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
  Result<void> ok;

  ok = settle(e.source, before(&Evaluation::source), sourceRequest(design.source, ask.read), {},
              e.seconds.read, [&context](const SourceRequest& request, Findings& findings) {
                context.report(0.0, "reading");
                return readSource(request, context.child(0.0, 0.25), findings);
              });
  if (!ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());
  const CadSource& source = *e.source.value;
  e.sourceFindings = changedSource(design.source, source.content);

  ok = settle(e.target, before(&Evaluation::target), ask.face, {e.source.value}, e.seconds.read,
              [&source](const FaceChoice& face, Findings& findings) {
                return geometry::Target::make(source.model, face, &findings);
              });
  if (!ok) return stop(ok.error());
  const geometry::Target& target = *e.target.value;

  // Block and direction; where the direction is left to us, the best of some. What the trials hang on does
  // not hold the number of stations: its change is what people drag.
  double none = 0;
  ok = settle(e.placed, before(&Evaluation::placed), ask.setup, {e.target.value}, none,
              [&target](const geometry::SetupRequest& request, Findings& findings) {
                return geometry::resolveSetup(target, request, findings);
              });
  if (!ok) return stop(ok.error());
  e.setup = e.placed.value;
  if (!ask.setup.direction) {
    ok = settle(e.directions, before(&Evaluation::directions), {*e.placed.value, ask.fit}, {e.target.value},
                e.seconds.direction, [&context, &target](const RowRequest& request, Findings& findings) {
                  context.report(0.25, "direction");
                  Result<DirectionSearch> search = searchDirection(target, request, context);
                  if (search) findings = directionFindings(*search);
                  return search;
                });
    if (!ok) return stop(ok.error());
    const DirectionSearch& search = *e.directions.value;
    e.setup = std::make_shared<const geometry::Setup>(
        geometry::Setup{e.placed.value->block, search.trials[search.chosen].direction});
  }
  if (context.stopped()) return stop(stoppedError().value());

  ok = settle(e.sections, before(&Evaluation::sections), {*e.setup, ask.sections}, {e.target.value},
              e.seconds.sections, [&context, &target](const PlanesRequest& request, Findings& findings) {
                context.report(0.3, "sections");
                return geometry::cutSections(target, request.setup, request.sections, context.child(0.3, 0.6),
                                             findings);
              });
  if (!ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());

  const std::vector<Section>& sections = *e.sections.value;
  ok = settle(e.fits, before(&Evaluation::fits), {*e.setup, ask.fit}, {e.sections.value}, none,
              [&context, &sections, &seconds = e.seconds](const RowRequest& request, Findings& findings) {
                context.report(0.6, "fitting");
                return buildSweep(sections, request.fit, request.setup.block, request.setup.direction,
                                  context.child(0.6, 0.75), findings, &seconds.fit, &seconds.extend);
              });
  if (!ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());

  const Sweep& fits = *e.fits.value;
  ok = settle(e.sweep, before(&Evaluation::sweep), {ask.check, ask.motion}, {e.fits.value, e.target.value},
              e.seconds.check, [&context, &fits, &target](const ResultRequest& request, Findings& findings) {
                context.report(0.75, "checking");
                return checkedSweep(fits, request, *target.sampler(), context.child(0.75, 0.95), findings);
              });
  if (!ok) return stop(ok.error());
  if (context.stopped()) return stop(stoppedError().value());

  // How the programs lie in their cell. A cell that cannot be read is a finding: the surface is judged
  // without it.
  const SweepResult& sweep = *e.sweep.value;
  if (!ask.programs.formats.empty()) {
    ok = settle(e.cell, before(&Evaluation::cell), {ask.programs, FileStamp::of(ask.programs.cell)},
                {e.sweep.value}, none, [&sweep](const CellRequest& request, Findings& findings) {
                  Result<Cell> cell = loadCell(request.programs.cell);
                  if (cell) findings = robotio::checkPlacement(sweep.motion, *cell);
                  return cell;
                });
    if (!ok) e.cell.findings = {{Severity::error, UnreadableCell{ok.error().message}, {}, {}}};
  }

  ok = settle(e.targetMesh, before(&Evaluation::targetMesh), {}, {e.target.value}, e.seconds.read,
              [&target](const NoRequest&, Findings&) { return target.mesh(); });
  if (!ok) return stop(ok.error());
  context.report(1.0, "done");
  e.seconds.total = secondsSince(start);
  return outcome;
}

}  // namespace bw::pipeline
