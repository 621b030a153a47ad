// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/motion/pose.h"

namespace bw {

/// The kinematics of a robot of six axes whose last three meet in a point. In its zero position the upper arm
/// stands upright and the forearm points forward, along x of the base; axes 1 turns about the base's z, 2, 3
/// and 5 about y, 4 and 6 about x. The flange's z points out of it, its x down.
struct RobotArm {
  std::string title;
  double d1 = 0;                                    ///< mm, from the base up to axis 2,
  double a1 = 0;                                    ///< and forward to it
  double a2 = 0;                                    ///< of the upper arm
  double a3 = 0;                                    ///< from axis 3 up to the forearm's axis
  double d4 = 0;                                    ///< of the forearm, to the wrist's centre
  double d6 = 0;                                    ///< from there to the flange
  std::array<std::array<double, 2>, 6> range = {};  ///< rad, of each axis
  bool operator==(const RobotArm&) const = default;

  /// The flange in the robot's base, for six joint angles (rad).
  Pose flange(std::span<const double> joints) const;
  /// mm, of the wrist's centre from the middle of axis 2: where a flange there has it, and at most.
  double wristDistance(const Pose& flange) const;
  double reach() const { return a2 + std::hypot(d4, a3); }
  /// The joint angles within the ranges that bring the flange there: of the up to eight postures the one that
  /// turns no axis farther from `near` than any other must. Empty where none is in reach.
  std::optional<std::vector<double>> jointsFor(const Pose& flange, std::span<const double> near) const;
};

/// Reads resources/robots/<word>.json; unknown keys, wrong types and impossible values are errors that name
/// them.
Result<RobotArm> parseRobotArm(std::string_view json, const std::string& name);
/// The robot of that word; empty if there is no such file in the resource folder.
Result<std::optional<RobotArm>> findRobotArm(const std::string& word);

}  // namespace bw
