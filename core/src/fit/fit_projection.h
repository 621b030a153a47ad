// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_target.h"

namespace bw::fit {

/// What a fit minimises, in units of the target's length.
struct FitObjective {
  FitNorm norm = FitNorm::L2;
  std::optional<double> fixedLength;  ///< length of the elastica; empty = free
};

/// Variable projection (docs/mathematics.md, 7.4): for a given shape the best length, turn and place are a
/// linear problem, so that only the three numbers of the shape are left. The residuals and Kaufman's Jacobian
/// for Ceres' TinySolver.
class ProjectedFit {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  ProjectedFit(const FitTarget& target, const FitObjective& objective);

  int NumResiduals() const { return static_cast<int>(2 * rows_); }
  /// Residuals (and Jacobian, by columns) in the scaled parameters `x` = shape · scale.
  bool operator()(const double* x, double* residuals, double* jacobian) const;

  /// The best placement of a shape and the objective there; empty if the shape cannot be placed.
  std::optional<FitSolution> place(const Shape& shape) const;
  /// The objective there to about seven digits, at a quarter of the cost.
  std::optional<double> roughValue(const Shape& shape) const;

  /// Descends from `start`; empty if the start cannot be placed. With a `rival`, the descent is given up
  /// (empty) as soon as it is clear that it ends at the rival or at something much worse.
  std::optional<FitSolution> solve(const Shape& start, const FitSolution* rival = nullptr);

 private:
  enum class End { converged, limit, aboveRival };
  /// Finishes a descent by Gauss–Newton steps with a secant correction for the second derivatives that
  /// Gauss–Newton leaves out, unless it is clear that it stays above a rival. Adds its steps to `steps`.
  End polish(Eigen::Vector3d& x, int& steps, const FitSolution* rival) const;
  /// Gradient of half the objective in the scaled parameters; false if the point cannot be evaluated.
  bool gradient(const Eigen::Vector3d& x, Eigen::Vector3d& g, double& value) const;

  struct Linear {
    Eigen::Vector2d factor = Eigen::Vector2d::Zero();  ///< length and turn as a complex number
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();    ///< weighted mean of the shape's points
    double squares = 0;                                ///< of the rows of the basis
  };
  /// Evaluates the shape, fills the rows of the basis, solves the linear problem.
  bool project(const Shape& shape, bool derivatives, Linear& linear) const;

  const FitTarget& target_;
  FitObjective objective_;
  std::size_t rows_;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones();
  const FitSolution* rival_ = nullptr;  ///< of the descent at hand
  std::vector<double> rootWeight_;
  std::vector<Eigen::Vector2d> goal_;
  mutable ShapeEvaluator evaluator_;
  mutable std::vector<Eigen::Vector2d> basis_;
  mutable std::vector<Eigen::Vector2d> column_;
  mutable Eigen::VectorXd residuals_;
  mutable Eigen::Matrix<double, Eigen::Dynamic, 3> jacobian_;
};

}  // namespace bw::fit
