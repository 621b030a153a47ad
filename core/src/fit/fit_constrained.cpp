// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constrained.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numbers>

namespace bw::detail {
namespace {

using Eigen::Vector2d;
using Vector = ConstrainedFit::Vector;
using Matrix = ConstrainedFit::Matrix;
using Rows = ConstrainedFit::Rows;
using Values = ConstrainedFit::Values;

constexpr double kPi = std::numbers::pi;
constexpr int kMaxIterations = 150;
// A step that moves the curve by less than this (root mean square, lengths) ends the descent.
constexpr double kStepTolerance = 1e-11;
// A step this short that does not lower the objective any more is rounding.
constexpr double kRoundingStep = 1e-7;
// An objective as small as this is zero (R4 of 1e-14).
constexpr double kExact = 1e-28;
// Relative rounding of the objective.
constexpr double kValueRounding = 1e-12;
// Steps shorter than this are led back exactly onto the bounds that press.
constexpr double kHoldingStep = 1e-3;
// Newton's method onto the constraints stops when they hold to this, well below `kFeasible`.
constexpr double kRestored = 1e-13;
constexpr int kMaxRestorations = 40;
// Steps in which constraints that are far off are approached.
constexpr int kGradualSteps = 24;
// Rank decision on the slopes of the constraints, which are of order one.
constexpr double kRank = 1e-9;
// A bound counts as active if it holds with equality to this.
constexpr double kActive = 1e-7;
// Part of its diagonal that is added to the metric of the steps onto the constraints.
constexpr double kMetricDiagonal = 1e-2;
// A peak of the curvature that stands out by less than this part is covered by the fixed places.
constexpr double kPeakExcess = 1e-11;
// The longest step in the unknowns within one Newton step onto the constraints.
constexpr double kLongestRestoration = 3;

Vector toVector(const Placement& p) {
  Vector v;
  v << p.shape, p.logLength, p.angle, p.middle;
  return v;
}

Placement toPlacement(const Vector& v) {
  Placement p;
  p.shape = v.head<3>();
  p.logLength = v[3];
  p.angle = v[4];
  p.middle = v.tail<2>();
  return p;
}

Shape shapeOf(const Vector& v) { return v.head<3>(); }

// Periods within a segment of length 1, and their derivatives with respect to the shape: agm(√f, √g) / 2π
// with inflections, else agm(ω, √−g) / π, where ω² = κ²/4 + (f − f_t)/2 and g = f − ω². The mean is
// differentiated along with its iteration.
struct Periods {
  double count = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};

Periods periodsOf(const Shape& shape) {
  const double f = shape.tail<2>().norm();
  const Eigen::Vector3d fSlope =
      f > 0 ? Eigen::Vector3d(0, shape[1] / f, shape[2] / f) : Eigen::Vector3d::Zero();
  const double squared = 0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]);
  const Eigen::Vector3d squaredSlope = Eigen::Vector3d(0.5 * shape[0], -0.5, 0) + 0.5 * fSlope;
  const double g = 0.5 * (f + shape[1]) - 0.25 * shape[0] * shape[0];
  const bool inflectional = g >= 0;
  const double larger = inflectional ? f : squared;
  double a = std::sqrt(larger);
  double b = std::sqrt(std::abs(g));
  if (!(a > 0) || !(b > 0)) return {};
  Eigen::Vector3d aSlope = (inflectional ? fSlope : squaredSlope) / (2 * a);
  Eigen::Vector3d bSlope = (inflectional ? fSlope - squaredSlope : squaredSlope - fSlope) / (2 * b);
  for (int i = 0; i < 40 && std::abs(a - b) > 1e-15 * a; ++i) {
    const double root = std::sqrt(a * b);
    const Eigen::Vector3d rootSlope = (b * aSlope + a * bSlope) / (2 * root);
    aSlope = 0.5 * (aSlope + bSlope);
    a = 0.5 * (a + b);
    bSlope = rootSlope;
    b = root;
  }
  const double factor = 1 / (inflectional ? 2 * kPi : kPi);
  return {a * factor, aSlope * factor};
}

}  // namespace

