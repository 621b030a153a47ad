// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>

namespace bw::detail {

/// A smooth function with derivatives where asked for.
struct SmoothValue {
  double value = 0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd bend;
};
using SmoothFunction = std::function<SmoothValue(const Eigen::VectorXd&, bool derivatives)>;

struct BoundedMinimum {
  Eigen::VectorXd at;
  double slope = 0;  ///< largest free component of the gradient
  int active = 0;    ///< coordinates held by a bound
  int iterations = 0;
  bool converged = false;
};

/// Projected Newton between bounds: coordinates that press against a bound stay, the others take a Newton
/// step (shifted until the second derivatives are positive), projected and shortened until the function
/// falls.
BoundedMinimum boundedNewton(const SmoothFunction& function, Eigen::VectorXd at, const Eigen::VectorXd& low,
                             const Eigen::VectorXd& high, double slopeTolerance, int maxIterations);

}  // namespace bw::detail
