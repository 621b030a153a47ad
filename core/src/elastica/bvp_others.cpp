// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_others.h"

#include <algorithm>
#include <cmath>

#include "elastica/bvp_describe.h"
#include "elastica/bvp_rest.h"
#include "elastica/bvp_search.h"
#include "elastica/bvp_shapes.h"

namespace bw::detail {

namespace {

/// Two blades between the same grips are one if no point is farther from its counterpart, in lengths.
constexpr double kSameBlade = 1e-5;

bool sameBlade(const Elastica& a, const Elastica& b) {
  constexpr int kPoints = 17;
  const std::vector<Eigen::Vector2d> first = a.sample(kPoints), second = b.sample(kPoints);
  for (std::size_t i = 0; i < first.size(); ++i)
    if ((first[i] - second[i]).norm() > kSameBlade * a.length()) return false;
  return true;
}

void add(ClampedOthers& others, double energy, double turning) {
  ++others.stable;
  if (others.stable > 1 && energy >= others.energy) return;
  others.energy = energy;
  others.turning = turning;
}

}  // namespace

ClampedOthers othersAmong(const std::vector<ClampedSolution>& solutions, std::size_t answer) {
  ClampedOthers others;
  for (std::size_t i = 0; i < solutions.size(); ++i)
    if (i != answer && solutions[i].stable) add(others, solutions[i].energy, solutions[i].turning);
  return others;
}

Result<ClampedOthers> othersBeside(const ClampedSolution& answer, const ClampedProblem& problem,
                                   const CheckedProblem& checked, const ClampedOptions& options) {
  ClampedOthers others;
  const int inflections = kRestInflections - hingesOf(checked.ends);
  const double turning = std::max(options.maxTurning, std::abs(answer.turning));
  for (const UnitSolution& found : shapesOf(checked, turning, inflections)) {
    const SampledSolution sampled = sample(found);
    if (!isResolved(found, sampled) || !restsIn(found, sampled)) continue;
    const Result<Elastica> blade = place(problem, found);
    if (!blade) return tl::unexpected<Error>(blade.error());
    if (sameBlade(*blade, answer.elastica)) continue;
    add(others, blade->energy(), found.turning);
  }
  return others;
}

}  // namespace bw::detail
