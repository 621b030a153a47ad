// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/elastica_bvp.h"
#include "elastica/bvp_unit.h"
#include "elastica/clamped_margin.h"

namespace bw::detail {

/// √f L of a taut blade whose bends at the angles `first` and `second` miss its length by `missing` of it.
double tautRoot(double first, double second, double missing);

/// The blade so taut that its bends do not know of each other: two parts of the single loop and a straight
/// stretch, to rounding an elastica. `startBend` is the bend at the start against the chord. Empty unless the
/// blade is that taut.
std::optional<UnitSolution> looselyJoinedBends(const UnitProblem& problem, double startBend);

/// What such a blade is like, the length its unit; of first order in 1/(√f L). Out of the plane, bends above
/// 109° count without the resistance to twist: a lower bound.
double tautEnergy(const TautBends& bends);
ClampedMargins tautMargins(const TautBends& bends);
ClampedSensitivity tautSensitivity(const TautBends& bends);

}  // namespace bw::detail
