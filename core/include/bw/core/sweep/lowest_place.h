// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <limits>
#include <span>

#include "bw/core/base/frame.h"

namespace bw {

/// Where a blade is lowest over the face that its block lies on.
struct LowestPlace {
  double height = std::numeric_limits<double>::infinity();  ///< mm; negative below that face
  Eigen::Vector3d point = Eigen::Vector3d::Zero();          ///< in the file's frame
};

/// Of a blade by points at even arc lengths, in the file's frame, with parabolas between them: for 41 points
/// of any blade that keeps its radius well within 0.05 mm. Infinitely high without points.
[[nodiscard]] LowestPlace lowestPlace(const Box& block, std::span<const Eigen::Vector3d> points);

/// mm below the floor that are not told: heights on the way are known no better.
inline constexpr double kFloorRounded = 0.05;

}  // namespace bw
