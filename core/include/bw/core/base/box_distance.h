// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "bw/core/base/frame.h"

namespace bw {

/// Distance of a point to a box in mm, negative inside (docs/mathematics.md, clearance). `away`, if given,
/// gets the unit direction in which it grows.
[[nodiscard]] inline double boxDistance(const Box& box, const Eigen::Vector3d& point,
                                        Eigen::Vector3d* away = nullptr) {
  const Eigen::Vector3d half = 0.5 * box.size;
  const Eigen::Vector3d local = box.frame.toLocal(point) - half;
  const Eigen::Vector3d q = local.cwiseAbs() - half;
  const double outside = q.cwiseMax(0.0).norm();
  if (away) {
    Eigen::Vector3d grows = Eigen::Vector3d::Zero();
    Eigen::Index side = 0;
    q.maxCoeff(&side);
    if (outside > 0)
      grows = q.cwiseMax(0.0) / outside;
    else
      grows(side) = 1;
    grows = (local.array() < 0).select(-grows, grows);
    *away = grows.x() * box.frame.x + grows.y() * box.frame.y + grows.z() * box.frame.normal;
  }
  return outside > 0 ? outside : q.maxCoeff();
}

}  // namespace bw
