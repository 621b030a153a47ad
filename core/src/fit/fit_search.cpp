// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::detail {
namespace {

using Eigen::Vector2d;
using Solution = ConstrainedFit::Solution;

// Two minima are the same if their values differ by less than this part.
constexpr double kSame = 1e-9;
// Sides of the polygon in which crossings are looked for.
constexpr int kSides = 240;
// By this part the periods stay below those that have one inflection more.
constexpr double kFewer = 1e-6;
// A blade between its ends is taken as it is above this tension (force times length squared), if it meets the
// conditions to kMet: descents in the numbers at its middle are slow there, and end at a force of 2500.
constexpr double kTautBlade = 250;
constexpr double kMet = 1e-9;
// Under strong tension the seven numbers of an elastica miss its ends by more than this (lengths, rad).
constexpr double kCarried = 1e-6;
// The last so many starts are an arc and a line.
constexpr std::size_t kFewStarts = 2;
// Rounds in which another demand may be broken by meeting the first one.
constexpr int kRounds = 3;

struct Crossing {
  double first = 0, second = 0;  ///< arc lengths over the length, in [−½, ½]
  double side = 1;               ///< of the second strand on which the first one goes on
};

// Where a curve crosses itself, seen on a polygon.
std::vector<Crossing> crossings(const Elastica& elastica) {
  const std::vector<Vector2d> points = elastica.sample(kSides + 1);
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<Crossing> out;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector2d a = points[i + 1] - points[i];
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j) {
      const Vector2d b = points[j + 1] - points[j];
      const double across = cross(a, b);
      if (across == 0) continue;
      const Vector2d gap = points[j] - points[i];
      const double u = cross(gap, b) / across;
      const double w = cross(gap, a) / across;
      if (u < 0 || u > 1 || w < 0 || w > 1) continue;
      out.push_back({(static_cast<double>(i) + u) / kSides - 0.5, (static_cast<double>(j) + w) / kSides - 0.5,
                     cross(b, a) > 0 ? 1.0 : -1.0});
    }
  }
  return out;
}

}  // namespace

ConditionedFit FitSearch::conditioned(const FitConstraints& constraints, const std::vector<Placement>& starts,
                                      double enough, bool first) const {
  ConstrainedFit fit(target_, constraints, norm_);
  ConditionedFit out;
  out.constraints = constraints;
  double least = std::numeric_limits<double>::infinity();
  for (const Placement& start : starts) {
    if (workExhausted()) break;
    const Solution solution = fit.solve(start);
    out.iterations += solution.iterations;
    if (!solution.feasible) {
      if (solution.violation < least) {
        least = solution.violation;
        out.worst = solution.worst;
      }
      continue;
    }
    const bool again = out.best && out.best->converged && solution.converged &&
                       std::abs(solution.value - out.best->value) <= kSame * out.best->value;
    if (!out.best || solution.value < out.best->value * (1 - kSame) ||
        (solution.converged && !out.best->converged && solution.value <= out.best->value * (1 + kSame)))
      out.best = solution;
    if (again || (out.best->converged && (first || out.best->value < enough))) break;
  }
  return out;
}

void FitSearch::scout(const FitConstraints& constraints, const std::vector<AtlasPlace>& starts,
                      std::vector<Solution>& ends) const {
  ConstrainedFit fit(target_, constraints, norm_);
  for (const AtlasPlace& start : starts) {
    if (workExhausted()) break;
    if (!ends.empty() && hopeless(start, ends.front().value)) continue;
    const Solution end = fit.scout(start.placement, ends);
    if (!end.feasible) continue;
    ends.insert(std::upper_bound(ends.begin(), ends.end(), end,
                                 [](const Solution& a, const Solution& b) { return a.value < b.value; }),
                end);
  }
}

bool FitSearch::taut(const Elastica& elastica) {
  return elastica.force().norm() * elastica.length() * elastica.length() > kTautBlade;
}

bool FitSearch::meets(const Elastica& elastica, const FitDemands& demands) const {
  if (demands.simple && elastica.selfIntersects()) return false;
  return !demands.maxInflections ||
         elastica.inflections().size() <= static_cast<std::size_t>(*demands.maxInflections);
}

