// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/isolines.h"

#include <algorithm>
#include <cmath>

namespace bw::scene {

Segments isolines(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::array<int, 3>>& triangles, const std::vector<double>& values,
                  const std::vector<double>& levels) {
  Segments segments;
  std::vector<double> sorted = levels;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& triangle : triangles) {
    std::array<double, 3> v;
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] = values[std::size_t(triangle[k])];
      p[k] = points[std::size_t(triangle[k])];
    }
    if (!std::isfinite(v[0] + v[1] + v[2])) continue;
    const auto [low, high] = std::minmax({v[0], v[1], v[2]});
    for (auto level = std::lower_bound(sorted.begin(), sorted.end(), low);
         level != sorted.end() && *level < high; ++level) {
      // A corner on the level counts as below it, so that neighbours agree on which edges are crossed.
      std::array<Eigen::Vector3d, 2> ends;
      std::size_t found = 0;
      for (std::size_t k = 0; k < 3 && found < 2; ++k) {
        const std::size_t n = (k + 1) % 3;
        if ((v[k] > *level) == (v[n] > *level)) continue;
        ends[found++] = p[k] + (*level - v[k]) / (v[n] - v[k]) * (p[n] - p[k]);
      }
      if (found == 2) segments.emplace_back(ends[0], ends[1]);
    }
  }
  return segments;
}

}  // namespace bw::scene
