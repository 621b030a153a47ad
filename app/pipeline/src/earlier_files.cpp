// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/earlier_files.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>

#include "program_unit.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHead = 4096;  ///< bytes of a file in which it says who wrote it
constexpr std::size_t kLargestReport = std::size_t(256) << 20;

std::string headOf(const fs::path& file) {
  std::string head(kHead, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(std::max<std::streamsize>(stream.gcount(), 0)));
  return head;
}

bool names(const fs::path& file, const std::string& text) {
  return headOf(file).find(text) != std::string::npos;
}

/// The regular files of a folder; none where it is not one or is reached through a link.
std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return files;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (fs::is_regular_file(it->symlink_status(error))) files.push_back(it->path());
  return files;
}

/// "Left_001" is the first part of "Left".
bool isPartOf(const std::string& name, const std::string& whole) {
  return name.size() > whole.size() + 1 && name.compare(0, whole.size(), whole) == 0 &&
         name[whole.size()] == '_' &&
         name.find_first_not_of("0123456789", whole.size() + 1) == std::string::npos;
}

/// True for a module under its own name; a copy that somebody saved under another is theirs.
bool bearsItsName(const fs::path& module) {
  return headOf(module).rfind("MODULE " + module.stem().string() + "\r\n", 0) == 0;
}

/// What we wrote into the folder of a task.
void addTask(const fs::path& folder, std::set<fs::path>& found) {
  const std::vector<fs::path> files = filesIn(folder);
  std::set<std::string> ours;  // stems of modules
  for (const fs::path& file : files)
    if (isModuleFile(file) && bearsItsName(file) && names(file, "! Bladewright: "))
      ours.insert(file.stem().string());
  const auto isOurs = [&](const std::string& stem) {
    return std::any_of(ours.begin(), ours.end(),
                       [&](const std::string& o) { return stem == o || isPartOf(stem, o); });
  };
  for (const fs::path& file : files) {
    if (isModuleFile(file) && isOurs(file.stem().string()) && bearsItsName(file)) found.insert(file);
    if (file.extension() == ".pgf" && isOurs(file.stem().string()) &&
        names(file, "<Module>" + file.stem().string() + ".mod"))
      found.insert(file);
  }
}

/// The motions that we wrote into the folder of a strip.
void addMotions(const fs::path& strip, std::set<fs::path>& found) {
  for (const fs::path& file : filesIn(strip))
    if (isMotionFile(file) &&
        names(file, file.extension() == ".csv" ? "time_s,station," : "\"bladewright-motion\""))
      found.insert(file);
}

/// The tasks of a strip whose folder is named by us: another cell may have had others.
void addTasks(const fs::path& strip, std::set<fs::path>& found) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(strip, error))) return;
  for (fs::directory_iterator it(strip, error), end; !error && it != end; it.increment(error))
    addTask(it->path(), found);
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
  std::error_code error;
  const fs::path file = folder / "report.json";
  if (!fs::is_regular_file(file, error)) return;
  const Result<std::string> text = readFile(file, kLargestReport);
  if (!text) return;
  const nlohmann::json report = nlohmann::json::parse(*text, nullptr, false);
  if (!report.is_object() || !report.contains("bladewright_report") || !report.contains("files")) return;
  for (const nlohmann::json& name : report["files"]) {
    if (!name.is_string()) continue;
    const fs::path path = name.get<std::string>();
    if (isPlainProgramPath(folder, path)) found.insert(folder / path);
  }
}

}  // namespace

std::vector<fs::path> earlierFiles(const fs::path& folder, const FileSet& files) {
  std::set<fs::path> found, strips, tasks;
  for (const fs::path& path : files.paths()) {
    if (path == "report.json") addListed(folder, found);
    if (isMotionFile(path)) strips.insert(path.parent_path());
    if (!isModuleFile(path)) continue;
    tasks.insert(path.parent_path());
    strips.insert(path.parent_path().parent_path());
  }
  for (const fs::path& strip : strips) {
    addMotions(strip.empty() ? folder : folder / strip, found);
    if (strip.filename().string().rfind("strip-", 0) == 0) addTasks(folder / strip, found);
  }
  for (const fs::path& task : tasks) addTask(folder / task, found);
  for (const fs::path& path : files.paths()) found.erase(folder / path);
  std::vector<fs::path> earlier;
  for (const fs::path& file : found) earlier.push_back(file.lexically_relative(folder));
  return earlier;
}

}  // namespace bw::pipeline
