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

/// The fit under end conditions (docs/mathematics.md, 7.5): rough descents on `coarse` from the free fit and,
/// if that leads to nothing good, from the atlas; the best is finished on `target`. A curve that meets more
/// conditions also meets fewer: where the result is very poor, the fits with one condition more are starts as
/// well, up to the equilibria of a clamped blade with the length of the target. 0.3 to 3 ms, some tens if
/// very poor or taut.
ConditionedFit fitUnderEndConditions(const FitTarget& target, const FitTarget& coarse,
                                     const FitConstraints& constraints, const FitDemands& demands,
                                     FitNorm norm, const FitStarts& starts);

}  // namespace bw::detail
