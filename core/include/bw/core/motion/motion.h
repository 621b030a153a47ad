// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

#include "bw/core/base/frame.h"

namespace bw {

/// The pose of one blade end at one instant, in the block frame. The rotation's columns are x = unit tangent
/// into the blade, z = cutting direction (both ends the same), y = z × x.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// One instant of a synchronised motion: one pose a task, in the order left, right.
struct MotionInstant {
  double time = 0;   ///< s from the start of the cut
  int station = -1;  ///< index of the station, −1 in the leads
  std::vector<Pose> poses;
};

/// A timed motion of the blade's ends in the frame of the block: what a robot program is written from.
struct Motion {
  Box block;
  double bladeLength = 0;   ///< mm
  double cuttingSpeed = 0;  ///< mm/s of the fastest point of the blade
  std::vector<MotionInstant> instants;

  /// s, leads included.
  double duration() const { return instants.empty() ? 0.0 : instants.back().time; }
};

}  // namespace bw
