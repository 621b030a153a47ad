// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/active_set_step.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"

namespace bw::optimise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rank decision on the gradients of the constraints, which are of order one.
constexpr double kRank = 1e-9;
// What counts as rounding, without dimension like the constraints: by how much a linearised bound may be
// broken and a multiplier may have the wrong sign.
struct Rounding {
  double broken, multiplier;
};
// Of a step from a set that was changed bound by bound, and of one from the dual problem, whose bounds are
// told less exactly.
constexpr Rounding kRounding{1e-12, 1e-14}, kDualRounding{1e-8, 1e-10};
// Of what is wrong with a step broken bounds come first: a multiplier of the wrong sign weighs this much
// less.
constexpr double kMultiplierWeight = 1e-6;
// Changes of the active set that are tried before the set is found from scratch.
constexpr int kChanges = 12;
// Bounds whose dual problem (with columns of size 1) has a residual up to this contradict each other.
constexpr double kContradiction = 1e-10;
// A component or a gain up to this part of the matrix (and of 1) is rounding.
constexpr double kZero = 1e-13;
// Part of its trace that is added to a Gauss–Newton matrix so that it can be factorised.
constexpr double kRegular = 1e-14;
// Products of numbers in a unit of work (`WorkMeter`).
constexpr Index kProductsPerUnit = 1500;

Eigen::CompleteOrthogonalDecomposition<MatrixXd> decompositionOf(const MatrixXd& matrix) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> rows;
  rows.setThreshold(kRank);
  rows.compute(matrix);
  return rows;
}

// The affine space in which some rows hold.
struct Space {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> rows;
  MatrixXd basis;  ///< orthonormal, of what the rows leave free

  explicit Space(const MatrixXd& matrix) : rows(decompositionOf(matrix)) {
    const Index left = matrix.cols() - rows.rank();
    if (left == 0) {
      basis.resize(matrix.cols(), 0);
      return;
    }
    basis = rows.colsPermutation() * rows.matrixZ().transpose().rightCols(left);
  }
  VectorXd multipliers(const VectorXd& gradient) const { return rows.transpose().solve(-gradient); }
};

// The step with exactly the constraints of a set active.
bool stepOn(const MatrixXd& hessian, const VectorXd& gradient, const Constraints& constraints,
            ActiveSetStep& step) {
  const Index n = gradient.size();
  const Index count = std::count(step.active.begin(), step.active.end(), char(1));
  step.multipliers = VectorXd::Zero(static_cast<Index>(constraints.size()));
  detail::chargeWork(n * n * (n + 4 * count) / kProductsPerUnit);
  if (count == 0) {
    const Eigen::LLT<MatrixXd> factor(hessian);
    if (factor.info() != Eigen::Success) return false;
    step.d = factor.solve(-gradient);
    return step.d.allFinite();
  }
  MatrixXd rows(count, n);
  VectorXd goals(count);
  Index at = 0;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!step.active[i]) continue;
    rows.row(at) = constraints.gradient(i).transpose();
    goals[at++] = -constraints.values[i];
  }
  const Space space(rows);
  step.d = space.rows.solve(goals);
  if (space.basis.cols() > 0) {
    const Eigen::LLT<MatrixXd> factor(space.basis.transpose() * (hessian * space.basis));
    if (factor.info() != Eigen::Success) return false;  // not convex without a bound that holds it
    const VectorXd there = gradient + hessian * step.d;
    step.d -= space.basis * factor.solve(space.basis.transpose() * there);
  }
  const VectorXd multipliers = space.multipliers(gradient + hessian * step.d);
  at = 0;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (step.active[i]) step.multipliers[static_cast<Index>(i)] = multipliers[at++];
  }
  return step.d.allFinite() && step.multipliers.allFinite();
}

