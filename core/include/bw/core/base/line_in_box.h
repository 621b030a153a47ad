// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <optional>

namespace bw {

/// The part of the straight way from a to b, in the axes of a box of this size from its corner, that lies in
/// the box as it is made larger by `slack` mm on all sides: the shares of the way, 0 to 1, at which it comes
/// in and goes out. Empty if it misses it.
[[nodiscard]] inline std::optional<std::array<double, 2>> lineInBox(const Eigen::Vector3d& size,
                                                                    const Eigen::Vector3d& a,
                                                                    const Eigen::Vector3d& b, double slack) {
  double from = 0, to = 1;
  for (int k = 0; k < 3; ++k) {
    const double way = b[k] - a[k], low = -slack - a[k], high = size[k] + slack - a[k];
    if (way == 0) {
      if (low > 0 || high < 0) return {};
      continue;
    }
    from = std::max(from, std::min(low / way, high / way));
    to = std::min(to, std::max(low / way, high / way));
  }
  if (from > to) return {};
  return std::array{from, to};
}

}  // namespace bw
