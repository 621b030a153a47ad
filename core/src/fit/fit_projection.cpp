// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_projection.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/work_meter.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// Limits of one descent. Steps are relative to the scaled parameters; the cost is in squared lengths of the
// target.
constexpr int kMaxIterations = 60;
constexpr double kCostTolerance = 1e-30;
constexpr double kGradientTolerance = 1e-15;
constexpr double kExactCost = 1e-32;
// Residual (lengths of the target) where a shape cannot be evaluated: far above any other, so that the step
// is refused.
constexpr double kNoResidual = 1e3;
// The descent hands over to Newton's method when its steps are shorter than this.
constexpr double kCoarseStep = 3e-3;
// A descent with a rival: its limit, the ratio of values beyond which it is given up, and the distance
// (scaled parameters) within which it is taken to end at the rival.
constexpr int kRivalIterations = 12;
constexpr double kHopeless = 2;
constexpr double kSamePlace = 0.006;
// Later it is given up where a gain of so many times what the model promises leaves it above the rival.
constexpr double kMostGain = 5;
constexpr int kMaxSecantSteps = 60;
// Until its steps are shorter than this (scaled parameters), a descent works with seven digits.
constexpr double kRoughStep = 1e-6;
constexpr int kMaxRefusals = 8;
// A step this short is the last one: its own error is far smaller, and the result is judged afterwards.
constexpr double kLastStep = 1e-9;
// A step this short that does not lower the value any more is rounding.
constexpr double kRoundingStep = 1e-7;
// Relative rounding of the objective.
constexpr double kValueRounding = 1e-12;
// Damping, in parts of the diagonal of the Hessian (at least the last of its trace): the least after a
// Hessian that is not convex, the least and the growth after a step that did not get on, what is left after
// one that did.
constexpr double kConvexDamping = 1e-10;
constexpr double kRefusedDamping = 1e-2;
constexpr double kMoreDamping = 10;
constexpr double kEasing = 0.1;
constexpr double kDampedTrace = 1e-14;
// A secant correction at right angles to the step, by this cosine, would be without bounds and is left out.
constexpr double kSecantCosine = 1e-8;
// A shape that has to be shrunk or stretched beyond these factors has lost the target.
constexpr double kSmallestLength = 0.2;
constexpr double kLargestLength = 5;
// A column of the Jacobian shorter than this is not scaled up further: the parameter hardly matters (tension
// along a line).
constexpr double kSmallestColumn = 1e-7;

// While it lives, an evaluator works to about seven digits.
struct Coarsely {
  ShapeEvaluator& evaluator;
  explicit Coarsely(ShapeEvaluator& e) : evaluator(e) { evaluator.setCoarse(true); }
  ~Coarsely() { evaluator.setCoarse(false); }
};

}  // namespace

ProjectedFit::ProjectedFit(const FitTarget& target, const FitObjective& objective)
    : target_(target),
      objective_(objective),
      rows_(target.size() * (1 + static_cast<std::size_t>(objective.norm))),
      evaluator_(target.s),
      basis_(rows_),
      column_(rows_) {
  const std::size_t count = target.size();
  rootWeight_.resize(count);
  goal_.resize(rows_);
  for (std::size_t i = 0; i < count; ++i) {
    rootWeight_[i] = std::sqrt(target.weight[i]);
    goal_[i] = rootWeight_[i] * target.point[i];
    if (objective.norm != FitNorm::L2) goal_[count + i] = rootWeight_[i] * target.tangent[i];
    if (objective.norm == FitNorm::H2)
      goal_[2 * count + i] = rootWeight_[i] * target.curvature[i] * quarterTurn(target.tangent[i]);
  }
}

bool ProjectedFit::project(const Shape& shape, bool derivatives, Linear& linear) const {
  if (!evaluator_.evaluate(shape, derivatives)) return false;
  const std::size_t count = target_.size();
  linear.mean.setZero();
  for (std::size_t i = 0; i < count; ++i) linear.mean += target_.weight[i] * evaluator_.point(i);
  for (std::size_t i = 0; i < count; ++i) {
    basis_[i] = rootWeight_[i] * (evaluator_.point(i) - linear.mean);
    if (objective_.norm != FitNorm::L2) basis_[count + i] = rootWeight_[i] * direction(evaluator_.angle(i));
    if (objective_.norm == FitNorm::H2)
      basis_[2 * count + i] = evaluator_.curvature(i) * quarterTurn(basis_[count + i]);
  }
  Vector2d product = Vector2d::Zero();
  linear.squares = 0;
  for (std::size_t i = 0; i < rows_; ++i) {
    product += turnedBack(basis_[i], goal_[i]);
    linear.squares += basis_[i].squaredNorm();
  }
  if (!(linear.squares > 0) || !(product.squaredNorm() > 0)) return false;
  if (objective_.fixedLength) {
    linear.factor = product.normalized() * *objective_.fixedLength;
    return true;
  }
  linear.factor = product / linear.squares;
  const double length = linear.factor.norm();
  return length > kSmallestLength && length < kLargestLength;
}

