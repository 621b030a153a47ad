// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw {

/// Files that are written together: all or none. Each goes to a temporary file beside its place; only when
/// every one is written and synced do they take their places (`Replacement`). A failure (no folder, no right,
/// disk full) leaves everything as it was and says which path and why. Temporary files that dead writers left
/// in the folders are removed.
class FileSet {
 public:
  /// Adds a file; `path` relative to the folder given to `commit`.
  void add(std::filesystem::path path, std::string bytes);
  /// Adds all files of `other` below `folder`.
  void append(FileSet other, const std::filesystem::path& folder);
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// The bytes of each, in the same order.
  const std::vector<std::string>& bytes() const { return bytes_; }
  /// Writes all below `folder`, which is made if missing. A symbolic link is followed; a device or pipe is
  /// written itself. A stop that is asked for while the temporary files are written removes them again
  /// (`ErrorCode::cancelled`).
  Result<void> commit(const std::filesystem::path& folder, const RunContext& context = {}) const;

 private:
  std::vector<std::filesystem::path> paths_;
  std::vector<std::string> bytes_;
};

/// Writes one file atomically.
Result<void> writeFile(const std::filesystem::path& file, const std::string& bytes);
/// The suffix of a file's name in small letters, with its dot: ".step".
std::string lowerSuffix(const std::filesystem::path& file);
/// Reads a whole file, or says why not. Larger than `limit` bytes is an error, told as soon as they are
/// exceeded.
Result<std::string> readFile(const std::filesystem::path& file, std::size_t limit = std::size_t(1) << 31);
/// The same from an open descriptor, which stays open; `name` is how messages call it.
Result<std::string> readDescriptor(int descriptor, const std::string& name, std::size_t limit);
/// The most that is read of a text: cases, jobs, designs, cells. Numbers as text take up to twenty times
/// their size in memory while they are read.
inline constexpr std::size_t kLargestText = std::size_t(256) << 20;

}  // namespace bw
