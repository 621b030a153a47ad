// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/bending_problem.h"

#include <cmath>
#include <limits>

#include "base/gauss_legendre.h"

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

}  // namespace bw::relax