bool ProjectedFit::operator()(const double* x, double* residuals, double* jacobian) const {
  const Shape shape = Eigen::Map<const Eigen::Vector3d>(x).cwiseQuotient(scale_);
  Linear linear;
  // The solver asks for the residuals first and, if it takes the step, for the Jacobian at the same point:
  // most steps are taken.
  if (!project(shape, true, linear)) {
    std::fill(residuals, residuals + 2 * rows_, kNoResidual);
    if (jacobian != nullptr) std::fill(jacobian, jacobian + 6 * rows_, 0.0);
    return false;
  }
  for (std::size_t i = 0; i < rows_; ++i) {
    Eigen::Map<Vector2d> row(residuals + 2 * i);
    row = turned(linear.factor, basis_[i]) - goal_[i];
  }
  if (jacobian == nullptr) return true;
  const bool atRival =
      rival_ != nullptr && (shape - rival_->placement.shape).cwiseProduct(scale_).norm() < kSamePlace &&
      Eigen::Map<const Eigen::VectorXd>(residuals, NumResiduals()).squaredNorm() > rival_->value;
  if (atRival || detail::workExhausted()) {
    std::fill(jacobian, jacobian + 6 * rows_, 0.0);  // ends the descent
    return true;
  }
  const std::size_t count = target_.size();
  for (int j = 0; j < 3; ++j) {
    Vector2d mean = Vector2d::Zero();
    for (std::size_t i = 0; i < count; ++i) mean += target_.weight[i] * evaluator_.pointDerivative(i, j);
    for (std::size_t i = 0; i < count; ++i) {
      column_[i] = rootWeight_[i] * (evaluator_.pointDerivative(i, j) - mean);
      if (objective_.norm != FitNorm::L2)
        column_[count + i] = quarterTurn(basis_[count + i]) * evaluator_.angleDerivative(i, j);
      if (objective_.norm == FitNorm::H2)
        column_[2 * count + i] = quarterTurn(basis_[2 * count + i]) * evaluator_.angleDerivative(i, j) +
                                 quarterTurn(basis_[count + i]) * evaluator_.curvatureDerivative(i, j);
    }
    Vector2d product = Vector2d::Zero();
    for (std::size_t i = 0; i < rows_; ++i) product += turnedBack(basis_[i], column_[i]);
    // Out goes what the linear unknowns can do: length and turn, or the turn alone if the length is fixed.
    Vector2d share = product / linear.squares;
    if (objective_.fixedLength) share.x() = 0;
    for (std::size_t i = 0; i < rows_; ++i) {
      Eigen::Map<Vector2d> row(jacobian + 2 * rows_ * static_cast<std::size_t>(j) + 2 * i);
      row = turned(linear.factor, column_[i] - turned(share, basis_[i])) / scale_[j];
    }
  }
  return true;
}

std::optional<FitSolution> ProjectedFit::place(const Shape& shape) const {
  Linear linear;
  if (!project(shape, false, linear)) return std::nullopt;
  FitSolution out;
  for (std::size_t i = 0; i < rows_; ++i)
    out.value += (turned(linear.factor, basis_[i]) - goal_[i]).squaredNorm();
  out.placement.shape = shape;
  out.placement.logLength = std::log(linear.factor.norm());
  out.placement.angle = std::atan2(linear.factor.y(), linear.factor.x());
  out.placement.middle = -turned(linear.factor, linear.mean);
  return out;
}

std::optional<double> ProjectedFit::roughValue(const Shape& shape) const {
  const Coarsely coarsely(evaluator_);
  const std::optional<FitSolution> placed = place(shape);
  return placed ? std::optional(placed->value) : std::nullopt;
}

bool ProjectedFit::gradient(const Eigen::Vector3d& x, Eigen::Vector3d& g, double& value) const {
  if (!(*this)(x.data(), residuals_.data(), jacobian_.data())) return false;
  g = jacobian_.transpose() * residuals_;
  value = residuals_.squaredNorm();
  return true;
}

