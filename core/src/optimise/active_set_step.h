// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace bw::optimise {

/// Constraints on n unknowns at one place, linearised: equalities c = 0 first, then bounds c ≤ 0.
struct Constraints {
  Eigen::MatrixXd gradients;  ///< by columns; there may be more columns than constraints
  std::vector<double> values;
  std::vector<int> names;  ///< tells a constraint again at another place; below 0: implied, limits steps only
  std::size_t equalities = 0;
  /// The Hessian of a bound that is curved by nature: size · row · rowᵀ, size ≥ 0. What its value curves
  /// besides is left to the secant correction.
  struct Hessian {
    std::size_t bound = 0;
    double size = 0;
    Eigen::VectorXd row;
  };
  std::vector<Hessian> hessians;

  std::size_t size() const { return values.size(); }
  Eigen::MatrixXd::ConstColXpr gradient(std::size_t i) const {
    return gradients.col(static_cast<Eigen::Index>(i));
  }
  /// Empties the list, keeps the room.
  void clear(Eigen::Index unknowns);
  /// Adds a constraint and returns its gradient, zero yet, which is valid until the next one is added.
  Eigen::MatrixXd::ColXpr add(double value, int name);
  /// The index of a bound by its name; nothing if it is not there.
  std::optional<std::size_t> bound(int name) const;
};

/// A sum of squares near one place: its value, half its gradient and half its Hessian without the second
/// derivatives of the residuals.
struct LeastSquaresModel {
  double value = 0;
  Eigen::VectorXd halfGradient;
  Eigen::MatrixXd gaussNewton;
};

/// The shortest d that solves rows · d = goals as well as can be (least squares, least norm).
Eigen::VectorXd leastNormSolution(const Eigen::MatrixXd& rows, const Eigen::VectorXd& goals);

/// Non-negative least squares: the u ≥ 0 that minimises |A u − b|, by the active sets of Lawson and Hanson
/// (Solving Least Squares Problems, 1974, chapter 23). Columns of A of like size, so that the choice of the
/// entering one is fair. Of several solutions one with linearly independent columns.
Eigen::VectorXd nonNegativeLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The minimum of a quadratic function under linear constraints.
struct ActiveSetStep {
  Eigen::VectorXd d;
  std::vector<char> active;     ///< one a constraint: 1 for equalities and active bounds
  Eigen::VectorXd multipliers;  ///< one a constraint, zero where not active
};
/// The step d that minimises gradient · d + ½ d · hessian d under the linearised constraints. `guess`: the
/// constraints thought to be active, or empty. Nothing if the function is not convex on the constraints.
/// Where more bounds became active than can hold together the step misses them by least squares: whoever
/// takes it checks the constraints there.
std::optional<ActiveSetStep> activeSetStep(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                                           const Constraints& constraints, const std::vector<char>& guess);

/// How far from stationary a place is. `gradient`: norm of the gradient, projected on the active constraints;
/// `movement`: root of the drop of the value by one more Gauss–Newton step.
struct Stationarity {
  double value = 0;  ///< of the function there
  double gradient = 0;
  double movement = 0;
};
/// Bounds are active from −`slack` on, if their multipliers have the right sign.
Stationarity stationarityOf(const LeastSquaresModel& model, const Constraints& constraints, double slack);

}  // namespace bw::optimise
