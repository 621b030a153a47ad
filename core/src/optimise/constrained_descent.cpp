// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/constrained_descent.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/work_meter.h"

namespace bw::optimise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Lengths and values are without dimension, as `ConstrainedProblem` has them.

// A step that moves less than this and does not lower the objective any more is rounding.
constexpr double kRoundingStep = 1e-7;
// An objective as small as this is zero: a root mean square of 1e-14.
constexpr double kExact = 1e-28;
// Relative rounding of the objective, and how far it may err for each multiplier and constraint that is only
// nearly met.
constexpr double kObjectiveRounding = 1e-12;
constexpr double kRestoredRounding = 8;
// In place of an objective that cannot be evaluated: above any that makes sense.
constexpr double kNoValue = 1e3;
// Steps that move less than this are led back exactly onto the active bounds.
constexpr double kHoldingStep = 1e-3;

// Parts in which constraints that are far off are approached.
constexpr int kGradualSteps = 24;
// Parts of its diagonal and, of these, of its trace that are added to the metric of the steps onto the
// constraints.
constexpr double kMetricDiagonal = 1e-2;
constexpr double kMetricTrace = 1e-6;
// The longest step in the unknowns within one Newton step onto the constraints. One that gets farther off is
// shortened, so often at most; then, if rounding is left, the best place is taken.
constexpr double kLongestRestoration = 3;
constexpr double kShortening = 0.4;
constexpr int kMostShortenings = 8;
constexpr double kNearlyFeasible = 0.1 * kFeasible;
// Newton steps in which a start is led onto the constraints.
constexpr int kMaxRestorations = 40;

// A descent ends at a rival if it is above it and nearer than this part of the root of the rival's value.
constexpr double kSamePlace = 0.2;
// It is given up if it would be above a rival after a gain of so many times what the model promises for a
// step that is hardly damped.
constexpr double kMostGain = 3;
constexpr double kLightDamping = 1e-2;

// Damping, in parts of the diagonal of the Hessian (at least the last of its trace): the least after a
// Hessian that is not convex, the least and the growth after a step that did not get on, what is as good as
// none, and where the descent ends.
constexpr double kConvexDamping = 1e-8;
constexpr double kRefusedDamping = 1e-3;
constexpr double kMoreDamping = 10;
constexpr double kNoDamping = 1e-12;
constexpr double kMostDamping = 1e12;
constexpr double kDampedTrace = 1e-12;
// A longer step in the unknowns leads nowhere.
constexpr double kLongestStep = 1e3;
// A secant correction at right angles to the step, by this cosine, would be without bounds and is left out.
constexpr double kSecantCosine = 1e-8;

class Descender {
 public:
  Descender(ConstrainedProblem& problem, const VectorXd& start, const DescentLimits& limits)
      : problem_(problem), limits_(limits) {
    out_.v = start;
  }

