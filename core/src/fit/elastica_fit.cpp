// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "bw/core/number_text.h"
#include "fit/fit_constrained.h"
#include "fit/fit_distance.h"
#include "fit/fit_guess.h"
#include "fit/fit_projection.h"
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

// A first result at least this good is taken; a worse one is compared with descents from an arc and a line,
// and a poor one with two S-shapes besides. In lengths (R4). Chosen on 1900 random curves: none better
// than 6.4e-3 was ever improved by another start.
constexpr double kGood = 5e-3;
constexpr double kPoor = 2e-2;
// End conditions and bounds may make the fit worse by this factor (R4) before other starts are tried.
constexpr double kMuchWorse = 4;
// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
constexpr std::size_t kManyNodes = 128;
constexpr int kCoarseNodes = 32;
// A fit has converged if one more Gauss–Newton step would move the curve by less than this (root mean square,
// lengths).
constexpr double kConvergedMovement = 1e-8;
// Conditions hold if the returned curve misses them by no more than this (lengths, rad).
constexpr double kHolds = 1e-9;

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
  FreeFit(const FitTarget& target, const FitObjective& objective) : projected_(target, objective) {}

  // Starts by how near they are to the target.
  std::vector<Shape> sorted(const std::vector<Shape>& starts) const {
    std::vector<std::pair<double, Shape>> order;
    for (const Shape& shape : starts) {
      const std::optional<double> value = projected_.roughValue(shape);
      if (value) order.emplace_back(*value, shape);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Shape> out;
    for (const auto& [value, shape] : order) out.push_back(shape);
    return out;
  }

  // Descends from a start and keeps the result if it is better than the best so far.
  void attempt(const Shape& start) {
    const auto solution = projected_.solve(start, best_ ? &best_->placed : nullptr);
    if (!solution) return;
    iterations_ += solution->iterations;
    if (!best_ || solution->placed.value < best_->placed.value * (1 - 1e-9)) best_ = solution;
  }

  bool worseThan(double R4) const { return !best_ || best_->placed.value > R4 * R4; }

  std::optional<Candidate> best() const {
    if (!best_) return std::nullopt;
    return Candidate{best_->placed.placement, best_->placed.value, iterations_, !best_->limit};
  }

 private:
  ProjectedFit projected_;
  std::optional<ProjectedFit::Solution> best_;
  int iterations_ = 0;
};

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

// By how much a curve misses the conditions (lengths of the target, rad; bounds: relatively), judged from its
// own seven numbers.
double largestViolation(const Elastica& elastica, const FitTarget& target, const FitConstraints& constraints,
                        std::string& name) {
  double largest = 0;
  const auto offer = [&](double miss, const char* what) {
    if (miss <= largest) return;
    largest = miss;
    name = what;
  };
  if (constraints.length) {
    offer(std::abs(elastica.length() / target.length - *constraints.length), "the length");
  }
  if (constraints.endpoints || constraints.tangents) {
    for (const bool atStart : {true, false}) {
      const Elastica::State state = elastica.at(atStart ? 0 : elastica.length());
      if (constraints.endpoints) {
        const Eigen::Vector2d place = (state.point - target.centre) / target.length;
        offer((place - (atStart ? target.start : target.end)).norm(),
              atStart ? "the start point" : "the end point");
      }
      if (constraints.tangents) {
        const double miss = state.angle - (atStart ? target.startAngle : target.endAngle);
        offer(std::abs(std::remainder(miss, 2 * std::numbers::pi)),
              atStart ? "the start tangent" : "the end tangent");
      }
    }
  }
  if (constraints.maxCurvature) {
    offer(elastica.maxCurvature() * target.length / *constraints.maxCurvature - 1, "the curvature bound");
  }
  if (constraints.maxPeriods) {
    if (const std::optional<double> period = elastica.period()) {
      offer(elastica.length() / (*period * *constraints.maxPeriods) - 1, "the number of periods");
    }
  }
  return largest;
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
  if (full.size() > kManyNodes && !options.initial) thinned.emplace(curve, kCoarseNodes);
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
  const double turning = coarse.endAngle - coarse.startAngle;
  if (options.initial) {
    free.attempt(starts.front());
  } else {
    for (const Shape& start : free.sorted(starts)) {
      free.attempt(start);
      if (!free.worseThan(1)) break;
    }
    if (free.worseThan(kGood)) {
      free.attempt({turning, 0, 0});
      free.attempt({0, 0, 0});
    }
    if (free.worseThan(kPoor)) {
      free.attempt({0, -10, 20});
      free.attempt({0, -10, -20});
    }
  }
  std::optional<Candidate> best = free.best();
  if (best && thinned) {
    FreeFit fine(full, objective);
    fine.attempt(best->placement.shape);
    if (const std::optional<Candidate> refined = fine.best()) {
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
  const char* worst = "";
  ConstrainedFit constrained(full, constraints, tangentNorm);
  if (constraints.endpoints || constraints.tangents ||
      (constraints.bounds() && constrained.violation(chosen.placement) > detail::kFeasible)) {
    std::vector<Placement> places;
    if (options.initial) places.push_back(detail::toPlacement(*options.initial, full));
    places.push_back(chosen.placement);
    const double enough = std::max(kGood * kGood, kMuchWorse * kMuchWorse * chosen.value);
    ProjectedFit projected(full, objective);
    starts.push_back({turning, 0, 0});
    starts.push_back({0, 0, 0});
    for (const Shape& shape : starts) {
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
      if (found->converged && (options.initial || found->value < enough)) break;
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
  const detail::Stationarity end = constrained.stationarity(detail::toPlacement(result.elastica, full));
  result.gradientNorm = end.gradient;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.R4 = std::sqrt(tangentNorm ? residualsOf(result.elastica, full).value : end.value);
  result.hausdorff = detail::oneSidedHausdorff(result.elastica, curve);
  std::string missed;
  const double violation = largestViolation(result.elastica, full, constraints, missed);
  if (infeasible) {
    result.status = FitStatus::infeasible;
    result.message =
        std::string("No elastica was found that meets all conditions together; the hardest to meet was ") +
        worst + ". Release one of them; the curve returned is the best without end conditions and bounds.";
  } else if (!chosen.converged) {
    result.status = FitStatus::iterationLimit;
    result.message = "The descent stopped after " + std::to_string(result.iterations) +
                     " iterations before it came to rest; the curve returned is the best so far.";
  } else if (violation > kHolds) {
    result.status = FitStatus::iterationLimit;
    result.message = "The curve misses " + missed + " by " + shortText(violation) +
                     " (of its length, or rad): so near to a line with sharp bends, the seven numbers of an "
                     "elastica do not carry "
                     "more digits.";
  } else if (!(end.movement <= kConvergedMovement)) {
    result.status = FitStatus::iterationLimit;
    result.message = "The best curve is not met more exactly than " + shortText(end.movement) +
                     " of its length: so near to a line with sharp bends, the seven numbers of an elastica "
                     "do not carry more digits.";
  } else {
    result.status = boundActive ? FitStatus::constraintsActive : FitStatus::converged;
    if (boundActive)
      result.message = "A bound on the curvature or the number of periods holds the curve back.";
  }
  return result;
}

}  // namespace bw
