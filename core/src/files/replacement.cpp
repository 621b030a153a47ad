// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/replacement.h"

#include <sys/stat.h>
#include <cstdio>

#include <algorithm>
#include <cerrno>
#include <set>
#include <system_error>

#include "bw/core/files/temporary_name.h"
#include "files/file_writing.h"

namespace bw {

namespace fs = std::filesystem;

namespace {

constexpr int kMostLinks = 40;  ///< that lead to one another, as for the system

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

fs::path parentOf(const fs::path& path) {
  const fs::path parent = path.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// True if the system, or this file system, cannot exchange two names; nothing was done then.
bool hasNoExchange(int error) {
  return error == EINVAL || error == ENOSYS || error == ENOTSUP || error == EOPNOTSUPP;
}

}  // namespace

Replacement::Replacement(RunContext context, bool exchange)
    : context_(std::move(context)), exchange_(exchange) {}

Replacement::~Replacement() {
  std::error_code ignored;
  if (!settled_) {
    for (const Step& step : steps_)
      if (!step.part.empty()) fs::remove_all(step.part, ignored);
    for (auto it = made_.rbegin(); it != made_.rend(); ++it) fs::remove(*it, ignored);
  }
}

Result<void> Replacement::makeFolder(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path p = folder; !p.empty() && !fs::exists(p, error); p = p.parent_path()) missing.push_back(p);
  for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
    if (fs::create_directory(*it, error)) made_.push_back(*it);
    if (error) return cannotWrite(*it, error.value());
  }
  if (!fs::is_directory(folder, error))
    return fail(ErrorCode::cannotWrite,
                "cannot write into " + folder.string() + ": it is not a folder; choose another name",
                folder.string());
  return {};
}

Result<void> Replacement::file(const fs::path& target, std::string bytes, bool together) {
  if (Result<void> ok = makeFolder(parentOf(target)); !ok) return ok;
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status))
    return fail(
        ErrorCode::cannotWrite,
        "cannot write " + target.string() + ": a folder of that name is in the way; choose another folder",
        target.string());
  Step step;
  step.target = target;
  step.together = together;
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    step.isDirect = true;
    step.direct = std::move(bytes);
    steps_.push_back(std::move(step));
    return {};
  }
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(step.target, error)); ++i)
    step.target = step.target.parent_path() / fs::read_symlink(step.target, error);
  step.part = temporaryName(step.target);
  steps_.push_back(step);
  return writeSynced(step.part, bytes, target, context_);
}

Result<fs::path> Replacement::folder(const fs::path& target) {
  if (Result<void> ok = makeFolder(parentOf(target)); !ok) return tl::unexpected<Error>(ok.error());
  Step step;
  step.target = target;
  step.part = temporaryName(target);
  step.isFolder = step.together = true;
  if (::mkdir(step.part.c_str(), 0777) != 0) return cannotWrite(target, errno);
  std::error_code error;
  if (const fs::perms mode = fs::status(target, error).permissions(); !error)
    fs::permissions(step.part, mode, error);
  steps_.push_back(step);
  return step.part;
}

Result<void> Replacement::fill(const fs::path& file, const std::string& bytes, const fs::path& shown) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return cannotWrite(shown.parent_path(), error.value());
  return writeSynced(file, bytes, shown, context_);
}

void Replacement::removal(const fs::path& target) {
  Step step;
  step.target = target;
  step.together = true;
  steps_.push_back(std::move(step));
}

Result<void> Replacement::rename(const fs::path& from, const fs::path& to, const fs::path& shown) {
  if (::rename(from.c_str(), to.c_str()) != 0) return cannotWrite(shown, errno);
  moves_.push_back({from, to});
  return {};
}

Result<void> Replacement::takeAway(Step& step) {
  if (!isThere(step.target)) return {};
  step.old = temporaryName(step.target);
  return rename(step.target, step.old, step.target);
}

Result<void> Replacement::put(Step& step) {
  if (step.isDirect) return writeInto(step.target, step.direct);
  if (step.part.empty()) return step.old.empty() ? takeAway(step) : Result<void>();
  if (!isThere(step.target)) return rename(step.part, step.target, step.target);
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(step.target, error)) != step.isFolder)
    return cannotWrite(step.target, step.isFolder ? ENOTDIR : EISDIR);
  if (exchange_) {
    if (::renameat2(AT_FDCWD, step.part.c_str(), AT_FDCWD, step.target.c_str(), RENAME_EXCHANGE) == 0) {
      moves_.push_back({step.part, step.target, true});
      step.old = step.part;
      return {};
    }
    if (!hasNoExchange(errno)) return cannotWrite(step.target, errno);
  }
  if (steps_.size() == 1 && !step.isFolder) {  // nothing else to undo it for
    if (::rename(step.part.c_str(), step.target.c_str()) != 0) return cannotWrite(step.target, errno);
    return {};
  }
  if (Result<void> ok = takeAway(step); !ok) return ok;
  return rename(step.part, step.target, step.target);
}

Result<void> Replacement::syncFolders() const {
  std::set<fs::path> folders;
  for (const Step& step : steps_)
    if (!step.isDirect) folders.insert(parentOf(step.target));
  for (const fs::path& folder : made_) folders.insert(parentOf(folder));
  for (const fs::path& folder : folders)
    if (Result<void> ok = syncFolder(folder); !ok) return ok;
  return {};
}

void Replacement::undo() {
  for (auto move = moves_.rbegin(); move != moves_.rend(); ++move) {
    const int result = move->exchanged ? ::renameat2(AT_FDCWD, move->from.c_str(), AT_FDCWD, move->to.c_str(),
                                                     RENAME_EXCHANGE)
                                       : ::rename(move->to.c_str(), move->from.c_str());
    if (result != 0) settled_ = true;  // a temporary name may hold what stood there before: it stays
  }
  moves_.clear();
  for (Step& step : steps_) step.old.clear();
}

Result<void> Replacement::commit() {
  if (context_.stopped()) return stoppedError();
  const auto failed = [this](Result<void> error) {
    undo();
    return error;
  };
  for (const Step& step : steps_)
    if (step.isFolder)
      if (Result<void> ok = syncTree(step.part); !ok) return ok;
  std::vector<Step*> together;
  for (Step& step : steps_)
    if (step.together) together.push_back(&step);
  for (std::size_t i = 0; i + 1 < together.size(); ++i)
    if (Result<void> ok = takeAway(*together[i]); !ok) return failed(ok);
  if (!together.empty())
    if (Result<void> ok = put(*together.back()); !ok) return failed(ok);
  for (std::size_t i = 0; i + 1 < together.size(); ++i)
    if (Result<void> ok = put(*together[i]); !ok) return failed(ok);
  for (Step& step : steps_) {
    if (&step == &steps_.back() && steps_.size() > 1)
      if (Result<void> ok = syncFolders(); !ok) return failed(ok);
    if (!step.together)
      if (Result<void> ok = put(step); !ok) return failed(ok);
  }
  if (Result<void> ok = syncFolders(); !ok) return failed(ok);
  settled_ = true;
  std::error_code ignored;
  for (const Step& step : steps_) {
    if (step.old.empty()) continue;
    if (step.isFolder)
      former_.emplace_back(step.old, step.target);
    else
      fs::remove(step.old, ignored);
  }
  return {};
}

}  // namespace bw
