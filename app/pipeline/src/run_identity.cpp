// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/run_identity.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "bw/core/fingerprint.h"
#include "bw/core/number_text.h"
#include "bw/robotio/program.h"
#include "program_unit.h"

namespace bw::pipeline {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLargestReport = std::size_t(256) << 20;
constexpr std::size_t kLargestModule = std::size_t(64) << 20;
constexpr int kLevels = 4;  ///< from a module up to its report: task, strip, programs, results

/// Collects values, one after the other, into bytes that differ where one of them does.
class Values {
 public:
  Values& text(std::string_view value) {
    bytes_ += std::to_string(value.size()) + ":";
    bytes_ += value;
    return *this;
  }
  Values& number(double value) {
    bytes_ += roundTripText(value) + ",";
    return *this;
  }
  /// 16 hexadecimal digits.
  std::string name() const {
    const std::string text = fingerprintText(fingerprintOf(bytes_));
    return text.substr(text.find('-') + 1);
  }

 private:
  std::string bytes_;
};

void add(Values& f, const Eigen::Vector3d& v) { f.number(v.x()).number(v.y()).number(v.z()); }

void add(Values& f, const Pose& pose) {
  add(f, pose.position);
  const Eigen::Quaterniond& q = pose.rotation;
  f.number(q.w()).number(q.x()).number(q.y()).number(q.z());
}

void add(Values& f, const Cell& cell) {
  f.text(cell.name).text(cell.title).text(cell.workObjectName).text(cell.heatSignal);
  f.number(cell.heatDwell).number(cell.travelSpeed).number(cell.approach).number(double(cell.tasks.size()));
  add(f, cell.workObject);
  for (const CellTask& task : cell.tasks) {
    f.text(task.name)
        .text(task.robot)
        .text(task.toolName)
        .number(task.toolMass)
        .number(double(task.home.size()));
    add(f, task.base);
    add(f, task.tool);
    add(f, task.toolCenter);
    for (const double angle : task.home) f.number(angle);
  }
}

void add(Values& f, const Motion& motion) {
  const Frame& frame = motion.block.frame;
  for (const Eigen::Vector3d& v : {frame.origin, frame.x, frame.y, frame.normal, motion.block.size})
    add(f, v);
  f.number(motion.bladeLength).number(motion.cuttingSpeed).number(double(motion.instants.size()));
  for (const MotionInstant& instant : motion.instants) {
    f.number(instant.time).number(instant.station);
    for (const Pose& pose : instant.poses) add(f, pose);
  }
}

/// What a report says of its run.
struct Record {
  fs::path folder;
  std::string run;
  std::map<std::string, std::string> fingerprints;  ///< by path within the folder
};

/// True for a path that leads out of no folder.
bool staysInside(const fs::path& path) {
  return !path.empty() && path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

/// Nothing where there is no report, or one that names no run.
Result<std::optional<Record>> recordOf(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "report.json";
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const Result<std::string> text = readFile(file, kLargestReport);
  if (!text) return tl::unexpected<Error>(text.error());
  const json report = json::parse(*text, nullptr, false);
  if (!report.is_object() && text->find("\"bladewright_report\"") != std::string::npos)
    return fail(ErrorCode::badInput, file.string() + " is damaged; write the results anew", file.string());
  if (!report.is_object()) return std::nullopt;  // somebody else's file of that name
  const auto run = report.find("run"), files = report.find("fingerprints");
  if (!report.contains("bladewright_report") || run == report.end() || !run->is_string() ||
      files == report.end() || !files->is_object())
    return std::nullopt;
  Record record{folder, run->get<std::string>(), {}};
  for (const auto& [name, value] : files->items())
    if (value.is_string() && staysInside(name)) record.fingerprints[name] = value.get<std::string>();
  return record;
}

Issue finding(Severity severity, const fs::path& file, std::string message) {
  Issue issue;
  issue.severity = severity;
  issue.kind = kRunIssue;
  issue.message = std::move(message);
  issue.where.text = file.string();
  return issue;
}

/// Compares one file that the report names.
std::optional<Issue> compare(const Record& record, const std::string& name) {
  const fs::path file = record.folder / name;
  std::error_code error;
  if (!fs::exists(file, error))
    return finding(
        Severity::error, file,
        "report.json of run " + record.run + " names the file, but it is missing; write the results anew");
  const Result<Fingerprint> fingerprint = fingerprintOfFile(file);
  if (!fingerprint) return finding(Severity::error, file, fingerprint.error().message);
  if (fingerprintText(*fingerprint) == record.fingerprints.at(name)) return std::nullopt;
  if (isModuleFile(file)) {
    const Result<std::string> bytes = readFile(file, kLargestModule);
    const std::string run = bytes ? robotio::runOfModule(*bytes) : std::string();
    if (run == record.run)
      return finding(Severity::warning, file, "the module was changed since run " + run + " wrote it");
    return finding(Severity::error, file,
                   "the module is of " + (run.empty() ? "no run that it names" : "run " + run) +
                       ", but report.json is of run " + record.run + "; write the results anew");
  }
  return finding(Severity::error, file,
                 "the file is of another run than report.json (run " + record.run +
                     ") or was changed since; write the results anew");
}

}  // namespace

std::string runId(const Evaluation& e, const Cell* cell) {
  json job = json::parse(jobToJson(e.design.job));
  for (const char* output : {"programs", "threads", "cell"}) job.erase(output);
  Values f;
  f.text(BW_VERSION).text(job.dump()).text(fingerprintText(e.source.value->content)).number(cell ? 1 : 0);
  if (cell) add(f, *cell);
  add(f, e.sweep.value->motion);
  return f.name();
}

bool isResultFolder(const fs::path& folder) {
  const Result<std::optional<Record>> record = recordOf(folder);
  return record && record->has_value();
}

Issues compareWithReport(const fs::path& path) {
  Issues issues;
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  if (error) return issues;
  fs::path folder = whole;
  for (int level = 0; level <= kLevels; ++level, folder = folder.parent_path()) {
    const Result<std::optional<Record>> record = recordOf(folder);
    if (!record) {
      issues.push_back(finding(Severity::error, folder / "report.json", record.error().message));
      return issues;
    }
    if (!*record) continue;
    const fs::path inside = whole.lexically_relative(folder);
    bool concerned = false;
    for (const auto& [name, fingerprint] : (*record)->fingerprints) {
      if (inside != "." && inside != name && !liesWithin(name, inside)) continue;
      concerned = true;
      if (std::optional<Issue> issue = compare(**record, name)) issues.push_back(std::move(*issue));
    }
    // Programs that the report does not name, in its own place for them.
    if (!concerned && !inside.empty() && *inside.begin() == "programs")
      issues.push_back(
          finding(Severity::error, whole,
                  "report.json of run " + (*record)->run + " names no program here; write the results anew"));
    return issues;
  }
  return issues;
}

Result<void> checkOneRun(const fs::path& folder, const std::string& designFile) {
  const Result<std::optional<Record>> record = recordOf(folder);
  if (!record) return tl::unexpected<Error>(record.error());
  if (!*record) return {};
  for (const std::string& name : {designFile, std::string("sweep.json")}) {
    if ((*record)->fingerprints.count(name) == 0) continue;
    const std::optional<Issue> issue = compare(**record, name);
    if (!issue) continue;
    const std::string file = (folder / designFile).string();
    return fail(ErrorCode::badInput,
                issue->where.text + ": " + issue->message + " (blade design " + file + " --out " +
                    folder.string() + "), or give " + file + " itself",
                issue->where.text);
  }
  return {};
}

}  // namespace bw::pipeline
