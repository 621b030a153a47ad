// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/fit_clamped.h"
#include "fit/fit_constrained.h"
#include "fit/shape_atlas.h"

namespace bw::detail {

/// Demands that are met by holding one of several bounds (docs/mathematics.md, 7.6).
struct FitDemands {
  bool simple = false;
  std::optional<int> maxInflections;
  bool any() const { return simple || maxInflections; }
};

/// What became of a fit under conditions.
struct ConditionedFit {
  std::optional<ConstrainedFit::Solution> best;
  FitConstraints constraints;  ///< those that the best one was found under
  int iterations = 0;
  const char* worst = "";  ///< if there is no solution: the condition that was hardest to meet
};

/// The fits under conditions of one target.
class FitSearch {
 public:
  FitSearch(const FitTarget& target, FitNorm norm) : target_(target), norm_(norm) {}

  /// Descends from one start after the other until a minimum is met for the second time, or is good: a value
  /// up to `enough`. With `first`, the first minimum is taken.
  ConditionedFit conditioned(const FitConstraints& constraints, const std::vector<Placement>& starts,
                             double enough, bool first) const;

  /// Rough descents from places that may be worth it, in turn. Adds new ends to those that are known, the
  /// lowest first.
  void scout(const FitConstraints& constraints, const std::vector<AtlasPlace>& starts,
             std::vector<ConstrainedFit::Solution>& ends) const;

  /// True if the numbers at the middle of a curve hardly carry its ends.
  static bool taut(const Elastica& elastica);

  /// True if a curve meets the demands.
  bool meets(const Elastica& elastica, const FitDemands& demands) const;
  bool meets(const Placement& placement, const FitDemands& demands) const;
  bool meets(const ConstrainedFit::Solution& solution, const FitDemands& demands) const;

  /// From a curve that meets the conditions but not the demands to the best one that meets both.
  ConditionedFit demanded(const FitConstraints& constraints, const FitDemands& demands,
                          const std::vector<Placement>& starts, double enough) const;
  /// The same from one that is known and breaks the demands. The simplest starts come last.
  ConditionedFit demanded(const ConditionedFit& breaking, const FitDemands& demands,
                          const std::vector<Placement>& starts, double enough) const;

  /// From a start that can be led onto the conditions to a curve that meets the demands. Nothing if there is
  /// none or its seven numbers do not carry it (strong tension).
  ConditionedFit near(const FitConstraints& constraints, const FitDemands& demands,
                      const Placement& start) const;
  /// The first of some blades between the ends, exactly if it is taut, that meets bounds and demands.
  ConditionedFit nearest(const FitConstraints& constraints, const FitDemands& demands,
                         const std::vector<ClampedBlade>& blades) const;

  /// Of conditions and demands that contradict each other, a part of which none can be left out.
  std::vector<std::string> conflict(const FitConstraints& constraints, const FitDemands& demands,
                                    const std::vector<Placement>& starts) const;

 private:
  std::vector<FitConstraints> variants(const FitConstraints& constraints, const FitDemands& demands,
                                       const Placement& placement) const;

  const FitTarget& target_;
  FitNorm norm_;
};

}  // namespace bw::detail
