// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_unit.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

#include "elastica/elastica_flow.h"

namespace bw::detail {

namespace {

/// The end is met when it is this close, in lengths and rad.
constexpr double kMet = 1e-13;
/// What rounding leaves of the miss where the end hangs on the shape's last digits.
constexpr double kSettled = 1e-9;

double sizeOf(const UnitShape& q) { return std::abs(q(0)) + std::sqrt(std::hypot(q(1), q(2))); }

}  // namespace

namespace {

/// Visits the flow of a shape at arc length s, with the unit of its lengths.
template <int Directions>
std::pair<typename ElasticaFlow<Directions>::Block, double> flowTo(const UnitShape& q, double s) {
  const double rate = std::max({std::abs(q(0)), std::sqrt(std::hypot(q(1), q(2))), 1.0});
  const double unit = std::ldexp(1.0, -std::ilogb(rate) - 1);
  const FlowParameters parameters{q(0) * unit, q(1) * unit * unit, q(2) * unit * unit};
  ElasticaFlow<Directions> flow(
      parameters, invariants(parameters.curvature, parameters.tangential, parameters.normal), 1);
  flow.advanceTo(s / unit);
  return {flow.at(s / unit), unit};
}

}  // namespace

UnitShot shoot(const UnitShape& q) {
  const auto [block, unit] = flowTo<3>(q, 1);
  const Eigen::Vector3d rows(unit, unit, 1), columns(unit, unit * unit, unit * unit);
  UnitShot shot;
  shot.end = block.col(0).head<3>().matrix().cwiseProduct(rows);
  shot.jacobian = rows.asDiagonal() * block.block<3, 3>(0, 1).matrix() * columns.asDiagonal();
  shot.curvature = block(3, 0) / unit;
  return shot;
}

UnitShape backOf(const UnitShape& q, double turning, double endCurvature) {
  const double c = std::cos(turning), s = std::sin(turning);
  return {-endCurvature, c * q(1) + s * q(2), c * q(2) - s * q(1)};
}

double gapInTheMiddle(const UnitProblem& problem, const UnitSolution& solution) {
  const auto [front, frontUnit] = flowTo<0>(solution.shape, 0.5);
  const auto [back, backUnit] = flowTo<0>(solution.back, 0.5);
  // The back half starts at the end with the tangent turned about.
  const double c = -std::cos(problem.turning), s = -std::sin(problem.turning);
  const double x = problem.end.x() + backUnit * (c * back(0, 0) - s * back(1, 0));
  const double y = problem.end.y() + backUnit * (s * back(0, 0) + c * back(1, 0));
  const double gap = std::max({std::abs(front(0, 0) * frontUnit - x), std::abs(front(1, 0) * frontUnit - y),
                               std::abs(front(2, 0) - problem.turning - back(2, 0))});
  return std::isfinite(gap) ? gap : INFINITY;
}

double phaseOf(const UnitShape& q) {
  const double f = std::hypot(q(1), q(2));
  return std::sqrt(q(0) * q(0) + 2 * (f - q(1))) + std::sqrt(f);
}

std::optional<UnitSolution> settle(const UnitProblem& problem, UnitShape shape, int iterations) {
  const Eigen::Vector3d target(problem.end.x(), problem.end.y(), problem.turning);
  std::optional<UnitSolution> best;
  double last = INFINITY;
  for (int i = 0; i <= iterations; ++i) {
    const double size = sizeOf(shape);
    if (!(size < kLargestShot)) return std::nullopt;
    const UnitShot shot = shoot(shape);
    const Eigen::Vector3d miss = target - shot.end;
    const double error = miss.cwiseAbs().maxCoeff();
    if (!(error < 1e3)) return std::nullopt;
    if (error < kSettled && (!best || error < best->error))
      best = UnitSolution{shape, backOf(shape, problem.turning, shot.curvature), problem.turning,
                          shot.jacobian, error};
    if (error < kMet || (best && error >= 0.5 * last)) return best;
    last = error;
    UnitShape step = shot.jacobian.partialPivLu().solve(miss);
    if (!step.allFinite()) return best;
    // A step turns or bends the blade by no more than about a radian.
    const double limit = 1.5 + 0.25 * size;
    const double force = std::sqrt(std::hypot(shape(1), shape(2)));
    const double length = std::max(std::abs(step(0)), std::hypot(step(1), step(2)) / (6 + 2 * force)) / limit;
    if (length > 1) step /= length;
    shape += step;
  }
  return best;
}

}  // namespace bw::detail
