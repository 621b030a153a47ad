// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "program_unit.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "bw/core/files/temporary_name.h"
#include "bw/robotio/dialects.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHead = 4096;  ///< bytes of a file in which it says who wrote it

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

std::string headOf(const fs::path& file) {
  std::string head(kHead, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(std::max<std::streamsize>(stream.gcount(), 0)));
  return head;
}

/// Those of the programs straight in a folder that we wrote: of the dialects that robots run, or of the
/// others. None where the folder is reached through a link.
std::set<fs::path> ownFiles(const fs::path& folder, bool ofRobots) {
  std::set<fs::path> found;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return found;
  robotio::Program heads;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (fs::is_regular_file(it->symlink_status(error)) && isProgramFile(it->path()))
      heads.push_back({it->path().filename().string(), headOf(it->path())});
  for (const robotio::Dialect& dialect : robotio::dialects())
    if ((dialect.check != nullptr) == ofRobots)
      for (const robotio::ProgramFile& file : dialect.own(robotio::filesOf(dialect, heads)))
        found.insert(folder / file.path);
  return found;
}

}  // namespace

bool isRobotFile(const fs::path& file) {
  const robotio::Dialect* dialect = robotio::dialectOfFile(file.string());
  return dialect && dialect->check;
}

bool isProgramFile(const fs::path& file) { return robotio::dialectOfFile(file.string()) != nullptr; }

std::set<fs::path> ownModules(const fs::path& folder) { return ownFiles(folder, true); }
std::set<fs::path> ownMotions(const fs::path& folder) { return ownFiles(folder, false); }

std::vector<fs::path> programUnits(const fs::path& folder, const FileSet& files) {
  std::set<fs::path> units;
  for (const fs::path& path : files.paths()) {
    if (!isProgramFile(path)) continue;
    const fs::path inside = path.parent_path();
    const fs::path strip = isRobotFile(path) ? inside.parent_path() : inside;
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
  std::set<fs::path> ours = ownModules(former);
  ours.merge(ownMotions(former));
  std::vector<fs::path> entries;
  for (fs::directory_iterator it(former, error), end; !error && it != end; it.increment(error))
    entries.push_back(it->path());
  for (const fs::path& entry : entries) {
    const fs::path twin = live / entry.filename();
    const bool taken = fs::exists(fs::symlink_status(twin, error));
    if (fs::is_directory(fs::symlink_status(entry, error))) {
      dissolve(entry, twin);
    } else if (isOneFile(entry, twin) || ours.count(entry) > 0 || (taken && isProgramFile(entry)) ||
               isTemporaryName(entry.filename().string())) {
      fs::remove(entry, error);
    } else if (!taken) {
      fs::create_directories(live, error);
      fs::rename(entry, twin, error);
    }
  }
  ::rmdir(former.c_str());
}

}  // namespace bw::pipeline
