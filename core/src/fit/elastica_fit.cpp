// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/fit/elastica_fit.h"

#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "bw/core/text/number_text.h"
#include "fit/fit_constrained.h"
#include "fit/fit_distance.h"
#include "fit/fit_guess.h"
#include "fit/fit_search.h"
#include "fit/start_rules.h"

namespace bw {
namespace {

using fit::ConstrainedFit;
using fit::FitConstraints;
using fit::FitTarget;

// Lengths of the curve that the curvature bound may reach over.
constexpr double kLongestRange = 500;
// A fit has converged if one more Gauss–Newton step would move the curve by less than this (root mean square,
// lengths).
constexpr double kConvergedMovement = 1e-8;
// Relative rounding of the objective.
constexpr double kValueRounding = 1e-12;
// Conditions hold if the returned curve misses them by no more than this (lengths, rad). The solver meets
// them to kFeasible, but along a line with sharp bends the numbers of an elastica do not carry all
// digits; misses above kNoted are told.
constexpr double kHolds = 1e-6;
constexpr double kNoted = 1e-9;

tl::unexpected<Error> badOption(const char* name, double value, const std::string& remedy, double limit) {
  return fail(ErrorCode::badInput,
              std::string("The option ") + name + " of the fit is " +
                  (std::isfinite(value) ? shortText(value, 6) : std::string("not a finite number")) + "; " +
                  remedy + ".",
              name, value, limit);
}

// `length` of the curve.
Result<void> checkOptions(const FitOptions& options, double length) {
  struct Number {
    const char* name;
    std::optional<double> value;
    bool orZero;
    const char* remedy;
  };
  const bool given = options.length == FitOptions::Length::given;
  const Number numbers[] = {
      {"given length", given ? std::optional(options.givenLength) : std::nullopt, false,
       "give a length above 0 mm"},
      {"largest curvature", options.maxCurvature, false, "give a curvature above 0 (1/mm), or none"},
      {"largest number of periods", options.maxPeriods, false, "give a number above 0, or none"},
      {"tolerance of the length", options.lengthTolerance, true, "give 0 mm or more"},
      {"range of the curvature bound", options.curvatureRange, false, "give a length above 0 mm, or none"},
      {"largest number of inflections", options.maxInflections, true, "give 0 or more, or none"},
  };
  for (const auto& [name, value, orZero, remedy] : numbers) {
    if (value && !(std::isfinite(*value) && (*value > 0 || (orZero && *value == 0))))
      return badOption(name, *value, remedy, 0);
  }
  if (options.curvatureRange && *options.curvatureRange > kLongestRange * length)
    return badOption("range of the curvature bound", *options.curvatureRange,
                     "give at most " + shortText(kLongestRange) + " times the length of the curve",
                     kLongestRange * length);
  return {};
}

FitConstraints constraintsOf(const FitOptions& options, double length) {
  FitConstraints constraints;
  if (options.length == FitOptions::Length::exact) constraints.length = 1;
  if (options.length == FitOptions::Length::given) constraints.length = options.givenLength / length;
  if (constraints.length) constraints.lengthTolerance = options.lengthTolerance / length;
  constraints.endpoints = options.endpoints;
  constraints.tangents = options.tangents;
  if (options.maxCurvature) constraints.maxCurvature = *options.maxCurvature * length;
  if (options.curvatureRange) constraints.curvatureRange = *options.curvatureRange / length;
  constraints.maxPeriods = options.maxPeriods;
  return constraints;
}

// The curve of a guess; where that is beyond the numbers of an elastica, a line along the tangent at the
// start.
Elastica curveOfGuess(const fit::LengthGuess& guess, const FitTarget& target) {
  if (const std::optional<Elastica> curve = toElastica(guess.placement, target)) return *curve;
  const Result<Elastica> line = Elastica::make(target.centre + target.length * target.start,
                                               target.startAngle, 0, {0, 0}, target.length);
  BW_CHECK(line.has_value());
  return *line;
}

// R4 of the fit as a product of powers of the residuals of the guess, by least squares of the logarithms over
// 6000 random curves (randomCurves in tests/support, seed 20261121), and the factors between which nine in
// ten of them lie.
FitForecast forecastFrom(const fit::AffineCurvature& law, double R4initial) {
  const double R4 =
      0.0721 * std::pow(R4initial, 0.2467) * std::pow(law.R1, 0.5739) * std::pow(law.R2, 0.4116);
  return {R4, 0.459 * R4, 1.912 * R4};
}

// The sentence for conditions that contradict each other; `worst` the name of the one hardest to meet.
std::string describeConflict(const std::vector<std::string>& conditions, int worst) {
  if (conditions.empty())
    return std::string("No elastica was found that meets all conditions together; the hardest to meet was ") +
           fit::wordsFor(worst) + ". Release one of them.";
  if (conditions.size() == 1)
    return "No elastica near the curve meets " + conditionsInWords(conditions) + "; release it.";
  return "No elastica was found that meets " + conditionsInWords(conditions) +
         " together; release one of them.";
}

// One fit, step by step.
class FitRun {
 public:
  FitRun(const PlanarCurve& curve, const FitOptions& options)
      : curve_(curve),
        options_(options),
        full_(curve),
        constraints_(constraintsOf(options, full_.length)),
        disjunctions_{options.simple, options.maxInflections},
        objective_{options.norm,
                   constraints_.lengthTolerance > 0 ? std::optional<double>() : constraints_.length},
        held_(constraints_) {
    if (full_.size() > fit::kManyNodes && !options.initial) thinned_.emplace(curve, fit::kCoarseNodes);
  }

