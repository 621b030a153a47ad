// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "discrete/angle_chain.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::discrete {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int kMaxIterations = 200;
/// A step that turns no segment by more than this (rad) ends the descent: Newton's error is then its square.
constexpr double kSettled = 1e-9;
/// Steps this short are taken whole: the merit carries only rounding there.
constexpr double kRoundingStep = 1e-6;
/// The longest turn of a segment in one step, rad.
constexpr double kLongestStep = 0.7;
constexpr double kArmijo = 1e-4;
constexpr int kMaxHalvings = 25;
/// First shift of the second variation, of the order of its smallest eigenvalue without a force (π²), and the
/// last.
constexpr double kFirstShift = 3, kLastShift = 1e12;
/// The two conditions on the end count as dependent (a straight chain) below this.
constexpr double kDependent = 1e-13;
/// Pivots below this part of the off-diagonal entries are rounding.
constexpr double kLeastPivot = 1e-14;
/// Turn with which a straight chain leaves the undecided state, rad.
constexpr double kBump = 0.05;
constexpr double kClosed = 1e-11;
/// Work (`WorkMeter`) of an iteration, for each segment.
constexpr std::int64_t kSegmentWork = 3;

/// The second variation with a shift, factorised, and the condition on the end eliminated.
class Kkt {
 public:
  /// Diagonal, off-diagonal (constant but at no place), the rows of the end condition.
  Kkt(VectorXd diagonal, double off, Eigen::MatrixX2d rows) : off_(off), rows_(std::move(rows)) {
    const Eigen::Index n = diagonal.size();
    pivots_ = std::move(diagonal);
    factors_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i > 0) {
        factors_[i] = off_ / pivots_[i - 1];
        pivots_[i] -= factors_[i] * off_;
      }
      // A pivot of zero is an eigenvalue of a leading part, not of the whole; a rounding away it does no
      // harm.
      if (std::abs(pivots_[i]) < kLeastPivot * std::abs(off_)) pivots_[i] = kLeastPivot * std::abs(off_);
      if (pivots_[i] < 0) ++negative_;
    }
    solved_.resize(n, 2);
    for (int c = 0; c < 2; ++c) solved_.col(c) = solveTridiagonal(rows_.col(c));
    schur_ = rows_.transpose() * solved_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(0.5 * (schur_ + schur_.transpose()),
                                                               Eigen::EigenvaluesOnly);
    const Vector2d values = eigen.eigenvalues();
    for (const double value : values)
      if (value > 0) ++negative_;
    dependent_ = !(values.cwiseAbs().minCoeff() > kDependent * values.cwiseAbs().maxCoeff());
  }

  /// Positive under the conditions: as many negative eigenvalues as conditions.
  bool minimum() const { return negative_ == 2; }
  bool dependent() const { return dependent_; }

  struct Step {
    VectorXd turn;
    Vector2d force = Vector2d::Zero();
  };
  /// [H Bᵀ; B 0] (turn, force) = (right, end).
  Step solve(const VectorXd& right, const Vector2d& end) const {
    const VectorXd free = solveTridiagonal(right);
    Step step;
    step.force = schur_.fullPivLu().solve(rows_.transpose() * free - end);
    step.turn = free - solved_ * step.force;
    return step;
  }

 private:
  VectorXd solveTridiagonal(VectorXd x) const {
    const Eigen::Index n = x.size();
    for (Eigen::Index i = 1; i < n; ++i) x[i] -= factors_[i] * x[i - 1];
    for (Eigen::Index i = n - 1; i >= 0; --i)
      x[i] = x[i] / pivots_[i] - (i + 1 < n ? factors_[i + 1] * x[i + 1] : 0);
    return x;
  }

  double off_ = 0;
  Eigen::MatrixX2d rows_, solved_;
  VectorXd pivots_, factors_;
  Eigen::Matrix2d schur_;
  int negative_ = 0;
  bool dependent_ = false;
};

/// The free angles of a chain, and everything about the energy at them.
class Problem {
 public:
  explicit Problem(const AngleChain& chain)
      : chain_(chain),
        h_(1.0 / chain.segments),
        free_(chain.halfEnds ? chain.segments : chain.segments - 2),
        endWeight_(chain.halfEnds ? 2 / h_ : 1 / h_) {
    target_ = chain.chord;
    if (!chain.halfEnds)
      target_ -= h_ * (Vector2d(std::cos(chain.startAngle), std::sin(chain.startAngle)) +
                       Vector2d(std::cos(chain.endAngle), std::sin(chain.endAngle)));
  }

  Eigen::Index size() const { return free_; }

  void place(const VectorXd& x) {
    cosine_ = x.array().cos();
    sine_ = x.array().sin();
    gap_ = h_ * Vector2d(cosine_.sum(), sine_.sum()) - target_;
    energy_ = 0;
    double before = chain_.startAngle;
    for (Eigen::Index i = 0; i <= free_; ++i) {
      const double here = i < free_ ? x[i] : chain_.endAngle;
      energy_ += 0.5 * weight(i) * (here - before) * (here - before);
      before = here;
    }
  }
  double energy() const { return energy_; }
  const Vector2d& gap() const { return gap_; }

