// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_unit.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace bw::elastica {

namespace {

/// The end is met when it is this close, in lengths and rad.
constexpr double kMet = 1e-13;
/// What rounding leaves of the miss where the end hangs on the shape's last digits.
constexpr double kSettled = 1e-9;
/// Misses above this, in lengths and rad, are told well enough by series of seven digits, as long as what is
/// off at the start does not grow by more than exp(kGentle) towards the end.
constexpr double kFarOff = 1e-4, kGentle = 8;

/// A shape so near to one that is known, in parts of its size, goes there: three rounds, of the costliest,
/// are spared.
constexpr double kBecomes = 1e-5;

double sizeOf(const UnitShape& q) { return std::abs(q(0)) + std::sqrt(std::hypot(q(1), q(2))); }

/// The state of a shape at arc length s, with the unit of its lengths.
template <int Directions, std::size_t Order = 22>
auto flowTo(const UnitShape& q, double s) {
  auto [flow, unit] = flowOf<Directions, Order>(q);
  flow.advanceTo(s / unit);
  return std::pair(flow.at(s / unit), unit);
}

/// Where a shape is at arc length s, with the derivatives carried along.
UnitShot shootTo(const UnitShape& q, double s) {
  const auto [block, unit] = flowTo<3>(q, s);
  const Eigen::Vector3d rows(unit, unit, 1), columns(unit, unit * unit, unit * unit);
  return {{block(0, 0) * unit, block(1, 0) * unit, block(2, 0)},
          rows.asDiagonal() * block.template block<3, 3>(0, 1).matrix() * columns.asDiagonal(),
          block(3, 0) / unit};
}

/// Columns by which the derivatives in closed form differ less than this (of their lengths' product) lose too
/// many digits.
constexpr double kIndependent = 1e-4;

/// ∂(x, y, ψ)(1)/∂(κ, f_t, f_n) from the end state alone, by scaling, by turning against sliding, and by the
/// third variation (docs/mathematics.md, 6). False near circles and other places where the three say the
/// same.
bool closedJacobian(const UnitShape& q, const UnitShot& shot, Eigen::Matrix3d& jacobian) {
  using Eigen::Vector2d;
  using Eigen::Vector3d;
  const double k0 = q(0), ft = q(1), fn = q(2), square = ft * ft + fn * fn;
  if (!(square > 1)) return false;
  const double k1 = shot.curvature;
  const Vector2d p = shot.end.head<2>(), across(-p.y(), p.x());
  const double c = std::cos(shot.end(2)), s = std::sin(shot.end(2));
  const Vector2d t1(c, s), n1(-s, c), n0(0, 1), force(ft, fn), forceAcross(-fn, ft);
  const double slope = fn * c - ft * s;      // κ'(1)
  const double constant = k0 * k0 - 2 * ft;  // κ² − 2 λ·t
  const double along = force.dot(p);

  Eigen::Matrix3d change, response;
  change.col(0) << k0, 2 * ft, 2 * fn;
  response.col(0) << t1 - p, k1;
  change.col(1) << -fn, -k0 * fn, k0 * ft;
  response.col(1) << k0 * across - (t1 - Vector2d(1, 0)), k0 - k1;
  change.col(2) << k0 * (k0 * k0 - 4 * ft), 4 * fn * fn, -4 * fn * ft;
  const auto cubic = [&](double k) { return k * (k * k / 3 - constant); };
  const Vector2d sixfold = (2 * (square - constant * along - (k1 * slope - k0 * fn)) / square) * force -
                           (3 * (cubic(k1) - cubic(k0)) / square) * forceAcross;
  const Vector2d place =
      constant * t1 + 3 * constant * p + 2 * along * t1 + sixfold + 4 * (k1 * n1 - k0 * n0) - 4 * fn * across;
  response.col(2) << place, constant * k1 + 2 * k1 * along + 4 * (slope - fn);

  // In units in which curvatures and forces of this blade are about 1.
  const double root = std::sqrt(std::sqrt(square));
  const Vector3d unit(1 / root, 1 / (root * root), 1 / (root * root));
  const Eigen::Matrix3d scaled = unit.asDiagonal() * change;
  const double volume = std::abs(scaled.determinant());
  if (!(volume > kIndependent * scaled.col(0).norm() * scaled.col(1).norm() * scaled.col(2).norm()))
    return false;
  jacobian = response * scaled.inverse() * unit.asDiagonal();
  return true;
}

/// Where a shape ends, by series of that order.
template <std::size_t Order>
UnitShot shootBy(const UnitShape& q) {
  const auto [block, unit] = flowTo<0, Order>(q, 1);
  UnitShot shot;
  shot.end = {block(0, 0) * unit, block(1, 0) * unit, block(2, 0)};
  shot.curvature = block(3, 0) / unit;
  if (!closedJacobian(q, shot, shot.jacobian)) shot.jacobian = shootTo(q, 1).jacobian;
  return shot;
}

}  // namespace

UnitShot shoot(const UnitShape& q) { return shootBy<22>(q); }

double phaseOf(const UnitShape& q) {
  const double f = std::hypot(q(1), q(2));
  return std::sqrt(q(0) * q(0) + 2 * (f - q(1))) + std::sqrt(f);
}

