// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/constrained_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/work_meter.h"

namespace bw::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A step this short that does not lower the objective any more is rounding.
constexpr double kRoundingStep = 1e-7;
// An objective as small as this is zero (R4 of 1e-14).
constexpr double kExact = 1e-28;
// Relative rounding of the objective.
constexpr double kValueRounding = 1e-12;
// Steps shorter than this are led back exactly onto the bounds that press.
constexpr double kHoldingStep = 1e-3;
// Steps in which conditions that are far off are approached.
constexpr int kGradualSteps = 24;
// Part of its diagonal that is added to the metric of the steps onto the conditions.
constexpr double kMetricDiagonal = 1e-2;
// The longest step in the unknowns within one Newton step onto the conditions.
constexpr double kLongestRestoration = 3;
// Newton steps in which a start is led onto the conditions.
constexpr int kMaxRestorations = 40;
// A descent ends at a rival if it is above it and nearer than this part of the rival's own distance from the
// target.
constexpr double kSamePlace = 0.2;
// It is given up if it would be above a rival after a gain of so many times what the model promises for a
// step that is hardly damped.
constexpr double kMostGain = 3;
constexpr double kLightDamping = 1e-2;
constexpr double kLongestStep = 1e3;
constexpr double kMostDamping = 1e12;

class Descender {
 public:
  Descender(ConstrainedProblem& problem, const VectorXd& start, const DescentLimits& limits)
      : problem_(problem), limits_(limits) {
    out_.v = start;
  }

  Descent run();

 private:
  bool restore(VectorXd& v, const std::vector<int>& hold, const std::vector<double>* relaxed = nullptr,
               double relaxedBounds = 0);
  bool restoreGradually();
  void measureBy(const MatrixXd& gaussNewton);
  Descent finish(bool feasible);
  bool aboveRival(double value) const;
  bool endsAtRival(const MatrixXd& gaussNewton, double value) const;
  void addBends(MatrixXd& hessian) const;
  void noteMultipliers(const ConstrainedStep& step);
  void learn(const LeastSquaresModel& before, const LeastSquaresModel& after, const ConstrainedStep& step,
             const VectorXd& moved, const VectorXd& there, MatrixXd& secant);

  ConstrainedProblem& problem_;
  const DescentLimits& limits_;
  Descent out_;
  int evaluations_ = 0;
  int restorations_ = kMaxRestorations;  ///< allowed
  MatrixXd stretch_;
  Conditions here_;
  Conditions missed_;
  std::vector<std::pair<int, double>> pressed_;  ///< names of the curved bounds and their last multipliers
};

void Descender::measureBy(const MatrixXd& gaussNewton) {
  // Steps onto the conditions should move the curve as little as possible, not its numbers; the part of the
  // diagonal keeps numbers that hardly move the curve (tension along a line) from running away.
  MatrixXd metric = gaussNewton;
  metric.diagonal() *= 1 + kMetricDiagonal;
  metric.diagonal().array() += 1e-6 * kMetricDiagonal * gaussNewton.trace();
  stretch_ = stretchOf(metric);
}

// Newton's method with the shortest steps onto the equalities, the bounds that are violated and those named
// in `hold`. With `relaxed`, onto equalities that are missed by as much, and bounds by `relaxedBounds`.
bool Descender::restore(VectorXd& v, const std::vector<int>& hold, const std::vector<double>* relaxed,
                        double relaxedBounds) {
  double before = std::numeric_limits<double>::infinity();
  VectorXd from = v;
  VectorXd step = VectorXd::Zero(v.size());
  int halvings = 0;
  std::vector<std::size_t> used;
  for (int n = 0; n < restorations_ && evaluations_++ < limits_.evaluations && !workExhausted(); ++n) {
    double size = std::numeric_limits<double>::infinity();
    used.clear();
    VectorXd values;
    if (problem_.conditions(v, missed_)) {
      for (std::size_t i = 0; i < missed_.size(); ++i) {
        if (missed_.names[i] < 0) continue;
        const bool equality = i < missed_.equalities;
        missed_.values[i] -= relaxed == nullptr ? 0 : equality ? (*relaxed)[i] : relaxedBounds;
        if (equality || missed_.values[i] > 0 ||
            std::find(hold.begin(), hold.end(), missed_.names[i]) != hold.end())
          used.push_back(i);
      }
      values.resize(static_cast<Index>(used.size()));
      for (std::size_t k = 0; k < used.size(); ++k) values[static_cast<Index>(k)] = missed_.values[used[k]];
      size = used.empty() ? 0 : values.norm();
    }
    if (size <= limits_.restored) return true;
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
    ++out_.iterations;
    halvings = 0;
    before = size;
    from = v;
    MatrixXd rows(static_cast<Index>(used.size()), v.size());
    for (std::size_t k = 0; k < used.size(); ++k) {
      rows.row(static_cast<Index>(k)) =
          missed_.slopes.col(static_cast<Index>(used[k])).transpose() * stretch_;
    }
    step = stretch_ * shortestSolution(rows, -values);
    if (!step.allFinite()) return false;
    if (step.norm() > kLongestRestoration) step *= kLongestRestoration / step.norm();
    v += step;
  }
  return before <= kFeasible;
}

