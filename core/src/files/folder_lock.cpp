// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <utility>

#include "bw/core/files/temporary_name.h"
#include "files/file_writing.h"

namespace bw {

namespace fs = std::filesystem;

namespace {

constexpr int kTries = 100;  ///< the holder may remove the file between our opening and our locking it

std::string holderText() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
  return "process " + std::to_string(::getpid()) + " on " + hostName() + " since " + text.data();
}

std::string holderOf(int fd) {
  std::array<char, 400> text{};
  const ssize_t n = ::pread(fd, text.data(), text.size() - 1, 0);
  return n > 0 ? std::string(text.data(), std::size_t(n)) : std::string("another process");
}

/// True if `file` still names what is open.
bool isStill(const fs::path& file, int fd) {
  struct stat named {};
  struct stat open {};
  return ::stat(file.c_str(), &named) == 0 && ::fstat(fd, &open) == 0 && named.st_ino == open.st_ino &&
         named.st_dev == open.st_dev;
}

}  // namespace

Result<FolderLock> FolderLock::take(const fs::path& folder) {
  const fs::path file = folder / kFile;
  for (int i = 0; i < kTries; ++i) {
    constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW;
    int fd = ::open(file.c_str(), O_RDWR | O_CREAT | kFlags, 0666);
    const int error = errno;
    // Another user's file that may only be read can be locked all the same.
    const bool foreign = fd < 0 && error == EACCES;
    if (foreign) fd = ::open(file.c_str(), O_RDONLY | kFlags);
    if (fd < 0) return cannotWrite(folder, error);
    FolderLock lock(file, fd);
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string holder = holderOf(fd);
      ::close(std::exchange(lock.fd_, -1));
      return fail(ErrorCode::cannotWrite,
                  "nothing was written to " + folder.string() + ", because " + holder +
                      " is writing there; wait for it, or choose another folder",
                  folder.string());
    }
    if (!isStill(file, fd)) {
      ::close(std::exchange(lock.fd_, -1));
      continue;
    }
    // Its writer is dead. Letting go of it removes it, so that the next try makes a file of our own; where a
    // folder forbids that, the lock holds and the text stays the dead one's.
    if (foreign && i == 0) continue;
    const std::string holder = holderText();
    // Without the text the lock still holds; the other is told less.
    if (::ftruncate(fd, 0) != 0 || ::pwrite(fd, holder.data(), holder.size(), 0) < 0) return lock;
    return lock;
  }
  return fail(ErrorCode::cannotWrite,
              "nothing was written to " + folder.string() + ", because other processes are writing there",
              folder.string());
}

FolderLock::~FolderLock() { release(); }

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), fd_(std::exchange(other.fd_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  if (this != &other) {
    release();
    file_ = std::move(other.file_);
    fd_ = std::exchange(other.fd_, -1);
  }
  return *this;
}

void FolderLock::release() {
  if (fd_ < 0) return;
  if (isStill(file_, fd_)) ::unlink(file_.c_str());
  ::flock(fd_, LOCK_UN);  // a process that was forked meanwhile shares the lock
  ::close(std::exchange(fd_, -1));
}

}  // namespace bw