  VectorXd gradient(const VectorXd& x) const {
    VectorXd g(free_);
    for (Eigen::Index i = 0; i < free_; ++i) {
      const double before = i > 0 ? x[i - 1] : chain_.startAngle;
      const double after = i + 1 < free_ ? x[i + 1] : chain_.endAngle;
      g[i] = weight(i) * (x[i] - before) - weight(i + 1) * (after - x[i]);
    }
    return g;
  }
  Kkt kkt(const Vector2d& force, double shift) const {
    VectorXd diagonal(free_);
    for (Eigen::Index i = 0; i < free_; ++i)
      diagonal[i] = weight(i) + weight(i + 1) + h_ * (shift - force.x() * cosine_[i] - force.y() * sine_[i]);
    Eigen::MatrixX2d rows(free_, 2);
    rows.col(0) = -h_ * sine_.matrix();
    rows.col(1) = h_ * cosine_.matrix();
    return Kkt(std::move(diagonal), -1 / h_, std::move(rows));
  }

 private:
  double weight(Eigen::Index i) const { return i == 0 || i == free_ ? endWeight_ : 1 / h_; }

  const AngleChain& chain_;
  double h_;
  Eigen::Index free_;
  double endWeight_;
  Vector2d target_;
  Eigen::ArrayXd cosine_, sine_;
  Vector2d gap_ = Vector2d::Zero();
  double energy_ = 0;
};

double limited(const VectorXd& turn) {
  const double longest = turn.lpNorm<Eigen::Infinity>();
  return longest > kLongestStep ? kLongestStep / longest : 1;
}

}  // namespace

ChainSolution solveChain(const AngleChain& chain, std::vector<double> angles) {
  Problem problem(chain);
  const Eigen::Index n = problem.size(), first = chain.halfEnds ? 0 : 1;
  VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = angles[std::size_t(i + first)];
  ChainSolution solution;
  double penalty = 1, lastShift = 0;
  bool bumped = false;
  problem.place(x);
  // Leaves a state from which either side is as good, to the left.
  const auto bump = [&] {
    for (Eigen::Index i = 0; i < n; ++i) x[i] += kBump * std::sin(2 * kPi * (double(i) + 0.5) / double(n));
    bumped = true;
    problem.place(x);
  };
  while (solution.iterations < kMaxIterations && !detail::workExhausted()) {
    detail::chargeWork(kSegmentWork * n);
    ++solution.iterations;
    const VectorXd slope = problem.gradient(x);
    double shift = 0;
    Kkt kkt = problem.kkt(solution.force, shift);
    solution.minimum = kkt.minimum();
    if (kkt.dependent() && !bumped) {
      // Straight: the end cannot come nearer to first order.
      bump();
      continue;
    }
    for (shift = std::max(kFirstShift, 0.25 * lastShift); !kkt.minimum() && shift < kLastShift; shift *= 4) {
      kkt = problem.kkt(solution.force, shift);
      lastShift = shift;
    }
    const Kkt::Step step = kkt.solve(-slope, -problem.gap());
    if (!step.turn.allFinite() || !step.force.allFinite()) return solution;
    const double longest = step.turn.lpNorm<Eigen::Infinity>();
    const double energy = problem.energy(), gap = problem.gap().lpNorm<1>();
    penalty = std::max(penalty, 1.5 * step.force.lpNorm<Eigen::Infinity>());
    if (longest < kRoundingStep) {
      x += step.turn;
      solution.force = step.force;
      problem.place(x);
      if (longest < kSettled) {
        if (!bumped && !problem.kkt(solution.force, 0).minimum()) {
          bump();
          continue;
        }
        solution.converged = problem.gap().norm() < kClosed;
        break;
      }
      continue;
    }
    const double descent = slope.dot(step.turn) - penalty * gap;
    const double merit = energy + penalty * gap;
    const auto accepted = [&](double t) {
      return problem.energy() + penalty * problem.gap().lpNorm<1>() <=
             merit + kArmijo * t * std::min(descent, 0.0);
    };
    const VectorXd origin = x;
    double t = limited(step.turn);
    bool taken = false;
    for (int halving = 0; halving < kMaxHalvings && !taken; ++halving, t *= 0.5) {
      x = origin + t * step.turn;
      problem.place(x);
      taken = accepted(t);
      if (!taken && halving == 0 && t == 1) {
        // A second-order correction back onto the end, without which steps along a curved condition are cut
        // short.
        x += kkt.solve(VectorXd::Zero(n), -problem.gap()).turn;
        problem.place(x);
        taken = accepted(t);
      }
      if (taken) solution.force += t * (step.force - solution.force);
    }
    if (!taken) return solution;
  }
  solution.energy = problem.energy();
  solution.closure = problem.gap().norm();
  for (Eigen::Index i = 0; i < n; ++i) angles[std::size_t(i + first)] = x[i];
  if (!chain.halfEnds) {
    angles.front() = chain.startAngle;
    angles.back() = chain.endAngle;
  }
  solution.angles = std::move(angles);
  if (solution.converged) solution.minimum = problem.kkt(solution.force, 0).minimum();
  return solution;
}

}  // namespace bw::discrete
