// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/bending_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"

namespace bw::relax {
namespace {

using Eigen::VectorXd;

/// Share of the even parametrisation in the objective, over the size of the energy: it only chooses among
/// parametrisations of one curve.
constexpr double kSpreadWeight = 1e-2;
/// Of the gradient, over the size of the energy.
constexpr double kGradient = 1e-7;
constexpr int kMaxIterations = 400, kMaxMultiplierSteps = 40;
/// A length that is missed by more than this part of the miss before, so often in a row, is out of reach.
constexpr double kStuck = 0.99;
constexpr int kMaxStuck = 3;
/// Widths of the tubes on the way to a wide one.
constexpr double kTubes[] = {0.03, 0.1, 0.3, 1};

RelaxedPoints descend(const BendingProblem& problem, const PoleFreedom& freedom, double size,
                      std::optional<double> length, int maxIterations) {
  const double spreadWeight = kSpreadWeight * size;
  double multiplier = 0, penalty = length ? 100 * size : 0;
  const auto function = [&](const VectorXd& z, bool derivatives) {
    const BendingProblem::Value v = problem.evaluate(freedom.points(z), spreadWeight, derivatives);
    const double off = length ? v.length - *length : 0;
    optimise::SmoothValue value;
    value.value = v.energy + spreadWeight * v.spread + multiplier * off + 0.5 * penalty * off * off;
    if (!derivatives) return value;
    const double pull = multiplier + penalty * off;
    VectorXd gradient = v.energyGradient;
    Eigen::MatrixXd hessian = v.energyHessian;
    if (length) {
      gradient += pull * v.lengthGradient;
      hessian += pull * v.lengthHessian;
    }
    value.gradient = freedom.lift.transpose() * gradient;
    value.hessian = freedom.lift.transpose() * (hessian * freedom.lift);
    if (length) {
      const VectorXd stretch = freedom.lift.transpose() * v.lengthGradient;
      value.hessian += penalty * stretch * stretch.transpose();
    }
    return value;
  };
  RelaxedPoints outcome;
  VectorXd z = freedom.start;
  double before = std::numeric_limits<double>::infinity();
  int stuck = 0;
  for (int round = 0; round < (length ? kMaxMultiplierSteps : 1); ++round) {
    outcome.minimum = optimise::boundedNewton(
        function, z, freedom.low, freedom.high,
        {.gradient = kGradient * size, .iterations = maxIterations - outcome.iterations});
    outcome.iterations += outcome.minimum.iterations;
    z = outcome.minimum.at;
    if (!length) break;
    outcome.lengthError = problem.evaluate(freedom.points(z), 0, false).length - *length;
    if (std::abs(outcome.lengthError) < kLengthTolerance || outcome.iterations >= maxIterations) break;
    // Pressed harder and harder without coming nearer: the bounds hold the length.
    stuck = std::abs(outcome.lengthError) > kStuck * before ? stuck + 1 : 0;
    outcome.outOfReach = stuck >= kMaxStuck;
    if (outcome.outOfReach || detail::workExhausted()) break;
    multiplier += penalty * outcome.lengthError;
    if (std::abs(outcome.lengthError) > 0.1 * before) penalty *= 5;
    before = std::abs(outcome.lengthError);
  }
  return outcome;
}

}  // namespace

RelaxedPoints minimise(const BendingProblem& problem, const PoleFreedom& freedom, double size,
                       std::optional<double> length) {
  RelaxedPoints outcome = descend(problem, freedom, size, length, kMaxIterations);
  if (outcome.minimum.converged) return outcome;
  int iterations = outcome.iterations;
  PoleFreedom tube = freedom;
  for (const double share : kTubes) {
    if (detail::workExhausted()) break;
    tube.low = freedom.start + share * (freedom.low - freedom.start);
    tube.high = freedom.start + share * (freedom.high - freedom.start);
    const RelaxedPoints next = descend(problem, tube, size, length, kMaxIterations);
    iterations += next.iterations;
    if (share == 1) {
      if (next.minimum.converged) outcome = next;
    } else {
      tube.start = next.minimum.at;
    }
  }
  outcome.iterations = iterations;
  return outcome;
}

}  // namespace bw::relax
