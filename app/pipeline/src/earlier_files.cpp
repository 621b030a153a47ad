// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/earlier_files.h"

#include <set>
#include <string>
#include <system_error>

#include "program_unit.h"
#include "report_record.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

/// The tasks of a strip whose folder is named by us: another cell may have had others.
void addTasks(const fs::path& strip, std::set<fs::path>& found) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(strip, error))) return;
  for (fs::directory_iterator it(strip, error), end; !error && it != end; it.increment(error))
    found.merge(ownModules(it->path()));
}

/// True for "programs/…" that stays inside and meets no link on its way.
bool isPlainProgramPath(const fs::path& folder, const fs::path& path) {
  if (path.is_absolute() || path.empty() || *path.begin() != "programs" || !isProgramFile(path)) return false;
  std::error_code error;
  fs::path whole = folder;
  for (const fs::path& part : path) {
    if (part == ".." || part == "." || part.empty()) return false;
    whole /= part;
    const fs::file_status status = fs::symlink_status(whole, error);
    if (fs::is_symlink(status) || !fs::exists(status)) return false;
  }
  return fs::is_regular_file(fs::symlink_status(whole, error));
}

/// The programs that the report of an earlier run lists.
void addListed(const fs::path& folder, std::set<fs::path>& found) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  if (!record || !*record) return;
  for (const std::string& name : (*record)->files)
    if (isPlainProgramPath(folder, name)) found.insert(folder / name);
}

}  // namespace

std::vector<fs::path> earlierFiles(const fs::path& folder, const FileSet& files) {
  std::set<fs::path> found, strips, tasks;
  for (const fs::path& path : files.paths()) {
    if (path == "report.json") addListed(folder, found);
    if (!isProgramFile(path)) continue;
    const fs::path inside = path.parent_path();
    strips.insert(isRobotFile(path) ? inside.parent_path() : inside);
    if (isRobotFile(path)) tasks.insert(inside);
  }
  for (const fs::path& strip : strips) {
    found.merge(ownMotions(strip.empty() ? folder : folder / strip));
    if (strip.filename().string().rfind("strip-", 0) == 0) addTasks(folder / strip, found);
  }
  for (const fs::path& task : tasks) found.merge(ownModules(folder / task));
  for (const fs::path& path : files.paths()) found.erase(folder / path);
  std::vector<fs::path> earlier;
  for (const fs::path& file : found) earlier.push_back(file.lexically_relative(folder));
  return earlier;
}

}  // namespace bw::pipeline
