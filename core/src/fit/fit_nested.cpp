// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_nested.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "fit/fit_clamped.h"
#include "fit/fit_free.h"
#include "fit/shape_atlas.h"

namespace bw::detail {
namespace {

// End conditions and bounds may make the fit worse by this factor (R4) before other starts are tried.
constexpr double kMuchWorse = 4;
// A fit (R4) better than the first or than the second times the free fit, which is a lower limit, is taken; a
// worse one is compared with so many places of the atlas, held at ends or tangents, or at both. Of 6000
// curves with 1 to 6 inflections, held at both, 3 ended above 1.01 of the best known.
constexpr double kGoodHeld = 1e-3;
constexpr double kWorseHeld = 1.01;
constexpr std::size_t kAtlasPlaces = 12, kAtlasPlacesBoth = 20;
// A fit (R4) worse than the first and than the second times the free fit, one that does not come to rest, or
// one with so many half periods more than the target has inflections is compared with the fits under more
// conditions: a taut blade may lie nearer than small waves.
constexpr double kPoorHeld = 6e-2;
constexpr double kWorse = 1.5;
constexpr int kMoreWaves = 2;
// Of two fits whose values differ by less than this part, the one that comes to rest is taken.
constexpr double kHardlyWorse = 2e-2;
// Where the nearest clamped blade is taut, so many others are starts as well.
constexpr std::size_t kSlackStarts = 2;
// A fit is better than another if its value is lower by more than this part.
constexpr double kSame = 1e-9;

class NestedFit {
 public:
  NestedFit(const FitTarget& target, const FitTarget& coarse, const FitDemands& demands, FitNorm norm,
            const FitStarts& starts)
      : target_(target),
        coarse_(coarse),
        demands_(demands),
        norm_(norm),
        starts_(starts),
        search_(target, norm),
        scouts_(coarse, norm),
        enough_(std::max(kGoodFit * kGoodFit, kMuchWorse * kMuchWorse * starts.freeValue)) {}

  ConditionedFit run(const FitConstraints& constraints) {
    ConditionedFit found;
    if (!constraints.equalities() && !constraints.bounds() && starts_.free) {
      // Only demands are broken.
      found.best = starts_.free;
      found.constraints = constraints;
    } else {
      found = constraints.bounds() ? bounded(constraints) : equalities(constraints);
    }
    if (found.best && demands_.any() && !search_.meets(*found.best, demands_))
      found = search_.demanded(found, demands_, starts_.places, enough_);
    return found;
  }

 private:
  bool worseThan(const ConditionedFit& fit, double R4, double factor) const {
    return !fit.best || fit.best->value > std::max(R4 * R4, factor * factor * starts_.freeValue);
  }

  // Keeps the better one of two fits, and counts the work of both.
  static void keepBetter(ConditionedFit& kept, ConditionedFit other) {
    const int iterations = kept.iterations + other.iterations;
    if (!kept.best || (other.best && other.best->value < kept.best->value * (1 - kSame)))
      kept = std::move(other);
    kept.iterations = iterations;
  }

  // Goes on from a fit under more conditions.
  void goOnFrom(ConditionedFit& kept, const ConditionedFit& more) const {
    if (more.best && (!kept.best || more.best->value < kept.best->value)) {
      const FitConstraints constraints = kept.constraints;
      keepBetter(kept, search_.conditioned(constraints, {more.best->placement}, 0, true));
      // From a taut curve a descent hardly gets on.
      if (more.best->taut) keepBetter(kept, search_.conditioned(constraints, slackBlades_, 0, false));
      ConditionedFit same = more;
      same.iterations = 0;
      same.best->converged = false;
      keepBetter(kept, same);
      kept.constraints = constraints;
    }
    kept.iterations += more.iterations;
  }

