// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_target.h"

namespace bw::detail {

/// The affine law κ ≈ α + λ2 x − λ1 y of a target (thesis 2.4, 3.2; docs/mathematics.md, 7.2), in the frame
/// of the target.
struct AffineCurvature {
  double alpha = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< (λ1, λ2)
  double beta = 0;
  double omega = 0;  ///< half the largest curvature of the whole elastica, δ₋ / 2
  double R1 = 0, R2 = 0, R3 = 0;

  double curvatureAt(const Eigen::Vector2d& p) const { return alpha + force.y() * p.x() - force.x() * p.y(); }
};
AffineCurvature fitAffineCurvature(const FitTarget& target);

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

}  // namespace bw::detail