ConstrainedFit::ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, bool tangentNorm)
    : target_(target),
      constraints_(constraints),
      tangentNorm_(tangentNorm),
      nodes_(target.s),
      ends_({-0.5, 0.5}) {}

bool ConstrainedFit::objective(const Vector& v, Linearised* derivatives, double& value) {
  if (!v.allFinite() || std::abs(v[3]) > 5 || !nodes_.evaluate(shapeOf(v), derivatives != nullptr))
    return false;
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  const Vector2d middle = v.tail<2>();
  value = 0;
  if (derivatives != nullptr) {
    derivatives->half.setZero();
    derivatives->gaussNewton.setZero();
  }
  Eigen::Matrix<double, 2, 7> rows;
  const auto add = [&](double weight, const Vector2d& miss) {
    value += weight * miss.squaredNorm();
    if (derivatives == nullptr) return;
    derivatives->half += weight * rows.transpose() * miss;
    derivatives->gaussNewton += weight * rows.transpose() * rows;
  };
  for (std::size_t i = 0; i < target_.size(); ++i) {
    const Vector2d placed = turned(factor, nodes_.point(i));
    if (derivatives != nullptr) {
      for (int j = 0; j < 3; ++j) rows.col(j) = turned(factor, nodes_.pointDerivative(i, j));
      rows.col(3) = placed;
      rows.col(4) = quarterTurn(placed);
      rows.rightCols<2>().setIdentity();
    }
    add(target_.weight[i], placed + middle - target_.point[i]);
    if (!tangentNorm_) continue;
    const Vector2d tangent = turned(factor, direction(nodes_.angle(i)));
    if (derivatives != nullptr) {
      for (int j = 0; j < 3; ++j) rows.col(j) = quarterTurn(tangent) * nodes_.angleDerivative(i, j);
      rows.col(3) = tangent;
      rows.col(4) = quarterTurn(tangent);
      rows.rightCols<2>().setZero();
    }
    add(target_.weight[i], tangent - target_.tangent[i]);
  }
  if (derivatives != nullptr) derivatives->value = value;
  return std::isfinite(value);
}

