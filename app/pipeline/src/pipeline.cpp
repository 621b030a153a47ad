// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/pipeline.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bw/core/fingerprint.h"
#include "bw/core/number_text.h"
#include "bw/robotio/program.h"

namespace bw::pipeline {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using nlohmann::json;

namespace {

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Identity of the source's bytes: for a linked file its path, size and time of change; for an embedded one
/// its hash.
std::string sourceKey(const Source& source) {
  if (!source.bytes.empty())
    return "embedded " + std::to_string(source.bytes.size()) + " " + std::to_string(source.bytes.hash());
  std::error_code error;
  const auto size = fs::file_size(source.path, error);
  const auto time = fs::last_write_time(source.path, error);
  return source.path.string() + " " + std::to_string(error ? 0 : size) + " " +
         std::to_string(error ? 0 : time.time_since_epoch().count());
}

/// The fingerprint of the bytes that were read; `then` is what `sourceKey` told before.
Result<Fingerprint> fingerprintOfSource(const Source& source, const std::string& then) {
  if (!source.bytes.empty()) return fingerprintOf(source.bytes.str());
  Result<Fingerprint> fingerprint = fingerprintOfFile(source.path);
  if (fingerprint && sourceKey(source) != then)
    return fail(ErrorCode::cannotRead, source.path.string() + " was changed while it was read; read it again",
                source.path.string());
  return fingerprint;
}

/// Identity of a cell: its word, or for a file its path, size and time of change.
std::string cellKey(const std::string& nameOrPath) {
  std::error_code error;
  return fs::is_regular_file(nameOrPath, error) ? sourceKey(Source{nameOrPath, {}}) : nameOrPath;
}

/// The members of the job that a stage depends on, as text.
class JobKeys {
 public:
  explicit JobKeys(const Job& job) : object_(json::parse(jobToJson(job))) {}
  std::string operator()(std::initializer_list<const char*> names) const {
    std::string key;
    for (const char* name : names) key += "\n" + std::string(name) + "=" + object_.at(name).dump();
    return key;
  }

