// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/bounded_newton.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/work_meter.h"

namespace bw::optimise {
namespace {

/// Part of the decrease that the gradient promises with which a step is content.
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 40;
/// Rounding of the function's value, relative.
constexpr double kValueRounding = 1e-14;
/// Where only rounding is left, a gradient within this factor of the tolerance has converged.
constexpr double kGradientRounding = 1e3;
/// Shifts of the Hessian, relative to its largest diagonal entry.
constexpr double kFirstShift = 1e-10, kShiftGrowth = 10, kLastShift = 1e3;
/// Eigenvalues below this part of the largest (or of 1) count as this.
constexpr double kFlattest = 1e-6;
/// A step below this part of the bounds' width (of 1 without bounds) is rounding.
constexpr double kNoStep = 1e-13;
/// Stands for 0 where it is divided by.
constexpr double kTiny = 1e-300;
/// Work (`WorkMeter`) of a step: in cubes of the number of unknowns, and for each of them.
constexpr std::int64_t kShiftCubesPerUnit = 1000, kReflectCubesPerUnit = 20, kUnknownWork = 100;

Eigen::VectorXd newtonStep(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                           Indefinite indefinite) {
  if (indefinite == Indefinite::reflect) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hessian);
    const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs();
    return -(solver.eigenvectors() * (solver.eigenvectors().transpose() * gradient)
                                         .cwiseQuotient(sizes.cwiseMax(kFlattest * (1 + sizes.maxCoeff()))));
  }
  const double size = std::max(hessian.diagonal().cwiseAbs().maxCoeff(), kTiny);
  double shift = 0;
  while (shift <= kLastShift) {
    Eigen::MatrixXd shifted = hessian;
    shifted.diagonal().array() += shift * size;
    const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
    if (factor.info() == Eigen::Success) return factor.solve(-gradient);
    shift = shift == 0 ? kFirstShift : shift * kShiftGrowth;
  }
  return -gradient / size;
}

}  // namespace

BoundedMinimum boundedNewton(const SmoothFunction& function, Eigen::VectorXd at, const Eigen::VectorXd& low,
                             const Eigen::VectorXd& high, const NewtonLimits& limits) {
  BoundedMinimum result;
  const double width = std::max((high - low).maxCoeff(), kTiny);
  const double least = kNoStep * (std::isfinite(width) ? width : 1);
  const std::int64_t size = at.size(), cubes = limits.indefinite == Indefinite::shift ? kShiftCubesPerUnit
                                                                                      : kReflectCubesPerUnit;
  for (;;) {
    const SmoothValue now = function(at, true);
    std::vector<int> free;
    result.gradient = 0;
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const bool held = (at[i] <= low[i] && now.gradient[i] > 0) || (at[i] >= high[i] && now.gradient[i] < 0);
      if (held) continue;
      free.push_back(int(i));
      result.gradient = std::max(result.gradient, std::abs(now.gradient[i]));
    }
    result.active = int(at.size()) - int(free.size());
    const bool finite = now.gradient.allFinite() && now.hessian.allFinite();
    result.converged = finite && result.gradient <= limits.gradient;
    // Told before it is done, so that no single decomposition exceeds the limit.
    detail::chargeWork(size * size * size / cubes + kUnknownWork * size);
    if (result.converged || !finite || result.iterations >= limits.iterations || detail::workExhausted())
      break;
    ++result.iterations;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(at.size());
    step(free) = newtonStep(now.gradient(free), now.hessian(free, free), limits.indefinite);
    if (const double longest = step.lpNorm<Eigen::Infinity>(); longest > limits.longestStep)
      step *= limits.longestStep / longest;
    bool better = false;
    Eigen::VectorXd next = at;
    double t = 1;
    for (int halving = 0; halving < kMaxHalvings && !better; ++halving, t *= 0.5) {
      next = (at + t * step).cwiseMax(low).cwiseMin(high);
      const double promised = now.gradient.dot(next - at);
      const double value = function(next, false).value;
      better = std::isfinite(value) &&
               value <= now.value + kArmijo * std::min(promised, 0.0) + kValueRounding * std::abs(now.value);
    }
    const double moved = (next - at).lpNorm<Eigen::Infinity>();
    if (!better || moved < least) {
      // Nothing left but rounding: settled if the gradient is small beside what rounding makes of it.
      result.converged = result.gradient <= kGradientRounding * limits.gradient;
      break;
    }
    at = next;
  }
  result.at = std::move(at);
  return result;
}

}  // namespace bw::optimise
