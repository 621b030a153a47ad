// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bw {

/// A place and an orientation in a frame that is told beside it. Of a blade end in the block frame, the
/// rotation's columns are x = unit tangent into the blade, z = cutting direction (both ends the same), y =
/// z × x.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

}  // namespace bw