bool Descender::restoreGradually() {
  const VectorXd start = out_.v;
  if (restore(out_.v, {})) return true;
  if (!limits_.gradual) return false;
  // Move the goals from where the curve is to where they should be, a little at a time.
  out_.v = start;
  if (!problem_.conditions(start, here_)) return false;
  const std::vector<double> misses(here_.values.begin(),
                                   here_.values.begin() + static_cast<std::ptrdiff_t>(here_.equalities));
  double excess = 0;
  for (std::size_t i = here_.equalities; i < here_.size(); ++i) excess = std::max(excess, here_.values[i]);
  for (int k = 1; k < kGradualSteps; ++k) {
    const double rest = 1 - static_cast<double>(k) / kGradualSteps;
    std::vector<double> relaxed = misses;
    for (double& miss : relaxed) miss *= rest;
    if (!restore(out_.v, {}, &relaxed, rest * excess)) return false;
  }
  return restore(out_.v, {});
}

Descent Descender::finish(bool feasible) {
  double value = 0;
  out_.value = problem_.objective(out_.v, nullptr, value) ? value : 1e3;
  out_.violation = 1;
  if (problem_.conditions(out_.v, here_)) {
    const Violation violation = largestViolation(here_);
    out_.violation = violation.size;
    out_.worst = violation.name;
    for (std::size_t i = here_.equalities; i < here_.size(); ++i)
      out_.boundActive = out_.boundActive || here_.values[i] > -kActive;
  }
  out_.feasible = feasible && out_.violation <= std::max(kFeasible, limits_.restored);
  return out_;
}

bool Descender::aboveRival(double value) const {
  return std::any_of(limits_.rivals.begin(), limits_.rivals.end(),
                     [&](const DescentRival& rival) { return value > rival.value; });
}

bool Descender::endsAtRival(const MatrixXd& gaussNewton, double value) const {
  return std::any_of(limits_.rivals.begin(), limits_.rivals.end(), [&](const DescentRival& rival) {
    const VectorXd apart = out_.v - rival.v;
    return value > rival.value && apart.dot(gaussNewton * apart) < kSamePlace * kSamePlace * rival.value;
  });
}

// What curved bounds add to the Lagrangian, with the multipliers of the step before.
void Descender::addBends(MatrixXd& hessian) const {
  for (const Conditions::Bend& bend : here_.bends) {
    const auto last = std::find_if(pressed_.begin(), pressed_.end(), [&](const auto& pressed) {
      return pressed.first == here_.names[bend.bound];
    });
    if (last != pressed_.end()) hessian += (last->second * bend.size) * bend.row * bend.row.transpose();
  }
}

void Descender::noteMultipliers(const ConstrainedStep& step) {
  pressed_.clear();
  for (const Conditions::Bend& bend : here_.bends) {
    const double multiplier = step.multipliers[static_cast<Index>(bend.bound)];
    if (multiplier > 0) pressed_.emplace_back(here_.names[bend.bound], multiplier);
  }
}

// Secant correction for the second derivatives of the curve and of the conditions, from the change of the
// Lagrangian's slope, group by group.
void Descender::learn(const LeastSquaresModel& before, const LeastSquaresModel& after,
                      const ConstrainedStep& step, const VectorXd& moved, const VectorXd& there,
                      MatrixXd& secant) {
  if (!problem_.conditions(there, missed_)) return;
  VectorXd change = after.half - before.half;
  for (std::size_t i = 0; i < here_.size(); ++i) {
    const double multiplier = step.multipliers[static_cast<Index>(i)];
    if (!step.active[i] || multiplier == 0) continue;
    std::optional<std::size_t> same = i;
    if (i >= here_.equalities) same = missed_.bound(here_.names[i]);
    if (!same) return;  // a bound has come or gone: the slopes do not compare
    change += multiplier *
              (missed_.slopes.col(static_cast<Index>(*same)) - here_.slopes.col(static_cast<Index>(i)));
  }
  for (const Conditions::Bend& bend : here_.bends) {
    const double multiplier = step.multipliers[static_cast<Index>(bend.bound)];
    if (step.active[bend.bound] && multiplier > 0)
      change -= multiplier * bend.size * bend.row.dot(moved) * bend.row;
  }
  const Index size = problem_.unknowns() / problem_.groups();
  for (Index at = 0; at < problem_.unknowns(); at += size) {
    const VectorXd part = moved.segment(at, size);
    const VectorXd miss =
        change.segment(at, size) -
        (after.gaussNewton.block(at, at, size, size) + secant.block(at, at, size, size)) * part;
    const double denominator = miss.dot(part);
    if (std::abs(denominator) > 1e-8 * miss.norm() * part.norm())
      secant.block(at, at, size, size) += miss * (miss.transpose() / denominator);
  }
}

