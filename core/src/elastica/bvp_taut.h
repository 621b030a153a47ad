// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/elastica/elastica_bvp.h"
#include "elastica/bvp_unit.h"
#include "elastica/clamped_modes.h"

namespace bw::elastica {

/// The bends that taut blades of this turning, or with the end hinged, would have, each less than a whole
/// turn, by energy; most problems have one or none. The start holds its tangent. True to the first order in
/// exp(−√f L).
std::vector<TautBends> tautBends(const UnitProblem& problem);

/// The blade with such bends: parts of the single loop at the grips and a nearly straight stretch between
/// them. Empty where the bends are wider than the blade, or too narrow for any number here.
std::optional<UnitSolution> tautShape(const UnitProblem& problem, const TautBends& bends);

/// What a blade is like whose bends do not know of each other, the length its unit; of first order in 1/(√f
/// L). Out of the plane, bends above 109° count without the resistance to twist: a lower bound.
double tautEnergy(const TautBends& bends);
ClampedMargins tautMargins(const TautBends& bends, HeldEnds ends);
ClampedSensitivity tautSensitivity(const TautBends& bends, HeldEnds ends);

}  // namespace bw::elastica