ProjectedFit::End ProjectedFit::polish(Eigen::Vector3d& x, int& steps, const FitSolution* rival) const {
  Eigen::Vector3d g;
  double value = 0;
  bool rough = true;
  const auto toAllDigits = [&] {
    rough = false;
    evaluator_.setCoarse(false);
    return gradient(x, g, value);
  };
  if (!gradient(x, g, value)) return End::limit;
  Eigen::Matrix3d gaussNewton = jacobian_.transpose() * jacobian_;
  Eigen::Matrix3d secant = Eigen::Matrix3d::Zero();
  double damping = 0;
  int refusals = 0;
  for (int n = 0; n < kMaxSecantSteps && !detail::workExhausted(); ++n) {
    const Eigen::Matrix3d scale =
        Eigen::Vector3d(gaussNewton.diagonal().array() + kDampedTrace * gaussNewton.trace()).asDiagonal();
    Eigen::LLT<Eigen::Matrix3d> factor(gaussNewton + secant + damping * scale);
    if (factor.info() != Eigen::Success) {
      secant.setZero();
      damping = std::max(damping, kConvexDamping);
      factor.compute(gaussNewton + damping * scale);
      if (factor.info() != Eigen::Success) return End::limit;
    }
    const Eigen::Vector3d step = factor.solve(-g);
    // The model promises a gain of −g·step.
    if (rival != nullptr && value + kMostGain * g.dot(step) > rival->value) return End::aboveRival;
    if (rough && step.norm() <= kRoughStep) {
      if (!toAllDigits()) return End::limit;
      continue;
    }
    if (step.norm() <= kLastStep) {
      x += step;
      return End::converged;
    }
    const Eigen::Vector3d next = x + step;
    Eigen::Vector3d gNext;
    double valueNext = 0;
    ++steps;
    const bool evaluated = gradient(next, gNext, valueNext);
    // At the level of rounding the gradient tells more than the value.
    const bool better = evaluated && (valueNext < value ||
                                      (valueNext <= value * (1 + kValueRounding) && gNext.norm() < g.norm()));
    if (!better) {
      if (evaluated && !rough && step.norm() <= kRoundingStep) return End::converged;
      if (++refusals > kMaxRefusals) {
        if (!rough || !toAllDigits()) return End::limit;
        refusals = 0;
      }
      secant.setZero();
      damping = std::max(kMoreDamping * damping, kRefusedDamping);
      continue;
    }
    damping *= kEasing;
    gaussNewton = jacobian_.transpose() * jacobian_;
    // Symmetric rank one, so that (gaussNewton + secant) step = change of the gradient.
    const Eigen::Vector3d miss = gNext - g - (gaussNewton + secant) * step;
    const double denominator = miss.dot(step);
    if (std::abs(denominator) > kSecantCosine * miss.norm() * step.norm())
      secant += miss * miss.transpose() / denominator;
    x = next;
    g = gNext;
    value = valueNext;
  }
  return End::limit;
}

std::optional<FitSolution> ProjectedFit::solve(const Shape& start, const FitSolution* rival) {
  scale_.setOnes();
  residuals_.resize(NumResiduals());
  jacobian_.resize(NumResiduals(), 3);
  // Far from the end seven digits are enough.
  const Coarsely coarsely(evaluator_);
  if (!(*this)(start.data(), residuals_.data(), jacobian_.data())) return std::nullopt;
  const Eigen::Vector3d norms = jacobian_.colwise().norm();
  scale_ = norms.cwiseMax(kSmallestColumn);
  ceres::TinySolver<ProjectedFit> solver;
  solver.options.max_num_iterations = rival != nullptr ? kRivalIterations : kMaxIterations;
  solver.options.parameter_tolerance = kCoarseStep;
  solver.options.function_tolerance = kCostTolerance;
  solver.options.gradient_tolerance = kGradientTolerance;
  solver.options.cost_threshold = kExactCost;
  Eigen::Vector3d x = start.cwiseProduct(scale_);
  rival_ = rival;
  const auto& summary = solver.Solve(*this, &x);
  rival_ = nullptr;
  int iterations = summary.iterations;
  if (rival != nullptr) {
    const double value = 2 * summary.final_cost;
    const double apart = (x - rival->placement.shape.cwiseProduct(scale_)).norm();
    if (value > kHopeless * rival->value || (value > rival->value && apart < kSamePlace)) return std::nullopt;
  }
  // With derivatives in the objective the residuals are too large for the model to promise anything.
  const End end = polish(x, iterations, objective_.norm == FitNorm::L2 ? rival : nullptr);
  if (end == End::aboveRival) return std::nullopt;
  evaluator_.setCoarse(false);
  std::optional<FitSolution> solution = place(x.cwiseQuotient(scale_));
  if (!solution) return std::nullopt;
  solution->iterations = iterations;
  solution->feasible = true;
  solution->converged = end == End::converged;
  return solution;
}

}  // namespace bw::fit
