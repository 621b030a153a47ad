// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/run_identity.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include "bw/core/design/design_versions.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/files/temporary_name.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/rapid/rapid.h"
#include "bw/words/findings.h"
#include "make_files.h"
#include "program_unit.h"
#include "report_record.h"

namespace bw::pipeline {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLargestModule = std::size_t(64) << 20;
constexpr const char* kProgramFolder = "programs";
constexpr const char* kSweepFile = "sweep.json";
constexpr int kDeepest = 12;  ///< below programs/, where a link may lead back
constexpr int kLevels = 5;    ///< from a module up to its report: task, strip, block, programs, results

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
    f.number(task.arm.has_value());
    if (task.arm) {
      const RobotArm& a = *task.arm;
      for (const double length : {a.d1, a.a1, a.a2, a.a3, a.d4, a.d6}) f.number(length);
      for (const auto& [from, to] : a.range) f.number(from).number(to);
    }
  }
}

void add(Values& f, const Motion& motion) {
  const Frame& frame = motion.block.frame;
  for (const Eigen::Vector3d& v : {frame.origin, frame.x, frame.y, frame.normal, motion.block.size})
    add(f, v);
  f.number(motion.bladeLength).number(motion.cuttingSpeed).number(motion.cornersWithin);
  f.number(double(motion.instants.size()));
  for (const MotionInstant& instant : motion.instants) {
    f.number(instant.time).number(instant.station);
    for (const Pose& pose : instant.poses) add(f, pose);
  }
}

using What = RunMismatch::What;

Finding finding(Severity severity, What what, const fs::path& file, const std::string& run = {},
                const std::string& other = {}, const std::string& text = {}) {
  return {severity, RunMismatch{what, file.string(), run, other, text}};
}

struct ModuleHead {
  std::string run;    ///< that it names, or empty
  bool ours = false;  ///< a module of ours, under its own name
};

ModuleHead headOfFile(const fs::path& module) {
  const Result<std::string> bytes = readFile(module, kLargestModule);
  if (!bytes) return {};
  return {robotio::runOfModule(*bytes), bytes->rfind("MODULE " + module.stem().string(), 0) == 0 &&
                                            bytes->find("! Bladewright: ") != std::string::npos};
}

/// The names of all files that the report tells of.
std::set<std::string> namesOf(const ReportRecord& record) {
  std::set<std::string> names = record.files;
  for (const auto& [name, fingerprint] : record.fingerprints) names.insert(name);
  return names;
}

/// Compares one file that the report names.
std::optional<Finding> compare(const ReportRecord& record, const std::string& name) {
  const fs::path file = record.folder / name;
  std::error_code error;
  if (!fs::exists(file, error)) return finding(Severity::error, What::missing, file, record.run);
  const Result<Fingerprint> fingerprint = fingerprintOfFile(file);
  if (!fingerprint)
    return finding(Severity::error, What::unreadable, file, record.run, {}, fingerprint.error().message);
  const auto told = record.fingerprints.find(name);
  if (told == record.fingerprints.end())
    return finding(Severity::error, What::noFingerprint, file, record.run);
  const bool same = fingerprintText(*fingerprint) == told->second;
  if (!robotio::isModuleFile(file.string()))
    return same ? std::nullopt : std::optional(finding(Severity::error, What::otherFile, file, record.run));
  const std::string run = headOfFile(file).run;
  if (same && run == record.run) return std::nullopt;
  return run == record.run ? finding(Severity::warning, What::changedModule, file, run)
                           : finding(Severity::error, What::moduleOfOther, file, record.run, run);
}

/// An error for each module of another run at `place`, a file or folder, which the report does not name.
void addStrays(const ReportRecord& record, const fs::path& place, Findings& findings) {
  const std::set<std::string> names = namesOf(record);
  const auto look = [&](const fs::path& file) {
    const std::string name = file.lexically_relative(record.folder).generic_string();
    if (!robotio::isModuleFile(file.string()) || names.count(name) > 0) return;
    const ModuleHead head = headOfFile(file);
    if ((head.ours || !head.run.empty()) && head.run != record.run)
      findings.push_back(finding(Severity::error, What::strayModule, file, record.run, head.run));
  };
  std::error_code error;
  if (fs::is_regular_file(place, error)) look(place);
  if (!fs::is_directory(place, error)) return;
  constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
  for (fs::recursive_directory_iterator it(place, kFollow, error), end; !error && it != end;
       it.increment(error)) {
    // What a writer has under way, or left when it was ended, is no robot's.
    const bool temporary = isTemporaryName(it->path().filename().string());
    if (temporary || it.depth() >= kDeepest) it.disable_recursion_pending();
    if (std::error_code ignored; !temporary && it->is_regular_file(ignored)) look(it->path());
  }
}

