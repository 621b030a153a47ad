// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace bw::model {

namespace {

constexpr int kTries = 100;  ///< the holder may remove the file between our opening and our locking it

}  // namespace

FileLock::Outcome FileLock::take(const std::filesystem::path& file) {
  release();
  for (int i = 0; i < kTries; ++i) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0) return Outcome::unavailable;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(descriptor);
      return Outcome::busy;
    }
    // Whoever held it before may have removed the file meanwhile: then this is the lock of nothing.
    struct stat mine {
    }, named{};
    if (::fstat(descriptor, &mine) == 0 && ::stat(file.c_str(), &named) == 0 && mine.st_ino == named.st_ino &&
        mine.st_dev == named.st_dev) {
      file_ = file;
      descriptor_ = descriptor;
      return Outcome::held;
    }
    ::close(descriptor);
  }
  return Outcome::busy;
}

void FileLock::remove() {
  if (descriptor_ >= 0) ::unlink(file_.c_str());
  release();
}

void FileLock::release() {
  if (const int descriptor = std::exchange(descriptor_, -1); descriptor >= 0) ::close(descriptor);
}

}  // namespace bw::model
