// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_clamped.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw::fit {
namespace {

// What the boundary value solver takes at most.
constexpr int kMostInflections = 12;
constexpr double kMostTurning = 8 * kPi;

}  // namespace

std::vector<ClampedBlade> clampedBlades(const FitTarget& target, const FitConstraints& constraints,
                                        FitNorm norm) {
  if (!constraints.clamped()) return {};
  const ClampedProblem problem{target.start,    target.end,          target.startAngle,
                               target.endAngle, *constraints.length, std::nullopt};
  ClampedOptions options;
  options.maxInflections = std::clamp(target.inflections() + 2, options.maxInflections, kMostInflections);
  options.maxTurning = std::min(
      std::max(options.maxTurning, std::abs(target.endAngle - target.startAngle) + 2 * kPi), kMostTurning);
  const Result<ClampedAnswer> answer = solveAllClamped(problem, options);
  if (!answer) return {};
  std::vector<ClampedBlade> blades;
  for (const ClampedSolution& solution : answer->solutions) {
    // The place of a loop between taut stretches hangs on last digits: no descent comes to rest there.
    if (solution.elastica.anchor() && !solution.stable) continue;
    const Elastica blade = solution.elastica.transformed(0, target.length, target.centre);
    blades.push_back({blade, objectiveOf(blade, target, norm)});
  }
  std::stable_sort(blades.begin(), blades.end(),
                   [](const ClampedBlade& a, const ClampedBlade& b) { return a.value < b.value; });
  return blades;
}

}  // namespace bw::fit
