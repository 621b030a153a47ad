// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/temporary_name.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "bw/core/files/fingerprint.h"

namespace bw {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = ".part-";
constexpr std::size_t kTag = 6;                ///< hexadecimal digits for the machine, and for its start
constexpr std::chrono::hours kForeignAge{24};  ///< of what another machine wrote

std::string digitsOf(const std::string& text) {
  const std::string fingerprint = fingerprintText(fingerprintOf(text));
  return fingerprint.substr(fingerprint.size() - kTag);
}

/// Six digits for the machine, six for its start. Containers of one machine may share its name, but the
/// numbers of processes count only within one namespace: each is a machine of its own.
const std::string& machineTag() {
  static const std::string tag = [] {
    std::string boot;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
    std::error_code none;
    return digitsOf(hostName() + fs::read_symlink("/proc/self/ns/pid", none).string()) + digitsOf(boot);
  }();
  return tag;
}

struct Writer {
  pid_t process = 0;
  std::string_view tag;
};

std::optional<Writer> writerOf(std::string_view name) {
  const std::size_t at = name.rfind(kMark);
  if (at == std::string_view::npos || at == 0) return std::nullopt;
  const std::string_view rest = name.substr(at + kMark.size());
  Writer writer;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), writer.process);
  const std::size_t digits = std::size_t(end - rest.data());
  if (error != std::errc{} || writer.process <= 0 || rest.size() < digits + 2 * kTag + 3) return std::nullopt;
  writer.tag = rest.substr(digits + 1, 2 * kTag);
  const std::string_view number = rest.substr(digits + 2 * kTag + 2);
  if (rest[digits] != '-' || rest[digits + 2 * kTag + 1] != '-' ||
      writer.tag.find_first_not_of("0123456789abcdef") != std::string_view::npos ||
      number.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  return writer;
}

bool isDead(const Writer& writer, const fs::path& file) {
  const std::string_view here = machineTag();
  if (writer.tag.substr(0, kTag) != here.substr(0, kTag)) {
    std::error_code error;
    const auto written = fs::last_write_time(file, error);
    return !error && fs::file_time_type::clock::now() - written > kForeignAge;
  }
  if (writer.tag != here) return true;
  return ::kill(writer.process, 0) != 0 && errno == ESRCH;
}

}  // namespace

std::string hostName() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "this machine";
  return name.data();
}

fs::path temporaryName(const fs::path& target) {
  static std::atomic<unsigned> counter = 0;
  const std::string begin =
      target.string() + std::string(kMark) + std::to_string(::getpid()) + "-" + machineTag() + "-";
  fs::path name;
  std::error_code error;
  // A dead process may have had our number.
  do name = begin + std::to_string(counter++);
  while (fs::exists(fs::symlink_status(name, error)));
  return name;
}

bool isTemporaryName(std::string_view name) { return writerOf(name).has_value(); }

fs::path placeOfTemporary(const fs::path& temporary) {
  const std::string name = temporary.filename().string();
  return isTemporaryName(name) ? temporary.parent_path() / name.substr(0, name.rfind(kMark)) : temporary;
}

std::vector<fs::path> leftByDeadWriters(const fs::path& folder) {
  std::vector<fs::path> left;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    const std::optional<Writer> writer = writerOf(name);
    if (writer && isDead(*writer, it->path())) left.push_back(it->path());
  }
  std::sort(left.begin(), left.end());
  return left;
}

void removeDeadFiles(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& file : leftByDeadWriters(folder))
    if (fs::is_regular_file(fs::symlink_status(file, error))) fs::remove(file, error);
}

}  // namespace bw
