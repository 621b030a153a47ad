// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "fit/fit_constraints.h"

namespace bw::fit {

/// An equilibrium of a clamped blade, mm, and the objective there.
struct ClampedBlade {
  Elastica elastica;
  double value = 0;
};

/// Ends, end tangents and an exact length leave isolated curves: the equilibria of a clamped blade. All of
/// them (docs/mathematics.md, 6) with at most two inflections more than the target and a turn more than it
/// turns, nearest to the target first. Empty if `constraints` leave out one of the three or there are none.
/// Some ms.
std::vector<ClampedBlade> clampedBlades(const FitTarget& target, const FitConstraints& constraints,
                                        FitNorm norm);

}  // namespace bw::fit
