// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "elastica/bvp_check.h"

namespace bw::elastica {

/// Inflections, those at hinges included, of the shapes among which blades at rest are sought: a blade that
/// holds a whole wave, from an inflection to the next but one, does not rest (docs/mathematics.md, 5).
inline constexpr int kRestInflections = 3;
/// Shapes with |1 − k²| above this have no stretch so taut that their start would not tell their end.
inline constexpr double kNearLoop = 1e-3;

/// All shapes of a problem, however its ends are held, with at most so many inflections between them and so
/// much turning (unless that is given), each once, no order promised. docs/mathematics.md, 6. Some ms; µs
/// with both ends hinged.
std::vector<UnitSolution> shapesOf(const CheckedProblem& problem, double maxTurning, int maxInflections);

/// All shapes of a blade of length 1 between hinges at this distance in (0, 1), with at most `maxInflections`
/// inflections between them: equal half waves along the chord (docs/mathematics.md, 6). Mirror images follow
/// each other, the one that lies to the left of the chord first. Left out are those pulled so taut that no
/// number tells how straight they are.
std::vector<UnitSolution> halfWaves(double distance, int maxInflections);

}  // namespace bw::elastica
