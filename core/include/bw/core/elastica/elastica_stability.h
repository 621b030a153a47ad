// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/elastica/elastica.h"

namespace bw {

/// True if a blade clamped at both ends (positions, tangents and length fixed) rests in this shape: no
/// conjugate point before its end, so that the second variation of the bending energy is positive under the
/// end constraints. In the plane; sampled at 1/96 of the length, so that a conjugate point closer than that
/// to the end may be missed. docs/mathematics.md, 5.
bool isClampedStable(const Elastica& blade);

/// How firmly the clamped blade rests in this shape, in the plane: the smallest eigenvalue of the second
/// variation of the bending energy under the end constraints, over that of the straight blade without force
/// (4π²/L²). 1 for a straight blade, 0 where the blade is about to snap, below 0 for a shape that no blade
/// keeps. It does not change with the scale. A blade that is straight to within 1e-3 rad of total bending
/// counts as straight, whatever its force. Accurate to
/// 1e-6 of 1 + |λ| L² up to (max |κ| + √|λ|) L = 100. 20 µs for a usual blade. docs/mathematics.md, 5.
double stabilityMargin(const Elastica& blade);

/// Torsional over flexural rigidity of a round steel tube or rod, GJ/EI = 1/(1 + ν) with ν = 0.3.
inline constexpr double kRoundTorsionRatio = 1 / 1.3;

/// The same margin against leaving the plane, for a blade of a section without preferred direction (tube,
/// rod) whose grips hold it without twist. `torsionRatio` = GJ/EI ≥ 0; 0 for grips that let it turn about its
/// axis.
double outOfPlaneMargin(const Elastica& blade, double torsionRatio = kRoundTorsionRatio);

}  // namespace bw
