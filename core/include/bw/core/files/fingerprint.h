// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"

namespace bw {

/// Size and checksum of a file's bytes: tells whether it changed, on any machine and after any copying. Not
/// meant against somebody who forges it.
struct Fingerprint {
  std::uint64_t size = 0;
  std::uint64_t crc = 0;  ///< CRC-64/XZ
  bool operator==(const Fingerprint&) const = default;
};

Fingerprint fingerprintOf(std::string_view bytes);
/// Reads the file in pieces; `ErrorCode::cannotRead` if that fails, or it is a folder, device or pipe.
Result<Fingerprint> fingerprintOfFile(const std::filesystem::path& file);

/// "81233-995dc9bbdf1939fa": size in bytes and checksum in hexadecimal digits.
std::string fingerprintText(const Fingerprint& fingerprint);
/// The reverse; nothing if `text` is no such text.
std::optional<Fingerprint> fingerprintFrom(std::string_view text);

}  // namespace bw
