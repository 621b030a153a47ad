// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "optimise/bounded_newton.h"
#include "relax/bending_problem.h"
#include "relax/refined_target.h"

namespace bw::relax {

/// The length is met to this, relatively, where the descent comes to rest; and counts as met to that.
inline constexpr double kLengthTolerance = 1e-9, kLengthMet = 1e-6;

/// Least energy, and the length by an augmented Lagrangian if one is asked for.
struct RelaxedPoints {
  optimise::BoundedMinimum minimum;
  double lengthError = 0;   ///< relative to the target's length
  bool outOfReach = false;  ///< the bounds hold the length where it is
  int iterations = 0;
};

/// Straight into the tube; where that does not come to rest, through narrower tubes, each from the curve in
/// the one before: a wide tube has room for folds that a long step falls into. `size` is that of the energy;
/// `length` in lengths of the target.
RelaxedPoints minimise(const BendingProblem& problem, const PoleFreedom& freedom, double size,
                       std::optional<double> length);

}  // namespace bw::relax