/// Compares what lies at `inside` of the record's folder.
Findings compareInside(const ReportRecord& record, const fs::path& inside) {
  Findings findings;
  if (record.run.empty())
    return {finding(Severity::error, What::reportNamesNoRun, record.folder / "report.json")};
  bool concerned = false;
  for (const std::string& name : namesOf(record)) {
    if (inside != "." && inside != name && !liesWithin(name, inside)) continue;
    concerned = true;
    if (std::optional<Finding> found = compare(record, name)) findings.push_back(std::move(*found));
  }
  const bool ofPrograms = !inside.empty() && *inside.begin() == kProgramFolder;
  if (inside == "." || ofPrograms) {
    const std::size_t before = findings.size();
    addStrays(record, record.folder / (ofPrograms ? inside : fs::path(kProgramFolder)), findings);
    concerned = concerned || findings.size() > before;
  }
  if (!concerned && ofPrograms)
    findings.push_back(finding(Severity::error, What::noProgramHere, record.folder / inside, record.run));
  return findings;
}

}  // namespace

std::string runId(const Evaluation& e, const Cell* cell) {
  // All that the results depend on, and nothing that only names it or chooses among outputs.
  Design inputs = withoutVersions(e.design);
  inputs.name.clear();
  inputs.output = {{}, {}};
  // The numbers that these came to are in the design and in the surface.
  inputs.variables.clear();
  inputs.bindings.clear();
  for (Source& source : inputs.sources) {
    source.surface.reset();
    source.path.clear();
    source.bytes.clear();
    source.saved.reset();
    source.curveNames.clear();
    source.drawing.reset();
  }
  Values f;
  f.text(BW_VERSION).text(designToJson(inputs)).text(fingerprintText(e.source.value->content));
  for (const Stage<SourceRequest, CadSource>& other : e.further)
    f.text(fingerprintText(other.value->content));
  f.number(cell ? 1 : 0);
  if (cell) add(f, *cell);
  for (const Strip& strip : stripsOf(e)) add(f, *strip.cut->motion.value);
  return f.name();
}

bool isResultFolder(const fs::path& folder) {
  std::error_code error;
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  return !record || record->has_value() || fs::is_regular_file(folder / kSweepFile, error) ||
         fs::is_directory(folder / kProgramFolder, error);
}

Findings compareWithReport(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  if (error) return {};
  fs::path folder = whole;
  for (int level = 0; level <= kLevels; ++level, folder = folder.parent_path()) {
    const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
    if (!record) {
      if (record.error().code != ErrorCode::cannotRead)
        return {finding(Severity::error, What::reportDamaged, folder / "report.json")};
      return {
          finding(Severity::error, What::unreadable, folder / "report.json", {}, {}, record.error().message)};
    }
    if (*record) return compareInside(**record, whole.lexically_relative(folder));
  }
  if (!isResultFolder(whole)) return {};
  return {finding(Severity::error, What::reportMissing, whole / "report.json")};
}

Result<void> checkOneRun(const fs::path& folder, const std::string& designFile) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  if (!record) return tl::unexpected<Error>(record.error());
  if (!*record) return {};
  const std::set<std::string> names = namesOf(**record);
  const std::string file = (folder / designFile).string();
  const std::string remedy =
      " (blade design " + file + " --out " + folder.string() + "), or give " + file + " itself";
  if ((*record)->run.empty())
    return fail(ErrorCode::badInput,
                (folder / "report.json").string() + " names no run; write the results anew" + remedy, file);
  if (names.count(designFile) == 0)
    return fail(ErrorCode::badInput,
                file + ": report.json of run " + (*record)->run +
                    " does not name the design; write the results anew" + remedy,
                file);
  for (const std::string& name : {designFile, std::string(kSweepFile)}) {
    if (names.count(name) == 0) continue;
    if (const std::optional<Finding> found = compare(**record, name)) {
      const std::string place = words::placeText(*found);
      return fail(ErrorCode::badInput,
                  place + ": " + words::sentence(*found, words::Reader::commandLine) + remedy, place);
    }
  }
  return {};
}

CutLengths lengthsMadeWith(const fs::path& folder) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  return record && *record ? (*record)->lengths : CutLengths();
}

std::vector<std::string> errorsOfReport(const fs::path& folder) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  return record && *record ? (*record)->errors : std::vector<std::string>();
}

CutLengths foundLengths(const fs::path& folder) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  if (!record || !*record) return {};
  CutLengths found = (*record)->lengths;
  std::erase_if(found, [&](const auto& of) { return !(*record)->found.contains(of.first); });
  return found;
}

}  // namespace bw::pipeline