Held heldAt(const UnitShape& shape, const Eigen::Vector3d& end, const Eigen::Matrix3d& jacobian,
            HeldEnds ends) {
  Held held{end, jacobian};
  if (ends == HeldEnds::both) return held;
  // κ = κ0 + f_n x − f_t y.
  held.value(2) = shape(0) + shape(2) * end.x() - shape(1) * end.y();
  held.slope.row(2) =
      Eigen::RowVector3d(1, -end.y(), end.x()) + shape(2) * jacobian.row(0) - shape(1) * jacobian.row(1);
  if (ends == HeldEnds::start) return held;
  const Eigen::Vector2d chord = end.head<2>();
  held.value.head<2>() << chord.norm(), shape(0);
  held.slope.row(0) = chord.normalized().transpose() * jacobian.topRows<2>();
  held.slope.row(1) << 1, 0, 0;
  return held;
}

Eigen::Vector3d heldBy(const UnitProblem& problem) {
  if (problem.ends == HeldEnds::none) return {problem.end.norm(), 0, 0};
  return {problem.end.x(), problem.end.y(), problem.ends == HeldEnds::both ? problem.turning : 0};
}

std::optional<UnitSolution> settle(const UnitProblem& problem, UnitShape shape, int iterations,
                                   std::span<const UnitSolution> known) {
  const Eigen::Vector3d target = heldBy(problem);
  std::optional<UnitSolution> best;
  double last = INFINITY;
  bool far = phaseOf(shape) < kGentle;
  // Once it has settled, some more rounds leave the rounding.
  for (int i = 0; i <= iterations + (best ? 2 : 0); ++i) {
    const double size = sizeOf(shape);
    if (!(size < kLargestShot)) return std::nullopt;
    const auto becomes = [&](const UnitSolution& other) {
      const UnitShape off = (other.shape - shape).cwiseAbs();
      return off(0) < kBecomes * (1 + size) && off.tail<2>().sum() < kBecomes * (1 + size) * (1 + size);
    };
    if (std::ranges::any_of(known, becomes)) return std::nullopt;
    UnitShot shot;
    Held held;
    Eigen::Vector3d miss;
    double error = INFINITY;
    const auto aim = [&](const UnitShot& at) {
      shot = at;
      held = heldAt(shape, shot.end, shot.jacobian, problem.ends);
      miss = target - held.value;
      error = miss.cwiseAbs().maxCoeff();
    };
    if (far) aim(shootBy<12>(shape));
    far = far && error > kFarOff;
    if (!far) aim(shoot(shape));
    if (!(error < 1e3)) return std::nullopt;
    if (error < kSettled && (!best || error < best->error))
      best = UnitSolution{
          .shape = shape,
          .turning = problem.ends == HeldEnds::both ? problem.turning : shot.end(2),
          .error = error,
          .ends = problem.ends,
      };
    if (error < kMet || (best && error >= 0.5 * last)) return best;
    last = error;
    UnitShape step = held.slope.partialPivLu().solve(miss);
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

std::optional<UnitSolution> settleFromMiddle(const UnitProblem& problem, UnitShape middle) {
  constexpr int kRounds = 12;
  /// Ends missed by more hang on digits that no number here has.
  constexpr double kLargestMiss = 1e-10;
  std::optional<UnitSolution> best;
  double last = INFINITY;
  for (int round = 0; round < kRounds; ++round) {
    if (!(sizeOf(middle) < kLargestShot)) return std::nullopt;
    // Run backwards a blade has the opposite curvature, and the same force in the frame of its tangent.
    const UnitShot ahead = shootTo(middle, 0.5);
    UnitShot back = shootTo({-middle(0), middle(1), middle(2)}, 0.5);
    back.jacobian.col(0) *= -1;
    const double c = std::cos(back.end(2)), s = std::sin(back.end(2));
    // The chord in the frame of the middle: what the blade spans, and where the start tangent wants it.
    const Eigen::Vector2d chord(c * problem.end.x() - s * problem.end.y(),
                                s * problem.end.x() + c * problem.end.y());
    Eigen::Vector3d miss = ahead.end;
    miss.head<2>() += back.end.head<2>() - chord;
    miss(2) -= back.end(2) + problem.turning;
    const double error = miss.cwiseAbs().maxCoeff();
    if (!(error < 1e3)) return std::nullopt;
    if (error < kLargestMiss && (!best || error < best->error)) {
      UnitSolution found;
      found.shape = {-back.curvature, c * middle(1) + s * middle(2), c * middle(2) - s * middle(1)};
      found.turning = problem.turning;
      found.error = error;
      found.anchor = Elastica::Anchor{};
      found.anchor->at = 0.5;
      found.anchor->point = {c * back.end.x() + s * back.end.y(), c * back.end.y() - s * back.end.x()};
      found.anchor->angle = -back.end(2);
      found.anchor->curvature = middle(0);
      found.anchor->force = middle.tail<2>();
      best = found;
    }
    if (error < kMet || (best && error >= 0.5 * last)) break;
    last = error;
    Eigen::Matrix3d slope = ahead.jacobian;
    slope.topRows<2>() += back.jacobian.topRows<2>();
    slope.topRows<2>() -= Eigen::Vector2d(-chord.y(), chord.x()) * back.jacobian.row(2);
    slope.row(2) -= back.jacobian.row(2);
    const UnitShape step = slope.partialPivLu().solve(miss);
    if (!step.allFinite()) break;
    middle -= step;
  }
  return best;
}

}  // namespace bw::elastica
