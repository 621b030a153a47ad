// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/lowest_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace bw {

LowestPlace lowestPlace(const Box& block, std::span<const Eigen::Vector3d> points) {
  const auto height = [&](std::size_t k) { return (points[k] - block.frame.origin).dot(block.frame.normal); };
  LowestPlace lowest;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double here = height(k);
    if (here < lowest.height) lowest = {here, points[k]};
    if (k == 0 || k + 1 == points.size()) continue;
    // Beside a point the curve is as good as the parabola through it and its neighbours; that of the first
    // and of the last three points reaches to the end.
    const double before = height(k - 1), after = height(k + 1), bend = before - 2 * here + after;
    if (!(bend > 0)) continue;
    const double place = (before - after) / (2 * bend);  // in steps from here
    if (place < (k == 1 ? -1 : -0.5) || place > (k + 2 == points.size() ? 1 : 0.5)) continue;
    const double between = here - 0.5 * bend * place * place;
    if (between < lowest.height) lowest = {between, points[k]};
  }
  return lowest;
}

LowestPlace lowestPlace(const Box& block, const BladePose& pose) {
  return lowestPlace(block, pose.bladePoints(kLowestPlaces));
}

Box deeper(Box block, double by) {
  block.frame.origin -= by * block.frame.normal;
  block.size.z() += by;
  return block;
}

Box standingBelow(Box block, std::span<const BladePose> poses, double room) {
  double least = room;
  for (const BladePose& pose : poses) least = std::min(least, lowestPlace(block, pose).height);
  return deeper(std::move(block), std::ceil(room - least));
}

}  // namespace bw
