// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_unit.h"

namespace bw::detail {

/// All shapes of a blade of length 1 between hinges at this distance in (0, 1), with at most `maxInflections`
/// inflections between them: equal half waves along the chord (docs/mathematics.md, 6). Mirror images follow
/// each other, the one that lies to the left of the chord first. Left out are those pulled so taut that no
/// number tells how straight they are.
std::vector<UnitSolution> halfWaves(double distance, int maxInflections);

/// The answer about the blade run backwards as one about the blade itself, between the grips of `problem`.
void runBackwards(ClampedAnswer& answer, const ClampedProblem& problem);

}  // namespace bw::detail
