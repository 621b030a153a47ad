// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw {

/// Files and folders that are prepared beside their places and put there together: all, or none if one step
/// fails. A program that is ended at any moment, by a signal or with the power, leaves each place old or new.
/// Those that are only valid `together` are never old here and new there: all but the last are taken away
/// first, so that the end may leave these places empty.
///
/// The last place prepared, unless it is one of those, is put there last, after all others are on the disk:
/// what tells of the others belongs there.
///
/// Errors without a word of their own are `ErrorCode::cannotWrite` with the path and the system's reason.
class Replacement {
 public:
  /// `exchange` false does without the system's exchange of two names, as on file systems that have none:
  /// there a place may be empty for a moment.
  explicit Replacement(RunContext context = {}, bool exchange = true);
  /// Removes what was prepared and not put in place, and the folders made for it.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Makes a folder and those above it that are missing. An error where one cannot be made, or a file has its
  /// name.
  Result<void> makeFolder(const std::filesystem::path& folder);
  /// Prepares a file: written and synced under a temporary name. A symbolic link is followed, also to what is
  /// not there yet; a device or pipe is written itself with `commit`. An error where the file cannot be
  /// written or a folder has its name; a stop that is asked for meanwhile ends it (`ErrorCode::cancelled`).
  Result<void> file(const std::filesystem::path& target, std::string bytes, bool together = false);
  /// Prepares an empty folder that takes the place of `target`, together with the other parts; its temporary
  /// path. An error where it cannot be made.
  Result<std::filesystem::path> folder(const std::filesystem::path& target);
  /// Writes and syncs a file within such a folder, the folders above it included. `shown` is its name for
  /// messages. An error where it is there already or cannot be written; `ErrorCode::cancelled` as for `file`.
  Result<void> fill(const std::filesystem::path& file, const std::string& bytes,
                    const std::filesystem::path& shown);
  /// Prepares that a file goes away, together with the other parts.
  void removal(const std::filesystem::path& target);
  /// Puts all in place and syncs the folders. On failure everything is as it was, but for what went into a
  /// device or pipe, and for a single file without the system's exchange, which stays where only the sync
  /// fails. `ErrorCode::cancelled` if a stop was asked for before.
  Result<void> commit();

  /// After `commit`: where the folders lie that stood in the places of new ones, and those places. They are
  /// the caller's to empty and remove.
  const std::vector<std::pair<std::filesystem::path, std::filesystem::path>>& formerFolders() const {
    return former_;
  }

 private:
  struct Step {
    std::filesystem::path target;
    std::filesystem::path part;  ///< what was prepared; empty for a removal
    std::string direct;          ///< the bytes for a device or pipe
    bool isDirect = false, isFolder = false, together = false;
    std::filesystem::path old = {};  ///< where the former one lies once it is replaced
  };
  struct Move {
    std::filesystem::path from, to;
    bool exchanged = false;
  };

  Result<void> rename(const std::filesystem::path& from, const std::filesystem::path& to,
                      const std::filesystem::path& shown);
  Result<void> takeAway(Step& step);
  Result<void> put(Step& step);
  Result<void> syncFolders() const;
  void undo();

  RunContext context_;
  bool exchange_;
  bool settled_ = false;  ///< what lies under temporary names is not ours to remove any more
  std::vector<Step> steps_;
  std::vector<Move> moves_;
  std::vector<std::filesystem::path> made_;  ///< folders, outermost first
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> former_;
};

}  // namespace bw
