// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/work_meter.h"
#include "fit/fit_constrained.h"
#include "fit/shape_atlas.h"
#include "fit/start_rules.h"

namespace bw::fit {
namespace {

// A value that is good enough whatever it is.
constexpr double kAnyValue = std::numeric_limits<double>::infinity();
// Two minima are the same if their values differ by less than this part.
constexpr double kSame = 1e-9;
// A blade between its ends is taken as it is above this tension (force times length squared), if it meets the
// conditions to kMet: descents in the numbers at its middle are slow there, and end at a force of 2500.
constexpr double kTautBlade = 250;
constexpr double kMet = 1e-9;
// Under strong tension the seven numbers of an elastica miss its ends by more than this (lengths, rad).
constexpr double kCarried = 1e-6;
// Rounds in which another disjunctive constraint may be violated by meeting the first one.
constexpr int kRounds = 3;

class FitSearch {
 public:
  FitSearch(const FitTarget& target, const FitTarget& coarse, const Disjunctions& disjunctions, FitNorm norm,
            const FitStarts& from)
      : target_(target),
        coarse_(coarse),
        disjunctions_(disjunctions),
        norm_(norm),
        starts_(from),
        enough_(from.warm ? kAnyValue : starts::kBlades.limit(from.free.value)) {}

  ConditionedFit run(const FitConstraints& constraints) {
    ConditionedFit found;
    if (!constraints.equalities() && !constraints.bounds() && starts_.free.converged) {
      // Only disjunctive constraints are violated.
      found.best = starts_.free;
      found.constraints = constraints;
    } else {
      found = solve(constraints);
    }
    if (found.best && disjunctions_.any() && !disjunctions_.metBy(curveOf(*found.best, target_)))
      found = repair(found, disjunctions_);
    if (!found.best) found.conflict = conflict(constraints);
    return found;
  }

 private:
  // Keeps the better one of two fits, and counts the work of both.
  static void keepBetter(ConditionedFit& kept, ConditionedFit other) {
    const int iterations = kept.iterations + other.iterations;
    if (!kept.best || (other.best && other.best->value < kept.best->value * (1 - kSame)))
      kept = std::move(other);
    kept.iterations = iterations;
  }

  // Goes on from a fit under more constraints.
  void goOnFrom(ConditionedFit& kept, const ConditionedFit& more) const {
    if (more.best && (!kept.best || more.best->value < kept.best->value)) {
      const FitConstraints constraints = kept.constraints;
      keepBetter(kept, descend(constraints, {more.best->placement}, kAnyValue));
      // From a taut curve a descent hardly gets on.
      if (more.best->taut) keepBetter(kept, descend(constraints, slackBlades_, 0));
      ConditionedFit same = more;
      same.iterations = 0;
      same.best->converged = false;
      keepBetter(kept, same);
      kept.constraints = constraints;
    }
    kept.iterations += more.iterations;
  }

  // The nearest equilibrium of a clamped blade.
  ConditionedFit clamped(const FitConstraints& constraints) {
    if (clamped_) return *clamped_;
    ConditionedFit found;
    if (starts_.warm)
      found = firstFeasible(constraints, {{*starts_.warm, objectiveOf(*starts_.warm, target_, norm_)}});
    // Hardly any freedom is left: what lies near is good, or all there is is looked at.
    if (!found.best) keepBetter(found, descendOnce(constraints, starts_.places.front()));
    if (!found.best || found.best->value > enough_) {
      const std::vector<ClampedBlade> blades = clampedBlades(target_, constraints, norm_);
      keepBetter(found, firstFeasible(constraints, blades));
      for (const ClampedBlade& blade : blades) {
        if (slackBlades_.size() < starts::kSlackBlades && !taut(blade.elastica))
          slackBlades_.push_back(toPlacement(blade.elastica, target_));
      }
    }
    clamped_ = found;
    clamped_->iterations = 0;  // counted once
    return found;
  }

  // The best fit but for disjunctive constraints.
  ConditionedFit solve(const FitConstraints& constraints) {
    ConditionedFit found;
    if (constraints.clamped()) found = clamped(constraints);
    if (found.best) return found;
    if (constraints.clamped() || constraints.bounds() || starts_.warm) {
      keepBetter(found, descend(constraints, starts_.places, enough_));
      found.constraints = constraints;
      return found;
    }
    fromEnds(found, scouted(constraints), constraints);
    if (!found.best) keepBetter(found, descend(constraints, starts_.places, enough_));
    found.constraints = constraints;
    if (found.best && found.best->converged &&
        found.best->value <= starts::kMoreConstraints.limit(starts_.free.value) &&
        halfPeriodsOf(found.best->placement.shape) <= target_.inflections() + starts::kMoreWaves)
      return found;
    FitConstraints more = constraints;
    more.endpoints = more.tangents = true;
    if (!constraints.endpoints || !constraints.tangents) goOnFrom(found, solve(more));
    more = constraints;
    more.length = 1;
    if (!constraints.length) goOnFrom(found, solve(more));
    return found;
  }

