// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/pipeline/result_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

#include "bw/core/files/fingerprint.h"
#include "bw/core/files/folder_lock.h"
#include "bw/core/files/replacement.h"
#include "bw/core/files/temporary_name.h"
#include "program_unit.h"
#include "report_record.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

/// Clears away what dead writers left in the folders that are written to.
void clearDead(const fs::path& folder, const FileSet& files) {
  std::set<fs::path> folders = {folder};
  for (const fs::path& path : files.paths())
    for (fs::path parent = path.parent_path(); !parent.empty(); parent = parent.parent_path())
      folders.insert(folder / parent);
  std::error_code error;
  for (const fs::path& place : folders) {
    removeDeadFiles(place);
    for (const fs::path& left : leftByDeadWriters(place))
      if (fs::is_directory(fs::symlink_status(left, error))) dissolve(left, placeOfTemporary(left));
  }
}

/// Prepares the new folder of a unit. False if what others put there cannot be in it.
Result<bool> prepareUnit(Replacement& replacement, const fs::path& folder, const fs::path& unit,
                         const FileSet& files, const std::vector<fs::path>& earlier) {
  Result<fs::path> fresh = replacement.folder(folder / unit);
  if (!fresh) return tl::unexpected<Error>(fresh.error());
  std::set<fs::path> gone;
  for (const fs::path& path : earlier)
    if (liesWithin(path, unit)) gone.insert(path.lexically_relative(unit));
  for (std::size_t i = 0; i < files.paths().size(); ++i) {
    const fs::path& path = files.paths()[i];
    if (!liesWithin(path, unit)) continue;
    const fs::path inner = path.lexically_relative(unit);
    gone.insert(inner);
    if (Result<void> ok = replacement.fill(*fresh / inner, files.bytes()[i], folder / path); !ok)
      return tl::unexpected<Error>(ok.error());
  }
  return linkOthers(folder / unit, *fresh, gone);
}

/// Puts all in place; with the folders of `units` as a whole. Nothing if those cannot be exchanged.
Result<bool> replaceAll(const FileSet& files, const fs::path& folder, const std::vector<fs::path>& units,
                        const std::vector<fs::path>& earlier, const RunContext& context) {
  Replacement replacement(context);
  const auto isInUnit = [&](const fs::path& path) {
    return std::any_of(units.begin(), units.end(),
                       [&](const fs::path& unit) { return liesWithin(path, unit); });
  };
  for (const fs::path& path : earlier)
    if (!isInUnit(path)) replacement.removal(folder / path);
  for (const fs::path& unit : units) {
    const Result<bool> whole = prepareUnit(replacement, folder, unit, files, earlier);
    if (!whole || !*whole) return whole;
  }
  for (std::size_t i = 0; i < files.paths().size(); ++i) {
    const fs::path& path = files.paths()[i];
    if (isInUnit(path)) continue;
    if (Result<void> ok = replacement.file(folder / path, files.bytes()[i], isProgramFile(path)); !ok)
      return tl::unexpected<Error>(ok.error());
  }
  if (Result<void> ok = replacement.commit(); !ok) return tl::unexpected<Error>(ok.error());
  std::error_code error;
  for (const auto& [former, live] : replacement.formerFolders()) {
    for (const fs::path& unit : units)
      for (const fs::path& path : earlier)
        if (liesWithin(path, unit) && fs::equivalent(folder / unit, live, error))
          fs::remove(former / path.lexically_relative(unit), error);
    dissolve(former, live);
  }
  return true;
}

/// The tasks of a strip whose folder is named by us: another cell may have had others.
void addTasks(const fs::path& strip, std::set<fs::path>& found) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(strip, error))) return;
  for (fs::directory_iterator it(strip, error), end; !error && it != end; it.increment(error))
    found.merge(ownModules(it->path()));
}

