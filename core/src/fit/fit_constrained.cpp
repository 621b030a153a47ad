// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constrained.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using optimise::Constraints;

// Logarithms of lengths beyond this are no fits.
constexpr double kLargestLogLength = 5;
// What the boundary value solver takes at most.
constexpr int kMostInflections = 12;
constexpr double kMostTurning = 8 * kPi;

std::vector<double> withEnds(const std::vector<double>& nodes) {
  std::vector<double> all{-0.5};
  all.insert(all.end(), nodes.begin(), nodes.end());
  all.push_back(0.5);
  return all;
}

// Adds up the model of a sum of squares, miss by miss, each with its derivatives by the unknowns as columns.
class Accumulator {
 public:
  using Rows = Eigen::Matrix<double, 2, 7>;

  void add(double weight, const Vector2d& miss, const Rows& rows) {
    for (int i = 0; i < 7; ++i) {
      const Vector2d weighted = weight * rows.col(i);
      half_[i] += weighted.dot(miss);
      for (int j = 0; j <= i; ++j) products_(i, j) += weighted.dot(rows.col(j));
    }
  }
  void give(optimise::LeastSquaresModel& model) const {
    model.halfGradient = half_;
    model.gaussNewton = products_.selfadjointView<Eigen::Lower>();
  }

 private:
  Eigen::Matrix<double, 7, 1> half_ = Eigen::Matrix<double, 7, 1>::Zero();
  Eigen::Matrix<double, 7, 7, Eigen::RowMajor> products_ = Eigen::Matrix<double, 7, 7>::Zero();
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

bool ConstrainedFit::objective(const VectorXd& v, optimise::LeastSquaresModel* model, double& value) {
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, model != nullptr))
    return false;
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  const Vector2d middle = v.tail<2>();
  value = 0;
  Accumulator sums;
  Accumulator::Rows rows;
  // A miss of what turns and grows with the whole curve, `shapeDerivative` of it, and how it moves.
  const auto add = [&](double weight, const Vector2d& miss, const Vector2d& whole, double moves,
                       const auto& shapeDerivative) {
    value += weight * miss.squaredNorm();
    if (model == nullptr) return;
    for (int j = 0; j < 3; ++j) rows.col(j) = shapeDerivative(j);
    rows.col(3) = whole;
    rows.col(4) = quarterTurn(whole);
    rows.rightCols<2>() = moves * Eigen::Matrix2d::Identity();
    sums.add(weight, miss, rows);
  };
  for (std::size_t i = 0; i < target_.size(); ++i) {
    const std::size_t at = i + 1;
    const double weight = target_.weight[i];
    const Vector2d placed = turned(factor, nodes_.point(at));
    add(weight, placed + middle - target_.point[i], placed, 1,
        [&](int j) -> Vector2d { return turned(factor, nodes_.pointDerivative(at, j)); });
    if (norm_ == FitNorm::L2) continue;
    const Vector2d tangent = turned(factor, direction(nodes_.angle(at)));
    const Vector2d across = quarterTurn(tangent);
    add(weight, tangent - target_.tangent[i], tangent, 0,
        [&](int j) -> Vector2d { return across * nodes_.angleDerivative(at, j); });
    if (norm_ != FitNorm::H2) continue;
    // γ'' = a κ i e^{iψ}.
    const Vector2d second = nodes_.curvature(at) * across;
    add(weight, second - target_.curvature[i] * quarterTurn(target_.tangent[i]), second, 0,
        [&](int j) -> Vector2d {
          return nodes_.curvatureDerivative(at, j) * across +
                 nodes_.angleDerivative(at, j) * quarterTurn(second);
        });
  }
  if (model != nullptr) {
    sums.give(*model);
    model->value = value;
  }
  return std::isfinite(value);
}

void ConstrainedFit::endConstraints(const VectorXd& v, Constraints& out) {
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  for (std::size_t end = 0; end < 2; ++end) {
    const std::size_t at = nodes_.end(end);
    if (constraints_.endpoints) {
      const Vector2d placed = turned(factor, nodes_.point(at));
      const Vector2d miss = placed + v.tail<2>() - (end == 0 ? target_.start : target_.end);
      const Vector2d across = quarterTurn(placed);
      for (int k = 0; k < 2; ++k) {
        auto gradient = out.add(miss[k], end == 0 ? kStartPoint : kEndPoint);
        for (int j = 0; j < 3; ++j) gradient[j] = turned(factor, nodes_.pointDerivative(at, j))[k];
        gradient[3] = placed[k];
        gradient[4] = across[k];
        gradient[5 + k] = 1;
      }
    }
    if (constraints_.tangents) {
      const double miss = v[4] + nodes_.angle(at) - (end == 0 ? startAngle_ : endAngle_);
      auto gradient = out.add(miss, end == 0 ? kStartTangent : kEndTangent);
      for (int j = 0; j < 3; ++j) gradient[j] = nodes_.angleDerivative(at, j);
      gradient[4] = 1;
    }
  }
}

