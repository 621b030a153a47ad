// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "bw/core/elastica.h"
#include "elastica_flow.h"

namespace bw::detail {

/// An elastica in the frame of its start and in a unit of length that fits its shape (docs/mathematics.md, 1).
struct ScaledElastica {
  FlowParameters flow;
  double unit = 1;    ///< the unit of length, mm
  double cosine = 1;  ///< of the start angle
  double sine = 0;    ///< of the start angle
  double length = 1;  ///< of the segment, in the unit
};
ScaledElastica scaled(const Elastica& elastica);

/// A turning below this (rad), or a curvature below this part of the peak, is zero: it lies beneath the rounding of the
/// curve's own parameters.
inline constexpr double kNegligible = 1e-12;
/// A few roundings.
inline constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

/// What does not change along an elastica (docs/mathematics.md, 2). Lengths and curvatures are in the unit of the parameters.
struct ElasticaInvariants {
  double force = 0;               ///< f = |(f_t, f_n)|
  double halfPeakCurvature = 0;   ///< ω = k √f: half the curvature at the apex
  double apexSine = 0;            ///< σ = sin of half the start's tangent angle as seen from the apex
  double apexCosine = 1;          ///< δ = cos of the same, ≥ 0
  double complement = 0;          ///< g = f (1 − k²): > 0 with inflections, < 0 without, 0 for k = 1
  double period = std::numeric_limits<double>::infinity();  ///< arc length; 2π/κ for a circle, infinite for a line without force
  double periodTurning = 0;       ///< 0 or ±2π: the turning over one period

  /// The curvature is zero, to rounding, wherever one looks on a segment of this length.
  bool isLine(double length) const { return 2 * halfPeakCurvature * length < kNegligible; }
  /// The curvature is constant to rounding.
  bool isCircle() const { return force <= kRounding * halfPeakCurvature * halfPeakCurvature; }
  /// k = 1 to rounding.
  bool isSingleLoop() const { return std::abs(complement) <= kRounding * force; }
};
ElasticaInvariants invariants(const FlowParameters& parameters);

}  // namespace bw::detail
