// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bw/core/base/frame.h"

namespace bw {

/// Where a plane leaves a box: the corners of the outline, mm in the frame of the plane, in their order
/// counter-clockwise. Empty where it misses the box, or touches it alone.
[[nodiscard]] inline std::vector<Eigen::Vector2d> boxInPlane(const Box& box, const Frame& plane) {
  std::array<Eigen::Vector3d, 8> corners = box.corners();
  for (Eigen::Vector3d& corner : corners) corner = plane.toLocal(corner);
  std::vector<Eigen::Vector2d> outline;
  for (std::size_t a = 0; a < corners.size(); ++a)
    for (const std::size_t axis : {1u, 2u, 4u}) {
      const Eigen::Vector3d &p = corners[a], &q = corners[a | axis];
      // Its edges, each once, that the plane crosses.
      if ((a & axis) || (p.z() < 0) == (q.z() < 0)) continue;
      outline.push_back((p + p.z() / (p.z() - q.z()) * (q - p)).head<2>());
    }
  if (outline.size() < 3) return {};
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : outline) middle += p / double(outline.size());
  std::ranges::sort(outline, {}, [&](const Eigen::Vector2d& p) {
    return std::atan2(p.y() - middle.y(), p.x() - middle.x());
  });
  return outline;
}

}  // namespace bw
