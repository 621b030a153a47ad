// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "bw/core/number_text.h"
#include "fit_constrained.h"
#include "fit_distance.h"
#include "fit_guess.h"
#include "fit_projection.h"
#include "fit_target.h"

namespace bw {
namespace {

using detail::ConstrainedFit;
using detail::FitConstraints;
using detail::FitObjective;
using detail::FitTarget;
using detail::Placement;
using detail::ProjectedFit;
using detail::Shape;

// A first result at least this good is taken; a worse one is compared with descents from other starts. In
// lengths (R4).
constexpr double kGood = 3e-3;
// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
constexpr std::size_t kManyNodes = 128;
constexpr int kCoarseNodes = 32;
// A fit has converged if one more Gauss–Newton step would move the curve by less than this (root mean square,
// lengths).
constexpr double kConvergedMovement = 1e-8;

tl::unexpected<Error> badOption(const char* name, double value, const char* remedy, double limit) {
  return fail(ErrorCode::badInput,
              std::string("The option ") + name + " of the fit is " +
                  (std::isfinite(value) ? shortText(value, 6) : std::string("not a finite number")) + "; " +
                  remedy + ".",
              name, value, limit);
}

struct Candidate {
  Placement placement;
  double value = 0;  ///< of the objective
  int iterations = 0;
  bool converged = false;
};

// Fits without end conditions and bounds: three unknowns.
class FreeFit {
 public:
  FreeFit(const FitTarget& target, const FitObjective& objective)
      : target_(target), projected_(target, objective) {}

