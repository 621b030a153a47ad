// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/fit/elastica_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "bw/core/text/number_text.h"
#include "fit/fit_constrained.h"
#include "fit/fit_distance.h"
#include "fit/fit_free.h"
#include "fit/fit_guess.h"
#include "fit/fit_nested.h"
#include "fit/fit_projection.h"
#include "fit/fit_search.h"
#include "fit/fit_target.h"

namespace bw {
namespace {

using detail::ConstrainedFit;
using detail::FitConstraints;
using detail::FitObjective;
using detail::FitTarget;
using detail::Placement;
using detail::ProjectedFit;
using detail::Shape;

// Lengths of the curve that the curvature bound may reach over.
constexpr double kLongestRange = 500;
// A fit has converged if one more Gauss–Newton step would move the curve by less than this (root mean square,
// lengths).
constexpr double kConvergedMovement = 1e-8;
// The guess by count takes the place of that by length where its value is below this part of the other's.
constexpr double kFarBetter = 1e-2;
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

struct Residuals {
  double value = 0;     ///< ∫ |γ − r|² dσ
  double tangents = 0;  ///< 1 − mean of the product of the unit tangents
};

Residuals residualsOf(const Elastica& elastica, const FitTarget& target) {
  std::vector<double> s(target.size());
  std::vector<Elastica::State> states(target.size());
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = (target.s[i] + 0.5) * elastica.length();
  elastica.at(s, states);
  Residuals out;
  double product = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    out.value += target.weight[i] *
                 ((states[i].point - target.centre) / target.length - target.point[i]).squaredNorm();
    product += target.weight[i] * detail::direction(states[i].angle).dot(target.tangent[i]);
  }
  out.tangents = 1 - product;
  return out;
}

// R4 of the fit as a product of powers of the residuals of the guess, by least squares of the logarithms over
// 6000 random curves (randomCurves in tests/support, seed 20261121), and the factors between which nine in
// ten of them lie.
FitForecast forecastFrom(const detail::AffineCurvature& law, double R4initial) {
  const double R4 =
      0.0721 * std::pow(R4initial, 0.2467) * std::pow(law.R1, 0.5739) * std::pow(law.R2, 0.4116);
  return {R4, 0.459 * R4, 1.912 * R4};
}

// The sentence for conditions that contradict each other.
std::string describeConflict(const std::vector<std::string>& names, const char* worst) {
  const auto words = [](const std::string& name) -> std::string {
    if (name == "length") return "the length";
    if (name == "endpoints") return "the end points";
    if (name == "tangents") return "the end tangents";
    if (name == "max_curvature") return "the bound on the curvature";
    if (name == "max_periods") return "the bound on the periods";
    if (name == "max_inflections") return "the bound on the inflections";
    return "the absence of self-intersections";
  };
  if (names.empty()) {
    return std::string("No elastica was found that meets all conditions together; the hardest to meet was ") +
           worst + ". Release one of them.";
  }
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + words(names[i]);
  if (names.size() == 1) {
    return "No elastica near the curve meets " + list + "; release it.";
  }
  return "No elastica was found that meets " + list + " together; release one of them.";
}

}  // namespace

const char* fitStatusName(FitStatus status) {
  switch (status) {
    case FitStatus::converged:
      return "converged";
    case FitStatus::iterationLimit:
      return "iteration-limit";
    case FitStatus::constraintsActive:
      return "bound-active";
    case FitStatus::infeasible:
      return "infeasible";
  }
  return "";
}

