// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"

namespace bw::heavy {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

Equations::Equations(const Modes& modes, const Hold& hold, const Shape& shape)
    : modes_(&modes), hold_(hold), shape_(shape) {
  Sampled& s = sampled_;
  s.angle.noalias() = modes.values.transpose() * shape.coefficients;
  s.angle += hold.turning * modes.nodes;
  s.angle.array() += hold.startAngle;
  s.cosine = s.angle.array().cos();
  s.sine = s.angle.array().sin();
  const ArrayXd left = 1 - modes.nodes.array();
  const ArrayXd x = shape.force.x() + hold.load.x() * left, y = shape.force.y() + hold.load.y() * left;
  s.along = x * s.cosine + y * s.sine;
  s.across = y * s.cosine - x * s.sine;
}

VectorXd Equations::moments(const ArrayXd& f) const {
  return modes_->values * (modes_->weights.array() * f).matrix();
}

VectorXd Equations::residual() const {
  VectorXd result(shape_.count() + 2);
  result << shape_.coefficients - moments(sampled_.across),
      hold_.chord.x() - modes_->weights.dot(sampled_.cosine.matrix()),
      hold_.chord.y() - modes_->weights.dot(sampled_.sine.matrix());
  return result;
}

const MatrixXd& Equations::hessian() const {
  if (hessian_) return *hessian_;
  // Charged like the eigenvalues of the weightless blade: half a microsecond for a hundred products.
  detail::chargeWork(modes_->count() * modes_->count() * modes_->nodes.size() / 400);
  const MatrixXd weighted = modes_->values * (modes_->weights.array() * sampled_.along).matrix().asDiagonal();
  MatrixXd result = MatrixXd::Identity(modes_->count(), modes_->count());
  result.template triangularView<Eigen::Lower>() += weighted * modes_->values.transpose();
  return hessian_.emplace(result.selfadjointView<Eigen::Lower>());
}

Eigen::Matrix<double, Eigen::Dynamic, 2> Equations::closure() const {
  Eigen::Matrix<double, Eigen::Dynamic, 2> result(modes_->count(), 2);
  result << moments(-sampled_.sine), moments(sampled_.cosine);
  return result;
}

namespace {

/// The second derivative of the energy, bordered with the gradients of what holds the ends.
MatrixXd bordered(const MatrixXd& hessian, const Eigen::Matrix<double, Eigen::Dynamic, 2>& closure) {
  const Index n = hessian.rows();
  MatrixXd result = MatrixXd::Zero(n + 2, n + 2);
  result.topLeftCorner(n, n) = hessian;
  result.topRightCorner(n, 2) = -closure;
  result.bottomLeftCorner(2, n) = result.topRightCorner(n, 2).transpose();
  return result;
}

}  // namespace

MatrixXd Equations::jacobian() const { return bordered(hessian(), closure()); }

const Eigen::PartialPivLU<MatrixXd>& Equations::factors() const {
  if (!factors_) factors_.emplace(jacobian());
  return *factors_;
}

VectorXd Equations::along(const Hold& change) const {
  const ArrayXd turned = change.startAngle + change.turning * modes_->nodes.array();
  const ArrayXd left = 1 - modes_->nodes.array();
  const ArrayXd loaded = left * (change.load.y() * sampled_.cosine - change.load.x() * sampled_.sine);
  VectorXd result(modes_->count() + 2);
  result << moments(sampled_.along * turned - loaded),
      change.chord.x() + modes_->weights.dot((turned * sampled_.sine).matrix()),
      change.chord.y() - modes_->weights.dot((turned * sampled_.cosine).matrix());
  return result;
}

double Equations::energy() const {
  const ArrayXd left = 1 - modes_->nodes.array();
  return 0.5 * (hold_.turning * hold_.turning + shape_.coefficients.squaredNorm()) -
         modes_->weights.dot(
             (left * (hold_.load.x() * sampled_.cosine + hold_.load.y() * sampled_.sine)).matrix());
}

namespace {

/// True if the energy falls along an odd number of the directions that the constraints leave free, by the
/// factors of the bordered matrix: its determinant has the sign of that of the reduced one, as there are two
/// constraints.
bool fallsOddly(const Eigen::PartialPivLU<MatrixXd>& factors) {
  const auto below = (factors.matrixLU().diagonal().array() < 0).count();
  return (below % 2 == 0) == (factors.permutationP().determinant() < 0);
}

}  // namespace

std::optional<Shape> settle(const Hold& hold, Shape shape, int iterations, Settling* seen,
                            const Equations* from) {
  constexpr double kLost = 1e3;       // no sensible coefficient is as large
  constexpr double kStillGood = 0.1;  // of the step before: the factors serve once more
  const Modes& modes = modesOf(shape.count());
  std::optional<Eigen::PartialPivLU<MatrixXd>> own;
  const Eigen::PartialPivLU<MatrixXd>* factors = nullptr;
  double before = 0;
  if (seen) *seen = {};
  for (int i = 0; i <= iterations; ++i) {
    VectorXd step;
    if (i == 0 && from) {
      factors = &from->factors();
      step = factors->solve(from->along(hold - from->hold()));
    } else {
      const Equations equations(modes, hold, shape);
      const VectorXd residual = equations.residual();
      // Rounding grows with the force.
      const double size = 1 + shape.force.norm() + hold.load.norm();
      if (residual.lpNorm<Eigen::Infinity>() < kAtRest * size) {
        if (seen && factors) seen->fallsOddly = fallsOddly(*factors);
        return shape;
      }
      if (i == iterations || detail::workExhausted()) break;
      if (factors) step = factors->solve(residual);
      if (!factors || !(step.head(shape.count()).norm() < kStillGood * before)) {
        own = equations.jacobian().partialPivLu();
        factors = &*own;
        step = factors->solve(residual);
      }
    }
    const double length = step.head(shape.count()).norm();
    if (!step.allFinite() || length > kLost) break;
    if (seen && i > 0 && before > kResolved && length > kOneBranch * before) break;
    before = length;
    shape.coefficients -= step.head(shape.count());
    shape.force -= step.tail<2>();
  }
  return {};
}

std::optional<Shape> finer(const Hold& hold, Shape shape) {
  const Index before = shape.count();
  if (before >= kMostModes) return {};
  const Index more = modesOf(before + 1).count();
  shape.coefficients.conservativeResize(more);
  shape.coefficients.tail(more - before).setZero();
  return settle(hold, shape, 12);
}

std::optional<Shape> refined(const Hold& hold, const Shape& shape, double carried) {
  std::optional<Shape> result = shape;
  while (result && result->coefficients.tail(3).lpNorm<Eigen::Infinity>() >= carried &&
         result->count() < kMostModes)
    result = finer(hold, *result);
  return result;
}

MatrixXd freeDirections(const Equations& equations) {
  const Index n = equations.modes().count();
  const Eigen::HouseholderQR<MatrixXd> qr(equations.closure());
  MatrixXd free = MatrixXd::Zero(n, n - 2);
  free.bottomRows(n - 2).setIdentity();
  return qr.householderQ() * free;
}

namespace {

/// What is left of a form of the modes where two gradients vanish.
MatrixXd reduced(MatrixXd form, const Eigen::Matrix<double, Eigen::Dynamic, 2>& gradients) {
  const Eigen::HouseholderQR<MatrixXd> qr(gradients);
  form.applyOnTheLeft(qr.householderQ().adjoint());
  form.applyOnTheRight(qr.householderQ());
  const Index free = form.rows() - 2;
  return form.bottomRightCorner(free, free);
}

}  // namespace

MatrixXd reducedHessian(const Equations& equations) {
  return reduced(equations.hessian(), equations.closure());
}

bool surelyPositive(MatrixXd form, MatrixXd constraints) {
  // What the constraints hold is made stiff instead: where that is positive everywhere, so is the form where
  // they hold.
  constexpr double kStiff = 1e6;     // beside modes of about 1
  constexpr double kNothing = 1e-6;  // of a constraint that holds nothing
  for (Index k = 0; k < constraints.cols(); ++k) {
    for (Index before = 0; before < k; ++before)
      constraints.col(k) -= constraints.col(before).dot(constraints.col(k)) * constraints.col(before);
    const double size = constraints.col(k).norm();
    if (size < kNothing)
      constraints.col(k).setZero();
    else
      constraints.col(k) /= size;
    form.noalias() += (kStiff * constraints.col(k)) * constraints.col(k).transpose();
  }
  return Eigen::LLT<Eigen::Ref<MatrixXd>>(form).info() == Eigen::Success;
}

bool isStable(const Equations& equations) {
  if (equations.sampled().along.minCoeff() > -kSurelyPositive) return true;
  const MatrixXd& hessian = equations.hessian();
  const Eigen::Matrix<double, Eigen::Dynamic, 2> closure = equations.closure();
  if (surelyPositive(hessian, closure)) return true;
  // Most that are not stable fall along one direction.
  const Eigen::PartialPivLU<MatrixXd> factors(bordered(hessian, closure));
  return !fallsOddly(factors) && reduced(hessian, closure).llt().info() == Eigen::Success;
}

Equations equationsOf(const HeavyBlade& blade) {
  const HeavyBlade::Numbers& n = blade.numbers();
  const double length = n.length, squared = length * length;
  return {modesOf(n.coefficients.size()),
          {(blade.at(length).point - n.start) / length, n.startAngle, n.turning, n.load * (squared * length)},
          {n.coefficients, n.endForce * squared}};
}

}  // namespace bw::heavy
