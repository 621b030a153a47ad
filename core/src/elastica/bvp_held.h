// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_check.h"

namespace bw::detail {

/// A blade that lies between the grips of `problem` already, as their solution; empty if it misses them, or
/// has a curvature at a hinge. So an answer is its own start, however taut it is.
std::optional<UnitSolution> heldAlready(const Elastica& blade, const ClampedProblem& problem,
                                        const CheckedProblem& checked);

}  // namespace bw::detail
