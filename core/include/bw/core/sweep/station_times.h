// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/motion/motion.h"
#include "bw/core/sweep/blade_pose.h"

namespace bw {

/// s from the start of a motion at which its blade comes through the stations of the row that it was made of,
/// in the order of travel. A station that is no target lies on a move from the one before it that is one to
/// the next, along which the grips go evenly: its time is as far between theirs as its travel is. Empty where
/// the first or the last station is none of the motion's instants.
[[nodiscard]] std::vector<double> stationTimes(const Motion& motion, const std::vector<BladePose>& poses);

}  // namespace bw
