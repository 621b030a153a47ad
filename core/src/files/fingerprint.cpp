// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/files/fingerprint.h"

#include <array>
#include <boost/crc.hpp>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace bw {

namespace {

constexpr std::uint64_t kAll = ~std::uint64_t(0);
using Crc = boost::crc_optimal<64, 0x42F0E1EBA9EA3693, kAll, kAll, true, true>;
constexpr int kHexadecimal = 16, kDigits = 16;

}  // namespace

Fingerprint fingerprintOf(std::string_view bytes) {
  Crc crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return {bytes.size(), crc.checksum()};
}

Result<Fingerprint> fingerprintOfFile(const std::filesystem::path& file) {
  const auto cannotRead = [&file] {
    return fail(ErrorCode::cannotRead, "cannot read " + file.string() + ": " + std::strerror(errno),
                file.string());
  };
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    return fail(ErrorCode::cannotRead, file.string() + " is no file with an end", file.string());
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rbe"), &std::fclose);
  if (!stream) return cannotRead();
  Crc crc;
  Fingerprint result;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), stream.get())) {
    crc.process_bytes(buffer.data(), n);
    result.size += n;
  }
  if (std::ferror(stream.get())) return cannotRead();
  result.crc = crc.checksum();
  return result;
}

std::string fingerprintText(const Fingerprint& fingerprint) {
  std::array<char, kDigits + 1> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(fingerprint.crc));
  return std::to_string(fingerprint.size) + "-" + digits.data();
}

std::optional<Fingerprint> fingerprintFrom(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos || text.size() - dash - 1 != kDigits) return std::nullopt;
  Fingerprint result;
  const char *middle = text.data() + dash, *end = text.data() + text.size();
  const auto size = std::from_chars(text.data(), middle, result.size);
  const auto crc = std::from_chars(middle + 1, end, result.crc, kHexadecimal);
  if (size.ec != std::errc() || size.ptr != middle || crc.ec != std::errc() || crc.ptr != end)
    return std::nullopt;
  return result;
}

}  // namespace bw