  Result<FitResult> run() {
    guess();
    descendFreely();
    if (violatesConstraints()) descendUnderConstraints();
    const std::optional<Elastica> curve = curveOf(best_, full_);
    if (!curve)
      return fail(
          ErrorCode::noSolution,
          "The best curve that was found is beyond the numbers of an elastica; look for a slip in the "
          "curve, or smooth it.",
          "curve");
    result_.elastica = *curve;
    finish();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    measure();
    judge();
    return std::move(result_);
  }

 private:
  const FitTarget& coarse() const { return thinned_ ? *thinned_ : full_; }

  // The canonical guess or the warm start with its residuals, and the shapes to start from.
  void guess() {
    const fit::AffineCurvature law = fitAffineCurvature(full_);
    result_.R1 = law.R1;
    result_.R2 = law.R2;
    result_.R3 = law.R3;
    if (options_.initial) {
      result_.initial = *options_.initial;
      result_.R3star = tangentResidual(result_.initial, full_);
      result_.R4initial = std::sqrt(objectiveOf(result_.initial, full_, FitOptions::Norm::L2));
      shapes_.push_back(toPlacement(*options_.initial, full_).shape);
      return;
    }
    const fit::LengthGuess byLength = guessByLength(coarse(), law);
    shapes_.push_back(byLength.placement.shape);
    result_.initial = curveOfGuess(byLength, coarse());
    result_.R3star = thinned_ ? tangentResidual(result_.initial, full_) : byLength.R3star;
    double value = objectiveOf(result_.initial, full_, FitOptions::Norm::L2);
    result_.forecast = forecastFrom(law, std::sqrt(value));
    const std::optional<fit::Placement> counted = guessByCount(full_, law);
    if (const std::optional<Elastica> byCount = counted ? toElastica(*counted, full_) : std::nullopt) {
      const double there = objectiveOf(*byCount, full_, FitOptions::Norm::L2);
      if (options_.guess == FitOptions::Guess::count || there < fit::starts::kFarBetter * value) {
        result_.initial = *byCount;
        value = there;
        shapes_.push_back(counted->shape);
      }
    }
    result_.R4initial = std::sqrt(value);
    shapes_.push_back(shapeFromLaw(coarse(), law));
    shapes_.push_back(shapeFromAngles(coarse()));
  }

  // The best fit without end conditions and bounds.
  void descendFreely() {
    const bool cold = !options_.initial;
    if (const auto found = freeFit(full_, cold ? coarse() : full_, objective_, shapes_, cold))
      best_ = *found;
    else
      best_.placement = toPlacement(result_.initial, full_);
  }

  bool violatesConstraints() const {
    return constraints_.endpoints || constraints_.tangents ||
           (constraints_.bounds() &&
            ConstrainedFit(full_, constraints_, options_.norm).violation(best_.placement) >
                optimise::kFeasible) ||
           (disjunctions_.any() && !disjunctions_.metBy(curveOf(best_, full_)));
  }

  // The best fit under all constraints in place of the free one, or what contradicts each other.
  void descendUnderConstraints() {
    fit::FitStarts from{{}, best_, options_.initial};
    if (options_.initial) from.places.push_back(toPlacement(*options_.initial, full_));
    from.places.push_back(best_.placement);
    const fit::ProjectedFit projected(full_, objective_);
    shapes_.push_back({coarse().endAngle - coarse().startAngle, 0, 0});
    shapes_.push_back({0, 0, 0});
    for (const fit::Shape& shape : shapes_) {
      if (const auto placed = projected.place(shape)) from.places.push_back(placed->placement);
    }
    const fit::ConditionedFit found =
        fitUnderConstraints(full_, coarse(), constraints_, disjunctions_, options_.norm, from);
    const int iterations = best_.iterations + found.iterations;
    if (found.best) {
      best_ = *found.best;
      held_ = found.constraints;
    } else {
      result_.status = FitStatus::infeasible;
      result_.conflict = found.conflict;
      result_.message = describeConflict(result_.conflict, found.worst);
    }
    best_.iterations = iterations;
  }

