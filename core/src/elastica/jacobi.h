// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw::detail {

/// The arithmetic-geometric mean of a > 0 and b > 0, to full accuracy. K(k) = π / (2 agm(1, sqrt(1 − k²))).
double arithmeticGeometricMean(double a, double b);

/// The incomplete elliptic integral of the first kind F(φ, k) for |φ| ≤ π/2, from s = sin φ, c = cos φ ≥ 0
/// and d = sqrt(1 − k² s²) ≥ 0, which the caller knows without cancellation. Infinite where it diverges (c =
/// d = 0).
double ellipticIntegralF(double s, double c, double d);

}  // namespace bw::detail