bool FitSearch::meets(const Placement& placement, const FitDemands& demands) const {
  const std::optional<Elastica> elastica = toElastica(placement, target_);
  return elastica && meets(*elastica, demands);
}

bool FitSearch::meets(const Solution& solution, const FitDemands& demands) const {
  return solution.taut ? meets(*solution.taut, demands) : meets(solution.placement, demands);
}

// The bounds of which any one meets the demand that a curve breaks.
std::vector<FitConstraints> FitSearch::variants(const FitConstraints& constraints, const FitDemands& demands,
                                                const Placement& placement) const {
  const std::optional<Elastica> curve = toElastica(placement, target_);
  if (!curve) return {};
  const Elastica& elastica = *curve;
  std::vector<FitConstraints> out;
  if (demands.maxInflections) {
    const std::vector<double> places = elastica.inflections();
    const auto allowed = static_cast<std::size_t>(*demands.maxInflections);
    // Some of the inflections leave over the start, the others over the end.
    for (std::size_t before = 0; places.size() > allowed && before <= places.size() - allowed; ++before) {
      const std::size_t after = places.size() - allowed - before;
      const double startSign = before % 2 == 0 ? 1 : -1;
      const double endSign = after % 2 == 0 ? 1 : -1;
      FitConstraints variant = constraints;
      if (before > 0) variant.startSign = startSign * (elastica.startCurvature() < 0 ? -1 : 1);
      if (after > 0) variant.endSign = endSign * (elastica.at(elastica.length()).curvature < 0 ? -1 : 1);
      out.push_back(variant);
    }
    if (places.size() > allowed) {
      // Enough for any elastica: fewer half periods than inflections, or none between ends that bend alike.
      FitConstraints variant = constraints;
      const double periods = allowed > 0 ? 0.5 * (1 - kFewer) * static_cast<double>(allowed) : 0.5;
      variant.maxPeriods = std::min(periods, constraints.maxPeriods.value_or(periods));
      if (allowed > 0) out.push_back(variant);
      for (const double sign : {1.0, -1.0}) {
        if (allowed > 0) break;
        variant.startSign = variant.endSign = sign;
        out.push_back(variant);
      }
      return out;
    }
  }
  if (!demands.simple || !elastica.selfIntersects()) return out;
  const std::vector<Crossing> all = crossings(elastica);
  if (!all.empty()) {
    const Crossing& last = *std::max_element(
        all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.first < b.first; });
    const Crossing& earliest = *std::min_element(
        all.begin(), all.end(), [](const Crossing& a, const Crossing& b) { return a.second < b.second; });
    FitConstraints variant = constraints;
    variant.strand = {true, last.second, last.side};
    out.push_back(variant);
    // Seen from the first strand the second one comes from the other side.
    variant.strand = {false, earliest.first, earliest.side};
    out.push_back(variant);
  }
  // Enough for any elastica: loops that do not reach each other, or a turning too small for a loop.
  FitConstraints variant = constraints;
  variant.openLoops = true;
  out.push_back(variant);
  variant = constraints;
  variant.maxTurning = kPi;
  out.push_back(variant);
  return out;
}

ConditionedFit FitSearch::demanded(const FitConstraints& constraints, const FitDemands& demands,
                                   const std::vector<Placement>& starts, double enough) const {
  const ConditionedFit out = conditioned(constraints, starts, enough, false);
  if (!out.best || meets(*out.best, demands)) return out;
  return demanded(out, demands, starts, enough);
}

ConditionedFit FitSearch::demanded(const ConditionedFit& breaking, const FitDemands& demands,
                                   const std::vector<Placement>& starts, double enough) const {
  ConditionedFit met;
  met.iterations = breaking.iterations;
  met.worst = demands.simple ? "the absence of self-intersections" : "the number of inflections";
  // From the curve that breaks the demands and the two simplest starts; from all of them only if these lead
  // nowhere.
  const std::size_t few = std::min(starts.size(), kFewStarts);
  for (const std::size_t count : {few, starts.size()}) {
    std::vector<std::pair<FitConstraints, Placement>> open{{breaking.constraints, breaking.best->placement}};
    for (int round = 0; round < kRounds && !open.empty() && !met.best && !workExhausted(); ++round) {
      std::vector<std::pair<FitConstraints, Placement>> next;
      for (const auto& [base, placement] : open) {
        for (const FitConstraints& variant : variants(base, demands, placement)) {
          std::vector<Placement> from{placement};
          from.insert(from.end(), starts.end() - static_cast<std::ptrdiff_t>(count), starts.end());
          const ConditionedFit fit = conditioned(variant, from, enough, true);
          met.iterations += fit.iterations;
          if (!fit.best) continue;
          if (!meets(fit.best->placement, demands)) {
            next.emplace_back(variant, fit.best->placement);
          } else if (!met.best || fit.best->value < met.best->value) {
            met.best = fit.best;
            met.constraints = fit.constraints;
          }
        }
      }
      open = std::move(next);
    }
    if (met.best || count == starts.size()) break;
  }
  return met;
}