/// True for a file that lies inside and meets no link on its way.
bool isPlainPath(const fs::path& folder, const fs::path& path) {
  if (path.is_absolute() || path.empty()) return false;
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

/// What the report of an earlier run lists: its programs, and of all else what is still as it was written.
void addListed(const fs::path& folder, std::set<fs::path>& found) {
  const Result<std::optional<ReportRecord>> record = readReportRecord(folder);
  if (!record || !*record) return;
  for (const std::string& name : (*record)->files) {
    if (!isPlainPath(folder, name)) continue;
    if (liesWithin(name, "programs") && isProgramFile(name)) {
      found.insert(folder / name);
      continue;
    }
    const auto told = (*record)->fingerprints.find(name);
    if (told == (*record)->fingerprints.end()) continue;
    const Result<Fingerprint> is = fingerprintOfFile(folder / name);
    if (is && fingerprintText(*is) == told->second) found.insert(folder / name);
  }
}

}  // namespace

FolderState folderState(const fs::path& folder) {
  FolderState state;
  std::set<fs::path> files = {folder / "report.json"};
  for (const char* strip : {"programs/strip-0", "strip-0", ""}) {
    files.merge(ownMotions(folder / strip));
    for (const char* task : {"T_ROB1", "T_ROB2"}) files.merge(ownModules(folder / strip / task));
  }
  for (const fs::path& file : files) {
    struct stat entry {};
    if (::stat(file.c_str(), &entry) != 0) continue;
    state.text += file.string() + " " + std::to_string(entry.st_ino) + " " +
                  std::to_string(entry.st_mtim.tv_sec) + "." + std::to_string(entry.st_mtim.tv_nsec) + "\n";
  }
  return state;
}

bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::is_regular_file(a, error) && fs::equivalent(a, b, error) && !error;
}

Result<std::vector<fs::path>> commitAfresh(const FileSet& files, const fs::path& folder,
                                           const std::vector<fs::path>& inputs, const RunContext& context,
                                           const std::optional<FolderState>& seen) {
  const fs::path place = folder.empty() ? fs::path(".") : folder;
  for (const fs::path& path : files.paths())
    for (const fs::path& input : inputs)
      if (sameFile(place / path, input))
        return fail(ErrorCode::badInput,
                    (place / path).string() + " is what the results are made from; choose another folder",
                    (place / path).string());
  Replacement made;  // the folder itself goes away again if nothing comes of it
  if (Result<void> ok = made.makeFolder(place); !ok) return tl::unexpected<Error>(ok.error());
  const Result<FolderLock> lock = FolderLock::take(place);
  if (!lock) return tl::unexpected<Error>(lock.error());
  if (seen && folderState(place) != *seen)
    return fail(ErrorCode::cannotWrite,
                "nothing was written to " + place.string() +
                    ", because another run was put there while this one was computed; choose another folder, "
                    "or run again",
                place.string());
  clearDead(place, files);
  std::vector<fs::path> earlier = earlierFiles(place, files);
  std::erase_if(earlier, [&](const fs::path& path) {
    return std::ranges::any_of(inputs, [&](const fs::path& input) { return sameFile(place / path, input); });
  });
  const std::vector<fs::path> units = programUnits(place, files);
  Result<bool> done = replaceAll(files, place, units, earlier, context);
  const bool stopped = !done && done.error().code == ErrorCode::cancelled;
  if (!stopped && !units.empty() && (!done || !*done)) done = replaceAll(files, place, {}, earlier, context);
  if (!done) return tl::unexpected<Error>(done.error());
  if (Result<void> ok = made.commit(); !ok) return tl::unexpected<Error>(ok.error());
  // A folder that is left empty goes too; one that is not stays, because this does not remove it.
  std::error_code error;
  for (const fs::path& path : earlier)
    for (fs::path parent = path.parent_path(); !parent.empty(); parent = parent.parent_path())
      if (!fs::remove(place / parent, error) || error) break;
  return earlier;
}

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
