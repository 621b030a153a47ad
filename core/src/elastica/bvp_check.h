// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/elastica_bvp.h"
#include "elastica/bvp_unit.h"

namespace bw::detail {

/// A problem found possible, in the frame of its start with its length as unit.
struct CheckedProblem {
  ClampedKind kind = ClampedKind::general;
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double turning = 0;  ///< the one given, or the least in size
  bool fixedTurning = false;

  /// The turnings to look at, least in size first, none larger than `limit` unless it is the one given.
  std::vector<double> turnings(double limit) const;
};

Result<CheckedProblem> check(const ClampedProblem& problem);
Result<void> check(const ClampedOptions& options);

}  // namespace bw::detail
