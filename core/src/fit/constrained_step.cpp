// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/constrained_step.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"

namespace bw::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rank decision on the slopes of the conditions, which are of order one.
constexpr double kRank = 1e-9;
// A linearised bound is met, and a multiplier has the right sign, to this.
constexpr double kMet = 1e-12;
constexpr double kSign = 1e-14;
// Changes of the set of active bounds that are tried before the set is found from scratch.
constexpr int kChanges = 12;
// Products of numbers in a unit of work (`WorkMeter`).
constexpr Index kProductsPerUnit = 1500;

// The affine space in which some rows hold.
struct Space {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> rows;
  MatrixXd basis;  ///< orthonormal, of what the rows leave free

  explicit Space(const MatrixXd& matrix) {
    rows.setThreshold(kRank);
    rows.compute(matrix);
    const Index left = matrix.cols() - rows.rank();
    if (left == 0) {
      basis.resize(matrix.cols(), 0);
      return;
    }
    basis = rows.colsPermutation() * rows.matrixZ().transpose().rightCols(left);
  }
};

// The step with exactly the conditions of a set active.
bool stepOn(const MatrixXd& hessian, const VectorXd& half, const Conditions& conditions,
            ConstrainedStep& step) {
  const Index n = half.size();
  const Index count = std::count(step.active.begin(), step.active.end(), char(1));
  step.multipliers = VectorXd::Zero(static_cast<Index>(conditions.size()));
  chargeWork(n * n * (n + 4 * count) / kProductsPerUnit);
  if (count == 0) {
    const Eigen::LLT<MatrixXd> factor(hessian);
    if (factor.info() != Eigen::Success) return false;
    step.d = factor.solve(-half);
    return step.d.allFinite();
  }
  MatrixXd rows(count, n);
  VectorXd goals(count);
  Index at = 0;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (!step.active[i]) continue;
    rows.row(at) = conditions.slopes.col(static_cast<Index>(i)).transpose();
    goals[at++] = -conditions.values[i];
  }
  const Space space(rows);
  step.d = space.rows.solve(goals);
  if (space.basis.cols() > 0) {
    const Eigen::LLT<MatrixXd> factor(space.basis.transpose() * (hessian * space.basis));
    if (factor.info() != Eigen::Success) return false;  // not convex without a bound that holds it
    const VectorXd slope = half + hessian * step.d;
    step.d -= space.basis * factor.solve(space.basis.transpose() * slope);
  }
  const VectorXd slope = half + hessian * step.d;
  const VectorXd multipliers = space.rows.transpose().solve(-slope);
  at = 0;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (step.active[i]) step.multipliers[static_cast<Index>(i)] = multipliers[at++];
  }
  return step.d.allFinite() && step.multipliers.allFinite();
}

// Non-negative least squares, min |E u − f| with u ≥ 0, by Lawson and Hanson's active sets.
VectorXd nonNegativeLeastSquares(const MatrixXd& E, const VectorXd& f) {
  const Index count = E.cols();
  VectorXd u = VectorXd::Zero(count);
  std::vector<Index> used;
  const double tolerance = 1e-13 * (1 + E.norm());
  for (Index round = 0; round < 3 * count + 10; ++round) {
    const VectorXd gain = E.transpose() * (f - E * u);
    Index enter = -1;
    for (Index i = 0; i < count; ++i) {
      if (std::find(used.begin(), used.end(), i) != used.end()) continue;
      if (gain[i] > tolerance && (enter < 0 || gain[i] > gain[enter])) enter = i;
    }
    if (enter < 0) break;
    used.push_back(enter);
    while (!used.empty()) {
      MatrixXd part(E.rows(), static_cast<Index>(used.size()));
      for (std::size_t k = 0; k < used.size(); ++k) part.col(static_cast<Index>(k)) = E.col(used[k]);
      const VectorXd x = part.colPivHouseholderQr().solve(f);
      double share = 1;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const double have = u[used[k]];
        if (x[static_cast<Index>(k)] <= 0) share = std::min(share, have / (have - x[static_cast<Index>(k)]));
      }
      if (!(share >= 0)) share = 0;
      for (std::size_t k = 0; k < used.size(); ++k)
        u[used[k]] += share * (x[static_cast<Index>(k)] - u[used[k]]);
      if (share >= 1) break;
      std::erase_if(used, [&](Index i) {
        if (u[i] > tolerance) return false;
        u[i] = 0;
        return true;
      });
    }
  }
  return u;
}

// The bounds that press at the optimum, from the dual problem: the point of the polyhedron nearest to the
// optimum without bounds, in the metric of the model. False if the model is not convex on the equalities or
// the bounds contradict each other.
bool pressingBounds(const MatrixXd& hessian, const VectorXd& half, const Conditions& conditions,
                    std::vector<char>& active) {
  const Index n = half.size();
  const auto equalities = static_cast<Index>(conditions.equalities);
  const Index bounds = static_cast<Index>(conditions.size()) - equalities;
  VectorXd d = VectorXd::Zero(n);
  MatrixXd basis = MatrixXd::Identity(n, n);
  if (equalities > 0) {
    const Space space(conditions.slopes.leftCols(equalities).transpose());
    d = -space.rows.solve(Eigen::Map<const VectorXd>(conditions.values.data(), equalities));
    basis = space.basis;
  }
  const Index left = basis.cols();
  if (left == 0) return false;
  const Eigen::LLT<MatrixXd> factor(basis.transpose() * (hessian * basis));
  if (factor.info() != Eigen::Success) return false;
  const VectorXd reduced = basis.transpose() * (half + hessian * d);
  const VectorXd nearest = -factor.matrixL().solve(reduced);
  const MatrixXd slopes = conditions.slopes.middleCols(equalities, bounds);
  const MatrixXd normals = factor.matrixL().solve(basis.transpose() * slopes);  // columns
  MatrixXd E(left + 1, bounds);
  E.topRows(left) = -normals;
  for (Index i = 0; i < bounds; ++i) {
    const double room = -conditions.values[static_cast<std::size_t>(equalities + i)] - slopes.col(i).dot(d);
    E(left, i) = normals.col(i).dot(nearest) - room;
    // Rows of one size, so that the choice of the entering bound is fair.
    const double size = E.col(i).norm();
    if (size > 0) E.col(i) /= size;
  }
  VectorXd f = VectorXd::Zero(left + 1);
  f[left] = 1;
  const VectorXd u = nonNegativeLeastSquares(E, f);
  if ((E * u - f).norm() < 1e-10) return false;
  for (Index i = 0; i < bounds; ++i) active[static_cast<std::size_t>(equalities + i)] = u[i] > 0 ? 1 : 0;
  return true;
}

}  // namespace

