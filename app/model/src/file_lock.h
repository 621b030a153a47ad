// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace bw::model {

/// An exclusive lock that the system keeps for as long as this object, and at most as long as the process,
/// lives. Neither a crash nor a process number that was given out again leaves it standing.
class FileLock {
 public:
  FileLock() = default;
  ~FileLock() { release(); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  enum class Outcome {
    held,        ///< now; also where the file system knows no locks
    busy,        ///< another holds it
    unavailable  ///< the file cannot be made or opened
  };

  /// Takes the lock of `file`, which is made if missing.
  Outcome take(const std::filesystem::path& file);
  bool held() const { return descriptor_ >= 0; }
  /// Lets go and removes the file.
  void remove();
  /// Lets go; the file stays.
  void release();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace bw::model
