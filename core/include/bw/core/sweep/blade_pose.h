// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// A blade that stands somewhere: what exists at one station of a sweep, however it was found.
struct BladePose {
  int index = 0;         ///< of its station
  double travel = 0;     ///< mm along the cutting direction
  Frame frame;           ///< of the plane in which the blade bends
  Elastica cut = {};     ///< the part that cuts the target
  Elastica blade = {};   ///< from grip to grip: `cut` extended at both ends to the blade's length
  double extension = 0;  ///< a ≥ 0: `blade` is `cut` over the parameters [−a, 1 + a]

  /// The ends of the blade in space: TCP origin and unit tangent in the direction of increasing arc length.
  Eigen::Vector3d leftPoint() const { return frame.toWorld(blade.start()); }
  Eigen::Vector3d leftTangent() const;
  Eigen::Vector3d rightPoint() const;
  Eigen::Vector3d rightTangent() const;

  /// Points in space of `cut` or `blade`: at arc lengths in mm from its start, or `count` ≥ 2 at equal ones.
  std::vector<Eigen::Vector3d> points(const Elastica& curve, std::span<const double> arcs) const;
  std::vector<Eigen::Vector3d> points(const Elastica& curve, int count) const;
};

/// How often a blade in this shape changes the side to which it bends. Bends so slight that no blade shows
/// them (|κ| times the length at most 1e-4), such as those of a straight section, do not count.
[[nodiscard]] int bladeInflections(const Elastica& shape);

}  // namespace bw