void Conditions::clear(Eigen::Index unknowns) {
  if (slopes.rows() != unknowns) slopes.resize(unknowns, 16);
  values.clear();
  names.clear();
  bends.clear();
  equalities = 0;
}

Eigen::Index Conditions::add(double value, int name) {
  const auto column = static_cast<Index>(values.size());
  if (column >= slopes.cols()) slopes.conservativeResize(slopes.rows(), 2 * slopes.cols() + 1);
  slopes.col(column).setZero();
  values.push_back(value);
  names.push_back(name);
  return column;
}

std::optional<std::size_t> Conditions::bound(int name) const {
  for (std::size_t i = equalities; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  return std::nullopt;
}

VectorXd shortestSolution(const MatrixXd& rows, const VectorXd& goals) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(kRank);
  solver.compute(rows);
  return solver.solve(goals);
}

std::optional<ConstrainedStep> constrainedStep(const MatrixXd& hessian, const VectorXd& half,
                                               const Conditions& conditions, const std::vector<char>& guess) {
  ConstrainedStep step;
  step.active = guess;
  step.active.resize(conditions.size(), 0);
  for (std::size_t i = 0; i < conditions.equalities; ++i) step.active[i] = 1;
  // What is most wrong with a step: a bound that it breaks, or one that should let go.
  const auto mostWrong = [&](double met, double sign) -> std::optional<std::size_t> {
    std::optional<std::size_t> wrong;
    double worst = 0;
    for (std::size_t i = conditions.equalities; i < conditions.size(); ++i) {
      const auto column = static_cast<Index>(i);
      const double miss = step.active[i]
                              ? -step.multipliers[column] - sign
                              : conditions.values[i] + conditions.slopes.col(column).dot(step.d) - met;
      // Broken bounds come before multipliers of the wrong sign.
      const double weight = step.active[i] ? 1e-6 : 1;
      if (miss > 0 && weight * miss > worst) {
        worst = weight * miss;
        wrong = i;
      }
    }
    return wrong;
  };
  for (int change = 0; change < kChanges; ++change) {
    if (!stepOn(hessian, half, conditions, step)) break;
    const std::optional<std::size_t> wrong = mostWrong(kMet, kSign);
    if (!wrong) return step;
    step.active[*wrong] = step.active[*wrong] ? 0 : 1;
  }
  if (conditions.size() == conditions.equalities) return std::nullopt;
  if (!pressingBounds(hessian, half, conditions, step.active)) return std::nullopt;
  if (!stepOn(hessian, half, conditions, step) || mostWrong(1e-8, 1e-10)) return std::nullopt;
  return step;
}

Stationarity stationarityOf(const LeastSquaresModel& model, const Conditions& conditions, double slack) {
  std::vector<std::size_t> active;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (i < conditions.equalities || conditions.values[i] > -slack) active.push_back(i);
  }
  const Index n = model.half.size();
  while (true) {
    MatrixXd basis = MatrixXd::Identity(n, n);
    if (!active.empty()) {
      MatrixXd rows(static_cast<Index>(active.size()), n);
      for (std::size_t k = 0; k < active.size(); ++k) {
        rows.row(static_cast<Index>(k)) = conditions.slopes.col(static_cast<Index>(active[k])).transpose();
      }
      const Space space(rows);
      basis = space.basis;
      const VectorXd multipliers = space.rows.transpose().solve(-model.half);
      // A bound whose multiplier has the wrong sign does not press.
      std::optional<std::size_t> wrong;
      for (std::size_t k = 0; k < active.size(); ++k) {
        const double size = multipliers[static_cast<Index>(k)];
        if (active[k] < conditions.equalities || !(size < 0)) continue;
        if (!wrong || size < multipliers[static_cast<Index>(*wrong)]) wrong = k;
      }
      if (wrong) {
        active.erase(active.begin() + static_cast<std::ptrdiff_t>(*wrong));
        continue;
      }
    }
    if (basis.cols() == 0) return {model.value, 0, 0};
    const VectorXd slope = basis.transpose() * model.half;
    MatrixXd hessian = basis.transpose() * (model.gaussNewton * basis);
    hessian.diagonal().array() += 1e-14 * hessian.trace();
    const VectorXd step = hessian.ldlt().solve(slope);
    return {model.value, 2 * slope.norm(), std::sqrt(std::max(0.0, slope.dot(step)))};
  }
}

MatrixXd stretchOf(const MatrixXd& metric) {
  const Eigen::LLT<MatrixXd> factor(metric);
  return factor.matrixU().solve(MatrixXd::Identity(metric.rows(), metric.cols()));
}

}  // namespace bw::detail
