// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bw {

/// What a blade melts away across itself where it passes at a speed: the slower, the more.
struct KerfAt {
  double speed = 0;  ///< mm/s, > 0
  double width = 0;  ///< mm, ≥ 0
  bool operator==(const KerfAt&) const = default;
};

/// Ascending in speed. Between entries the width is linear in the speed; slower and faster than all of them
/// it is that of the nearest.
using KerfTable = std::vector<KerfAt>;

/// mm; 0 where the table is empty.
[[nodiscard]] double kerfAt(const KerfTable& table, double speed);
/// mm, the widest of it; 0 where it is empty.
[[nodiscard]] double widestKerf(const KerfTable& table);

}  // namespace bw
