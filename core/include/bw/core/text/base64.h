// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace bw {

/// Bytes as letters of RFC 4648, 4, filled up with =.
std::string toBase64(const std::string& bytes);
/// The bytes of such a text; empty where it is none.
std::optional<std::string> fromBase64(std::string text);

}  // namespace bw
