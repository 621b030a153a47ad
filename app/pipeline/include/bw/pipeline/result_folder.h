// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/files/file_set.h"

namespace bw::pipeline {

/// Which report, programs and motions of ours a result folder held at some moment: enough to see whether
/// another run was put there since. What others keep there does not count.
struct FolderState {
  std::string text;
  bool operator==(const FolderState&) const = default;
};
/// The state of a folder now; empty where it is not there.
FolderState folderState(const std::filesystem::path& folder);

/// True if both name one file that exists.
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Writes `files` into `folder` in place of what an earlier run of ours left there (`earlierFiles`): all or
/// nothing, and at no moment, should the program be ended there, with the program of one robot from one run
/// and that of the other from another (`Replacement`). The folder of a strip is exchanged as a whole, with
/// what others put into it; where that cannot be (a link, a mount point, no hard links), its files take their
/// places after those of the former run went away. The last of `files` comes last. Files and folders of dead
/// writers are cleared away. Returns the earlier files that were removed.
///
/// Errors: another process is writing there, or with `seen` has written since (`ErrorCode::cannotWrite`); one
/// of `files` would take the place of one of `inputs`, which they were made from (`ErrorCode::badInput`).
Result<std::vector<std::filesystem::path>> commitAfresh(
    const FileSet& files, const std::filesystem::path& folder,
    const std::vector<std::filesystem::path>& inputs = {}, const RunContext& context = {},
    const std::optional<FolderState>& seen = std::nullopt);

/// Files that an earlier run of ours left in `folder` and that are not among `files`, which are about to be
/// written there. If `files` brings a new report.json, what that of the folder lists: programs in programs/,
/// and whatever else is still, by its fingerprint, as it was written. And of programs in each folder of a
/// strip that `files` writes to, motions as CSV and JSON, modules whose head names Bladewright, their parts
/// and their .pgf. There only the folders of tasks that `files` writes to are looked at, or all where the
/// strip's folder bears our name, "strip-N". Relative to `folder`, sorted. Nothing that is itself a symbolic
/// link, nothing outside of the folder, nothing that others wrote; a link that leads to the folder of a
/// strip, which `files` is written through too, is followed.
std::vector<std::filesystem::path> earlierFiles(const std::filesystem::path& folder, const FileSet& files);

}  // namespace bw::pipeline