 private:
  json object_;
};

template <class T>
bool reuse(Stage<T>& stage, const Stage<T>* before, const std::string& key) {
  stage.key = key;
  if (!before || !before->value || before->key != key) return false;
  stage = *before;
  return true;
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
  for (const Issues* list : {&source.issues, &model.issues, &target.issues, &setup.issues, &directions.issues,
                             &sections.issues, &fits.issues, &sweep.issues, &cell.issues, &programs})
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
  RunContext run = context;
  run.threads = context.threads > 0 ? context.threads : design.job.threads;
  const Job& job = design.job;
  const JobKeys keys(job);

  // Reading.
  const geometry::ReadOptions options{job.unit, job.sewingTolerance()};
  std::string key = sourceKey(design.source) + keys({"unit"}) + "\nsewing=" + roundTripText(options.sewing);
  const bool known = reuse(e.source, before(&Evaluation::source), key);
  if (!reuse(e.model, before(&Evaluation::model), key) || !known) {
    run.report(0.0, "reading");
    const auto readStart = Clock::now();
    const std::string sourceThen = sourceKey(design.source);
    if (design.source.bytes.empty() && design.source.path.empty())
      return stop(
          Error{ErrorCode::badInput, "no CAD file is chosen; open one or drag it into the window", "source"});
    Result<geometry::CadModel> model =
        design.source.bytes.empty()
            ? geometry::CadModel::read(design.source.path, run.child(0.0, 0.25), options)
            : geometry::CadModel::readBytes(design.source.bytes, design.source.path.string(),
                                            run.child(0.0, 0.25), options);
    if (!model) return stop(model.error());
    const Result<Fingerprint> read = fingerprintOfSource(design.source, sourceThen);
    if (!read) return stop(read.error());
    e.source.value = std::make_shared<const Fingerprint>(*read);
    for (const std::string& text : model->info().leftOut)
      e.model.issues.push_back({Severity::warning, "left-out", text, {}});
    for (const std::string& text : model->info().healing)
      e.model.issues.push_back({Severity::info, "healing", text, {}});
    e.model.value = std::make_shared<const geometry::CadModel>(std::move(*model));
    e.seconds.read = secondsSince(readStart);
  }
  e.source.issues = changedSource(design.source, *e.source.value);
  if (run.stopped()) return stop(stoppedError().value());

  // The faces to cut, and a mesh of them for pictures.
  key += keys({"face", "near"});
  if (!reuse(e.target, before(&Evaluation::target), key)) {
    const auto targetStart = Clock::now();
    Result<geometry::Target> target = geometry::Target::make(*e.model.value, job.face, &e.target.issues);
    if (!target) return stop(target.error());
    e.target.value = std::make_shared<const geometry::Target>(std::move(*target));
    e.seconds.read += secondsSince(targetStart);
  }
  const std::string targetKey = key;

  // Block and direction.
  key += keys({"block", "direction", "blade", "clearance"});
  if (!reuse(e.setup, before(&Evaluation::setup), key)) {
    Result<geometry::Setup> setup = geometry::resolveSetup(*e.target.value, job, e.setup.issues);
    if (!setup) return stop(setup.error());
    e.setup.value = std::make_shared<const geometry::Setup>(std::move(*setup));
  }
  // Where the direction is left to us, the best of some. Its key holds all that the trials hang on, but not
  // the number of stations: their change is what people drag.
  std::string along;
  if (!job.direction) {
    key = targetKey + keys({"block", "blade", "fit", "lead", "tolerance", "clearance"});
    if (!reuse(e.directions, before(&Evaluation::directions), key)) {
      run.report(0.25, "direction");
      const auto directionStart = Clock::now();
      Result<DirectionSearch> search = searchDirection(*e.target.value, *e.setup.value, job, run);
      if (!search) return stop(search.error());
      e.directions.value = std::make_shared<const DirectionSearch>(std::move(*search));
      e.directions.issues = directionFindings(*e.directions.value);
      e.seconds.direction = secondsSince(directionStart);
    }
    const Eigen::Vector3d& chosen = e.directions.value->trials[e.directions.value->chosen].direction;
    e.setup.value = std::make_shared<const geometry::Setup>(geometry::Setup{e.setup.value->block, chosen});
    for (int i = 0; i < 3; ++i) along += " " + roundTripText(chosen[i]);
  }
  if (run.stopped()) return stop(stoppedError().value());

  const auto sectionsStart = Clock::now();
  key = targetKey + keys({"block", "direction", "planes", "stations"}) + along;
  if (!reuse(e.sections, before(&Evaluation::sections), key)) {
    run.report(0.3, "sections");
    Result<std::vector<Section>> sections =
        geometry::cutSections(*e.target.value, *e.setup.value, job, run.child(0.3, 0.6), e.sections.issues);
    if (!sections) return stop(sections.error());
    e.sections.value = std::make_shared<const std::vector<Section>>(std::move(*sections));
    e.seconds.sections = secondsSince(sectionsStart);
  }
  if (run.stopped()) return stop(stoppedError().value());

  // Elastica.
  key += keys({"blade", "fit", "lead", "tolerance", "clearance"});
  if (!reuse(e.fits, before(&Evaluation::fits), key)) {
    run.report(0.6, "fitting");
    Result<Sweep> sweep = buildSweep(*e.sections.value, job, e.setup.value->block, e.setup.value->direction,
                                     run.child(0.6, 0.75), e.fits.issues, &e.seconds.fit, &e.seconds.extend);
    if (!sweep) return stop(sweep.error());
    e.fits.value = std::make_shared<const Sweep>(std::move(*sweep));
  }
  if (run.stopped()) return stop(stoppedError().value());

  // Checks and motion: the speed of the cut comes in here.
  key += keys({"cutting_speed"});
  if (!reuse(e.sweep, before(&Evaluation::sweep), key)) {
    run.report(0.75, "checking");
    const auto checkStart = Clock::now();
    auto result = std::make_shared<SweepResult>();
    result->sweep = *e.fits.value;
    Result<SweepAnalysis> analysis =
        analyzeSweep(result->sweep, job, *e.target.value->sampler(), run.child(0.75, 0.95));
    if (!analysis) return stop(analysis.error());
    Result<Motion> motion = buildMotion(result->sweep, job.cuttingSpeed);
    if (!motion) return stop(motion.error());
    result->analysis = std::move(*analysis);
    result->motion = std::move(*motion);
    result->analysis.summary.cuttingTime = result->motion.instants.back().time;
    e.sweep.issues = result->analysis.issues;
    e.sweep.value = std::move(result);
    e.seconds.check = secondsSince(checkStart);
  }
  if (run.stopped()) return stop(stoppedError().value());

  // How the programs lie in their cell. A cell that cannot be read is a finding: the surface is judged
  // without it.
  key += keys({"programs"}) + "\ncell=" + cellKey(job.cell);
  if (!job.programs.empty() && !reuse(e.cell, before(&Evaluation::cell), key)) {
    Result<Cell> cell = loadCell(job.cell);
    if (cell) {
      e.cell.issues = robotio::checkPlacement(e.sweep.value->motion, *cell);
      e.cell.value = std::make_shared<const Cell>(std::move(*cell));
    } else {
      e.cell.issues.push_back({Severity::error, "cell", cell.error().message, {}});
    }
  }

  if (!reuse(e.targetMesh, before(&Evaluation::targetMesh), targetKey)) {
    const auto meshStart = Clock::now();
    Result<TriangleMesh> mesh = e.target.value->mesh();
    if (!mesh) return stop(mesh.error());
    e.targetMesh.value = std::make_shared<const TriangleMesh>(std::move(*mesh));
    e.seconds.read += secondsSince(meshStart);
  }
  run.report(1.0, "done");
  e.seconds.total = secondsSince(start);
  return outcome;
}

}  // namespace bw::pipeline
