// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "files/file_writing.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace bw {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kChunk = std::size_t(1) << 20;  ///< bytes between two looks at the stop token

/// True if the place has no such thing as waiting for the disk: a pipe, some network shares.
bool cannotSync(int error) { return error == EINVAL || error == ENOTSUP || error == EROFS; }

Result<void> writeAll(int fd, const std::string& bytes, const fs::path& shown, const RunContext& context) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    if (context.stopped()) return stoppedError();
    const ssize_t n = ::write(fd, bytes.data() + done, std::min(kChunk, bytes.size() - done));
    if (n < 0) {
      if (errno == EINTR) continue;
      return cannotWrite(shown, errno);
    }
    done += std::size_t(n);
  }
  if (::fsync(fd) != 0 && !cannotSync(errno)) return cannotWrite(shown, errno);
  return {};
}

Result<void> openAndWrite(const fs::path& path, int flags, const std::string& bytes, const fs::path& shown,
                          const RunContext& context) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (fd < 0) return cannotWrite(shown, errno);
  Result<void> ok = writeAll(fd, bytes, shown, context);
  if (::close(fd) != 0 && ok) ok = cannotWrite(shown, errno);
  if (!ok && (flags & O_CREAT) != 0) ::unlink(path.c_str());
  return ok;
}

}  // namespace

tl::unexpected<Error> cannotWrite(const fs::path& path, int error) {
  std::string remedy;
  if (error == ENOSPC || error == EDQUOT) remedy = "; free some space or choose another folder";
  if (error == EFBIG) remedy = "; the file system or a limit of your session allows no larger file";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "; choose a folder that you may write to";
  return fail(ErrorCode::cannotWrite, "cannot write " + path.string() + ": " + std::strerror(error) + remedy,
              path.string());
}

Result<void> writeSynced(const fs::path& path, const std::string& bytes, const fs::path& shown,
                         const RunContext& context) {
  return openAndWrite(path, O_CREAT | O_EXCL, bytes, shown, context);
}

Result<void> writeInto(const fs::path& path, const std::string& bytes) {
  return openAndWrite(path, 0, bytes, path, {});
}

Result<void> syncFolder(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return {};
  Result<void> ok;
  if (::fsync(fd) != 0 && !cannotSync(errno)) ok = cannotWrite(folder, errno);
  ::close(fd);
  return ok;
}

Result<void> syncTree(const fs::path& folder) {
  if (Result<void> ok = syncFolder(folder); !ok) return ok;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (fs::is_directory(it->symlink_status(error)))
      if (Result<void> ok = syncFolder(it->path()); !ok) return ok;
  return {};
}

}  // namespace bw