bool ConstrainedFit::constraintsAt(const Vector& v, std::vector<Constraint>& equalities,
                                   std::vector<Constraint>& bounds) {
  equalities.clear();
  bounds.clear();
  const Shape shape = shapeOf(v);
  if (!v.allFinite() || std::abs(v[3]) > 5 || !ends_.evaluate(shape, true)) return false;
  if (constraints_.length) {
    Constraint c;
    c.value = v[3] - std::log(*constraints_.length);
    c.slope[3] = 1;
    c.name = "the length";
    equalities.push_back(c);
  }
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  for (std::size_t end = 0; end < 2; ++end) {
    if (constraints_.endpoints) {
      const Vector2d placed = turned(factor, ends_.point(end));
      const Vector2d miss = placed + v.tail<2>() - (end == 0 ? target_.start : target_.end);
      const Vector2d across = quarterTurn(placed);
      for (int k = 0; k < 2; ++k) {
        Constraint c;
        c.value = miss[k];
        for (int j = 0; j < 3; ++j) c.slope[j] = turned(factor, ends_.pointDerivative(end, j))[k];
        c.slope[3] = placed[k];
        c.slope[4] = across[k];
        c.slope[5 + k] = 1;
        c.name = end == 0 ? "the start point" : "the end point";
        equalities.push_back(c);
      }
    }
    if (constraints_.tangents) {
      Constraint c;
      c.value = v[4] + ends_.angle(end) - (end == 0 ? startAngle_ : endAngle_);
      for (int j = 0; j < 3; ++j) c.slope[j] = ends_.angleDerivative(end, j);
      c.slope[4] = 1;
      c.name = end == 0 ? "the start tangent" : "the end tangent";
      equalities.push_back(c);
    }
  }
  if (constraints_.maxCurvature) {
    // At both ends and in the middle, and at a peak of |κ| between them. Three fixed places keep the bound
    // smooth where the elastica is nearly a circle and has no definite peak.
    static constexpr const char* kNames[] = {"the curvature bound at the start",
                                             "the curvature bound in the middle",
                                             "the curvature bound at the end"};
    const double scale = std::exp(-v[3]) / *constraints_.maxCurvature;
    double highest = 0;
    for (int place = 0; place < 3; ++place) {
      const auto end = static_cast<std::size_t>(place / 2);
      const double kappa = place == 1 ? shape[0] : ends_.state(end).curvature;
      const double sign = kappa < 0 ? -1 : 1;
      Constraint c;
      c.value = std::abs(kappa) * scale - 1;
      for (int j = 0; j < 3; ++j) {
        c.slope[j] = sign * scale * (place == 1 ? (j == 0 ? 1.0 : 0.0) : ends_.curvatureDerivative(end, j));
      }
      c.slope[3] = -std::abs(kappa) * scale;
      c.name = kNames[place];
      bounds.push_back(c);
      highest = std::max(highest, std::abs(kappa));
    }
    // κ' = f_n cos ψ − f_t sin ψ changes sign where the tangent runs with the force. The height of the peak
    // is known in closed form, κ_peak² = κ² + 2 (f − f_t).
    if (!nodes_.evaluate(shape, false)) return false;
    const double ft = shape[1];
    const double fn = shape[2];
    const auto slopeAt = [&](double angle) { return fn * std::cos(angle) - ft * std::sin(angle); };
    double before = slopeAt(ends_.angle(0));
    bool peak = false;
    for (std::size_t i = 0; i <= nodes_.size() && !peak; ++i) {
      const double angle = i < nodes_.size() ? nodes_.angle(i) : ends_.angle(1);
      const double here = slopeAt(angle);
      peak = before * here < 0 && ft * std::cos(angle) + fn * std::sin(angle) > 0;
      before = here;
    }
    const double f = std::hypot(ft, fn);
    const double height = std::sqrt(std::max(0.0, shape[0] * shape[0] + 2 * (f - ft)));
    if (peak && f > 0 && height > highest * (1 + kPeakExcess)) {
      Constraint c;
      c.value = height * scale - 1;
      c.slope[0] = scale * shape[0] / height;
      c.slope[1] = scale * (ft / f - 1) / height;
      c.slope[2] = scale * (fn / f) / height;
      c.slope[3] = -height * scale;
      c.name = "the curvature bound";
      bounds.push_back(c);
    }
  }
  if (constraints_.maxPeriods) {
    const Periods periods = periodsOf(shape);
    Constraint c;
    c.value = periods.count / *constraints_.maxPeriods - 1;
    c.slope.head<3>() = periods.slope / *constraints_.maxPeriods;
    c.name = "the number of periods";
    bounds.push_back(c);
  }
  return true;
}

void ConstrainedFit::chooseBranch(const Placement& placement) {
  startAngle_ = target_.startAngle;
  endAngle_ = target_.endAngle;
  if (!ends_.evaluate(placement.shape, false)) return;
  startAngle_ += 2 * kPi * std::round((placement.angle + ends_.angle(0) - startAngle_) / (2 * kPi));
  endAngle_ += 2 * kPi * std::round((placement.angle + ends_.angle(1) - endAngle_) / (2 * kPi));
}