Descent Descender::run() {
  LeastSquaresModel model;
  double value = 0;
  if (!problem_.objective(out_.v, &model, value)) return finish(false);
  measureBy(model.gaussNewton);
  if (!restoreGradually()) return finish(false);
  if (!problem_.objective(out_.v, &model, value)) return finish(false);

  restorations_ = limits_.restorations;
  const Index unknowns = problem_.unknowns();
  double damping = 0;
  MatrixXd secant = MatrixXd::Zero(unknowns, unknowns);
  int refusals = 0;
  std::vector<char> guess;
  LeastSquaresModel there;
  for (int n = 0; n < limits_.iterations && evaluations_ < limits_.evaluations && !workExhausted(); ++n) {
    if (endsAtRival(model.gaussNewton, value) || !problem_.conditions(out_.v, here_)) return finish(false);
    const VectorXd scale = model.gaussNewton.diagonal().array() + 1e-12 * model.gaussNewton.trace();
    MatrixXd hessian = model.gaussNewton + secant;
    addBends(hessian);
    hessian.diagonal() += damping * scale;
    if (guess.size() != here_.size()) guess.clear();
    std::optional<ConstrainedStep> step = constrainedStep(hessian, model.half, here_, guess);
    if (!step) {
      secant.setZero();
      damping = std::max(damping, 1e-8);
      hessian = model.gaussNewton;
      addBends(hessian);
      hessian.diagonal() += damping * scale;
      step = constrainedStep(hessian, model.half, here_, guess);
    }
    if (!step) return finish(true);
    guess = step->active;
    noteMultipliers(*step);
    const VectorXd& d = step->d;
    const double movement = std::sqrt(std::max(0.0, d.dot(model.gaussNewton * d)));
    if ((movement <= limits_.movement && d.norm() <= limits_.unknowns) || value <= kExact) {
      out_.converged = true;
      return finish(true);
    }
    if (n > 0 && damping <= kLightDamping && aboveRival(value - kMostGain * movement * movement))
      return finish(false);
    ++out_.iterations;
    VectorXd next;
    double valueThere = 0;
    // The conditions hold only to `restored`, which the multipliers carry into the objective.
    const double rounding = kValueRounding * value + 8 * limits_.restored * step->multipliers.lpNorm<1>();
    const auto tryStep = [&](const std::vector<int>& hold) {
      next = out_.v + d;
      const int counted = out_.iterations;
      const bool evaluated =
          d.norm() < kLongestStep && restore(next, hold) && problem_.objective(next, &there, valueThere);
      out_.iterations = counted;
      return evaluated &&
             (valueThere < value || (valueThere <= value + rounding && movement <= kRoundingStep));
    };
    // Near the end the step is led back exactly onto the bounds that press, since the slack that it leaves
    // costs more than it gains. Farther off that may be impossible: a peak of the curvature may have come in
    // at an end.
    std::vector<int> pressing;
    for (std::size_t i = here_.equalities; i < here_.size(); ++i) {
      if (movement <= kHoldingStep && step->active[i]) pressing.push_back(here_.names[i]);
    }
    if (!tryStep(pressing) && (pressing.empty() || !tryStep({}))) {
      if (movement <= kRoundingStep) {
        out_.converged = true;
        return finish(true);
      }
      secant.setZero();
      damping = std::max(10 * damping, 1e-3);
      if (++refusals > limits_.refusals || damping > kMostDamping) return finish(true);
      continue;
    }
    learn(model, there, *step, next - out_.v, next, secant);
    damping *= limits_.easing;
    if (damping < 1e-12) damping = 0;
    out_.v = next;
    std::swap(model, there);
    value = valueThere;
    measureBy(model.gaussNewton);
  }
  return finish(true);
}

}  // namespace

Violation largestViolation(const Conditions& conditions) {
  Violation largest;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const double size = i < conditions.equalities ? std::abs(conditions.values[i]) : conditions.values[i];
    if (size > largest.size) largest = {size, conditions.names[i]};
  }
  return largest;
}

DescentLimits DescentLimits::rough(std::vector<DescentRival> rivals) {
  return {.iterations = 30,
          .refusals = 12,
          .restorations = 5,
          .evaluations = 120,
          .movement = 1e-4,
          .unknowns = std::numeric_limits<double>::infinity(),
          .restored = 1e-7,
          .easing = 0.3,
          .gradual = false,
          .rivals = std::move(rivals)};
}

Descent descend(ConstrainedProblem& problem, const VectorXd& start, const DescentLimits& limits) {
  return Descender(problem, start, limits).run();
}

}  // namespace bw::detail
