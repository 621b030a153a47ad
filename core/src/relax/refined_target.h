// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/relax/curve_relaxation.h"
#include "relax/spline_space.h"

namespace bw::relax {

/// Limits of `RelaxOptions::spans`; the target's own spans are kept up to the second.
inline constexpr int kFewestSpans = 4, kMostSpans = 200;

/// The target in its refined space, along its chord and in units of its length.
struct RefinedTarget {
  SplineSpace space;
  Eigen::MatrixX2d points;
  double error = 0;  ///< largest distance from the target at the places that were looked at, lengths
};

/// The target against its chord: `in` from mm to units of its length along the chord, `out` back.
struct ChordFrame {
  Eigen::Vector2d origin;
  double angle = 0, unit = 1;

  Eigen::Vector2d in(const Eigen::Vector2d& p) const {
    return Eigen::Rotation2Dd(-angle) * (p - origin) / unit;
  }
  Eigen::Vector2d out(const Eigen::Vector2d& p) const {
    return origin + unit * (Eigen::Rotation2Dd(angle) * p);
  }
};

/// The spline of `options.degree` that stands for the target: the target itself on finer knots where it is a
/// polynomial spline of that degree or less, else through it, evenly in arc length.
RefinedTarget refineTarget(const PlanarCurve& target, const ChordFrame& placed, const RelaxOptions& options);

}  // namespace bw::relax
