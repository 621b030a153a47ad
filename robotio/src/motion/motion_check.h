// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/core/base/result.h"
#include "bw/core/motion/motion.h"

namespace bw::robotio {

inline constexpr std::size_t kMaxInstants = 2000000;  ///< of a motion that is read or written

/// Whether a motion can be written and read: at least two instants, ascending times from 0 on, as many poses
/// at each instant as at the first (1 to 6), finite numbers, coordinates within 100 m, unit quaternions and
/// directions (within 1e-6), an orthonormal block frame. The error names the instant.
Result<void> checkMotion(const Motion& motion);

/// The farthest that any end goes from one instant to another, mm.
double farthest(const std::vector<Pose>& from, const std::vector<Pose>& to);

/// The turn from one orientation to another, degrees; the quaternions have unit length.
double turnDegrees(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to);

/// The name of one end in columns and keys: "left", "right", "end3", …
std::string endName(std::size_t end);

}  // namespace bw::robotio
