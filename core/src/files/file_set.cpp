// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/file_set.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <set>

#include "bw/core/files/replacement.h"
#include "bw/core/files/temporary_name.h"

namespace bw {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> cannotRead(const std::string& name, int error) {
  return fail(ErrorCode::cannotRead, "cannot read " + name + ": " + std::strerror(error), name);
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
  Replacement replacement(context);
  std::set<fs::path> folders;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const fs::path target = folder / paths_[i];
    if (folders.insert(target.parent_path()).second)
      removeDeadFiles(target.has_parent_path() ? target.parent_path() : fs::path("."));
    if (Result<void> ok = replacement.file(target, bytes_[i]); !ok) return ok;
  }
  return replacement.commit();
}

Result<void> writeFile(const fs::path& file, const std::string& bytes) {
  FileSet set;
  set.add(file.filename(), bytes);
  return set.commit(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

Result<std::string> readDescriptor(int descriptor, const std::string& name, std::size_t limit) {
  const auto tooLarge = [&](double size) {
    return fail(ErrorCode::cannotRead,
                name + " is larger than " + std::to_string(limit >> 20) + " MB, the most that is read", name,
                size, double(limit));
  };
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && std::uintmax_t(status.st_size) > limit)
    return tooLarge(double(status.st_size));
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  while (true) {
    const ssize_t n = ::read(descriptor, buffer.data(), buffer.size());
    if (n < 0) {
      if (errno == EINTR) continue;
      return cannotRead(name, errno);
    }
    if (n == 0) return bytes;
    bytes.append(buffer.data(), std::size_t(n));
    if (bytes.size() > limit) return tooLarge(double(bytes.size()));
  }
}

Result<std::string> readFile(const fs::path& file, std::size_t limit) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return cannotRead(file.string(), errno);
  Result<std::string> bytes = readDescriptor(fd, file.string(), limit);
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
