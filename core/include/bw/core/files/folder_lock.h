// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>

#include "bw/core/base/result.h"

namespace bw {

/// The right to write into a folder, held by one process at a time: a file in it that the system locks and
/// that tells who writes there. The system lets go of the lock when its holder ends, however that was; what a
/// dead one left is taken over, another user's too. On file systems without locks everybody gets it.
class FolderLock {
 public:
  static constexpr const char* kFile = ".bladewright-writer";

  /// The lock of a folder that is there. `ErrorCode::cannotWrite` if another holds it, with its process,
  /// machine and time, and where the folder may not be written to, with the system's reason.
  static Result<FolderLock> take(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  FolderLock(std::filesystem::path file, int fd) : file_(std::move(file)), fd_(fd) {}
  void release();

  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace bw
