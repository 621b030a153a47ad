// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLockFile>

#include <filesystem>
#include <memory>
#include <optional>

#include "bw/core/design.h"
#include "bw/core/result.h"

namespace bw::model {

/// The autosaved copy of one running window. It is locked as long as the program runs; a copy without a
/// living owner was left by a crash.
class RecoveryFile {
 public:
  /// Takes an unused name in `folder`, which is made if missing. Nothing is written yet.
  explicit RecoveryFile(const std::filesystem::path& folder);
  /// Removes the copy: a window that closes in order needs no recovery.
  ~RecoveryFile();
  RecoveryFile(const RecoveryFile&) = delete;
  RecoveryFile& operator=(const RecoveryFile&) = delete;

  /// Writes the copy, atomically; `file` is the design's own file or empty.
  Result<void> write(const Design& design, const std::filesystem::path& file);
  /// Forgets the copy (after a save).
  void clear();

 private:
  std::filesystem::path base_;
  std::unique_ptr<QLockFile> lock_;
};

/// An autosaved design that a crash left behind.
struct Recovered {
  Design design;
  std::filesystem::path file;  ///< where it was last saved; empty if never
};

/// Takes one copy that no running program owns out of `folder` (it is removed from it); the others wait for
/// the next start. Unreadable copies are dropped.
std::optional<Recovered> takeRecovered(const std::filesystem::path& folder);

}  // namespace bw::model
