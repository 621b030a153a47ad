// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "elastica/bvp_check.h"
#include "elastica/bvp_describe.h"

namespace bw::elastica {

/// True if the blade rests in this shape, as far as the numbers can tell.
bool restsIn(const UnitSolution& found, const SampledSolution& sampled);

/// Of all shapes in which it rests, the one of least `measure`; empty if there is none. Some ms.
std::optional<UnitSolution> leastAtRest(const CheckedProblem& problem, double maxTurning,
                                        const std::function<double(const UnitSolution&)>& measure);

/// The one of least energy. About 0.1 ms where both ends hold their tangents.
std::optional<UnitSolution> atRest(const CheckedProblem& problem, double maxTurning);

/// The stable ones of `solutions`, besides the one that is the answer: how many, and the one of least energy.
ClampedOthers othersAmong(const std::vector<ClampedSolution>& solutions, std::size_t answer);

/// The same where only the answer is known: seeks all that rest. Some ms.
Result<ClampedOthers> othersBeside(const ClampedSolution& answer, const ClampedProblem& problem,
                                   const CheckedProblem& checked, const ClampedOptions& options);

}  // namespace bw::elastica