// What is most wrong with a step: a bound that it breaks, or an active one whose multiplier has the wrong
// sign.
std::optional<std::size_t> mostWrong(const ActiveSetStep& step, const Constraints& constraints,
                                     const Rounding& rounding) {
  std::optional<std::size_t> wrong;
  double worst = 0;
  for (std::size_t i = constraints.equalities; i < constraints.size(); ++i) {
    const double miss = step.active[i]
                            ? -step.multipliers[static_cast<Index>(i)] - rounding.multiplier
                            : constraints.values[i] + constraints.gradient(i).dot(step.d) - rounding.broken;
    const double weight = step.active[i] ? kMultiplierWeight : 1;
    if (miss > 0 && weight * miss > worst) {
      worst = weight * miss;
      wrong = i;
    }
  }
  return wrong;
}

// The bounds that are active at the optimum, from the dual problem: the point of the polyhedron nearest to
// the optimum without bounds, in the metric of the model. False if the model is not convex on the equalities
// or the bounds contradict each other.
bool activeBounds(const MatrixXd& hessian, const VectorXd& gradient, const Constraints& constraints,
                  std::vector<char>& active) {
  const Index n = gradient.size();
  const auto equalities = static_cast<Index>(constraints.equalities);
  const Index bounds = static_cast<Index>(constraints.size()) - equalities;
  VectorXd d = VectorXd::Zero(n);
  MatrixXd basis = MatrixXd::Identity(n, n);
  if (equalities > 0) {
    const Space space(constraints.gradients.leftCols(equalities).transpose());
    d = -space.rows.solve(Eigen::Map<const VectorXd>(constraints.values.data(), equalities));
    basis = space.basis;
  }
  const Index left = basis.cols();
  if (left == 0) return false;
  const Eigen::LLT<MatrixXd> factor(basis.transpose() * (hessian * basis));
  if (factor.info() != Eigen::Success) return false;
  const VectorXd reduced = basis.transpose() * (gradient + hessian * d);
  const VectorXd unbounded = -factor.matrixL().solve(reduced);
  const MatrixXd gradients = constraints.gradients.middleCols(equalities, bounds);
  const MatrixXd normals = factor.matrixL().solve(basis.transpose() * gradients);  // columns
  MatrixXd A(left + 1, bounds);
  A.topRows(left) = -normals;
  for (Index i = 0; i < bounds; ++i) {
    const double room =
        -constraints.values[static_cast<std::size_t>(equalities + i)] - gradients.col(i).dot(d);
    A(left, i) = normals.col(i).dot(unbounded) - room;
    const double size = A.col(i).norm();
    if (size > 0) A.col(i) /= size;
  }
  const VectorXd b = VectorXd::Unit(left + 1, left);
  const VectorXd u = nonNegativeLeastSquares(A, b);
  if ((A * u - b).norm() < kContradiction) return false;
  for (Index i = 0; i < bounds; ++i) active[static_cast<std::size_t>(equalities + i)] = u[i] > 0 ? 1 : 0;
  return true;
}

}  // namespace

void Constraints::clear(Index unknowns) {
  if (gradients.rows() != unknowns) gradients.resize(unknowns, 16);
  values.clear();
  names.clear();
  hessians.clear();
  equalities = 0;
}

MatrixXd::ColXpr Constraints::add(double value, int name) {
  const auto column = static_cast<Index>(values.size());
  if (column >= gradients.cols()) gradients.conservativeResize(gradients.rows(), 2 * gradients.cols() + 1);
  values.push_back(value);
  names.push_back(name);
  gradients.col(column).setZero();
  return gradients.col(column);
}

