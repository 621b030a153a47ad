// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "elastica/bvp_unit.h"

namespace bw::detail {

/// Inflections of the shapes among which blades at rest are sought.
inline constexpr int kRestInflections = 3;

/// All shapes with at most `maxInflections` inflections that meet the problem, each once, no order promised.
/// docs/mathematics.md, 6. Some ms.
std::vector<UnitSolution> allShapes(const UnitProblem& problem, int maxInflections);

}  // namespace bw::detail
