// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <limits>
#include <span>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/sweep/blade_pose.h"

namespace bw {

/// Where a blade is lowest over the face that its block lies on.
struct LowestPlace {
  double height = std::numeric_limits<double>::infinity();  ///< mm; negative below that face
  Eigen::Vector3d point = Eigen::Vector3d::Zero();          ///< in the file's frame
};

/// Points of a blade by which it is told how low it comes.
inline constexpr int kLowestPlaces = 41;

/// Of a blade by points at even arc lengths, in the file's frame, with parabolas between them: for
/// `kLowestPlaces` points of any blade that keeps its radius within 0.05 mm. The point is the nearest of
/// those given. Infinitely high without points.
[[nodiscard]] LowestPlace lowestPlace(const Box& block, std::span<const Eigen::Vector3d> points);
/// Of the blade in a pose, from grip to grip.
[[nodiscard]] LowestPlace lowestPlace(const Box& block, const BladePose& pose);

/// The block going on below by so many mm: the face that it lies on is that much lower, all else stays.
[[nodiscard]] Box deeper(Box block, double by);
/// The block, where the lowest of these blades comes nearer to the face that it lies on than `room`, in mm,
/// going on below by so many whole mm that none does.
[[nodiscard]] Box standingBelow(Box block, std::span<const BladePose> poses, double room);

/// Of a blade that comes nearer to the face that its block lies on than the floor: below it is what bears the
/// block, and no robot may drive a blade there.
constexpr Severity severityOfLow(double height) { return height < 0 ? Severity::error : Severity::warning; }

/// mm below the floor that are not told: heights on the way are known no better.
inline constexpr double kFloorRounded = 0.05;

}  // namespace bw
