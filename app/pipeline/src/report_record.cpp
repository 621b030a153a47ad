// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "report_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bw/core/files/file_set.h"

namespace bw::pipeline {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLargestReport = std::size_t(256) << 20;  ///< bytes
constexpr const char* kOurs = "bladewright_report";
constexpr int kFormat = 1;

/// True for a path that leads out of no folder.
bool staysInside(const fs::path& path) {
  return !path.empty() && path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

std::optional<double> numberOf(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// Each strip tells its own where there are several; else the blade does.
void readLengths(const json& report, ReportRecord& record) {
  const json none = json::object();
  const auto in = [&](const json& object, const char* key) -> const json& {
    const auto found = object.find(key);
    return found != object.end() && found->is_object() ? *found : none;
  };
  const json& blade = in(report, "blade");
  const std::optional<double> best = numberOf(in(blade, "lengths"), "best");
  const auto strips = report.find("strips");
  if (strips == report.end() || !strips->is_array()) return;
  for (const json& strip : *strips) {
    const auto cut = strip.is_object() ? strip.find("cut") : strip.end();
    if (cut == strip.end() || !cut->is_string()) continue;
    const std::optional<double> own = numberOf(strip, "blade_length"),
                                length = own ? own : numberOf(blade, "length"),
                                serves = own ? numberOf(strip, "best_length") : best;
    if (!length || !(*length > 0 && *length <= Blade::kLongest)) continue;
    record.lengths[cut->get<std::string>()] = *length;
    if (serves == length) record.found.insert(cut->get<std::string>());
  }
}

/// The errors that it tells among its issues.
void readErrors(const json& report, ReportRecord& record) {
  const auto issues = report.find("issues");
  if (issues == report.end() || !issues->is_array()) return;
  const auto textOf = [](const json& issue, const char* key) {
    const auto text = issue.find(key);
    return text != issue.end() && text->is_string() ? text->get<std::string>() : std::string();
  };
  for (const json& issue : *issues)
    if (issue.is_object() && textOf(issue, "severity") == severityName(Severity::error))
      record.errors.push_back(textOf(issue, "message"));
}

}  // namespace

Result<std::optional<ReportRecord>> readReportRecord(const fs::path& folder) {
  std::error_code error;
  const fs::path file = folder / "report.json";
  if (!fs::exists(file, error)) return std::nullopt;
  const Result<std::string> text = readFile(file, kLargestReport);
  // Beside results of ours, or where it names us, it is no other program's.
  const bool amongOurs = fs::exists(folder / "sweep.json", error);
  if (!text && amongOurs) return tl::unexpected<Error>(text.error());
  if (!text) return std::nullopt;
  const json report = json::parse(*text, nullptr, false);
  const auto format = report.is_object() ? report.find(kOurs) : report.end();
  if (format == report.end() || *format != kFormat) {
    const bool ours = format != report.end() || amongOurs ||
                      text->find("\"" + std::string(kOurs) + "\"") != std::string::npos;
    if (!ours) return std::nullopt;
    return fail(ErrorCode::badInput,
                file.string() + " is damaged, or of another version of the program; write the results anew",
                file.string());
  }
  ReportRecord record;
  record.folder = folder;
  if (const auto run = report.find("run"); run != report.end() && run->is_string())
    record.run = run->get<std::string>();
  readLengths(report, record);
  readErrors(report, record);
  if (const auto files = report.find("files"); files != report.end() && files->is_array())
    for (const json& name : *files)
      if (name.is_string() && staysInside(name.get<std::string>())) record.files.insert(name);
  if (const auto prints = report.find("fingerprints"); prints != report.end() && prints->is_object())
    for (const auto& [name, value] : prints->items())
      if (value.is_string() && staysInside(name)) record.fingerprints[name] = value.get<std::string>();
  record.files.erase("report.json");
  return record;
}

}  // namespace bw::pipeline