  Descent run() {
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
    LeastSquaresModel modelThere;
    for (int n = 0; n < limits_.iterations && evaluations_ < limits_.evaluations && !detail::workExhausted();
         ++n) {
      if (endsAtRival(model.gaussNewton, value) || !problem_.constraints(out_.v, here_)) return finish(false);
      if (guess.size() != here_.size()) guess.clear();
      std::optional<ActiveSetStep> step = dampedStep(model, secant, damping, guess);
      if (!step) {
        secant.setZero();
        damping = std::max(damping, kConvexDamping);
        step = dampedStep(model, secant, damping, guess);
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
      // The constraints hold only to `restored`, which the multipliers carry into the objective.
      const double rounding =
          kObjectiveRounding * value + kRestoredRounding * limits_.restored * step->multipliers.lpNorm<1>();
      const auto tryStep = [&](const std::vector<int>& active) {
        next = out_.v + d;
        const int counted = out_.iterations;
        const bool evaluated = d.norm() < kLongestStep && restore(next, active) &&
                               problem_.objective(next, &modelThere, valueThere);
        out_.iterations = counted;
        return evaluated &&
               (valueThere < value || (valueThere <= value + rounding && movement <= kRoundingStep));
      };
      // Near the end the step is led back exactly onto the active bounds, since the slack that it leaves
      // costs more than it gains. Farther off that may be impossible: a bound may have come in.
      std::vector<int> active;
      for (std::size_t i = here_.equalities; i < here_.size(); ++i) {
        if (movement <= kHoldingStep && step->active[i]) active.push_back(here_.names[i]);
      }
      if (!tryStep(active) && (active.empty() || !tryStep({}))) {
        if (movement <= kRoundingStep) {
          out_.converged = true;
          return finish(true);
        }
        secant.setZero();
        damping = std::max(kMoreDamping * damping, kRefusedDamping);
        if (++refusals > limits_.refusals || damping > kMostDamping) return finish(true);
        continue;
      }
      learn(model, modelThere, *step, next - out_.v, next, secant);
      damping *= limits_.easing;
      if (damping < kNoDamping) damping = 0;
      out_.v = next;
      std::swap(model, modelThere);
      value = valueThere;
      measureBy(model.gaussNewton);
    }
    return finish(true);
  }

 private:
  void measureBy(const MatrixXd& gaussNewton) {
    // Steps onto the constraints should change the residuals as little as possible, not the unknowns; the
    // part of the diagonal keeps unknowns that hardly matter from running away.
    MatrixXd metric = gaussNewton;
    metric.diagonal() *= 1 + kMetricDiagonal;
    metric.diagonal().array() += kMetricTrace * kMetricDiagonal * gaussNewton.trace();
    const Eigen::LLT<MatrixXd> factor(metric);
    inverseFactor_ = factor.matrixU().solve(MatrixXd::Identity(metric.rows(), metric.cols()));
  }

  // Newton's method with the shortest steps onto the equalities, the bounds that are violated and those named
  // in `active`. With `relaxed`, onto equalities that are missed by as much, and bounds by `relaxedBounds`.
  bool restore(VectorXd& v, const std::vector<int>& active, const std::vector<double>* relaxed = nullptr,
               double relaxedBounds = 0) {
    double before = std::numeric_limits<double>::infinity();
    VectorXd from = v;
    VectorXd step = VectorXd::Zero(v.size());
    int shortenings = 0;
    std::vector<std::size_t> used;
    for (int n = 0; n < restorations_ && evaluations_++ < limits_.evaluations && !detail::workExhausted();
         ++n) {
      double size = std::numeric_limits<double>::infinity();
      used.clear();
      VectorXd values;
      if (problem_.constraints(v, there_)) {
        for (std::size_t i = 0; i < there_.size(); ++i) {
          if (there_.names[i] < 0) continue;
          const bool equality = i < there_.equalities;
          there_.values[i] -= relaxed == nullptr ? 0 : equality ? (*relaxed)[i] : relaxedBounds;
          if (equality || there_.values[i] > 0 ||
              std::find(active.begin(), active.end(), there_.names[i]) != active.end())
            used.push_back(i);
        }
        values.resize(static_cast<Index>(used.size()));
        for (std::size_t k = 0; k < used.size(); ++k) values[static_cast<Index>(k)] = there_.values[used[k]];
        size = used.empty() ? 0 : values.norm();
      }
      if (size <= limits_.restored) return true;
      if (n > 0 && !(size < before)) {
        // The step was too long, or nothing is left but rounding.
        if (before <= kNearlyFeasible && shortenings >= 1) {
          v = from;
          return true;
        }
        if (++shortenings > kMostShortenings) return false;
        step *= kShortening;
        v = from + step;
        continue;
      }
      ++out_.iterations;
      shortenings = 0;
      before = size;
      from = v;
      MatrixXd rows(static_cast<Index>(used.size()), v.size());
      for (std::size_t k = 0; k < used.size(); ++k) {
        rows.row(static_cast<Index>(k)) = there_.gradient(used[k]).transpose() * inverseFactor_;
      }
      step = inverseFactor_ * leastNormSolution(rows, -values);
      if (!step.allFinite()) return false;
      if (step.norm() > kLongestRestoration) step *= kLongestRestoration / step.norm();
      v += step;
    }
    return before <= kFeasible;
  }

  bool restoreGradually() {
    const VectorXd start = out_.v;
    if (restore(out_.v, {})) return true;
    if (!limits_.gradual) return false;
    // Move the goals from where the start is to where they should be, a little at a time.
    out_.v = start;
    if (!problem_.constraints(start, here_)) return false;
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

  Descent finish(bool feasible) {
    double value = 0;
    out_.value = problem_.objective(out_.v, nullptr, value) ? value : kNoValue;
    out_.violation = 1;
    if (problem_.constraints(out_.v, here_)) {
      const Violation violation = largestViolation(here_);
      out_.violation = violation.size;
      out_.worst = violation.name;
      for (std::size_t i = here_.equalities; i < here_.size(); ++i)
        out_.boundActive = out_.boundActive || here_.values[i] > -kActive;
    }
    out_.feasible = feasible && out_.violation <= std::max(kFeasible, limits_.restored);
    return out_;
  }

  bool aboveRival(double value) const {
    return std::any_of(limits_.rivals.begin(), limits_.rivals.end(),
                       [&](const DescentRival& rival) { return value > rival.value; });
  }

  bool endsAtRival(const MatrixXd& gaussNewton, double value) const {
    return std::any_of(limits_.rivals.begin(), limits_.rivals.end(), [&](const DescentRival& rival) {
      const VectorXd apart = out_.v - rival.v;
      return value > rival.value && apart.dot(gaussNewton * apart) < kSamePlace * kSamePlace * rival.value;
    });
  }

  // The step with the secant correction, the Hessians of curved bounds with their last multipliers, and
  // damping. Nothing if that is not convex.
  std::optional<ActiveSetStep> dampedStep(const LeastSquaresModel& model, const MatrixXd& secant,
                                          double damping, const std::vector<char>& guess) const {
    MatrixXd hessian = model.gaussNewton + secant;
    for (const Constraints::Hessian& own : here_.hessians) {
      const auto last = std::find_if(multipliers_.begin(), multipliers_.end(), [&](const auto& multiplier) {
        return multiplier.first == here_.names[own.bound];
      });
      if (last != multipliers_.end()) hessian += (last->second * own.size) * own.row * own.row.transpose();
    }
    const VectorXd scale = model.gaussNewton.diagonal().array() + kDampedTrace * model.gaussNewton.trace();
    hessian.diagonal() += damping * scale;
    return activeSetStep(hessian, model.halfGradient, here_, guess);
  }

  void noteMultipliers(const ActiveSetStep& step) {
    multipliers_.clear();
    for (const Constraints::Hessian& own : here_.hessians) {
      const double multiplier = step.multipliers[static_cast<Index>(own.bound)];
      if (multiplier > 0) multipliers_.emplace_back(here_.names[own.bound], multiplier);
    }
  }

  // Secant correction (symmetric rank one) for the second derivatives of the residuals and of the
  // constraints, from the change of the Lagrangian's gradient, group by group.
  void learn(const LeastSquaresModel& before, const LeastSquaresModel& after, const ActiveSetStep& step,
             const VectorXd& moved, const VectorXd& next, MatrixXd& secant) {
    if (!problem_.constraints(next, there_)) return;
    VectorXd change = after.halfGradient - before.halfGradient;
    for (std::size_t i = 0; i < here_.size(); ++i) {
      const double multiplier = step.multipliers[static_cast<Index>(i)];
      if (!step.active[i] || multiplier == 0) continue;
      std::optional<std::size_t> same = i;
      if (i >= here_.equalities) same = there_.bound(here_.names[i]);
      if (!same) return;  // a bound has come or gone: the gradients do not compare
      change += multiplier * (there_.gradient(*same) - here_.gradient(i));
    }
    for (const Constraints::Hessian& own : here_.hessians) {
      const double multiplier = step.multipliers[static_cast<Index>(own.bound)];
      if (step.active[own.bound] && multiplier > 0)
        change -= multiplier * own.size * own.row.dot(moved) * own.row;
    }
    const Index size = problem_.unknowns() / problem_.groups();
    for (Index at = 0; at < problem_.unknowns(); at += size) {
      const VectorXd part = moved.segment(at, size);
      const VectorXd miss =
          change.segment(at, size) -
          (after.gaussNewton.block(at, at, size, size) + secant.block(at, at, size, size)) * part;
      const double denominator = miss.dot(part);
      if (std::abs(denominator) > kSecantCosine * miss.norm() * part.norm())
        secant.block(at, at, size, size) += miss * (miss.transpose() / denominator);
    }
  }

  ConstrainedProblem& problem_;
  const DescentLimits& limits_;
  Descent out_;
  int evaluations_ = 0;
  int restorations_ = kMaxRestorations;  ///< allowed
  MatrixXd inverseFactor_;               ///< of the metric: steps in it are this times ordinary ones
  Constraints here_;
  Constraints there_;
  std::vector<std::pair<int, double>> multipliers_;  ///< the last ones of the active curved bounds, by name
};

}  // namespace

Violation largestViolation(const Constraints& constraints) {
  Violation largest;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const double size = i < constraints.equalities ? std::abs(constraints.values[i]) : constraints.values[i];
    if (size > largest.size) largest = {size, constraints.names[i]};
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

}  // namespace bw::optimise
