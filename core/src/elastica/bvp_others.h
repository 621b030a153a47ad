// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_check.h"

namespace bw::detail {

/// The stable ones of `solutions`, besides the one that is the answer: how many, and the one of least energy.
ClampedOthers othersAmong(const std::vector<ClampedSolution>& solutions, std::size_t answer);

/// The same where only the answer is known: seeks all that rest. Some ms.
Result<ClampedOthers> othersBeside(const ClampedSolution& answer, const ClampedProblem& problem,
                                   const CheckedProblem& checked, const ClampedOptions& options);

}  // namespace bw::detail
