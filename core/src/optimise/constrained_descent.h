// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "optimise/active_set_step.h"

namespace bw::optimise {

/// A sum of squares under constraints: what `descend` asks of it (docs/mathematics.md, 7.5). All quantities
/// without dimension, of order one.
class ConstrainedProblem {
 public:
  virtual ~ConstrainedProblem() = default;
  virtual Eigen::Index unknowns() const = 0;
  /// Unknowns fall into this many groups of equal size, between which the value and the constraints have no
  /// mixed second derivatives.
  virtual Eigen::Index groups() const { return 1; }
  /// The value, and its model if asked for; false if the place makes no sense.
  virtual bool objective(const Eigen::VectorXd& v, LeastSquaresModel* model, double& value) = 0;
  /// The constraints and their gradients; false if the place makes no sense.
  virtual bool constraints(const Eigen::VectorXd& v, Constraints& out) = 0;
};

/// A constraint holds if it is violated by no more than this.
inline constexpr double kFeasible = 1e-10;
/// A bound counts as active if it holds with equality to this.
inline constexpr double kActive = 1e-7;

struct Descent {
  Eigen::VectorXd v;
  double value = 0;
  int iterations = 0;
  bool feasible = false;  ///< every constraint holds to kFeasible
  bool converged = false;
  bool boundActive = false;
  double violation = 0;  ///< the largest
  int worst = -1;        ///< the name of the constraint of the largest violation
};

/// Where another descent has ended: one that nears it from above is of no use.
struct DescentRival {
  Eigen::VectorXd v;
  double value = 0;
};

/// How far a descent goes. Movement is the root of the change of the value that the model tells for a step.
struct DescentLimits {
  int iterations = 150;
  int refusals = 30;      ///< steps that do not get on
  int restorations = 40;  ///< Newton steps with which a step is led back onto the constraints
  int evaluations = std::numeric_limits<int>::max();  ///< of the constraints in all restorations
  double movement = 1e-11;                            ///< a step that moves less is the last one
  double unknowns = 1e-5;                             ///< if the unknowns change by less, too
  double restored = 1e-13;                            ///< to which the constraints hold after a step
  double easing = 0.1;                                ///< of the damping after a step that gets on
  bool gradual = true;                    ///< a start that is far off is led onto the constraints in parts
  std::vector<DescentRival> rivals = {};  ///< it ends early where it nears one from above, or stays above

  /// Enough to tell where a descent leads, with constraints that are known to about seven digits.
  static DescentLimits rough(std::vector<DescentRival> rivals);
};

/// Makes the start feasible, then descends along the constraints: Gauss–Newton steps with a secant correction
/// and Levenberg–Marquardt damping under the linearised constraints (`activeSetStep`), each led back onto the
/// constraints themselves.
Descent descend(ConstrainedProblem& problem, const Eigen::VectorXd& start, const DescentLimits& limits = {});

/// The largest violation of a constraint, and its name.
struct Violation {
  double size = 0;
  int name = -1;
};
Violation largestViolation(const Constraints& constraints);

}  // namespace bw::optimise