  // Where rough descents end, the lowest first: from the free fit and, if that is poor, from the atlas.
  std::vector<FitSolution> scouted(const FitConstraints& constraints) const {
    const StartRule& atlas =
        constraints.endpoints && constraints.tangents ? starts::kHeldAtlasOfBoth : starts::kHeldAtlas;
    std::vector<FitSolution> ends;
    scout(constraints, {{starts_.places.front(), 0, 0, true}}, ends);
    if (ends.empty() || !ends.front().converged || ends.front().value > atlas.limit(starts_.free.value))
      scout(constraints, placesFromAtlas(coarse_, constraints, atlas.most), ends);
    return ends;
  }

  // Goes on from the lowest of some ends, and from others that are hardly higher if it does not come to rest.
  void fromEnds(ConditionedFit& found, const std::vector<FitSolution>& ends,
                const FitConstraints& constraints) const {
    for (const FitSolution& end : ends) {
      const double hardlyWorse = found.best ? (1 + starts::kHardlyWorse) * found.best->value : kAnyValue;
      if (found.best && (found.best->converged || end.value > hardlyWorse)) break;
      ConditionedFit fit = descend(constraints, {end.placement}, kAnyValue);
      if (fit.best && fit.best->converged && fit.best->value <= hardlyWorse) found.best.reset();
      keepBetter(found, std::move(fit));
    }
  }

  // Descends from one start after the other until a minimum is met for the second time, or is good: a value
  // below `enough`.
  ConditionedFit descend(const FitConstraints& constraints, const std::vector<Placement>& starts,
                         double enough) const {
    ConstrainedFit fit(target_, constraints, norm_);
    ConditionedFit out;
    out.constraints = constraints;
    double least = kAnyValue;
    for (const Placement& start : starts) {
      if (detail::workExhausted()) break;
      const FitSolution solution = fit.solve(start);
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
      if (again || (out.best->converged && out.best->value < enough)) break;
    }
    return out;
  }

  // Rough descents from places that may be worth it, in turn. Adds new ends to those that are known, the
  // lowest first.
  void scout(const FitConstraints& constraints, const std::vector<AtlasPlace>& starts,
             std::vector<FitSolution>& ends) const {
    ConstrainedFit fit(coarse_, constraints, norm_);
    for (const AtlasPlace& start : starts) {
      if (detail::workExhausted()) break;
      if (!ends.empty() && hopeless(start, ends.front().value)) continue;
      const FitSolution end = fit.scout(start.placement, ends);
      if (!end.feasible) continue;
      ends.insert(
          std::upper_bound(ends.begin(), ends.end(), end,
                           [](const FitSolution& a, const FitSolution& b) { return a.value < b.value; }),
          end);
    }
  }

  // True if the numbers at the middle of a curve hardly carry its ends.
  static bool taut(const Elastica& elastica) {
    return elastica.force().norm() * elastica.length() * elastica.length() > kTautBlade;
  }

  // From a fit that violates the disjunctive constraints to the best one that meets them as well.
  ConditionedFit repair(const ConditionedFit& violating, const Disjunctions& disjunctions) const {
    const std::vector<Placement>& places = starts_.places;
    ConditionedFit met;
    met.iterations = violating.iterations;
    met.worst = disjunctions.simple ? kLoops : kStartSign;
    for (const std::size_t count : {std::min(places.size(), starts::kSimplestPlaces), places.size()}) {
      std::vector<std::pair<FitConstraints, Placement>> open{
          {violating.constraints, violating.best->placement}};
      for (int round = 0; round < kRounds && !open.empty() && !met.best && !detail::workExhausted();
           ++round) {
        std::vector<std::pair<FitConstraints, Placement>> next;
        for (const auto& [base, placement] : open) {
          const std::optional<Elastica> curve = toElastica(placement, target_);
          if (!curve) continue;
          for (const FitConstraints& disjunct : disjunctions.disjuncts(base, *curve)) {
            std::vector<Placement> from{placement};
            from.insert(from.end(), places.end() - static_cast<std::ptrdiff_t>(count), places.end());
            const ConditionedFit fit = descend(disjunct, from, kAnyValue);
            met.iterations += fit.iterations;
            if (!fit.best) continue;
            if (!disjunctions.metBy(curveOf(*fit.best, target_))) {
              next.emplace_back(disjunct, fit.best->placement);
            } else if (!met.best || fit.best->value < met.best->value) {
              met.best = fit.best;
              met.constraints = fit.constraints;
            }
          }
        }
        open = std::move(next);
      }
      if (met.best || count == places.size()) break;
    }
    return met;
  }

