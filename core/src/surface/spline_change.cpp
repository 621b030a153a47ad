// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/spline_change.h"

#include <cstddef>

namespace bw {

Eigen::AlignedBox2d changedPart(const SplineSurface& before, const SplineSurface& after) {
  if (before.degreeU != after.degreeU || before.degreeV != after.degreeV || before.polesU != after.polesU ||
      before.polesV != after.polesV || before.knotsU != after.knotsU || before.knotsV != after.knotsV)
    return {Eigen::Vector2d(after.knotsU.front(), after.knotsV.front()),
            Eigen::Vector2d(after.knotsU.back(), after.knotsV.back())};
  Eigen::AlignedBox2d changed;
  for (int j = 0; j < after.polesV; ++j)
    for (int i = 0; i < after.polesU; ++i) {
      const std::size_t pole = std::size_t(j) * std::size_t(after.polesU) + std::size_t(i);
      if (before.poles[pole] == after.poles[pole]) continue;
      changed.extend(Eigen::Vector2d(after.knotsU[std::size_t(i)], after.knotsV[std::size_t(j)]));
      changed.extend(Eigen::Vector2d(after.knotsU[std::size_t(i + after.degreeU + 1)],
                                     after.knotsV[std::size_t(j + after.degreeV + 1)]));
    }
  return changed;
}

}  // namespace bw