  ConditionedFit clamped(const FitConstraints& constraints) {
    if (clamped_) return *clamped_;
    ConditionedFit found;
    if (starts_.blade)
      found = search_.nearest(constraints, demands_,
                              {{*starts_.blade, objectiveOf(*starts_.blade, target_, norm_)}});
    // Hardly any freedom is left: what lies near is good, or all there is is looked at.
    if (!found.best) keepBetter(found, search_.near(constraints, demands_, starts_.places.front()));
    if (!found.best || (!starts_.warm && found.best->value > enough_)) {
      const std::vector<ClampedBlade> blades = clampedBlades(target_, constraints, norm_);
      keepBetter(found, search_.nearest(constraints, demands_, blades));
      for (const ClampedBlade& blade : blades) {
        if (slackBlades_.size() < kSlackStarts && !FitSearch::taut(blade.elastica))
          slackBlades_.push_back(toPlacement(blade.elastica, target_));
      }
    }
    clamped_ = found;
    clamped_->iterations = 0;  // counted once
    return found;
  }

  ConditionedFit equalities(const FitConstraints& constraints) {
    ConditionedFit found;
    if (constraints.clamped()) found = clamped(constraints);
    if (found.best) return found;
    if (constraints.clamped() || starts_.warm) {
      keepBetter(found, search_.conditioned(constraints, starts_.places, enough_, starts_.warm));
      found.constraints = constraints;
      return found;
    }
    fromEnds(found, scouted(constraints), constraints);
    if (!found.best) keepBetter(found, search_.conditioned(constraints, starts_.places, enough_, false));
    found.constraints = constraints;
    if (found.best && found.best->converged && !worseThan(found, kPoorHeld, kWorse) &&
        2 * periodsOf(found.best->placement.shape).count <= target_.inflections() + kMoreWaves)
      return found;
    FitConstraints more = constraints;
    more.endpoints = more.tangents = true;
    if (!constraints.endpoints || !constraints.tangents) goOnFrom(found, equalities(more));
    more = constraints;
    more.length = 1;
    if (!constraints.length) goOnFrom(found, equalities(more));
    return found;
  }

  // Where rough descents end, the lowest first: from the fit without conditions and, if that is poor, from
  // the atlas.
  std::vector<ConstrainedFit::Solution> scouted(const FitConstraints& constraints) const {
    std::vector<ConstrainedFit::Solution> ends;
    scouts_.scout(constraints, {{starts_.places.front(), 0, 0, true}}, ends);
    const double good = std::max(kGoodHeld * kGoodHeld, kWorseHeld * kWorseHeld * starts_.freeValue);
    const bool both = constraints.endpoints && constraints.tangents;
    if (ends.empty() || !ends.front().converged || ends.front().value > good)
      scouts_.scout(constraints,
                    placesFromAtlas(coarse_, constraints, both ? kAtlasPlacesBoth : kAtlasPlaces), ends);
    return ends;
  }

  // Goes on from the lowest of some ends, and from others that are hardly higher if it does not come to rest.
  void fromEnds(ConditionedFit& found, const std::vector<ConstrainedFit::Solution>& ends,
                const FitConstraints& constraints) const {
    for (const ConstrainedFit::Solution& end : ends) {
      if (found.best && (found.best->converged || end.value > (1 + kHardlyWorse) * found.best->value)) break;
      ConditionedFit fit = search_.conditioned(constraints, {end.placement}, 0, true);
      if (found.best && fit.best && fit.best->converged &&
          fit.best->value <= (1 + kHardlyWorse) * found.best->value)
        found.best.reset();
      keepBetter(found, std::move(fit));
    }
  }

  // Bounds hold back the best curve without them.
  ConditionedFit bounded(const FitConstraints& constraints) {
    ConditionedFit found;
    if (constraints.clamped()) found = clamped(constraints);
    if (!found.best)
      keepBetter(found, search_.conditioned(constraints, starts_.places, enough_, starts_.warm));
    return found;
  }

  const FitTarget& target_;
  const FitTarget& coarse_;
  const FitDemands& demands_;
  FitNorm norm_;
  const FitStarts& starts_;
  FitSearch search_, scouts_;
  double enough_;
  std::vector<Placement> slackBlades_;     ///< the nearest clamped blades that are not taut
  std::optional<ConditionedFit> clamped_;  ///< under ends, tangents and length; one length a run
};

}  // namespace

ConditionedFit fitUnderEndConditions(const FitTarget& target, const FitTarget& coarse,
                                     const FitConstraints& constraints, const FitDemands& demands,
                                     FitNorm norm, const FitStarts& starts) {
  return NestedFit(target, coarse, demands, norm, starts).run(constraints);
}

}  // namespace bw::detail
