// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/bounded_newton.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/work_meter.h"

namespace bw::detail {
namespace {

constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 40;
/// Rounding of the function's value, relative.
constexpr double kValueRounding = 1e-14;
/// Shifts of the second derivatives, relative to their largest diagonal entry.
constexpr double kFirstShift = 1e-10, kShiftGrowth = 10, kLastShift = 1e3;
/// A step below this part of the bounds' width is rounding.
constexpr double kNoStep = 1e-13;
/// Work (`WorkMeter`) of a step: in cubes of the number of unknowns, and for each of them.
constexpr std::int64_t kCubesPerUnit = 1000, kUnknownWork = 100;

Eigen::VectorXd newtonStep(const SmoothValue& now, const std::vector<int>& free) {
  const Eigen::MatrixXd bend = now.bend(free, free);
  const Eigen::VectorXd slope = now.slope(free);
  const double size = std::max(bend.diagonal().cwiseAbs().maxCoeff(), 1e-300);
  double shift = 0;
  while (shift <= kLastShift) {
    Eigen::MatrixXd shifted = bend;
    shifted.diagonal().array() += shift * size;
    const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
    if (factor.info() == Eigen::Success) return factor.solve(-slope);
    shift = shift == 0 ? kFirstShift : shift * kShiftGrowth;
  }
  return -slope / size;
}

}  // namespace

BoundedMinimum boundedNewton(const SmoothFunction& function, Eigen::VectorXd at, const Eigen::VectorXd& low,
                             const Eigen::VectorXd& high, double slopeTolerance, int maxIterations) {
  BoundedMinimum result;
  const double width = std::max((high - low).maxCoeff(), 1e-300);
  for (;;) {
    const SmoothValue now = function(at, true);
    std::vector<int> free;
    result.slope = 0;
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const bool held = (at[i] <= low[i] && now.slope[i] > 0) || (at[i] >= high[i] && now.slope[i] < 0);
      if (held) continue;
      free.push_back(int(i));
      result.slope = std::max(result.slope, std::abs(now.slope[i]));
    }
    result.active = int(at.size()) - int(free.size());
    result.converged = result.slope <= slopeTolerance;
    const std::int64_t size = at.size();
    chargeWork(size * size * size / kCubesPerUnit + kUnknownWork * size);
    if (result.converged || result.iterations >= maxIterations || workExhausted()) break;
    ++result.iterations;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(at.size());
    step(free) = newtonStep(now, free);
    bool better = false;
    Eigen::VectorXd next = at;
    double t = 1;
    for (int halving = 0; halving < kMaxHalvings && !better; ++halving, t *= 0.5) {
      next = (at + t * step).cwiseMax(low).cwiseMin(high);
      const double promised = now.slope.dot(next - at);
      const double value = function(next, false).value;
      better = std::isfinite(value) &&
               value <= now.value + kArmijo * std::min(promised, 0.0) + kValueRounding * std::abs(now.value);
    }
    const double moved = (next - at).lpNorm<Eigen::Infinity>();
    if (!better || moved < kNoStep * width) {
      // Nothing left but rounding: settled if the slope is small beside what rounding makes of it.
      result.converged = result.slope <= 1e3 * slopeTolerance;
      break;
    }
    at = next;
  }
  result.at = std::move(at);
  return result;
}

}  // namespace bw::detail
