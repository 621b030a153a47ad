// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "elastica/bvp_unit.h"

namespace bw::detail {

/// All shapes with at most `maxInflections` inflections that meet the problem, each once, no order promised.
/// docs/mathematics.md, 6. Some ms.
std::vector<UnitSolution> allShapes(const UnitProblem& problem, int maxInflections);

/// The shape of a taut blade: bends at the grips and a nearly straight stretch between them, which it crosses
/// or touches once. Empty if the problem has no such shape, or none that is taut.
std::optional<UnitSolution> tautShape(const UnitProblem& problem);

}  // namespace bw::detail
