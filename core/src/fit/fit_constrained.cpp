// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constrained.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"
#include "fit/condition_names.h"

namespace bw::detail {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Logarithms of lengths beyond this are no fits.
constexpr double kLargestLogLength = 5;

std::vector<double> withEnds(const std::vector<double>& nodes) {
  std::vector<double> all{-0.5};
  all.insert(all.end(), nodes.begin(), nodes.end());
  all.push_back(0.5);
  return all;
}

// Adds up the model of a sum of squares, row by row.
class Accumulator {
 public:
  void add(double weight, const Vector2d& miss, const std::array<Vector2d, 7>& rows) {
    for (std::size_t i = 0; i < 7; ++i) {
      const Vector2d weighted = weight * rows[i];
      half_[i] += weighted.dot(miss);
      for (std::size_t j = 0; j <= i; ++j) products_[i][j] += weighted.dot(rows[j]);
    }
  }
  void give(LeastSquaresModel& model) const {
    model.half.resize(7);
    model.gaussNewton.resize(7, 7);
    for (std::size_t i = 0; i < 7; ++i) {
      model.half[static_cast<Index>(i)] = half_[i];
      for (std::size_t j = 0; j <= i; ++j) {
        model.gaussNewton(static_cast<Index>(i), static_cast<Index>(j)) = products_[i][j];
        model.gaussNewton(static_cast<Index>(j), static_cast<Index>(i)) = products_[i][j];
      }
    }
  }

 private:
  std::array<double, 7> half_{};
  std::array<std::array<double, 7>, 7> products_{};
};

}  // namespace

VectorXd toVector(const Placement& p) {
  VectorXd v(7);
  v << p.shape, p.logLength, p.angle, p.middle;
  return v;
}

Placement toPlacement(const VectorXd& v) {
  Placement p;
  p.shape = v.head<3>();
  p.logLength = v[3];
  p.angle = v[4];
  p.middle = v.tail<2>();
  return p;
}

ConstrainedFit::ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, FitNorm norm)
    : target_(target),
      constraints_(constraints),
      norm_(norm),
      nodes_(withEnds(target.s)),
      range_({-0.5, 0.5}),
      between_({}),
      foot_({0.0}) {}

bool ConstrainedFit::objective(const VectorXd& v, LeastSquaresModel* model, double& value) {
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, model != nullptr))
    return false;
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  const Vector2d middle = v.tail<2>();
  value = 0;
  Accumulator sums;
  std::array<Vector2d, 7> rows;
  for (std::size_t i = 0; i < target_.size(); ++i) {
    const Vector2d placed = turned(factor, nodes_.point(i + 1));
    const Vector2d miss = placed + middle - target_.point[i];
    value += target_.weight[i] * miss.squaredNorm();
    if (model != nullptr) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<std::size_t>(j)] = turned(factor, nodes_.pointDerivative(i + 1, j));
      rows[3] = placed;
      rows[4] = quarterTurn(placed);
      rows[5] = Vector2d(1, 0);
      rows[6] = Vector2d(0, 1);
      sums.add(target_.weight[i], miss, rows);
    }
    if (norm_ == FitNorm::L2) continue;
    const Vector2d tangent = turned(factor, direction(nodes_.angle(i + 1)));
    const Vector2d missed = tangent - target_.tangent[i];
    value += target_.weight[i] * missed.squaredNorm();
    if (model != nullptr) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<std::size_t>(j)] = quarterTurn(tangent) * nodes_.angleDerivative(i + 1, j);
      rows[3] = tangent;
      rows[4] = quarterTurn(tangent);
      rows[5] = rows[6] = Vector2d::Zero();
      sums.add(target_.weight[i], missed, rows);
    }
    if (norm_ != FitNorm::H2) continue;
    // γ'' = a κ i e^{iψ}.
    const Vector2d across = quarterTurn(tangent);
    const Vector2d bend = nodes_.state(i + 1).curvature * across;
    const Vector2d unbent = bend - target_.curvature[i] * quarterTurn(target_.tangent[i]);
    value += target_.weight[i] * unbent.squaredNorm();
    if (model != nullptr) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<std::size_t>(j)] = nodes_.curvatureDerivative(i + 1, j) * across +
                                            nodes_.angleDerivative(i + 1, j) * quarterTurn(bend);
      rows[3] = bend;
      rows[4] = quarterTurn(bend);
      rows[5] = rows[6] = Vector2d::Zero();
      sums.add(target_.weight[i], unbent, rows);
    }
  }
  if (model != nullptr) {
    sums.give(*model);
    model->value = value;
  }
  return std::isfinite(value);
}