double ConstrainedFit::violation(const Placement& placement, std::string* worst) {
  chooseBranch(placement);
  std::vector<Constraint> equalities;
  std::vector<Constraint> bounds;
  if (!constraintsAt(toVector(placement), equalities, bounds)) return 1;
  double largest = 0;
  const auto offer = [&](double size, const char* name) {
    if (size <= largest) return;
    largest = size;
    if (worst != nullptr) *worst = name;
  };
  for (const Constraint& c : equalities) offer(std::abs(c.value), c.name);
  for (const Constraint& c : bounds) offer(c.value, c.name);
  return largest;
}

void ConstrainedFit::measureBy(const Matrix& gaussNewton) {
  // Steps onto the constraints should move the curve as little as possible, not its numbers; the part of the
  // diagonal keeps numbers that hardly move the curve (tension along a line) from running away.
  Matrix metric = gaussNewton;
  metric.diagonal() *= 1 + kMetricDiagonal;
  metric.diagonal().array() += 1e-6 * kMetricDiagonal * gaussNewton.trace();
  const Matrix lower = metric.llt().matrixL();
  stretch_ = lower.transpose().triangularView<Eigen::Upper>().solve(Matrix::Identity());
}

bool ConstrainedFit::restore(Vector& v, const std::vector<const char*>& hold, int& iterations) {
  std::vector<Constraint> missed;
  std::vector<Constraint> bounds;
  double before = 0;
  Vector from = v;
  Vector step = Vector::Zero();
  int halvings = 0;
  for (int n = 0; n < kMaxRestorations; ++n) {
    double size = std::numeric_limits<double>::infinity();
    Rows slopes;
    Values values;
    if (constraintsAt(v, missed, bounds)) {
      std::copy_if(bounds.begin(), bounds.end(), std::back_inserter(missed), [&](const Constraint& c) {
        return c.value > 0 || std::find(hold.begin(), hold.end(), c.name) != hold.end();
      });
      const auto count = static_cast<Eigen::Index>(missed.size());
      slopes.resize(count, 7);
      values.resize(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        slopes.row(i) = missed[static_cast<std::size_t>(i)].slope.transpose() * stretch_;
        values[i] = missed[static_cast<std::size_t>(i)].value;
      }
      size = count > 0 ? values.norm() : 0;
    }
    if (size <= kRestored) return true;
    if (n > 0 && !(size < before)) {
      // The step was too long, or nothing is left but rounding.
      if (before <= 0.1 * kFeasible && halvings >= 1) {
        v = from;
        return true;
      }
      if (++halvings > 8) return false;
      step *= 0.4;
      v = from + step;
      continue;
    }
    ++iterations;
    halvings = 0;
    before = size;
    from = v;
    Eigen::CompleteOrthogonalDecomposition<Rows> solver;
    solver.setThreshold(kRank);
    solver.compute(slopes);
    step = stretch_ * Vector(solver.solve(-values));
    if (!step.allFinite()) return false;
    if (step.norm() > kLongestRestoration) step *= kLongestRestoration / step.norm();
    v += step;
  }
  return before <= kFeasible;
}

bool ConstrainedFit::restoreGradually(Vector& v, int& iterations) {
  if (Vector direct = v; restore(direct, {}, iterations)) {
    v = direct;
    return true;
  }
  // Move the goals from where the curve is to where they should be, a little at a time.
  const FitConstraints wanted = constraints_;
  const double wantedStart = startAngle_;
  const double wantedEnd = endAngle_;
  const Vector2d start = target_.start;
  const Vector2d end = target_.end;
  FitTarget moving = target_;
  ConstrainedFit path(moving, wanted, tangentNorm_);
  if (!ends_.evaluate(shapeOf(v), false)) return false;
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  const Vector2d fromStart = turned(factor, ends_.point(0)) + v.tail<2>();
  const Vector2d fromEnd = turned(factor, ends_.point(1)) + v.tail<2>();
  const double fromStartAngle = v[4] + ends_.angle(0);
  const double fromEndAngle = v[4] + ends_.angle(1);
  const double fromLength = v[3];
  path.stretch_ = stretch_;
  Vector x = v;
  for (int k = 1; k <= kGradualSteps; ++k) {
    const double part = static_cast<double>(k) / kGradualSteps;
    moving.start = fromStart + part * (start - fromStart);
    moving.end = fromEnd + part * (end - fromEnd);
    path.startAngle_ = fromStartAngle + part * (wantedStart - fromStartAngle);
    path.endAngle_ = fromEndAngle + part * (wantedEnd - fromEndAngle);
    if (wanted.length)
      path.constraints_.length = std::exp(fromLength + part * (std::log(*wanted.length) - fromLength));
    if (!path.restore(x, {}, iterations)) return false;
  }
  v = x;
  return restore(v, {}, iterations);
}