bool ConstrainedFit::constraints(const VectorXd& v, Constraints& out) {
  out.clear(7);
  if (!constraints_.equalities() && !constraints_.bounds()) return true;
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, true)) return false;
  const bool tolerant = constraints_.lengthTolerance > 0;
  if (constraints_.length && !tolerant) out.add(v[3] - std::log(*constraints_.length), kLength)[3] = 1;
  endConstraints(v, out);
  out.equalities = out.size();
  if (constraints_.length && tolerant) {
    const double shortest = *constraints_.length - constraints_.lengthTolerance;
    if (shortest > 0) out.add(std::log(shortest) - v[3], kShortest)[3] = -1;
    const double longest = *constraints_.length + constraints_.lengthTolerance;
    out.add(v[3] - std::log(longest), kLongest)[3] = 1;
  }
  if (constraints_.maxCurvature && !curvatureBounds(v, out)) return false;
  if (constraints_.maxPeriods) {
    const Periods periods = periodsOf(shape);
    out.add(periods.count / *constraints_.maxPeriods - 1, kPeriods).head<3>() =
        periods.gradient / *constraints_.maxPeriods;
  }
  return shapeBounds(v, out);
}

void ConstrainedFit::chooseBranch(const Placement& placement) {
  startAngle_ = target_.startAngle;
  endAngle_ = target_.endAngle;
  if (!nodes_.evaluate(placement.shape, false)) return;
  startAngle_ +=
      2 * kPi * std::round((placement.angle + nodes_.angle(nodes_.end(0)) - startAngle_) / (2 * kPi));
  endAngle_ += 2 * kPi * std::round((placement.angle + nodes_.angle(nodes_.end(1)) - endAngle_) / (2 * kPi));
}

double ConstrainedFit::violation(const Placement& placement) {
  chooseBranch(placement);
  Constraints all;
  return constraints(toVector(placement), all) ? largestViolation(all).size : 1;
}

optimise::Stationarity ConstrainedFit::stationarity(const Placement& placement,
                                                    const std::vector<double>& peaks) {
  chooseBranch(placement);
  peaks_ = peaks;
  const VectorXd v = toVector(placement);
  optimise::LeastSquaresModel model;
  double value = 0;
  Constraints all;
  if (!objective(v, &model, value) || !constraints(v, all)) return {1, 1, 1};
  return stationarityOf(model, all, optimise::kActive);
}

FitSolution ConstrainedFit::scout(const Placement& start, const std::vector<FitSolution>& known) {
  std::vector<optimise::DescentRival> rivals;
  for (const FitSolution& end : known) rivals.push_back({toVector(end.placement), end.value});
  nodes_.setCoarse(true);
  FitSolution out = solve(start, optimise::DescentLimits::rough(std::move(rivals)));
  nodes_.setCoarse(false);
  return out;
}

FitSolution ConstrainedFit::solve(const Placement& start, const optimise::DescentLimits& limits) {
  chooseBranch(start);
  peaks_.clear();
  nextPeak_ = 0;
  const optimise::Descent descent = descend(*this, toVector(start), limits);
  return {toPlacement(descent.v), descent.value,     descent.iterations, descent.feasible, descent.converged,
          descent.boundActive,    descent.violation, descent.worst,      peaks_,           std::nullopt};
}

std::vector<ClampedBlade> clampedBlades(const FitTarget& target, const FitConstraints& constraints,
                                        FitNorm norm) {
  if (!constraints.clamped()) return {};
  const ClampedProblem problem{target.start,    target.end,          target.startAngle,
                               target.endAngle, *constraints.length, std::nullopt};
  ClampedOptions options;
  options.maxInflections = std::clamp(target.inflections() + 2, options.maxInflections, kMostInflections);
  options.maxTurning = std::min(
      std::max(options.maxTurning, std::abs(target.endAngle - target.startAngle) + 2 * kPi), kMostTurning);
  const Result<ClampedAnswer> answer = solveAllClamped(problem, options);
  if (!answer) return {};
  std::vector<ClampedBlade> blades;
  for (const ClampedSolution& solution : answer->solutions) {
    // The place of a loop between taut stretches hangs on last digits: no descent comes to rest there.
    if (solution.elastica.anchor() && !solution.stable) continue;
    const Elastica blade = solution.elastica.transformed(0, target.length, target.centre);
    blades.push_back({blade, objectiveOf(blade, target, norm)});
  }
  std::stable_sort(blades.begin(), blades.end(),
                   [](const ClampedBlade& a, const ClampedBlade& b) { return a.value < b.value; });
  return blades;
}

}  // namespace bw::fit
