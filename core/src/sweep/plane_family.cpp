// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/plane_family.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace bw {

PlaneFamily PlaneFamily::across(const Box& block, const Eigen::Vector3d& direction) {
  constexpr double kParallel = 1e-6;  // sine of an angle: below it two directions are one
  PlaneFamily planes{block.frame, 1e300, -1e300};
  Frame& frame = planes.frame;
  const auto across = [&](const Eigen::Vector3d& axis) -> Eigen::Vector3d {
    return axis - axis.dot(direction) * direction;
  };
  Eigen::Vector3d up = across(block.frame.normal);
  if (up.norm() < kParallel) up = across(block.frame.y);
  frame.normal = direction;
  frame.y = up.normalized();
  frame.x = frame.y.cross(direction);
  for (const Eigen::Vector3d& corner : block.corners()) {
    planes.entry = std::min(planes.entry, direction.dot(corner));
    planes.exit = std::max(planes.exit, direction.dot(corner));
  }
  return planes;
}

Frame PlaneFamily::at(double level) const {
  Frame plane = frame;
  plane.origin += (level - direction().dot(frame.origin)) * direction();
  return plane;
}

}  // namespace bw
