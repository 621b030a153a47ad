// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "elastica/bvp_check.h"
#include "elastica/bvp_describe.h"

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
