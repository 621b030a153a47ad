// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "fit/fit_constraints.h"

namespace bw::fit {

/// The fit with all seven unknowns: objective, constraints, and their derivatives (docs/mathematics.md, 7.5).
/// Unknowns in the order κ, f_t, f_n, ln length, angle, x, y of `Placement`.
class ConstrainedFit : public optimise::ConstrainedProblem {
 public:
  ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, FitNorm norm);

  Eigen::Index unknowns() const override { return 7; }
  bool objective(const Eigen::VectorXd& v, optimise::LeastSquaresModel* model, double& value) override;
  bool constraints(const Eigen::VectorXd& v, optimise::Constraints& out) override;

  /// Makes the start feasible, then descends along the constraints.
  FitSolution solve(const Placement& start, const optimise::DescentLimits& limits = {});
  /// The same with few digits and as far as is needed to tell where it leads. Not feasible if it leads to one
  /// of the ends that are known, or does not come below them soon.
  FitSolution scout(const Placement& start, const std::vector<FitSolution>& known);

  /// How far from stationary a placement is. `movement`: root mean square by which one more Gauss–Newton step
  /// would move the curve, in lengths.
  optimise::Stationarity stationarity(const Placement& placement, const std::vector<double>& peaks = {});

  /// Largest violation of any constraint (dimensionless). Fixes the branch of the end angles nearest to the
  /// placement.
  double violation(const Placement& placement);

 private:
  void chooseBranch(const Placement& placement);
  void endConstraints(const Eigen::VectorXd& v, optimise::Constraints& out);
  /// In fit_bounds.cpp, as is `shapeBounds`. Remembers peaks of the curvature that were met on the way.
  bool curvatureBounds(const Eigen::VectorXd& v, optimise::Constraints& out);
  bool shapeBounds(const Eigen::VectorXd& v, optimise::Constraints& out);

  const FitTarget& target_;
  FitConstraints constraints_;
  FitNorm norm_;
  double startAngle_ = 0, endAngle_ = 0;
  /// The start, the nodes of the target, the end: one walk serves objective and constraints.
  ShapeEvaluator nodes_;
  ShapeEvaluator range_;
  ShapeEvaluator between_;
  ShapeEvaluator foot_;
  std::vector<double> peaks_;  ///< places of peaks that were met, as parts of half the range
  std::size_t nextPeak_ = 0;
};

/// An equilibrium of a clamped blade, mm, and the objective there.
struct ClampedBlade {
  Elastica elastica;
  double value = 0;
};

/// Ends, end tangents and an exact length leave isolated curves: the equilibria of a clamped blade. All of
/// them (docs/mathematics.md, 6) with at most two inflections more than the target and a turn more than it
/// turns, nearest to the target first. Empty if `constraints` leave out one of the three or there are none.
/// Some ms.
std::vector<ClampedBlade> clampedBlades(const FitTarget& target, const FitConstraints& constraints,
                                        FitNorm norm);

Eigen::VectorXd toVector(const Placement& placement);
Placement toPlacement(const Eigen::VectorXd& v);

/// Periods within a segment of length 1, and their derivatives with respect to the shape.
struct Periods {
  double count = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};
Periods periodsOf(const Shape& shape);
inline double halfPeriodsOf(const Shape& shape) { return 2 * periodsOf(shape).count; }

}  // namespace bw::fit
