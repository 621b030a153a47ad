// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "program_unit.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

#include "bw/core/temporary_name.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

/// True if all folders from `folder` down to `unit` are real and on one file system. A unit that is not there
/// yet will be.
bool canBeExchanged(const fs::path& folder, const fs::path& unit) {
  struct stat outer {};
  if (::stat(folder.c_str(), &outer) != 0) return false;
  fs::path whole = folder;
  for (const fs::path& part : unit) {
    whole /= part;
    struct stat inner {};
    if (::lstat(whole.c_str(), &inner) != 0) return true;
    if (!S_ISDIR(inner.st_mode) || inner.st_dev != outer.st_dev) return false;
  }
  return true;
}

bool isOneFile(const fs::path& a, const fs::path& b) {
  struct stat first {};
  struct stat second {};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 &&
         first.st_ino == second.st_ino && first.st_dev == second.st_dev;
}

/// Links what is in `live` / `inner`; a folder of ours that nothing is left in is not made again.
bool linkFolder(const fs::path& live, const fs::path& fresh, const fs::path& inner,
                const std::set<fs::path>& gone) {
  // A folder that somebody made read-only is not to be changed by way of the one above it.
  if (::access((live / inner).c_str(), W_OK | X_OK) != 0) return false;
  std::error_code error;
  std::vector<fs::directory_entry> entries;
  for (fs::directory_iterator it(live / inner, error), end; !error && it != end; it.increment(error))
    entries.push_back(*it);
  if (error) return false;
  if (entries.empty()) fs::create_directories(fresh / inner, error);  // somebody's empty folder
  for (const fs::directory_entry& entry : entries) {
    const fs::path path = inner / entry.path().filename();
    if (gone.count(path) > 0) continue;
    if (fs::is_directory(entry.symlink_status(error))) {
      if (!linkFolder(live, fresh, path, gone)) return false;
      continue;
    }
    fs::create_directories(fresh / inner, error);
    if (error || ::linkat(AT_FDCWD, entry.path().c_str(), AT_FDCWD, (fresh / path).c_str(), 0) != 0)
      return false;
  }
  struct stat former {};
  if (::stat((live / inner).c_str(), &former) == 0) ::chmod((fresh / inner).c_str(), former.st_mode & 07777);
  return true;
}

}  // namespace

bool isModuleFile(const fs::path& file) { return file.extension() == ".mod" || file.extension() == ".modx"; }

bool isMotionFile(const fs::path& file) {
  return file.filename() == "motion.csv" || file.filename() == "motion.json";
}

bool isProgramFile(const fs::path& file) {
  return isModuleFile(file) || file.extension() == ".pgf" || isMotionFile(file);
}

std::vector<fs::path> programUnits(const fs::path& folder, const FileSet& files) {
  std::set<fs::path> units;
  for (const fs::path& path : files.paths()) {
    if (!isProgramFile(path)) continue;
    const fs::path inside = path.parent_path();
    const fs::path strip = isMotionFile(path) ? inside : inside.parent_path();
    const fs::path& unit = strip.empty() ? inside : strip;
    if (!unit.empty() && canBeExchanged(folder, unit)) units.insert(unit);
  }
  return {units.begin(), units.end()};
}

bool liesWithin(const fs::path& path, const fs::path& unit) {
  const fs::path rest = path.lexically_relative(unit);
  return !rest.empty() && *rest.begin() != ".." && rest != ".";
}

bool linkOthers(const fs::path& live, const fs::path& fresh, const std::set<fs::path>& gone) {
  std::error_code error;
  return !fs::exists(fs::symlink_status(live, error)) || linkFolder(live, fresh, {}, gone);
}

void dissolve(const fs::path& former, const fs::path& live) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator it(former, error), end; !error && it != end; it.increment(error))
    entries.push_back(it->path());
  for (const fs::path& entry : entries) {
    const fs::path twin = live / entry.filename();
    if (fs::is_directory(fs::symlink_status(entry, error))) {
      dissolve(entry, twin);
    } else if (isOneFile(entry, twin) || isProgramFile(entry) || isTemporaryName(entry.filename().string())) {
      fs::remove(entry, error);
    } else if (!fs::exists(fs::symlink_status(twin, error))) {
      fs::create_directories(live, error);
      fs::rename(entry, twin, error);
    }
  }
  ::rmdir(former.c_str());
}

}  // namespace bw::pipeline
