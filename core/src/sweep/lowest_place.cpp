// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/lowest_place.h"

#include <cstddef>

namespace bw {

LowestPlace lowestPlace(const Box& block, std::span<const Eigen::Vector3d> points) {
  const auto height = [&](std::size_t k) { return (points[k] - block.frame.origin).dot(block.frame.normal); };
  LowestPlace lowest;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double here = height(k);
    if (here < lowest.height) lowest = {here, points[k]};
    if (k == 0 || k + 1 == points.size()) continue;
    // The lowest place lies beside the lowest point, where a parabola through it and its neighbours has it.
    const double before = height(k - 1), after = height(k + 1), bend = before - 2 * here + after;
    if (here > before || here > after || !(bend > 0)) continue;
    const double between = here - (after - before) * (after - before) / (8 * bend);
    if (between < lowest.height) lowest = {between, points[k]};
  }
  return lowest;
}

}  // namespace bw
