// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "fit/constrained_descent.h"
#include "fit/fit_target.h"

namespace bw::detail {

/// What a fit must respect, in units of the target.
struct FitConstraints {
  std::optional<double> length;  ///< of the elastica
  double lengthTolerance = 0;    ///< by which `length` may be missed
  bool endpoints = false;
  bool tangents = false;
  std::optional<double> maxCurvature;
  std::optional<double>
      curvatureRange;  ///< length of the part about the middle with that bound; empty = the segment
  std::optional<double> maxPeriods;

  /// The end stays on one side of another strand of the curve, near the arc length `place`; +1 is the left of
  /// it.
  struct Strand {
    bool atStart = true;
    double place = 0;  ///< in [−½, ½]
    double side = 1;
  };
  std::optional<Strand> strand;
  std::optional<double> maxTurning;   ///< between the ends, rad
  bool openLoops = false;             ///< k below the value at which the loops of an elastica touch
  double startSign = 0, endSign = 0;  ///< if not zero, the sign of the curvature at an end

  /// Ends, tangents and length: what is left are the equilibria of a clamped blade.
  bool clamped() const { return length && endpoints && tangents; }
  bool equalities() const { return (length && lengthTolerance == 0) || endpoints || tangents; }
  bool bounds() const {
    return maxCurvature || maxPeriods || (length && lengthTolerance > 0) || strand || maxTurning ||
           openLoops || startSign != 0 || endSign != 0;
  }
};

/// The fit with all seven unknowns: objective, conditions, and their derivatives (docs/mathematics.md, 7.5).
/// Unknowns in the order κ, f_t, f_n, ln length, angle, x, y of `Placement`.
class ConstrainedFit : public ConstrainedProblem {
 public:
  ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, FitNorm norm);

  Eigen::Index unknowns() const override { return 7; }
  bool objective(const Eigen::VectorXd& v, LeastSquaresModel* model, double& value) override;
  bool conditions(const Eigen::VectorXd& v, Conditions& out) override;

  struct Solution {
    Placement placement;
    double value = 0;
    int iterations = 0;
    bool feasible = false;  ///< every condition holds to kFeasible
    bool converged = false;
    bool boundActive = false;
    double violation = 0;    ///< the largest, dimensionless
    const char* worst = "";  ///< the condition of the largest violation, in words
    std::vector<double>
        peaks;  ///< where the curvature was found to press on its bound besides the fixed places
    std::optional<Elastica> taut;  ///< the curve, where the seven numbers at its middle do not carry it
  };
  /// Makes the start feasible, then descends along the conditions.
  Solution solve(const Placement& start);
  /// The same with few digits and as far as is needed to tell where it leads. Not feasible if it leads to one
  /// of the ends that are known, or does not come below them soon.
  Solution scout(const Placement& start, const std::vector<Solution>& known);

  /// How far from stationary a placement is. `movement`: root mean square by which one more Gauss–Newton step
  /// would move the curve, in lengths.
  Stationarity stationarity(const Placement& placement, const std::vector<double>& peaks = {});

  /// Largest violation of any condition (dimensionless). Fixes the branch of the end angles nearest to the
  /// placement.
  double violation(const Placement& placement);

 private:
  Solution solve(const Placement& start, const DescentLimits& limits);
  ShapeEnds ends() const { return ShapeEnds(nodes_); }
  void chooseBranch(const Placement& placement);
  void endConditions(const Eigen::VectorXd& v, Conditions& out);
  /// In curvature_bounds.cpp. Remembers peaks of the curvature that were met on the way.
  bool curvatureBounds(const Eigen::VectorXd& v, Conditions& out);
  /// In shape_bounds.cpp.
  bool shapeBounds(const Eigen::VectorXd& v, Conditions& out);

  const FitTarget& target_;
  FitConstraints constraints_;
  FitNorm norm_;
  double startAngle_ = 0, endAngle_ = 0;
  ShapeEvaluator
      nodes_;  ///< the start, the nodes of the target, the end: one walk serves objective and conditions
  ShapeEvaluator range_;
  ShapeEvaluator between_;
  ShapeEvaluator foot_;
  std::vector<double> peaks_;  ///< places of peaks that were met, as parts of half the range
  std::size_t nextPeak_ = 0;
};

/// By how much a curve misses the conditions (lengths of the target, rad; bounds: relatively), judged from
/// its own seven numbers. Names the worst.
double largestMiss(const Elastica& elastica, const FitTarget& target, const FitConstraints& constraints,
                   const char*& name);

Eigen::VectorXd toVector(const Placement& placement);
Placement toPlacement(const Eigen::VectorXd& v);

/// Periods within a segment of length 1, and their derivatives with respect to the shape.
struct Periods {
  double count = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};
Periods periodsOf(const Shape& shape);

}  // namespace bw::detail
