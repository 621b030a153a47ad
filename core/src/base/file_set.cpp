// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/file_set.h"

#include <fcntl.h>
#include <unistd.h>
#include <cctype>

#include <algorithm>
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
  if (error == EFBIG) remedy = "; the file system or a limit of your session allows no larger file";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "; choose a folder that you may write to";
  return fail(ErrorCode::cannotWrite, "cannot write " + path.string() + ": " + std::strerror(error) + remedy,
              path.string());
}

constexpr std::size_t kChunk = std::size_t(1) << 20;  ///< bytes between two looks at the stop token

/// Where a file is written and how it gets to its place.
struct Destination {
  fs::path target;  ///< its place, symbolic links followed
  fs::path part;    ///< the temporary file beside it; empty for a device or pipe, which is written itself
};

Result<Destination> placeOf(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    return fail(
        ErrorCode::cannotWrite,
        "cannot write " + path.string() + ": a folder of that name is in the way; choose another folder",
        path.string());
  Destination place{path, {}};
  if (fs::exists(status) && !fs::is_regular_file(status)) return place;
  if (fs::is_symlink(path, error)) {
    const fs::path real = fs::weakly_canonical(path, error);
    if (!error) place.target = real;
  }
  place.part = place.target.string() + ".part-" + std::to_string(::getpid());
  return place;
}

/// Writes and syncs one file; on failure a temporary file is removed again. `shown` is the name for messages.
Result<void> writePlain(const fs::path& path, const std::string& bytes, const fs::path& shown,
                        const RunContext& context, bool temporary) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return cannotWrite(shown, errno);
  const auto giveUp = [&](tl::unexpected<Error> error) -> Result<void> {
    ::close(fd);
    if (temporary) ::unlink(path.c_str());
    return error;
  };
  std::size_t done = 0;
  while (done < bytes.size()) {
    if (context.stopped()) return giveUp(stoppedError());
    const ssize_t n = ::write(fd, bytes.data() + done, std::min(kChunk, bytes.size() - done));
    if (n < 0) {
      if (errno == EINTR) continue;
      return giveUp(cannotWrite(shown, errno));
    }
    done += std::size_t(n);
  }
  // A file that lies on a device without sync (a pipe, some network shares) is written all the same.
  if (::fsync(fd) != 0 && errno != EINVAL && errno != ENOTSUP) return giveUp(cannotWrite(shown, errno));
  if (::close(fd) != 0) {
    const int error = errno;
    if (temporary) ::unlink(path.c_str());
    return cannotWrite(shown, error);
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

Result<void> FileSet::commit(const fs::path& folder, const RunContext& context) const {
  std::vector<Destination> places;
  std::vector<fs::path> made;  // folders made here, outermost first
  const auto undo = [&] {
    std::error_code ignored;
    for (const Destination& place : places)
      if (!place.part.empty()) fs::remove(place.part, ignored);
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
  const auto prepare = [&](const fs::path& target, const std::string& bytes) -> Result<void> {
    const fs::path parent = target.parent_path();
    if (Result<void> ok = makeFolder(parent.empty() ? fs::path(".") : parent); !ok) return ok;
    Result<Destination> place = placeOf(target);
    if (!place) return tl::unexpected<Error>(place.error());
    places.push_back(std::move(*place));
    return places.back().part.empty() ? Result<void>()
                                      : writePlain(places.back().part, bytes, target, context, true);
  };
  for (std::size_t i = 0; i < paths_.size(); ++i)
    if (Result<void> ok = prepare(folder / paths_[i], bytes_[i]); !ok) {
      undo();
      return ok;
    }
  if (context.stopped()) {
    undo();
    return stoppedError();
  }
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    Result<void> ok;
    if (places[i].part.empty())
      ok = writePlain(places[i].target, bytes_[i], folder / paths_[i], {}, false);
    else if (::rename(places[i].part.c_str(), places[i].target.c_str()) != 0)
      ok = cannotWrite(folder / paths_[i], errno);
    if (!ok) {
      undo();
      return ok;
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

std::string lowerSuffix(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return suffix;
}

}  // namespace bw
