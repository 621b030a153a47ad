// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"

namespace bw {

/// The parallel planes of a row of stations, across the cutting direction. A plane is told by its level,
/// direction · point, or by its number in the row; the travel is the way of the blade since it met the block.
/// All in mm.
struct PlaneFamily {
  Frame frame;                 ///< of the plane through the block's corner; all others have its axes
  double entry = 0, exit = 0;  ///< levels between which planes meet the block
  double first = 0, last = 0;  ///< levels of the first and the last plane of the row
  int count = 0;               ///< of planes, evenly spaced

  /// The planes across a `direction` of length 1, not placed yet: y points to the side from which the block
  /// is looked at, or along its own y where the blade travels that way.
  static PlaneFamily across(const Box& block, const Eigen::Vector3d& direction);

  const Eigen::Vector3d& direction() const { return frame.normal; }
  double level(int i) const { return i + 1 == count ? last : first + (last - first) * i / (count - 1); }
  double travel(double level) const { return level - entry; }
  Frame at(double level) const;
};

}  // namespace bw
