// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "elastica/bvp_unit.h"

namespace bw::detail {

/// Inflections, those at hinges included, of the shapes among which blades at rest are sought: a blade that
/// holds a whole wave, from an inflection to the next but one, does not rest (docs/mathematics.md, 5).
inline constexpr int kRestInflections = 3;
/// Shapes with |1 − k²| above this have no stretch so taut that their start would not tell their end.
inline constexpr double kNearLoop = 1e-3;

/// All shapes with at most `maxInflections` inflections, that of a hinge not counted, that meet the problem,
/// each once, no order promised. The start holds its tangent. docs/mathematics.md, 6. Some ms.
std::vector<UnitSolution> allShapes(const UnitProblem& problem, int maxInflections);

}  // namespace bw::detail