ConstrainedFit::Stationarity ConstrainedFit::stationarity(const Placement& placement) {
  chooseBranch(placement);
  const Vector v = toVector(placement);
  Linearised model;
  double value = 0;
  Stationarity out{1, 1};
  std::vector<Constraint> equalities;
  std::vector<Constraint> bounds;
  if (!objective(v, &model, value) || !constraintsAt(v, equalities, bounds)) return out;
  // Bounds that press take part; one whose multiplier has the wrong sign does not.
  std::vector<Constraint> active = equalities;
  for (const Constraint& c : bounds) {
    if (c.value > -kActive) active.push_back(c);
  }
  while (true) {
    const auto count = static_cast<Eigen::Index>(active.size());
    Matrix free = Matrix::Identity();
    Eigen::Index rank = 0;
    Values multipliers;
    if (count > 0) {
      Rows slopes(count, 7);
      for (Eigen::Index i = 0; i < count; ++i)
        slopes.row(i) = active[static_cast<std::size_t>(i)].slope.transpose();
      Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 7, Eigen::Dynamic>> qr;
      qr.setThreshold(kRank);
      qr.compute(slopes.transpose());
      rank = qr.rank();
      free = qr.householderQ();
      multipliers =
          Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 7, Eigen::Dynamic>>(slopes.transpose())
              .solve(-model.half);
      Eigen::Index wrong = -1;
      for (auto i = static_cast<Eigen::Index>(equalities.size()); i < count; ++i) {
        if (multipliers[i] < 0 && (wrong < 0 || multipliers[i] < multipliers[wrong])) wrong = i;
      }
      if (wrong >= 0) {
        active.erase(active.begin() + wrong);
        continue;
      }
    }
    const Eigen::Index left = 7 - rank;
    if (left == 0) return {0, 0};
    const Eigen::Matrix<double, 7, Eigen::Dynamic> basis = free.rightCols(left);
    const Eigen::VectorXd g = basis.transpose() * model.half;
    Eigen::MatrixXd h = basis.transpose() * model.gaussNewton * basis;
    h.diagonal().array() += 1e-14 * h.trace();
    out.gradient = 2 * g.norm();
    out.movement = std::sqrt(std::max(0.0, g.dot(h.ldlt().solve(g))));
    return out;
  }
}