  // From a start that can be led onto the constraints to a curve that meets all. Nothing if there is none or
  // its seven numbers do not carry it (strong tension).
  ConditionedFit descendOnce(const FitConstraints& constraints, const Placement& start) const {
    ConditionedFit out;
    out.constraints = constraints;
    const FitSolution solution = ConstrainedFit(target_, constraints, norm_).solve(start);
    out.iterations = solution.iterations;
    const std::optional<Elastica> elastica = toElastica(solution.placement, target_);
    if (solution.feasible && solution.converged && disjunctions_.metBy(elastica) &&
        largestMiss(*elastica, target_, constraints).size <= kCarried)
      out.best = solution;
    return out;
  }

  // The first of some blades between the ends, exactly if it is taut, that meets all constraints.
  ConditionedFit firstFeasible(const FitConstraints& constraints,
                               const std::vector<ClampedBlade>& blades) const {
    ConditionedFit out;
    out.constraints = constraints;
    for (const auto& [elastica, value] : blades) {
      const Placement placement = toPlacement(elastica, target_);
      if (!taut(elastica)) {
        ConditionedFit fit = descendOnce(constraints, placement);
        out.iterations += fit.iterations;
        if (fit.best) out.best = fit.best;
      } else if (largestMiss(elastica, target_, constraints).size <= kMet && disjunctions_.metBy(elastica)) {
        FitSolution& exact = out.best.emplace();
        exact.placement = placement;
        exact.value = value;
        exact.feasible = exact.converged = true;
        exact.taut = elastica;
      }
      if (out.best) break;
    }
    return out;
  }

  // Of constraints that contradict each other, a part of which none can be left out.
  std::vector<std::string> conflict(const FitConstraints& constraints) const {
    struct Member {
      const char* name;
      bool there;
      void (*leaveOut)(FitConstraints&, Disjunctions&);
    };
    const Member members[] = {
        {"simple", disjunctions_.simple, [](FitConstraints&, Disjunctions& d) { d.simple = false; }},
        {"max_inflections", disjunctions_.maxInflections.has_value(),
         [](FitConstraints&, Disjunctions& d) { d.maxInflections.reset(); }},
        {"max_periods", constraints.maxPeriods.has_value(),
         [](FitConstraints& c, Disjunctions&) { c.maxPeriods.reset(); }},
        {"max_curvature", constraints.maxCurvature.has_value(),
         [](FitConstraints& c, Disjunctions&) { c.maxCurvature.reset(); }},
        {"tangents", constraints.tangents, [](FitConstraints& c, Disjunctions&) { c.tangents = false; }},
        {"endpoints", constraints.endpoints, [](FitConstraints& c, Disjunctions&) { c.endpoints = false; }},
        {"length", constraints.length.has_value(),
         [](FitConstraints& c, Disjunctions&) { c.length.reset(); }},
    };
    // Leave out one after the other what is not needed for the contradiction.
    FitConstraints kept = constraints;
    Disjunctions keptDisjunctions = disjunctions_;
    std::vector<std::string> names;
    for (const Member& member : members) {
      if (!member.there) continue;
      FitConstraints trial = kept;
      Disjunctions trialDisjunctions = keptDisjunctions;
      member.leaveOut(trial, trialDisjunctions);
      ConditionedFit fit = descend(trial, starts_.places, kAnyValue);
      if (fit.best && !trialDisjunctions.metBy(curveOf(*fit.best, target_)))
        fit = repair(fit, trialDisjunctions);
      // Not to have found one any more means nothing.
      if (!fit.best && detail::workExhausted()) return {};
      if (fit.best) {
        names.emplace_back(member.name);
      } else {
        kept = trial;
        keptDisjunctions = trialDisjunctions;
      }
    }
    std::reverse(names.begin(), names.end());
    return names;
  }

  const FitTarget& target_;
  const FitTarget& coarse_;
  const Disjunctions& disjunctions_;
  FitNorm norm_;
  const FitStarts& starts_;
  double enough_;                          ///< a value that needs no other starts
  std::vector<Placement> slackBlades_;     ///< the nearest clamped blades that are not taut
  std::optional<ConditionedFit> clamped_;  ///< under ends, tangents and length; one length a run
};

}  // namespace

ConditionedFit fitUnderConstraints(const FitTarget& target, const FitTarget& coarse,
                                   const FitConstraints& constraints, const Disjunctions& disjunctions,
                                   FitNorm norm, const FitStarts& starts) {
  return FitSearch(target, coarse, disjunctions, norm, starts).run(constraints);
}

}  // namespace bw::fit
