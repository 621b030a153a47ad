// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "fit/constrained_step.h"

namespace bw::detail {

/// A least-squares problem under conditions: what `descend` asks of it (docs/mathematics.md, 7.5). All
/// quantities without dimension, of order one.
class ConstrainedProblem {
 public:
  virtual ~ConstrainedProblem() = default;
  virtual Eigen::Index unknowns() const = 0;
  /// Unknowns fall into this many groups of equal size, between which the value and the conditions have no
  /// mixed second derivatives.
  virtual Eigen::Index groups() const { return 1; }
  /// The value, and its model if asked for; false if the place makes no sense.
  virtual bool objective(const Eigen::VectorXd& v, LeastSquaresModel* model, double& value) = 0;
  /// The conditions and their slopes; false if the place makes no sense.
  virtual bool conditions(const Eigen::VectorXd& v, Conditions& out) = 0;
};

/// A condition holds if it is missed by no more than this (lengths of the target, rad; bounds: relatively).
inline constexpr double kFeasible = 1e-10;
/// A bound counts as active if it holds with equality to this.
inline constexpr double kActive = 1e-7;

struct Descent {
  Eigen::VectorXd v;
  double value = 0;
  int iterations = 0;
  bool feasible = false;  ///< every condition holds to kFeasible
  bool converged = false;
  bool boundActive = false;
  double violation = 0;  ///< the largest
  int worst = -1;        ///< the name of the condition of the largest violation
};

/// Makes the start feasible, then descends along the conditions.
Descent descend(ConstrainedProblem& problem, const Eigen::VectorXd& start);

/// The largest violation of a condition, and its name.
struct Violation {
  double size = 0;
  int name = -1;
};
Violation largestViolation(const Conditions& conditions);

}  // namespace bw::detail
