// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace bw {

/// How many planes cut the target.
struct SectionRequest {
  int stations = 60;              ///< used unless `spacing` is set; 2 to kMost
  std::optional<double> spacing;  ///< mm between stations, above 0

  static constexpr int kMost = 20000;
  bool operator==(const SectionRequest&) const = default;
};

}  // namespace bw