  // The best of the descents from `starts`; stops after the first if that is good.
  std::optional<Candidate> fromSeveral(std::vector<Shape> starts, bool all) {
    // The nearest start first.
    std::vector<std::pair<double, Shape>> order;
    for (const Shape& shape : starts) {
      const auto placed = projected_.place(shape);
      if (placed) order.emplace_back(placed->value, shape);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::optional<Candidate> best;
    int iterations = 0;
    for (const auto& [value, shape] : order) {
      const std::optional<Candidate> found = from(shape);
      if (!found) continue;
      iterations += found->iterations;
      if (!best || found->value < best->value * (1 - 1e-9)) best = found;
      if (!all && best->value < kGood * kGood) break;
    }
    if (best) best->iterations = iterations;
    return best;
  }

  std::optional<Candidate> from(const Shape& shape) {
    const auto solution = projected_.solve(shape);
    if (!solution) return std::nullopt;
    return Candidate{solution->placed.placement, solution->placed.value, solution->iterations,
                     !solution->limit};
  }

 private:
  const FitTarget& target_;
  ProjectedFit projected_;
};

// Starts that do not come from the curvature: for targets far from any elastica, where the law of the
// curvature says little.
std::vector<Shape> structuredStarts(const FitTarget& target) {
  const double turning = target.endAngle - target.startAngle;
  const double full = 2 * 3.14159265358979323846;
  return {
      {turning, 0, 0}, {turning - full, 0, 0}, {turning + full, 0, 0}, {0, -20, 20},
      {0, -20, -20},   {turning, -15, 0},      {turning, 15, 0},
  };
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
  const auto begin = std::chrono::steady_clock::now();
  const FitTarget full(curve);
  std::optional<FitTarget> thinned;
  if (full.size() > kManyNodes) thinned.emplace(curve, kCoarseNodes);
  const FitTarget& coarse = thinned ? *thinned : full;

  FitConstraints constraints;
  if (options.length == FitOptions::Length::exact) constraints.length = 1;
  if (options.length == FitOptions::Length::given) constraints.length = options.givenLength / full.length;
  constraints.endpoints = options.endpoints;
  constraints.tangents = options.tangents;
  if (options.maxCurvature) constraints.maxCurvature = *options.maxCurvature * full.length;
  constraints.maxPeriods = options.maxPeriods;
  const bool tangentNorm = options.norm == FitOptions::Norm::H1;
  const FitObjective objective{tangentNorm, constraints.length};

  // The canonical guess and its residuals.
  FitResult result;
  const detail::AffineCurvature law = detail::fitAffineCurvature(full);
  result.R1 = law.R1;
  result.R2 = law.R2;
  result.R3 = law.R3;
  std::vector<Shape> starts;
  if (options.initial) {
    result.initial = *options.initial;
    result.R3star = residualsOf(result.initial, full).tangents;
    starts.push_back(detail::toPlacement(*options.initial, full).shape);
  } else {
    const detail::LengthGuess guess = detail::guessByLength(coarse, law);
    const Elastica byLength = detail::toElastica(guess.placement, coarse);
    result.R3star = thinned ? residualsOf(byLength, full).tangents : guess.R3star;
    result.initial = byLength;
    starts.push_back(guess.placement.shape);
    if (options.guess == FitOptions::Guess::count) {
      if (const std::optional<Placement> counted = detail::guessByCount(full, law)) {
        result.initial = detail::toElastica(*counted, full);
        starts.push_back(counted->shape);
      }
    }
    starts.push_back(detail::shapeFromLaw(coarse, law));
    starts.push_back(detail::shapeFromAngles(coarse));
  }
  result.R4initial = std::sqrt(residualsOf(result.initial, full).value);

  // Descend without end conditions and bounds.
  FreeFit free(coarse, objective);
  std::optional<Candidate> best;
  if (options.initial) {
    best = free.from(starts.front());
  } else {
    best = free.fromSeveral(starts, false);
    if (!best || best->value > kGood * kGood) {
      const std::optional<Candidate> other = free.fromSeveral(structuredStarts(coarse), true);
      if (other && (!best || other->value < best->value * (1 - 1e-9))) {
        const int before = best ? best->iterations : 0;
        best = other;
        best->iterations += before;
      } else if (other) {
        best->iterations += other->iterations;
      }
    }
  }
  if (best && thinned) {
    FreeFit fine(full, objective);
    if (const std::optional<Candidate> refined = fine.from(best->placement.shape)) {
      const int before = best->iterations;
      best = refined;
      best->iterations += before;
    }
  }
  Candidate chosen;
  if (best) {
    chosen = *best;
  } else {
    chosen.placement = detail::toPlacement(result.initial, full);
  }

  // End conditions, and bounds that the free fit breaks.
  bool infeasible = false;
  bool boundActive = false;
  std::string worst;
  ConstrainedFit constrained(full, constraints, tangentNorm);
  if (constraints.endpoints || constraints.tangents ||
      (constraints.bounds() && constrained.violation(chosen.placement) > ConstrainedFit::kFeasible)) {
    std::vector<Placement> places;
    if (options.initial) places.push_back(detail::toPlacement(*options.initial, full));
    places.push_back(chosen.placement);
    ProjectedFit projected(full, objective);
    for (const Shape& shape : starts) {
      if (const auto placed = projected.place(shape)) places.push_back(placed->placement);
    }
    for (const Shape& shape : structuredStarts(full)) {
      if (const auto placed = projected.place(shape)) places.push_back(placed->placement);
    }
    std::optional<ConstrainedFit::Solution> found;
    double leastViolation = 0;
    bool any = false;
    int iterations = chosen.iterations;
    for (const Placement& place : places) {
      const ConstrainedFit::Solution solution = constrained.solve(place);
      iterations += solution.iterations;
      if (!solution.feasible) {
        if (!any || solution.violation < leastViolation) {
          leastViolation = solution.violation;
          worst = solution.worst;
        }
        any = true;
        continue;
      }
      if (!found || solution.value < found->value * (1 - 1e-9)) found = solution;
      if (found->converged && (options.initial || found->value < kGood * kGood)) break;
    }
    if (found) {
      chosen = {found->placement, found->value, iterations, found->converged};
      boundActive = found->boundActive;
    } else {
      infeasible = true;
      chosen.iterations = iterations;
    }
  }

  result.elastica = detail::toElastica(chosen.placement, full);
  result.iterations = chosen.iterations;
  const ConstrainedFit::Stationarity end =
      constrained.stationarity(detail::toPlacement(result.elastica, full));
  result.gradientNorm = end.gradient;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.R4 = std::sqrt(residualsOf(result.elastica, full).value);
  result.hausdorff = detail::oneSidedHausdorff(result.elastica, curve);
  if (infeasible) {
    result.status = FitStatus::infeasible;
    result.message =
        "No elastica was found that meets all conditions together; the hardest to meet was " + worst +
        ". Release one of them; the curve returned is the best without end conditions and bounds.";
  } else if (!chosen.converged || !(end.movement <= kConvergedMovement)) {
    result.status = FitStatus::iterationLimit;
    result.message = "The descent stopped after " + std::to_string(result.iterations) +
                     " iterations before it came to rest; the curve returned is the best so far.";
  } else {
    result.status = boundActive ? FitStatus::constraintsActive : FitStatus::converged;
    if (boundActive)
      result.message = "A bound on the curvature or the number of periods holds the curve back.";
  }
  return result;
}

}  // namespace bw
