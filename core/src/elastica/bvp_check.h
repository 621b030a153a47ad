// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_unit.h"

namespace bw::elastica {

/// A problem found possible, in the frame of its start with its length as unit; if neither end holds its
/// tangent, in that of the chord.
struct CheckedProblem {
  ClampedKind kind = ClampedKind::general;
  HeldEnds ends = HeldEnds::both;
  /// The start alone is hinged: all else is said of the blade run backwards, as `reversed` has it.
  bool backwards = false;
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double turning = 0;  ///< the one given, or the least in size; 0 with a hinge
  bool fixedTurning = false;

  /// The turnings to look at, least in size first, none larger than `limit` unless it is the one given. Both
  /// ends hold their tangents.
  std::vector<double> turnings(double limit) const;
};

/// The same blade run backwards.
ClampedProblem reversed(const ClampedProblem& problem);

Result<CheckedProblem> check(const ClampedProblem& problem);
Result<void> check(const ClampedOptions& options);

}  // namespace bw::elastica
