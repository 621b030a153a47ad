// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/files/file_set.h"
#include "bw/core/files/replacement.h"

namespace bw::pipeline {

/// What programs are made of, by the names of their files: what robots run, which lies in the folder of a
/// task, and motions, which lie in that of a strip.
bool isProgramFile(const std::filesystem::path& file);
bool isRobotFile(const std::filesystem::path& file);

/// What robots run, or the motions, that we wrote straight into a folder, as their heads tell; none where it
/// is reached through a link.
std::set<std::filesystem::path> ownModules(const std::filesystem::path& folder);
std::set<std::filesystem::path> ownMotions(const std::filesystem::path& folder);

/// The folders below `folder` that hold only programs and can be exchanged as a whole, relative: those of
/// strips, or of tasks where `folder` itself is the strip. None that is reached through a link or is a mount
/// point.
std::vector<std::filesystem::path> programUnits(const std::filesystem::path& folder, const FileSet& files);

/// True if `path` lies within `unit`; both relative to one folder.
bool liesWithin(const std::filesystem::path& path, const std::filesystem::path& unit);

/// Fills the new folder `fresh` with hard links to all that `live` holds except `gone` (relative to `live`),
/// so that what others put there is in both. False if something cannot be linked.
bool linkOthers(const std::filesystem::path& live, const std::filesystem::path& fresh,
                const std::set<std::filesystem::path>& gone);

/// Removes a folder that `live` took the place of, or that a dead writer prepared for it: what `live` holds
/// too, programs of ours, and those whose names ours took. Anything else, which somebody put there, moves
/// into `live`, or stays where the name is taken.
void dissolve(const std::filesystem::path& former, const std::filesystem::path& live);

}  // namespace bw::pipeline
