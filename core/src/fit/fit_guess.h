// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "fit/affine_curvature.h"
#include "fit/fit_target.h"

namespace bw::fit {

/// The canonical guess of the thesis from the affine law: with ℓ = L/S and the s0 that maximises (3.3).
struct LengthGuess {
  Placement placement;
  double R3star = 0;
};
LengthGuess guessByLength(const FitTarget& target, const AffineCurvature& law);

/// The guess of thesis 2.4, by counting the pieces where u is monotone; empty where it is not defined (lines,
/// circles).
std::optional<Placement> guessByCount(const FitTarget& target, const AffineCurvature& law);

/// Shapes to start from besides the canonical guess: the affine law at the middle of the target, and the same
/// law fitted to the tangent angles, which needs no curvature.
Shape shapeFromLaw(const FitTarget& target, const AffineCurvature& law);
Shape shapeFromAngles(const FitTarget& target);

}  // namespace bw::fit
