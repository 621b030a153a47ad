// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bw {

/// A name beside `target` that no one else uses and where nothing is:
/// "report.json.part-1234-0a1b2c3d4e5f-0". It tells the process, the machine (each namespace of processes
/// counts as one) and its start, so that what a dead writer left can be told from what a living one is
/// writing.
std::filesystem::path temporaryName(const std::filesystem::path& target);

/// True for names that `temporaryName` gives.
bool isTemporaryName(std::string_view name);

/// The place that a temporary name stands beside: "report.json". The name itself if it is not temporary.
std::filesystem::path placeOfTemporary(const std::filesystem::path& temporary);

/// What dead writers left in `folder`, files and folders, sorted: their process is gone, or the machine was
/// started since. Of other machines, what is older than a day. Empty where the folder cannot be read.
std::vector<std::filesystem::path> leftByDeadWriters(const std::filesystem::path& folder);

/// Removes the files among them, as far as that can be done.
void removeDeadFiles(const std::filesystem::path& folder);

/// The name of this machine, for people.
std::string hostName();

}  // namespace bw
