// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/curve/planar_curve.h"

namespace bw::sweep {

/// How far a blade that bends to no less than a radius must stay off a section somewhere.
struct TightSpot {
  double distance = 0;  ///< mm, a lower bound; 0 if the curvature alone tells none
  double radius = 0;    ///< mm, the smallest there
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< where that is, in the plane of the section
};

/// A section as the curvature check sees it: a chain of points whose bends are measured against circles.
/// docs/mathematics.md, too tight.
class TightSection {
 public:
  /// True if a point of the section bends below `radius` mm. Cost: below 1 µs.
  [[nodiscard]] static bool bendsBeyond(const PlanarCurve& section, double radius);

  /// Cost: some 0.1 ms.
  explicit TightSection(const PlanarCurve& section);

  /// True if no point of the section bends below `radius` mm. O(1).
  bool gentlerThan(double radius) const { return sharpest_ * radius <= 1; }
  /// The spot that keeps a blade of that smallest radius (mm) farthest off. Some 0.1 ms, unless the section
  /// is gentler than that.
  TightSpot tightest(double radius) const;
  /// The largest radius (mm) of a blade that the section's curvature keeps off by `distance` mm at most; to
  /// 0.1 %. Infinity for a section that is nearly straight.
  double widestRadius(double distance) const;

 private:
  double sharpest_ = 0;  ///< 1/mm, largest curvature
  double spacing_ = 0;   ///< mm of arc length between neighbouring points
  std::vector<Eigen::Vector2d> points_;
};

}  // namespace bw::sweep
