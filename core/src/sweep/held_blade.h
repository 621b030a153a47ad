// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// A blade of a row as its grips hold it, with its weight, in the plane of its frame.
[[nodiscard]] inline HeavyProblem heldAt(const Sweep& sweep, const BladePose& pose) {
  const Elastica::State end = pose.blade.at(pose.blade.length());
  const Eigen::Vector3d& weight = sweep.request.weight;
  HeavyProblem problem{
      {}, sweep.request.blade.flexuralRigidity(), {weight.dot(pose.frame.x), weight.dot(pose.frame.y)}};
  problem.grips.start = pose.blade.start();
  problem.grips.end = end.point;
  problem.grips.startAngle = pose.blade.startAngle();
  problem.grips.endAngle = end.angle;
  problem.grips.length = pose.blade.length();
  return problem;
}

}  // namespace bw::sweep
