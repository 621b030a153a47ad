// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_clamped.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bw/core/elastica_bvp.h"

namespace bw::detail {
namespace {

// What the boundary value solver takes at most.
constexpr int kMostInflections = 12;
constexpr double kMostTurning = 8 * std::numbers::pi;
// Curvature changes of the target below this (rad a length) are not counted as inflections.
constexpr double kNoBend = 0.1;

int inflectionsOf(const FitTarget& target) {
  int count = 0;
  double before = 0;
  for (const double kappa : target.curvature) {
    if (std::abs(kappa) < kNoBend) continue;
    if (before * kappa < 0) ++count;
    before = kappa;
  }
  return count;
}

}  // namespace

std::vector<Placement> clampedPlacements(const FitTarget& target, const FitConstraints& constraints,
                                         bool tangentNorm) {
  if (!constraints.clamped()) return {};
  const ClampedProblem problem{target.start,    target.end,          target.startAngle,
                               target.endAngle, *constraints.length, std::nullopt};
  ClampedOptions options;
  options.maxInflections = std::clamp(inflectionsOf(target) + 2, options.maxInflections, kMostInflections);
  options.maxTurning = std::min(
      std::max(options.maxTurning, std::abs(target.endAngle - target.startAngle) + 2 * std::numbers::pi),
      kMostTurning);
  const Result<ClampedAnswer> answer = solveAllClamped(problem, options);
  if (!answer) return {};
  ConstrainedFit fit(target, constraints, tangentNorm);
  std::vector<std::pair<double, Placement>> order;
  for (const ClampedSolution& solution : answer->solutions) {
    // The place of a loop between taut stretches hangs on last digits: no descent comes to rest there.
    if (solution.elastica.anchor() && !solution.stable) continue;
    const Placement placement =
        toPlacement(solution.elastica.transformed(0, target.length, target.centre), target);
    double value = 0;
    if (fit.objective(toVector(placement), nullptr, value)) order.emplace_back(value, placement);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Placement> placements;
  for (const auto& [value, placement] : order) placements.push_back(placement);
  return placements;
}

}  // namespace bw::detail
