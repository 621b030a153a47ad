// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// The weight of a length of blade, N/mm, in the plane of a frame.
[[nodiscard]] inline Eigen::Vector2d weightIn(const Sweep& sweep, const Frame& frame) {
  return {sweep.request.weight.dot(frame.x), sweep.request.weight.dot(frame.y)};
}

/// A blade of a row as its grips hold it, with its weight, in the plane of its frame.
[[nodiscard]] inline HeavyProblem heldAt(const Sweep& sweep, const BladePose& pose) {
  const Elastica::State end = pose.blade.at(pose.blade.length());
  HeavyProblem problem{{}, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame)};
  problem.grips.start = pose.blade.start();
  problem.grips.end = end.point;
  problem.grips.startAngle = pose.blade.startAngle();
  problem.grips.endAngle = end.angle;
  problem.grips.length = pose.blade.length();
  return problem;
}

}  // namespace bw::sweep