std::optional<std::size_t> Constraints::bound(int name) const {
  const auto found = std::find(names.begin() + static_cast<std::ptrdiff_t>(equalities), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

VectorXd leastNormSolution(const MatrixXd& rows, const VectorXd& goals) {
  return decompositionOf(rows).solve(goals);
}

VectorXd nonNegativeLeastSquares(const MatrixXd& A, const VectorXd& b) {
  const Index count = A.cols();
  VectorXd u = VectorXd::Zero(count);
  std::vector<Index> passive;  // the components that may be above zero
  const double tolerance = kZero * (1 + A.norm());
  // Every set is visited at most once, in practice about one a component.
  for (Index round = 0; round < 3 * count + 10; ++round) {
    const VectorXd gain = A.transpose() * (b - A * u);
    Index enter = -1;
    for (Index i = 0; i < count; ++i) {
      if (std::find(passive.begin(), passive.end(), i) != passive.end()) continue;
      if (gain[i] > tolerance && (enter < 0 || gain[i] > gain[enter])) enter = i;
    }
    if (enter < 0) break;
    passive.push_back(enter);
    while (!passive.empty()) {
      MatrixXd part(A.rows(), static_cast<Index>(passive.size()));
      for (std::size_t k = 0; k < passive.size(); ++k) part.col(static_cast<Index>(k)) = A.col(passive[k]);
      const VectorXd x = part.colPivHouseholderQr().solve(b);
      double share = 1;  // of the way to x on which all components stay above zero
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double have = u[passive[k]];
        if (x[static_cast<Index>(k)] <= 0) share = std::min(share, have / (have - x[static_cast<Index>(k)]));
      }
      if (!(share >= 0)) share = 0;
      for (std::size_t k = 0; k < passive.size(); ++k)
        u[passive[k]] += share * (x[static_cast<Index>(k)] - u[passive[k]]);
      if (share >= 1) break;
      std::erase_if(passive, [&](Index i) {
        if (u[i] > tolerance) return false;
        u[i] = 0;
        return true;
      });
    }
  }
  return u;
}

std::optional<ActiveSetStep> activeSetStep(const MatrixXd& hessian, const VectorXd& gradient,
                                           const Constraints& constraints, const std::vector<char>& guess) {
  ActiveSetStep step;
  step.active = guess;
  step.active.resize(constraints.size(), 0);
  std::fill_n(step.active.begin(), constraints.equalities, char(1));
  for (int change = 0; change < kChanges; ++change) {
    if (!stepOn(hessian, gradient, constraints, step)) break;
    const std::optional<std::size_t> wrong = mostWrong(step, constraints, kRounding);
    if (!wrong) return step;
    step.active[*wrong] = step.active[*wrong] ? 0 : 1;
  }
  if (constraints.size() == constraints.equalities ||
      !activeBounds(hessian, gradient, constraints, step.active) ||
      !stepOn(hessian, gradient, constraints, step) || mostWrong(step, constraints, kDualRounding))
    return std::nullopt;
  return step;
}

Stationarity stationarityOf(const LeastSquaresModel& model, const Constraints& constraints, double slack) {
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (i < constraints.equalities || constraints.values[i] > -slack) active.push_back(i);
  }
  const Index n = model.halfGradient.size();
  while (true) {
    MatrixXd basis = MatrixXd::Identity(n, n);
    if (!active.empty()) {
      MatrixXd rows(static_cast<Index>(active.size()), n);
      for (std::size_t k = 0; k < active.size(); ++k)
        rows.row(static_cast<Index>(k)) = constraints.gradient(active[k]).transpose();
      const Space space(rows);
      basis = space.basis;
      const VectorXd multipliers = space.multipliers(model.halfGradient);
      // The bound whose multiplier is most wrong in its sign is not active.
      std::optional<std::size_t> wrong;
      for (std::size_t k = 0; k < active.size(); ++k) {
        const double size = multipliers[static_cast<Index>(k)];
        if (active[k] < constraints.equalities || !(size < 0)) continue;
        if (!wrong || size < multipliers[static_cast<Index>(*wrong)]) wrong = k;
      }
      if (wrong) {
        active.erase(active.begin() + static_cast<std::ptrdiff_t>(*wrong));
        continue;
      }
    }
    if (basis.cols() == 0) return {model.value, 0, 0};
    const VectorXd gradient = basis.transpose() * model.halfGradient;
    MatrixXd hessian = basis.transpose() * (model.gaussNewton * basis);
    hessian.diagonal().array() += kRegular * hessian.trace();
    const VectorXd step = hessian.ldlt().solve(gradient);
    return {model.value, 2 * gradient.norm(), std::sqrt(std::max(0.0, gradient.dot(step)))};
  }
}

}  // namespace bw::optimise
