// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::calibration {

/// Half of a symmetric elastica segment, from its middle (curvature 1, tangent along x) to its end (tangent
/// angle α), in one parameter that passes through all cases of thesis 8 without a seam: the height of the end
/// over the middle. docs/mathematics.md, blade length.
struct SymmetricArc {
  double height = 0;        ///< Y: height times middle curvature
  double endCurvature = 1;  ///< c: over the middle curvature
  double arc = 0;           ///< T
  double sag = 0;           ///< J = ∫ sin²(ψ/2) ds, so that the half chord is T − 2 J
  double chord = 0;         ///< X = T − 2 J; ≤ 0 once the halves have met
  double force = 0;         ///< p: ψ'' = −p sin ψ
};

/// The half with end angle α = 2 asin `sine` (`cosine` = cos(α/2) > 0) and this height > 0, below
/// `tallestArc`.
SymmetricArc symmetricArc(double sine, double cosine, double height);

/// The half that ends in an inflection (hinged), with 0 < k < 1 = sin(α/2).
SymmetricArc hingedArc(double k);

/// The height at which the modulus of case A reaches `k` ≥ sin(α/2).
double tallestArc(double sine, double k);

/// Where the bellies of the halves touch each other (thesis 8.2).
inline constexpr double kTouchingModulus = 0.855092407720383;
/// The modulus at which hinged ends meet: 2 E = K (thesis 8.1).
inline constexpr double kHingesMeet = 0.908908557548541;

}  // namespace bw::calibration
