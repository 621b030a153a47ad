// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"

namespace bw {

/// The planes in which the blade may stand: parallel, across the cutting direction. A plane is told by its
/// level, direction · point; the travel is the way of the blade since it met the block. All in mm.
struct PlaneFamily {
  Frame frame;                 ///< of the plane through the block's corner; all others have its axes
  double entry = 0, exit = 0;  ///< levels between which planes meet the block
  bool operator==(const PlaneFamily&) const = default;

  /// The planes across a `direction` of length 1: y points to the side from which the block is looked at, or
  /// along its own y where the blade travels that way.
  static PlaneFamily across(const Box& block, const Eigen::Vector3d& direction);

  const Eigen::Vector3d& direction() const { return frame.normal; }
  double travel(double level) const { return level - entry; }
  Frame at(double level) const;
};

}  // namespace bw