void ConstrainedFit::endConditions(const VectorXd& v, Conditions& out) {
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  for (std::size_t end = 0; end < 2; ++end) {
    if (constraints_.endpoints) {
      const Vector2d placed = turned(factor, ends().point(end));
      const Vector2d miss = placed + v.tail<2>() - (end == 0 ? target_.start : target_.end);
      const Vector2d across = quarterTurn(placed);
      for (int k = 0; k < 2; ++k) {
        auto slope = out.slopes.col(out.add(miss[k], end == 0 ? kStartPoint : kEndPoint));
        for (int j = 0; j < 3; ++j) slope[j] = turned(factor, ends().pointDerivative(end, j))[k];
        slope[3] = placed[k];
        slope[4] = across[k];
        slope[5 + k] = 1;
      }
    }
    if (constraints_.tangents) {
      const double miss = v[4] + ends().angle(end) - (end == 0 ? startAngle_ : endAngle_);
      auto slope = out.slopes.col(out.add(miss, end == 0 ? kStartTangent : kEndTangent));
      for (int j = 0; j < 3; ++j) slope[j] = ends().angleDerivative(end, j);
      slope[4] = 1;
    }
  }
}

bool ConstrainedFit::conditions(const VectorXd& v, Conditions& out) {
  out.clear(7);
  if (!constraints_.equalities() && !constraints_.bounds()) return true;
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, true)) return false;
  const bool tolerant = constraints_.lengthTolerance > 0;
  if (constraints_.length && !tolerant)
    out.slopes(3, out.add(v[3] - std::log(*constraints_.length), kLength)) = 1;
  endConditions(v, out);
  out.equalities = out.size();
  if (constraints_.length && tolerant) {
    const double shortest = *constraints_.length - constraints_.lengthTolerance;
    if (shortest > 0) out.slopes(3, out.add(std::log(shortest) - v[3], kShortest)) = -1;
    const double longest = *constraints_.length + constraints_.lengthTolerance;
    out.slopes(3, out.add(v[3] - std::log(longest), kLongest)) = 1;
  }
  if (constraints_.maxCurvature && !curvatureBounds(v, out)) return false;
  if (constraints_.maxPeriods) {
    const Periods periods = periodsOf(shape);
    auto slope = out.slopes.col(out.add(periods.count / *constraints_.maxPeriods - 1, kPeriods));
    slope.head<3>() = periods.slope / *constraints_.maxPeriods;
  }
  return shapeBounds(v, out);
}

void ConstrainedFit::chooseBranch(const Placement& placement) {
  startAngle_ = target_.startAngle;
  endAngle_ = target_.endAngle;
  if (!nodes_.evaluate(placement.shape, false)) return;
  startAngle_ += 2 * kPi * std::round((placement.angle + ends().angle(0) - startAngle_) / (2 * kPi));
  endAngle_ += 2 * kPi * std::round((placement.angle + ends().angle(1) - endAngle_) / (2 * kPi));
}

double ConstrainedFit::violation(const Placement& placement) {
  chooseBranch(placement);
  Conditions all;
  return conditions(toVector(placement), all) ? largestViolation(all).size : 1;
}

Stationarity ConstrainedFit::stationarity(const Placement& placement, const std::vector<double>& peaks) {
  chooseBranch(placement);
  peaks_ = peaks;
  const VectorXd v = toVector(placement);
  LeastSquaresModel model;
  double value = 0;
  Conditions all;
  if (!objective(v, &model, value) || !conditions(v, all)) return {1, 1, 1};
  return stationarityOf(model, all, kActive);
}

ConstrainedFit::Solution ConstrainedFit::solve(const Placement& start) {
  return solve(start, DescentLimits());
}

ConstrainedFit::Solution ConstrainedFit::scout(const Placement& start, const std::vector<Solution>& known) {
  std::vector<DescentRival> rivals;
  for (const Solution& end : known) rivals.push_back({toVector(end.placement), end.value});
  nodes_.setCoarse(true);
  const Solution out = solve(start, DescentLimits::rough(std::move(rivals)));
  nodes_.setCoarse(false);
  return out;
}

ConstrainedFit::Solution ConstrainedFit::solve(const Placement& start, const DescentLimits& limits) {
  chooseBranch(start);
  peaks_.clear();
  nextPeak_ = 0;
  const Descent descent = descend(*this, toVector(start), limits);
  Solution out;
  out.placement = toPlacement(descent.v);
  out.value = descent.value;
  out.iterations = descent.iterations;
  out.feasible = descent.feasible;
  out.converged = descent.converged;
  out.boundActive = descent.boundActive;
  out.violation = descent.violation;
  out.worst = wordsFor(descent.worst);
  out.peaks = peaks_;
  return out;
}

}  // namespace bw::detail
