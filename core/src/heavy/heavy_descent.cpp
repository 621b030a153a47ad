// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_descent.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"

namespace bw::heavy {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostFalls = 100;
constexpr int kHalvings = 12;
constexpr double kLongestFall = 0.7;   // rad: a step that does not leave the valley
constexpr double kNearRest = 1e-5;     // of the gradient: Newton's method does the rest
constexpr double kStiffEnough = 1e-3;  // smaller eigenvalues count as this
constexpr double kOffASaddle = 0.05;   // rad: a step from where nothing pulls but nothing holds either
constexpr double kFirstStride = 0.03;  // rad, of a way that begins beside an unstable shape
constexpr double kStride = 0.5;        // of that way, the longest from there on

/// Leads the coefficients back to where the ends are held, by the shortest way.
bool close(const Modes& modes, const Hold& hold, Shape& shape) {
  constexpr double kClosed = 1e-12;
  for (int i = 0; i < 8; ++i) {
    const Equations equations(modes, hold, shape);
    const Eigen::Vector2d miss = equations.residual().tail<2>();
    if (miss.lpNorm<Eigen::Infinity>() < kClosed) return true;
    const auto a = equations.closure();
    const Eigen::Matrix2d normal = a.transpose() * a;
    shape.coefficients += a * normal.partialPivLu().solve(miss);
    if (!shape.coefficients.allFinite()) return false;
  }
  return false;
}

/// The force at the end grip that balances the coefficients best.
void balance(const Modes& modes, const Hold& hold, Shape& shape) {
  shape.force.setZero();
  const Equations equations(modes, hold, shape);
  const auto a = equations.closure();
  const Eigen::Matrix2d normal = a.transpose() * a;
  shape.force = normal.partialPivLu().solve(a.transpose() * equations.residual().head(shape.count())).eval();
}

}  // namespace

VectorXd softest(const Equations& equations) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(reducedHessian(equations));
  return freeDirections(equations) * eigen.eigenvectors().col(0);
}

std::vector<VectorXd> givingWay(const Equations& equations) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(reducedHessian(equations));
  const MatrixXd free = freeDirections(equations);
  std::vector<VectorXd> ways;
  for (Eigen::Index i = 0; i < eigen.eigenvalues().size() && eigen.eigenvalues()(i) < 0; ++i)
    ways.push_back(free * eigen.eigenvectors().col(i));
  return ways;
}

namespace {

/// A shape pushed off where it is, by a part of the push where its ends do not allow for more of it: a blade
/// that is held nearly taut.
std::optional<Shape> pushed(const Modes& modes, const Hold& hold, const Shape& start, VectorXd push) {
  for (int halving = 0; halving < kHalvings; ++halving, push *= 0.5) {
    Shape shape{(start.coefficients + push).head(modes.count()), start.force};
    if (close(modes, hold, shape)) return shape;
  }
  return {};
}

std::optional<Shape> fallFrom(const Hold& hold, const Shape& start, const VectorXd& push, bool beside) {
  // The way down needs no fine modes, only its end.
  const Modes& modes = modesOf(1);
  std::optional<Shape> begin = pushed(modes, hold, start, push);
  if (!begin) return {};
  Shape shape = std::move(*begin);
  balance(modes, hold, shape);
  const VectorXd from = shape.coefficients;
  double energy = Equations(modes, hold, shape).energy();
  for (int i = 0; i < kMostFalls && !detail::workExhausted(); ++i) {
    const Equations equations(modes, hold, shape);
    const MatrixXd free = freeDirections(equations);
    const VectorXd gradient = free.transpose() * equations.residual().head(shape.count());
    const MatrixXd hessian = reducedHessian(equations);
    VectorXd step;
    // Stiff enough in all directions, which a factorisation shows in a fraction of the time, it needs no
    // other steps than Newton's.
    const MatrixXd beyond = hessian - kStiffEnough * MatrixXd::Identity(hessian.rows(), hessian.cols());
    if (beyond.llt().info() == Eigen::Success) {
      if (gradient.norm() < kNearRest) break;
      step = free * -hessian.llt().solve(gradient);
    } else {
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(hessian);
      const bool holds = eigen.eigenvalues()(0) > 0;
      if (gradient.norm() < kNearRest && holds) break;
      step = eigen.eigenvectors().transpose() * gradient;
      step.array() /= -eigen.eigenvalues().array().abs().max(kStiffEnough);
      if (!holds && std::abs(step(0)) < kOffASaddle) step(0) = step(0) < 0 ? -kOffASaddle : kOffASaddle;
      step = free * (eigen.eigenvectors() * step);
    }
    const double longest =
        beside ? std::clamp(kStride * (shape.coefficients - from).norm(), kFirstStride, kLongestFall)
               : kLongestFall;
    step *= std::min(1.0, longest / step.norm());
    bool lower = false;
    for (int halving = 0; halving < kHalvings && !lower; ++halving, step *= 0.5) {
      Shape next = shape;
      next.coefficients += step;
      if (!close(modes, hold, next)) continue;
      const double there = Equations(modes, hold, next).energy();
      if (!(there < energy)) continue;
      balance(modes, hold, next);
      shape = std::move(next);
      energy = there;
      lower = true;
    }
    if (!lower) break;
  }
  const std::optional<Shape> rest = settle(hold, shape, 8);
  if (!rest || !isStable(Equations(modes, hold, *rest))) return {};
  return refined(hold, *rest, kResolved);
}

}  // namespace

std::optional<Shape> fall(const Hold& hold, const Shape& start, const VectorXd& push) {
  return fallFrom(hold, start, push, false);
}

std::optional<Shape> fallBeside(const Hold& hold, const Shape& start, const VectorXd& push) {
  return fallFrom(hold, start, push, true);
}

std::optional<Shape> passBeside(const Hold& hold, const Shape& start, const VectorXd& up,
                                const VectorXd& push) {
  const Modes& modes = modesOf(1);
  Shape shape{(start.coefficients + push).head(modes.count()), start.force};
  if (!close(modes, hold, shape)) return {};
  balance(modes, hold, shape);
  const VectorXd from = shape.coefficients;
  VectorXd climbing = up.head(modes.count());
  for (int i = 0; i < kMostFalls && !detail::workExhausted(); ++i) {
    const Equations equations(modes, hold, shape);
    const MatrixXd free = freeDirections(equations);
    const VectorXd gradient = free.transpose() * equations.residual().head(shape.count());
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(reducedHessian(equations));
    const MatrixXd directions = free * eigen.eigenvectors();
    Eigen::Index along = 0;
    (directions.transpose() * climbing).cwiseAbs().maxCoeff(&along);
    climbing = directions.col(along);
    const auto soft = (eigen.eigenvalues().array() < 0).count();
    if (gradient.norm() < kNearRest && soft == 1 && along == 0) break;
    VectorXd step = eigen.eigenvectors().transpose() * gradient;
    step.array() /= -eigen.eigenvalues().array().abs().max(kStiffEnough);
    step(along) = -step(along);
    const double longest =
        std::clamp(kStride * (shape.coefficients - from).norm(), kFirstStride, kLongestFall);
    step *= std::min(1.0, longest / step.norm());
    shape.coefficients += directions * step;
    if (!close(modes, hold, shape)) return {};
    balance(modes, hold, shape);
  }
  const std::optional<Shape> pass = settle(hold, shape, 8);
  if (!pass || givingWay(Equations(modesOf(pass->count()), hold, *pass)).size() != 1) return {};
  return refined(hold, *pass, kResolved);
}

}  // namespace bw::heavy
