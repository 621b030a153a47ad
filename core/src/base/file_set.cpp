// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/file_set.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace bw {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> cannotWrite(const fs::path& path, int error) {
  std::string remedy;
  if (error == ENOSPC || error == EDQUOT) remedy = "; free some space or choose another folder";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "; choose a folder that you may write to";
  return fail(ErrorCode::cannotWrite, "cannot write " + path.string() + ": " + std::strerror(error) + remedy,
              path.string());
}

/// Writes and syncs one file; on failure it is removed again.
Result<void> writePlain(const fs::path& path, const std::string& bytes) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return cannotWrite(path, errno);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0) {
      if (errno == EINTR) continue;
      const int error = errno;
      ::close(fd);
      ::unlink(path.c_str());
      return cannotWrite(path, error);
    }
    done += std::size_t(n);
  }
  // A file that lies on a device without sync (a pipe, some network shares) is written all the same.
  if (::fsync(fd) != 0 && errno != EINVAL && errno != ENOTSUP) {
    const int error = errno;
    ::close(fd);
    ::unlink(path.c_str());
    return cannotWrite(path, error);
  }
  if (::close(fd) != 0) {
    const int error = errno;
    ::unlink(path.c_str());
    return cannotWrite(path, error);
  }
  return {};
}

}  // namespace

void FileSet::add(fs::path path, std::string bytes) {
  paths_.push_back(std::move(path));
  bytes_.push_back(std::move(bytes));
}

void FileSet::append(FileSet other, const fs::path& folder) {
  for (std::size_t i = 0; i < other.paths_.size(); ++i)
    add(folder / other.paths_[i], std::move(other.bytes_[i]));
}

Result<void> FileSet::commit(const fs::path& folder) const {
  std::vector<fs::path> temporary;
  std::vector<fs::path> made;  // folders made here, outermost first
  const auto undo = [&] {
    std::error_code ignored;
    for (const fs::path& path : temporary) fs::remove(path, ignored);
    for (auto it = made.rbegin(); it != made.rend(); ++it) fs::remove(*it, ignored);
  };
  const auto makeFolder = [&](const fs::path& path) -> Result<void> {
    std::vector<fs::path> missing;
    std::error_code error;
    for (fs::path p = path; !p.empty() && !fs::exists(p, error); p = p.parent_path()) missing.push_back(p);
    for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
      if (fs::create_directory(*it, error)) made.push_back(*it);
      if (error) return cannotWrite(*it, error.value());
    }
    if (!fs::is_directory(path, error))
      return fail(ErrorCode::cannotWrite,
                  "cannot write into " + path.string() + ": it is not a folder; choose another name",
                  path.string());
    return {};
  };
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const fs::path target = folder / paths_[i];
    const fs::path parent = target.parent_path();
    if (Result<void> ok = makeFolder(parent.empty() ? fs::path(".") : parent); !ok) {
      undo();
      return ok;
    }
    const fs::path part = target.string() + ".part-" + std::to_string(::getpid());
    if (Result<void> ok = writePlain(part, bytes_[i]); !ok) {
      undo();
      return ok;
    }
    temporary.push_back(part);
    std::error_code error;
    if (fs::is_directory(target, error)) {
      undo();
      return fail(
          ErrorCode::cannotWrite,
          "cannot write " + target.string() + ": a folder of that name is in the way; choose another folder",
          target.string());
    }
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const fs::path target = folder / paths_[i];
    if (::rename(temporary[i].c_str(), target.c_str()) != 0) {
      const int error = errno;
      undo();
      return cannotWrite(target, error);
    }
  }
  return {};
}

Result<void> writeFile(const fs::path& file, const std::string& bytes) {
  FileSet set;
  set.add(file.filename(), bytes);
  return set.commit(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

Result<std::string> readFile(const fs::path& file, std::size_t limit) {
  const auto cannotRead = [&](int error) {
    return fail(ErrorCode::cannotRead, "cannot read " + file.string() + ": " + std::strerror(error),
                file.string());
  };
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return cannotRead(errno);
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0) {
      if (errno == EINTR) continue;
      const int error = errno;
      ::close(fd);
      return cannotRead(error);
    }
    if (n == 0) break;
    bytes.append(buffer.data(), std::size_t(n));
    if (bytes.size() > limit) {
      ::close(fd);
      return fail(
          ErrorCode::cannotRead,
          file.string() + " is larger than " + std::to_string(limit >> 20) + " MB, the most that is read",
          file.string(), double(bytes.size()), double(limit));
    }
  }
  ::close(fd);
  return bytes;
}

}  // namespace bw