ConditionedFit FitSearch::near(const FitConstraints& constraints, const FitDemands& demands,
                               const Placement& start) const {
  ConditionedFit out;
  out.constraints = constraints;
  const Solution solution = ConstrainedFit(target_, constraints, norm_).solve(start);
  out.iterations = solution.iterations;
  const char* missed = "";
  const std::optional<Elastica> elastica = toElastica(solution.placement, target_);
  if (solution.feasible && solution.converged && elastica && meets(*elastica, demands) &&
      largestMiss(*elastica, target_, constraints, missed) <= kCarried)
    out.best = solution;
  return out;
}

ConditionedFit FitSearch::nearest(const FitConstraints& constraints, const FitDemands& demands,
                                  const std::vector<ClampedBlade>& blades) const {
  ConditionedFit out;
  out.constraints = constraints;
  for (const auto& [elastica, value] : blades) {
    const char* missed = "";
    const Placement placement = toPlacement(elastica, target_);
    if (!taut(elastica)) {
      ConditionedFit fit = near(constraints, demands, placement);
      out.iterations += fit.iterations;
      if (fit.best) out.best = fit.best;
    } else if (largestMiss(elastica, target_, constraints, missed) <= kMet && meets(elastica, demands)) {
      Solution& exact = out.best.emplace();
      exact.placement = placement;
      exact.value = value;
      exact.feasible = exact.converged = true;
      exact.taut = elastica;
    }
    if (out.best) break;
  }
  return out;
}

std::vector<std::string> FitSearch::conflict(const FitConstraints& constraints, const FitDemands& demands,
                                             const std::vector<Placement>& starts) const {
  struct Member {
    const char* name;
    bool there;
    void (*leaveOut)(FitConstraints&, FitDemands&);
  };
  const Member members[] = {
      {"simple", demands.simple, [](FitConstraints&, FitDemands& d) { d.simple = false; }},
      {"max_inflections", demands.maxInflections.has_value(),
       [](FitConstraints&, FitDemands& d) { d.maxInflections.reset(); }},
      {"max_periods", constraints.maxPeriods.has_value(),
       [](FitConstraints& c, FitDemands&) { c.maxPeriods.reset(); }},
      {"max_curvature", constraints.maxCurvature.has_value(),
       [](FitConstraints& c, FitDemands&) { c.maxCurvature.reset(); }},
      {"tangents", constraints.tangents, [](FitConstraints& c, FitDemands&) { c.tangents = false; }},
      {"endpoints", constraints.endpoints, [](FitConstraints& c, FitDemands&) { c.endpoints = false; }},
      {"length", constraints.length.has_value(), [](FitConstraints& c, FitDemands&) { c.length.reset(); }},
  };
  // Leave out one after the other what is not needed for the contradiction.
  FitConstraints kept = constraints;
  FitDemands keptDemands = demands;
  std::vector<std::string> names;
  for (const Member& member : members) {
    if (!member.there) continue;
    FitConstraints trial = kept;
    FitDemands trialDemands = keptDemands;
    member.leaveOut(trial, trialDemands);
    const ConditionedFit fit = demanded(trial, trialDemands, starts, std::numeric_limits<double>::infinity());
    // Not to have found one any more means nothing.
    if (!fit.best && workExhausted()) return {};
    if (fit.best) {
      names.emplace_back(member.name);
    } else {
      kept = trial;
      keptDemands = trialDemands;
    }
  }
  std::reverse(names.begin(), names.end());
  return names;
}

}  // namespace bw::detail
