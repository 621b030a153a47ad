// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/fit_constraints.h"
#include "fit/fit_projection.h"

namespace bw::fit {

/// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
inline constexpr std::size_t kManyNodes = 64;
inline constexpr int kCoarseNodes = 32;

/// The best fit without constraints from some shapes; if `more` is set and the result is poor, also from
/// others (start_rules.h). Done on `coarse` and finished on `full`, if these are not the same. Empty if no
/// start can be placed.
std::optional<FitSolution> freeFit(const FitTarget& full, const FitTarget& coarse,
                                   const FitObjective& objective, const std::vector<Shape>& shapes,
                                   bool more);

/// What a fit under constraints starts from. The simplest places come last.
struct FitStarts {
  std::vector<Placement> places;
  FitSolution free;              ///< the fit without constraints
  std::optional<Elastica> warm;  ///< if set, the first place is its own, and the only start
};

/// What became of a fit under constraints.
struct ConditionedFit {
  std::optional<FitSolution> best;
  FitConstraints constraints;  ///< those that the best one was found under
  int iterations = 0;
  int worst = -1;  ///< if there is no solution: the name of the constraint that was hardest to meet
  std::vector<std::string> conflict =
      {};  ///< then: constraints that contradict each other, all of them needed
};

/// The fit under constraints (docs/mathematics.md, 7.5): under end conditions rough descents on `coarse` from
/// the free fit and, if that leads to nothing good, from the atlas; the best is finished on `target`. A curve
/// that meets more constraints also meets fewer: where the result is very poor, the fits with one constraint
/// more are starts as well, up to the equilibria of a clamped blade with the length of the target. 0.3 to 3
/// ms, some tens if very poor or taut.
ConditionedFit fitUnderConstraints(const FitTarget& target, const FitTarget& coarse,
                                   const FitConstraints& constraints, const Disjunctions& disjunctions,
                                   FitNorm norm, const FitStarts& starts);

}  // namespace bw::fit
