// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <limits>
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

/// Where another descent has ended: one that nears it from above is of no use.
struct DescentRival {
  Eigen::VectorXd v;
  double value = 0;
};

/// How far a descent goes.
struct DescentLimits {
  int iterations = 150;
  int refusals = 30;      ///< steps that do not get on
  int restorations = 40;  ///< Newton steps with which a step is led back onto the conditions
  int evaluations = std::numeric_limits<int>::max();  ///< of the conditions while steps are led back, in all
  double movement = 1e-11;  ///< a step that moves the curve by less (root mean square, lengths) is the last
  double unknowns = 1e-5;   ///< if the unknowns move by less, too
  double restored = 1e-13;  ///< to which the conditions hold after a step
  double easing = 0.1;      ///< of the damping after a step that gets on
  bool gradual = true;      ///< a start that is far off is led onto the conditions little by little
  std::vector<DescentRival> rivals = {};  ///< it ends early where it nears one from above, or stays above

  /// Enough to tell where a descent leads, with conditions that are known to about seven digits.
  static DescentLimits rough(std::vector<DescentRival> rivals);
};

/// Makes the start feasible, then descends along the conditions.
Descent descend(ConstrainedProblem& problem, const Eigen::VectorXd& start, const DescentLimits& limits = {});

/// The largest violation of a condition, and its name.
struct Violation {
  double size = 0;
  int name = -1;
};
Violation largestViolation(const Conditions& conditions);

}  // namespace bw::detail
