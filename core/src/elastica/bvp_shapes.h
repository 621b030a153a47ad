// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "elastica/bvp_check.h"

namespace bw::detail {

/// All shapes of a problem, however its ends are held, with at most so many inflections between them and so
/// much turning (unless that is given), each once, no order promised. Some ms; µs with both ends hinged.
std::vector<UnitSolution> shapesOf(const CheckedProblem& problem, double maxTurning, int maxInflections);

}  // namespace bw::detail