Result<FitResult> fitElastica(const PlanarCurve& curve, const FitOptions& options) {
  if (options.length == FitOptions::Length::given &&
      !(options.givenLength > 0 && std::isfinite(options.givenLength))) {
    return badOption("given length", options.givenLength, "give a length above 0 mm", 0);
  }
  if (options.maxCurvature && !(*options.maxCurvature > 0 && std::isfinite(*options.maxCurvature))) {
    return badOption("largest curvature", *options.maxCurvature, "give a curvature above 0 (1/mm), or none",
                     0);
  }
  if (options.maxPeriods && !(*options.maxPeriods > 0 && std::isfinite(*options.maxPeriods))) {
    return badOption("largest number of periods", *options.maxPeriods, "give a number above 0, or none", 0);
  }
  if (!(options.lengthTolerance >= 0) || !std::isfinite(options.lengthTolerance)) {
    return badOption("tolerance of the length", options.lengthTolerance, "give 0 mm or more", 0);
  }
  if (options.curvatureRange && !(*options.curvatureRange > 0 && std::isfinite(*options.curvatureRange))) {
    return badOption("range of the curvature bound", *options.curvatureRange,
                     "give a length above 0 mm, or none", 0);
  }
  if (options.maxInflections && *options.maxInflections < 0) {
    return badOption("largest number of inflections", *options.maxInflections, "give 0 or more, or none", 0);
  }
  const auto begin = std::chrono::steady_clock::now();
  const FitTarget full(curve);
  std::optional<FitTarget> thinned;
  if (full.size() > detail::kManyNodes && !options.initial) thinned.emplace(curve, detail::kCoarseNodes);
  const FitTarget& coarse = thinned ? *thinned : full;
  if (options.curvatureRange && *options.curvatureRange > kLongestRange * full.length)
    return badOption("range of the curvature bound", *options.curvatureRange,
                     "give at most " + shortText(kLongestRange) + " times the length of the curve",
                     kLongestRange * full.length);

  FitConstraints constraints;
  if (options.length == FitOptions::Length::exact) constraints.length = 1;
  if (options.length == FitOptions::Length::given) constraints.length = options.givenLength / full.length;
  if (constraints.length) constraints.lengthTolerance = options.lengthTolerance / full.length;
  constraints.endpoints = options.endpoints;
  constraints.tangents = options.tangents;
  if (options.maxCurvature) constraints.maxCurvature = *options.maxCurvature * full.length;
  if (options.curvatureRange) constraints.curvatureRange = *options.curvatureRange / full.length;
  constraints.maxPeriods = options.maxPeriods;
  const detail::FitDemands demands{options.simple, options.maxInflections};
  const FitOptions::Norm norm = options.norm;
  const FitObjective objective{
      norm, constraints.lengthTolerance > 0 ? std::optional<double>() : constraints.length};

  // The canonical guess and its residuals.
  FitResult result;
  const detail::AffineCurvature law = detail::fitAffineCurvature(full);
  result.R1 = law.R1;
  result.R2 = law.R2;
  result.R3 = law.R3;
  std::vector<Shape> starts;
  double initialValue = 0;
  if (options.initial) {
    result.initial = *options.initial;
    const Residuals residuals = residualsOf(result.initial, full);
    result.R3star = residuals.tangents;
    initialValue = residuals.value;
    starts.push_back(detail::toPlacement(*options.initial, full).shape);
  } else {
    const detail::LengthGuess guess = detail::guessByLength(coarse, law);
    const Elastica byLength =
        detail::toElastica(guess.placement, coarse).value_or(detail::straightGuess(coarse));
    const Residuals lengthResiduals = residualsOf(byLength, full);
    result.R3star = thinned ? lengthResiduals.tangents : guess.R3star;
    result.initial = byLength;
    initialValue = lengthResiduals.value;
    result.forecast = forecastFrom(law, std::sqrt(lengthResiduals.value));
    starts.push_back(guess.placement.shape);
    // On short, nearly straight pieces the tangents hardly tell the place: counting does.
    if (const std::optional<Placement> counted = detail::guessByCount(full, law)) {
      const std::optional<Elastica> byCount = detail::toElastica(*counted, full);
      const double value = byCount ? residualsOf(*byCount, full).value : 0;
      if (byCount && (options.guess == FitOptions::Guess::count || value < kFarBetter * initialValue)) {
        result.initial = *byCount;
        initialValue = value;
        starts.push_back(counted->shape);
      }
    }
    starts.push_back(detail::shapeFromLaw(coarse, law));
    starts.push_back(detail::shapeFromAngles(coarse));
  }
  result.R4initial = std::sqrt(initialValue);

  // Descend without end conditions and bounds.
  const std::optional<detail::FreeFitResult> best =
      options.initial ? detail::freeFit(full, full, objective, starts, false)
                      : detail::freeFit(full, coarse, objective, starts, true);
  detail::FreeFitResult chosen;
  if (best) {
    chosen = *best;
  } else {
    chosen.placement = detail::toPlacement(result.initial, full);
  }

  // End conditions, and bounds and demands that the free fit breaks.
  bool infeasible = false;
  bool boundActive = false;
  const char* worst = "";
  std::vector<double> peaks;
  FitConstraints held = constraints;
  std::optional<Elastica> taut;
  const detail::FitSearch search(full, norm);
  if (constraints.endpoints || constraints.tangents ||
      (constraints.bounds() &&
       ConstrainedFit(full, constraints, norm).violation(chosen.placement) > detail::kFeasible) ||
      (demands.any() && !search.meets(chosen.placement, demands))) {
    detail::FitStarts from;
    from.freeValue = chosen.value;
    from.warm = options.initial.has_value();
    if (options.initial) from.places.push_back(detail::toPlacement(*options.initial, full));
    from.blade = options.initial;
    from.places.push_back(chosen.placement);
    if (chosen.converged) {
      from.free.emplace();
      from.free->placement = chosen.placement;
      from.free->value = chosen.value;
      from.free->feasible = from.free->converged = true;
    }
    ProjectedFit projected(full, objective);
    starts.push_back({coarse.endAngle - coarse.startAngle, 0, 0});
    starts.push_back({0, 0, 0});
    for (const Shape& shape : starts) {
      if (const auto placed = projected.place(shape)) from.places.push_back(placed->placement);
    }
    const detail::ConditionedFit found =
        detail::fitUnderEndConditions(full, coarse, constraints, demands, norm, from);
    const int iterations = chosen.iterations + found.iterations;
    if (found.best) {
      chosen = {found.best->placement, found.best->value, iterations, found.best->converged};
      boundActive = found.best->boundActive;
      peaks = found.best->peaks;
      held = found.constraints;
      taut = found.best->taut;
    } else {
      infeasible = true;
      worst = found.worst;
      chosen.iterations = iterations;
      result.conflict = search.conflict(constraints, demands, from.places);
    }
  }

  const std::optional<Elastica> answer = taut ? taut : detail::toElastica(chosen.placement, full);
  if (!answer)
    return fail(ErrorCode::noSolution,
                "The best curve that was found is beyond the numbers of an elastica; look for a slip in the "
                "curve, or smooth it.",
                "curve");
  result.elastica = *answer;
  ConstrainedFit last(full, held, norm);
  detail::Stationarity end{chosen.value, 0, 0};
  if (!taut) end = last.stationarity(detail::toPlacement(result.elastica, full), peaks);
  // Where the conditions leave nothing to vary, only they can be missed.
  if (!infeasible && constraints.clamped() && constraints.lengthTolerance == 0)
    end.gradient = end.movement = 0;
  if (!infeasible && !taut && (!chosen.converged || !(end.movement <= kConvergedMovement))) {
    // The descent in three unknowns stalls where the shape hardly matters; all seven go on from there.
    const ConstrainedFit::Solution finished = last.solve(chosen.placement);
    chosen.iterations += finished.iterations;
    const std::optional<Elastica> elastica = detail::toElastica(finished.placement, full);
    if (finished.feasible && elastica && finished.value <= chosen.value * (1 + 1e-12)) {
      const detail::Stationarity there =
          last.stationarity(detail::toPlacement(*elastica, full), finished.peaks);
      if (finished.converged && (!chosen.converged || there.movement < end.movement)) {
        chosen.converged = true;
        result.elastica = *elastica;
        end = there;
      }
    }
  }
  result.iterations = chosen.iterations;
  result.gradientNorm = end.gradient;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.R4 = std::sqrt(norm != FitOptions::Norm::L2 ? residualsOf(result.elastica, full).value : end.value);
  result.hausdorff = detail::oneSidedHausdorff(result.elastica, curve);
  const char* missed = "";
  result.violation = detail::largestMiss(result.elastica, full, constraints, missed);
  const std::string carried =
      " (of its length, or rad): near a line with sharp bends the numbers of an elastica do not carry "
      "more digits.";
  if (infeasible) {
    result.status = FitStatus::infeasible;
    result.message = describeConflict(result.conflict, worst);
  } else if (!chosen.converged) {
    result.status = FitStatus::iterationLimit;
    result.message = "The descent stopped after " + std::to_string(result.iterations) +
                     " iterations before it came to rest; the curve returned is the best so far.";
  } else if (result.violation > kHolds) {
    result.status = FitStatus::iterationLimit;
    result.message =
        "The curve misses " + std::string(missed) + " by " + shortText(result.violation) + carried;
  } else if (demands.any() && !search.meets(result.elastica, demands)) {
    result.status = FitStatus::iterationLimit;
    result.message =
        "The curve meets itself or has more inflections than asked for, by rounding; loosen the other "
        "conditions.";
  } else if (!(end.movement <= kConvergedMovement)) {
    result.status = FitStatus::iterationLimit;
    result.message = "The best curve is not met more exactly than " + shortText(end.movement) + carried;
  } else {
    result.status = boundActive ? FitStatus::constraintsActive : FitStatus::converged;
    if (boundActive)
      result.message = "A bound holds the curve back: on its curvature, length, periods or shape.";
    if (result.violation > kNoted)
      result.message =
          "The curve misses " + std::string(missed) + " by " + shortText(result.violation) + carried;
  }
  return result;
}

FitForecast forecastFit(const PlanarCurve& curve) {
  const FitTarget target(curve);
  const detail::AffineCurvature law = detail::fitAffineCurvature(target);
  const detail::LengthGuess guess = detail::guessByLength(target, law);
  const Elastica initial =
      detail::toElastica(guess.placement, target).value_or(detail::straightGuess(target));
  return forecastFrom(law, std::sqrt(residualsOf(initial, target).value));
}

}  // namespace bw
