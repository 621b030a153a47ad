// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "relax/bending_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/gauss_legendre.h"
#include "base/work_meter.h"

namespace bw::relax {
namespace {

using Eigen::Vector2d;
using Vector4 = Eigen::Vector4d;
using Matrix4 = Eigen::Matrix4d;

/// A curve that runs slower than this part of the target's speed stands still: its bending would hide in a
/// point.
constexpr double kStandstill = 0.02;

/// A function of (x', y', x'', y'') with its derivatives.
struct Local {
  double value = 0;
  Vector4 gradient = Vector4::Zero();
  Matrix4 hessian = Matrix4::Zero();
};

/// ½ c² v⁻⁵ with c = x' y'' − y' x'', v² = x'² + y'².
Local bending(const Vector2d& d1, const Vector2d& d2) {
  const double c = d1.x() * d2.y() - d1.y() * d2.x();
  const double w = d1.squaredNorm();
  const double f = std::pow(w, -2.5), fw = -2.5 * f / w, fww = 8.75 * f / (w * w);
  Vector4 cGradient(d2.y(), -d2.x(), -d1.y(), d1.x()), wGradient(2 * d1.x(), 2 * d1.y(), 0, 0);
  Local local;
  local.value = 0.5 * c * c * f;
  local.gradient = c * f * cGradient + 0.5 * c * c * fw * wGradient;
  local.hessian = f * cGradient * cGradient.transpose() +
                  c * fw * (cGradient * wGradient.transpose() + wGradient * cGradient.transpose()) +
                  0.5 * c * c * fww * wGradient * wGradient.transpose();
  local.hessian(0, 3) += c * f;
  local.hessian(3, 0) += c * f;
  local.hessian(1, 2) -= c * f;
  local.hessian(2, 1) -= c * f;
  local.hessian(0, 0) += c * c * fw;
  local.hessian(1, 1) += c * c * fw;
  return local;
}

/// ½ q² with q = (d1·d2 − r d1·d1)/v², half the slope of the squared speed over the target's v².
Local spreading(const Vector2d& d1, const Vector2d& d2, double speed, double rise) {
  const double scale = 1 / (speed * speed);
  const double q = scale * (d1.dot(d2) - rise * d1.squaredNorm());
  Vector4 gradient;
  gradient << scale * (d2 - 2 * rise * d1), scale * d1;
  Local local;
  local.value = 0.5 * q * q;
  local.gradient = q * gradient;
  local.hessian = gradient * gradient.transpose();
  for (int i = 0; i < 2; ++i) {
    local.hessian(i, i) -= 2 * q * scale * rise;
    local.hessian(i, i + 2) += q * scale;
    local.hessian(i + 2, i) += q * scale;
  }
  return local;
}

}  // namespace

BendingProblem::BendingProblem(const SplineSpace& space, const Eigen::MatrixX2d& target)
    : count_(space.size()) {
  // The energy is not polynomial: two more nodes a span than a polynomial of the degree would ask for.
  const detail::GaussRule rule = detail::gaussRule(space.degree + 2);
  for (std::size_t s = 0; s + 1 < space.breaks.size(); ++s) {
    const double low = space.breaks[s], width = space.breaks[s + 1] - low;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      Node node;
      node.weight = width * rule.weights[k];
      node.first = space.basis(low + width * rule.nodes[k], node.basis);
      const Eigen::Matrix<double, 3, 2> d =
          node.basis.transpose() * target.middleRows(node.first, space.degree + 1);
      const Vector2d d1 = d.row(1), d2 = d.row(2);
      node.speed = d1.norm();
      node.speedRise = d1.dot(d2) / d1.squaredNorm();
      nodes_.push_back(std::move(node));
    }
  }
}

BendingProblem::Value BendingProblem::evaluate(const Eigen::VectorXd& points, double weight,
                                               bool derivatives) const {
  Value value;
  const Eigen::Index n = 2 * count_;
  if (derivatives) {
    value.energyGradient = value.lengthGradient = Eigen::VectorXd::Zero(n);
    value.energyHessian = value.lengthHessian = Eigen::MatrixXd::Zero(n, n);
  }
  const Eigen::Map<const Eigen::Matrix2Xd> poles(points.data(), 2, count_);
  Vector2d before = Vector2d::Zero();
  for (const Node& node : nodes_) {
    const Eigen::Index m = node.basis.rows();
    const Eigen::Matrix<double, 2, 3> d = poles.middleCols(node.first, m) * node.basis;
    const Vector2d d1 = d.col(1), d2 = d.col(2);
    const Local bend = bending(d1, d2), spread = spreading(d1, d2, node.speed, node.speedRise);
    const double v = d1.norm();
    if (before.dot(d1) < 0 || v < kStandstill * node.speed) {
      value.energy = std::numeric_limits<double>::infinity();
      return value;
    }
    before = d1;
    value.energy += node.weight * bend.value;
    value.spread += node.weight * spread.value;
    value.length += node.weight * v;
    if (!derivatives) continue;
    // (x', y', x'', y'') from the control points that matter here.
    Eigen::Matrix<double, 4, Eigen::Dynamic> lift = Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, 2 * m);
    for (Eigen::Index j = 0; j < m; ++j)
      for (int c = 0; c < 2; ++c) {
        lift(c, 2 * j + c) = node.basis(j, 1);
        lift(2 + c, 2 * j + c) = node.basis(j, 2);
      }
    const Eigen::Index at = 2 * node.first;
    value.energyGradient.segment(at, 2 * m) +=
        node.weight * lift.transpose() * (bend.gradient + weight * spread.gradient);
    value.energyHessian.block(at, at, 2 * m, 2 * m) +=
        node.weight * lift.transpose() * (bend.hessian + weight * spread.hessian) * lift;
    const Vector2d t = d1 / v;
    const Eigen::Matrix2d across = (Eigen::Matrix2d::Identity() - t * t.transpose()) / v;
    value.lengthGradient.segment(at, 2 * m) += node.weight * lift.topRows<2>().transpose() * t;
    value.lengthHessian.block(at, at, 2 * m, 2 * m) +=
        node.weight * lift.topRows<2>().transpose() * across * lift.topRows<2>();
  }
  return value;
}
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