ConstrainedFit::Solution ConstrainedFit::solve(const Placement& start) {
  Solution solution;
  solution.placement = start;
  chooseBranch(start);
  Vector v = toVector(start);
  const auto finish = [&](bool feasible) {
    solution.placement = toPlacement(v);
    double value = 0;
    solution.value = objective(v, nullptr, value) ? value : 1e3;
    std::vector<Constraint> equalities;
    std::vector<Constraint> bounds;
    solution.violation = 1;
    if (constraintsAt(v, equalities, bounds)) {
      solution.violation = 0;
      const auto offer = [&](double size, const char* name) {
        if (size <= solution.violation) return;
        solution.violation = size;
        solution.worst = name;
      };
      for (const Constraint& c : equalities) offer(std::abs(c.value), c.name);
      for (const Constraint& c : bounds) {
        offer(c.value, c.name);
        solution.boundActive = solution.boundActive || c.value > -kActive;
      }
    }
    solution.feasible = feasible && solution.violation <= kFeasible;
    return solution;
  };
  Linearised model;
  double value = 0;
  if (!objective(v, &model, value)) return finish(false);
  measureBy(model.gaussNewton);
  if (!restoreGradually(v, solution.iterations)) return finish(false);

  double damping = 0;
  Matrix secant = Matrix::Zero();
  int refusals = 0;
  if (!objective(v, &model, value)) return finish(false);
  for (int n = 0; n < kMaxIterations; ++n) {
    std::vector<Constraint> equalities;
    std::vector<Constraint> bounds;
    if (!constraintsAt(v, equalities, bounds)) return finish(false);
    const Matrix scale =
        Vector(model.gaussNewton.diagonal().array() + 1e-12 * model.gaussNewton.trace()).asDiagonal();
    Matrix hessian = model.gaussNewton + secant + damping * scale;

    // The quadratic model under the linearised constraints. There are at most four bounds: try every set of
    // active ones, small sets first, and take the first that fulfils the conditions of the optimum; the model
    // is convex, so that it is the only one.
    const auto eqCount = equalities.size();
    const auto solveModel = [&](const Matrix& h, Vector& best, Values& bestMultipliers, unsigned& bestSet) {
      const unsigned sets = 1U << bounds.size();
      std::vector<unsigned> order(sets);
      for (unsigned i = 0; i < sets; ++i) order[i] = i;
      std::stable_sort(order.begin(), order.end(),
                       [](unsigned a, unsigned b) { return __builtin_popcount(a) < __builtin_popcount(b); });
      for (const unsigned set : order) {
        std::vector<const Constraint*> used;
        for (const Constraint& c : equalities) used.push_back(&c);
        for (std::size_t i = 0; i < bounds.size(); ++i) {
          if ((set >> i) & 1U) used.push_back(&bounds[i]);
        }
        const auto count = static_cast<Eigen::Index>(used.size());
        Vector d = Vector::Zero();
        Matrix q = Matrix::Identity();
        Eigen::Index rank = 0;
        Rows slopes(count, 7);
        if (count > 0) {
          Values values(count);
          for (Eigen::Index i = 0; i < count; ++i) {
            slopes.row(i) = used[static_cast<std::size_t>(i)]->slope.transpose();
            values[i] = used[static_cast<std::size_t>(i)]->value;
          }
          Eigen::CompleteOrthogonalDecomposition<Rows> particular;
          particular.setThreshold(kRank);
          particular.compute(slopes);
          d = -particular.solve(values);
          Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 7, Eigen::Dynamic>> qr;
          qr.setThreshold(kRank);
          qr.compute(slopes.transpose());
          rank = qr.rank();
          q = qr.householderQ();
        }
        if (rank < 7) {
          const Eigen::Matrix<double, 7, Eigen::Dynamic> basis = q.rightCols(7 - rank);
          const Eigen::LLT<Eigen::MatrixXd> factor(basis.transpose() * h * basis);
          if (factor.info() != Eigen::Success) continue;  // not convex without a bound that holds it
          d += basis * factor.solve(-(basis.transpose() * (model.half + h * d)));
        }
        bool right = d.allFinite();
        for (std::size_t i = 0; i < bounds.size() && right; ++i) {
          if (!((set >> i) & 1U)) right = bounds[i].value + bounds[i].slope.dot(d) <= 1e-12;
        }
        Values multipliers(count);
        if (right && count > 0) {
          multipliers = Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, 7, Eigen::Dynamic>>(
                            slopes.transpose())
                            .solve(-(model.half + h * d));
          for (Eigen::Index i = static_cast<Eigen::Index>(eqCount); i < count && right; ++i)
            right = multipliers[i] >= -1e-14;
        }
        if (!right) continue;
        best = d;
        bestMultipliers = multipliers;
        bestSet = set;
        return true;
      }
      return false;
    };
    Vector d = Vector::Zero();
    Values multipliers;
    unsigned set = 0;
    bool solved = solveModel(hessian, d, multipliers, set);
    if (!solved) {
      secant.setZero();
      damping = std::max(damping, 1e-8);
      hessian = model.gaussNewton + damping * scale;
      solved = solveModel(hessian, d, multipliers, set);
    }
    if (!solved) return finish(true);
    const double movement = std::sqrt(std::max(0.0, d.dot(model.gaussNewton * d)));
    const double turn = d.head<5>().norm();
    if ((movement <= kStepTolerance && turn <= 1e-5) || value <= kExact) {
      solution.converged = true;
      return finish(true);
    }
    ++solution.iterations;
    int unused = 0;
    Vector next = v + d;
    Linearised there;
    double valueThere = 0;
    // The constraints hold only to kRestored, which the multipliers carry into the objective.
    const double rounding = kValueRounding * value + 8 * kRestored * multipliers.lpNorm<1>();
    const auto tryStep = [&](const std::vector<const char*>& hold) {
      next = v + d;
      const bool evaluated =
          d.norm() < 1e3 && restore(next, hold, unused) && objective(next, &there, valueThere);
      return evaluated &&
             (valueThere < value || (valueThere <= value + rounding && movement <= kRoundingStep));
    };
    // Near the end the step is led back exactly onto the bounds that press, since the slack that it leaves
    // costs more than it gains. Farther off that may be impossible: a peak of the curvature may have come in
    // at an end.
    std::vector<const char*> pressing;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (movement <= kHoldingStep && ((set >> i) & 1U)) pressing.push_back(bounds[i].name);
    }
    const bool better = tryStep(pressing) || (!pressing.empty() && tryStep({}));
    if (!better) {
      if (movement <= kRoundingStep) {
        solution.converged = true;
        return finish(true);
      }
      secant.setZero();
      damping = std::max(10 * damping, 1e-3);
      if (++refusals > 30 || damping > 1e12) {
        solution.converged = movement <= kRoundingStep;
        return finish(true);
      }
      continue;
    }
    // Secant correction for the second derivatives of the curve and of the constraints, from the change of
    // the Lagrangian's slope.
    std::vector<Constraint> equalitiesThere;
    std::vector<Constraint> boundsThere;
    if (constraintsAt(next, equalitiesThere, boundsThere)) {
      Vector slope = there.half;
      Vector slopeBefore = model.half;
      for (std::size_t i = 0; i < eqCount; ++i) {
        slope += multipliers[static_cast<Eigen::Index>(i)] * equalitiesThere[i].slope;
        slopeBefore += multipliers[static_cast<Eigen::Index>(i)] * equalities[i].slope;
      }
      Eigen::Index index = static_cast<Eigen::Index>(eqCount);
      bool matched = true;
      for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (!((set >> i) & 1U)) continue;
        const auto same = std::find_if(boundsThere.begin(), boundsThere.end(), [&](const Constraint& c) {
          return std::strcmp(c.name, bounds[i].name) == 0;
        });
        matched = matched && same != boundsThere.end();
        if (same != boundsThere.end()) slope += multipliers[index] * same->slope;
        slopeBefore += multipliers[index] * bounds[i].slope;
        ++index;
      }
      const Vector moved = next - v;
      const Vector miss = slope - slopeBefore - (there.gaussNewton + secant) * moved;
      const double denominator = miss.dot(moved);
      if (matched && std::abs(denominator) > 1e-8 * miss.norm() * moved.norm())
        secant += miss * miss.transpose() / denominator;
    }
    damping *= 0.1;
    if (damping < 1e-12) damping = 0;
    v = next;
    model = there;
    value = valueThere;
    measureBy(model.gaussNewton);
  }
  return finish(true);
}

}  // namespace bw::detail
