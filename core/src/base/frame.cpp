// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bw {

std::array<Eigen::Vector3d, 8> Box::corners() const {
  std::array<Eigen::Vector3d, 8> result;
  for (int i = 0; i < 8; ++i)
    result[i] = frame.toWorld({(i & 1) ? size.x() : 0.0, (i & 2) ? size.y() : 0.0}, (i & 4) ? size.z() : 0.0);
  return result;
}

Eigen::Vector3d Box::center() const {
  return frame.toWorld({0.5 * size.x(), 0.5 * size.y()}, 0.5 * size.z());
}

Eigen::Matrix3d rotationFromAngles(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

Eigen::Vector3d anglesFromRotation(const Eigen::Matrix3d& r) {
  // R = Rx(a) Ry(b) Rz(c): R02 = sin b; at |b| = 90° only a ± c is defined and c = 0 is chosen.
  const double sb = std::clamp(r(0, 2), -1.0, 1.0);
  const double cb = std::hypot(r(0, 0), r(0, 1));
  if (cb < 1e-12) return {std::atan2(r(2, 1), r(1, 1)), std::atan2(sb, cb), 0.0};
  return {std::atan2(-r(1, 2), r(2, 2)), std::atan2(sb, cb), std::atan2(-r(0, 1), r(0, 0))};
}

Box BlockPlacement::box() const {
  const Eigen::Matrix3d r = rotationFromAngles(rotation);
  return Box{Frame{origin, r.col(0), r.col(1), r.col(2)}, size};
}

BlockPlacement placementOf(const Box& box) {
  Eigen::Matrix3d axes;
  axes << box.frame.x, box.frame.y, box.frame.normal;
  return {box.frame.origin, box.size, anglesFromRotation(axes)};
}

}  // namespace bw
