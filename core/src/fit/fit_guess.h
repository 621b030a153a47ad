// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include "bw/core/elastica/elastica.h"
#include "fit/fit_target.h"

namespace bw::fit {

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

/// Everything that the guesses need of the elastica of a law: f, ω and the sense of turning, in the frame of
/// the target.
struct LawOrbit {
  double force = 0;
  double angle = 0;  ///< of the force: the tangent angle at the apex
  double omega = 0;  ///< half the largest curvature
  double sense = 1;  ///< sign of the curvature, if it does not change
  /// True if the curvature changes sign.
  bool inflectional() const { return omega <= std::sqrt(force); }
};
LawOrbit orbitOf(const AffineCurvature& law);

/// The elastica of an orbit from its apex, where the thesis has s = 0.
Elastica fromApex(const LawOrbit& orbit);

/// The placement of the part of an apex elastica that starts at arc length `from` and is `length` long
/// (lengths of the target), moved so that (2.25) holds.
Placement placePart(const FitTarget& target, const LawOrbit& orbit, const Elastica& apex, double from,
                    double length);

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
