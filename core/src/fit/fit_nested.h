// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_search.h"

namespace bw::detail {

/// A fit without conditions, and places to start from. The simplest ones come last.
struct FitStarts {
  std::vector<Placement> places;
  double freeValue = 0;                          ///< of the objective, without end conditions
  bool warm = false;                             ///< the first place is the only start
  std::optional<Elastica> blade = std::nullopt;  ///< the warm start itself
  std::optional<ConstrainedFit::Solution> free =
      std::nullopt;  ///< the fit without conditions, if it came to rest
};

/// The fit under end conditions (docs/mathematics.md, 7.5). A curve that meets more conditions also meets
/// fewer: where the result is poor, the fits with one condition more are starts as well, up to the
/// equilibria of a clamped blade with the length of the target. From there a descent only gains, so that
/// fewer conditions never fit worse. Without a length, ends and tangents: 0.2 to 0.5 ms, some ms if poor.
ConditionedFit fitUnderEndConditions(const FitTarget& target, const FitConstraints& constraints,
                                     const FitDemands& demands, FitNorm norm, const FitStarts& starts);

}  // namespace bw::detail
