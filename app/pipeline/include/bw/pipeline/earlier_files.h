// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "bw/core/files/file_set.h"

namespace bw::pipeline {

/// Program files that an earlier run of ours left in `folder` and that are not among `files`, which are about
/// to be written there: those in programs/ that the folder's report.json lists, if `files` brings a new one;
/// and in each folder of a strip that `files` writes to, motions as CSV and JSON, modules whose head names
/// Bladewright, their parts and their .pgf. There only the folders of tasks that `files` writes to are looked
/// at, or all where the strip's folder bears our name, "strip-N". Relative to `folder`, sorted. Nothing
/// that is itself a symbolic link, nothing outside of the folder, nothing that others wrote; a link that
/// leads to the folder of a strip, which `files` is written through too, is followed.
std::vector<std::filesystem::path> earlierFiles(const std::filesystem::path& folder, const FileSet& files);

}  // namespace bw::pipeline
