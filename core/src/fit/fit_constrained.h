// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "fit/fit_target.h"

namespace bw::detail {

/// What a fit must respect, in units of the target.
struct FitConstraints {
  std::optional<double> length;  ///< of the elastica
  bool endpoints = false;
  bool tangents = false;
  std::optional<double> maxCurvature;
  std::optional<double> maxPeriods;

  bool equalities() const { return length || endpoints || tangents; }
  bool bounds() const { return maxCurvature || maxPeriods; }
};

/// The fit with all seven unknowns: objective, constraints, and their derivatives (docs/mathematics.md, 5.5).
/// Unknowns in the order κ, f_t, f_n, ln length, angle, x, y of `Placement`.
class ConstrainedFit {
 public:
  using Vector = Eigen::Matrix<double, 7, 1>;
  using Matrix = Eigen::Matrix<double, 7, 7>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 7, 0, 12, 7>;
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;

  ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, bool tangentNorm);

  struct Solution {
    Placement placement;
    double value = 0;
    int iterations = 0;
    bool feasible = false;  ///< every constraint holds to kFeasible
    bool converged = false;
    bool boundActive = false;
    double violation = 0;  ///< the largest, dimensionless
    std::string worst;     ///< the constraint of the largest violation, in words
  };
  /// Makes the start feasible, then descends along the constraints.
  Solution solve(const Placement& start);

  /// How far from stationary a placement is. `gradient`: norm of the objective's gradient, projected on the
  /// constraints that hold with equality; `movement`: root mean square by which one more Gauss–Newton step
  /// would move the curve, in lengths.
  struct Stationarity {
    double gradient = 0;
    double movement = 0;
  };
  Stationarity stationarity(const Placement& placement);

  /// Largest violation of any constraint (dimensionless); names it in `worst` if given. Fixes the branch of
  /// the end angles nearest to the placement.
  double violation(const Placement& placement, std::string* worst = nullptr);

  /// A constraint holds if it is missed by no more than this (lengths of the target, rad).
  static constexpr double kFeasible = 1e-10;

 private:
  struct Constraint {
    double value = 0;  ///< equality: = 0; bound: ≤ 0
    Vector slope = Vector::Zero();
    const char* name = "";
  };
  struct Linearised {
    double value = 0;
    Vector half = Vector::Zero();  ///< half the gradient of the objective
    Matrix gaussNewton = Matrix::Zero();
  };
  void chooseBranch(const Placement& placement);
  bool objective(const Vector& v, Linearised* derivatives, double& value);
  bool constraintsAt(const Vector& v, std::vector<Constraint>& equalities, std::vector<Constraint>& bounds);
  /// Sets the metric of the steps of `restore`.
  void measureBy(const Matrix& gaussNewton);
  /// Newton's method with the shortest steps onto the equalities, the bounds that are violated and those
  /// named in `hold`.
  bool restore(Vector& v, const std::vector<const char*>& hold, int& iterations);
  bool restoreGradually(Vector& v, int& iterations);

  const FitTarget& target_;
  FitConstraints constraints_;
  bool tangentNorm_;
  double startAngle_ = 0, endAngle_ = 0;
  ShapeEvaluator nodes_;
  ShapeEvaluator ends_;
  Matrix stretch_ = Matrix::Identity();
};

}  // namespace bw::detail
