// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace bw::detail {

/// Conditions on n unknowns at one place, linearised: equalities c = 0 first, then bounds c ≤ 0.
struct Conditions {
  Eigen::MatrixXd
      slopes;  ///< column i is the gradient of condition i; there may be more columns than conditions
  std::vector<double> values;
  std::vector<int> names;  ///< tells a condition again at another place; below 0: implied, limits steps only
  std::size_t equalities = 0;
  /// A bound that is curved by nature: its second derivatives hold size · row · rowᵀ, size ≥ 0. What its
  /// value curves besides is left to the secant correction.
  struct Bend {
    std::size_t bound = 0;
    double size = 0;
    Eigen::VectorXd row;
  };
  std::vector<Bend> bends;

  std::size_t size() const { return values.size(); }
  /// Empties the list, keeps the room.
  void clear(Eigen::Index unknowns);
  /// Adds a condition with zero slope and returns its column.
  Eigen::Index add(double value, int name);
  /// The index of a bound by its name; nothing if it is not there.
  std::optional<std::size_t> bound(int name) const;
};

/// A function near one place: its value, half its gradient and half its second derivatives without the
/// curvature of the residuals.
struct LeastSquaresModel {
  double value = 0;
  Eigen::VectorXd half;
  Eigen::MatrixXd gaussNewton;
};

/// The shortest d that solves rows · d = goals as well as can be (least squares, least norm).
Eigen::VectorXd shortestSolution(const Eigen::MatrixXd& rows, const Eigen::VectorXd& goals);

/// The step d that minimises half · d + ½ d · hessian d under the linearised conditions.
struct ConstrainedStep {
  Eigen::VectorXd d;
  std::vector<char> active;     ///< one a condition: equalities, and bounds that press
  Eigen::VectorXd multipliers;  ///< one a condition, zero where not active
};
/// `guess`: the conditions thought to be active, or empty. Nothing if the model is not convex on the
/// conditions or the conditions contradict each other.
std::optional<ConstrainedStep> constrainedStep(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& half,
                                               const Conditions& conditions, const std::vector<char>& guess);

/// How far from stationary a place is. `gradient`: norm of the gradient, projected on the conditions that
/// hold with equality and press; `movement`: root of the drop of the value by one more Gauss–Newton step.
struct Stationarity {
  double value = 0;  ///< of the function there
  double gradient = 0;
  double movement = 0;
};
/// A bound counts as holding with equality from −`slack` on.
Stationarity stationarityOf(const LeastSquaresModel& model, const Conditions& conditions, double slack);

/// The inverse of the upper Cholesky factor of a metric: steps measured by the metric are this times ordinary
/// ones.
Eigen::MatrixXd stretchOf(const Eigen::MatrixXd& metric);

}  // namespace bw::detail