  // How far from stationary the curve is. Where the descent in three unknowns stalls, since the shape hardly
  // matters, all seven go on from there.
  void finish() {
    ConstrainedFit all(full_, held_, options_.norm);
    end_ = {best_.value, 0, 0};
    if (!best_.taut) end_ = all.stationarity(toPlacement(result_.elastica, full_), best_.peaks);
    if (result_.status == FitStatus::infeasible) return;
    // Where the constraints leave nothing to vary, only they can be missed.
    if (constraints_.clamped() && constraints_.lengthTolerance == 0) end_.gradient = end_.movement = 0;
    if (best_.taut || (best_.converged && end_.movement <= kConvergedMovement)) return;
    const fit::FitSolution finished = all.solve(best_.placement);
    best_.iterations += finished.iterations;
    const std::optional<Elastica> curve = toElastica(finished.placement, full_);
    if (!finished.feasible || !finished.converged || !curve ||
        !(finished.value <= best_.value * (1 + kValueRounding)))
      return;
    const optimise::Stationarity there = all.stationarity(toPlacement(*curve, full_), finished.peaks);
    if (best_.converged && !(there.movement < end_.movement)) return;
    best_.converged = true;
    result_.elastica = *curve;
    end_ = there;
  }

  void measure() {
    result_.iterations = best_.iterations;
    result_.gradientNorm = end_.gradient;
    result_.R4 = std::sqrt(options_.norm != FitOptions::Norm::L2
                               ? objectiveOf(result_.elastica, full_, FitOptions::Norm::L2)
                               : end_.value);
    result_.hausdorff = fit::oneSidedHausdorff(result_.elastica, curve_);
  }

  // Status and message.
  void judge() {
    const optimise::Violation missed = largestMiss(result_.elastica, full_, constraints_);
    result_.violation = missed.size;
    if (result_.status == FitStatus::infeasible) return;
    const std::string carried =
        " (of its length, or rad): near a line with sharp bends the numbers of an elastica do not carry "
        "more digits.";
    const auto misses = [&] {
      return std::string("The curve misses ") + fit::wordsFor(missed.name) + " by " + shortText(missed.size) +
             carried;
    };
    result_.status = FitStatus::iterationLimit;
    if (!best_.converged) {
      result_.message = "The descent stopped after " + std::to_string(result_.iterations) +
                        " iterations before it came to rest; the curve returned is the best so far.";
    } else if (missed.size > kHolds) {
      result_.message = misses();
    } else if (disjunctions_.any() && !disjunctions_.metBy(result_.elastica)) {
      result_.message =
          "The curve meets itself or has more inflections than asked for, by rounding; loosen the other "
          "conditions.";
    } else if (!(end_.movement <= kConvergedMovement)) {
      result_.message = "The best curve is not met more exactly than " + shortText(end_.movement) + carried;
    } else {
      result_.status = best_.boundActive ? FitStatus::constraintsActive : FitStatus::converged;
      if (best_.boundActive)
        result_.message = "A bound holds the curve back: on its curvature, length, periods or shape.";
      if (missed.size > kNoted) result_.message = misses();
    }
  }

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  const PlanarCurve& curve_;
  const FitOptions& options_;
  FitTarget full_;
  std::optional<FitTarget> thinned_;  ///< of curves with many nodes, for the first descents
  FitConstraints constraints_;
  fit::Disjunctions disjunctions_;
  fit::FitObjective objective_;
  FitConstraints held_;             ///< the constraints and bounds that `best_` was found under
  std::vector<fit::Shape> shapes_;  ///< to start from
  fit::FitSolution best_;
  optimise::Stationarity end_;  ///< there
  FitResult result_;
};

}  // namespace

const char* fitStatusName(FitStatus status) {
  static constexpr const char* kNames[] = {"converged", "iteration-limit", "bound-active", "infeasible"};
  return kNames[static_cast<std::size_t>(status)];
}

std::string conditionsInWords(const std::vector<std::string>& conditions) {
  static constexpr std::pair<std::string_view, const char*> kWords[] = {
      {"length", "the length"},
      {"endpoints", "the end points"},
      {"tangents", "the end tangents"},
      {"max_curvature", "the bound on the curvature"},
      {"max_periods", "the bound on the periods"},
      {"max_inflections", "the bound on the inflections"},
      {"simple", "the absence of self-intersections"}};
  std::string list;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    list += i == 0 ? "" : i + 1 == conditions.size() ? " and " : ", ";
    for (const auto& [name, words] : kWords) list += name == conditions[i] ? words : "";
  }
  return list;
}

Result<FitResult> fitElastica(const PlanarCurve& curve, const FitOptions& options) {
  if (Result<void> ok = checkOptions(options, curve.length()); !ok) return tl::unexpected<Error>(ok.error());
  return FitRun(curve, options).run();
}

FitForecast forecastFit(const PlanarCurve& curve) {
  const FitTarget target(curve);
  const fit::AffineCurvature law = fitAffineCurvature(target);
  const Elastica guess = curveOfGuess(guessByLength(target, law), target);
  return forecastFrom(law, std::sqrt(objectiveOf(guess, target, FitOptions::Norm::L2)));
}

}  // namespace bw
