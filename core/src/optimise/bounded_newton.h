// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <limits>

namespace bw::optimise {

/// A twice differentiable function at a point. A value that is not finite says that there is none.
struct SmoothValue {
  double value = 0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};
/// Gradient and Hessian are needed only for `derivatives`. A place with derivatives is one that was asked for
/// without them just before, but for the start.
using SmoothFunction = std::function<SmoothValue(const Eigen::VectorXd&, bool derivatives)>;

/// What a step does where the Hessian is indefinite.
enum class Indefinite {
  shift,    ///< adds a multiple of the identity until it is positive definite; for many unknowns
  reflect,  ///< takes its eigenvalues by their absolute values, so that a saddle is left for either side;
            ///< costs twenty times as much
};

struct NewtonLimits {
  double gradient = 0;  ///< largest free component at which the descent has converged
  int iterations = 0;
  Indefinite indefinite = Indefinite::shift;
  double longestStep = std::numeric_limits<double>::infinity();  ///< of any unknown
};

struct BoundedMinimum {
  Eigen::VectorXd at;
  double gradient = 0;  ///< largest free component
  int active = 0;       ///< unknowns held by a bound
  int iterations = 0;
  bool converged = false;
};

/// Projected Newton between bounds (which may be infinite): unknowns that the gradient presses against their
/// bound form the active set and stay, the others take a Newton step, projected onto the bounds and halved
/// until the function falls (Armijo). Ends with the best place so far at the limit of iterations, where the
/// work is spent (`WorkMeter`) and where the derivatives are not finite.
BoundedMinimum boundedNewton(const SmoothFunction& function, Eigen::VectorXd at, const Eigen::VectorXd& low,
                             const Eigen::VectorXd& high, const NewtonLimits& limits);

}  // namespace bw::optimise
