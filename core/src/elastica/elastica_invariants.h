// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace bw::elastica {

/// The scaled elastica in the frame of its start: ψ'' = −f_t sin ψ + f_n cos ψ, x' = cos ψ, y' = sin ψ from
/// the origin with ψ(0) = 0, ψ'(0) = κ. The unit of length is chosen so that |κ| ≤ 1 and |f| ≤ 1
/// (docs/mathematics.md, 1).
struct FlowParameters {
  double curvature = 0;
  double tangential = 0;
  double normal = 0;
};

/// A turning below this (rad), or a curvature below this part of the peak, is zero: it lies beneath the
/// rounding of the curve's own parameters.
inline constexpr double kNegligible = 1e-12;
/// A few roundings.
inline constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

/// What does not change along an elastica, and its start as seen from the apex, where the tangent points
/// along the force (docs/mathematics.md, 2). All without cancellation through line, circle and k = 1.
struct ElasticaInvariants {
  double force = 0;              ///< f = |(f_t, f_n)|
  double halfPeakCurvature = 0;  ///< ω = k √f: half the curvature at the apex
  double complement = 0;         ///< g = f (1 − k²): > 0 with inflections, < 0 without, 0 for k = 1
  double complementScale = 0;    ///< g is known to rounding of this
  double apexSine = 0;           ///< σ = sin of half the start's tangent angle against the force
  double apexCosine = 1;         ///< δ = cos of the same, ≥ 0

  /// The curvature is zero, to rounding, all over a segment of this length.
  bool isLine(double length) const { return 2 * halfPeakCurvature * length < kNegligible; }
  /// The curvature is constant to rounding.
  bool isCircle() const { return force <= kRounding * halfPeakCurvature * halfPeakCurvature; }
  /// k = 1 to rounding.
  bool isSingleLoop() const { return std::abs(complement) <= kRounding * complementScale; }
  bool hasInflections() const { return complement >= 0; }
};

/// From κ, f_t and f_n, in extended precision where the machine has it: near k = 1 the complement is the
/// difference of two nearly equal numbers, and the length of a period hangs on it.
ElasticaInvariants invariants(long double curvature, long double tangential, long double normal);

/// Arc length of one period: 2π/κ for a circle; infinite for a line without force. For k = 1 it is that of
/// the nearest elastica which rounding can tell from it.
double periodLength(const ElasticaInvariants& known);

}  // namespace bw::elastica
