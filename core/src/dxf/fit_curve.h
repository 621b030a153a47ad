// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The curve that CAD programs draw through fit points.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/curve/space_curve.h"

namespace bw::dxf {

struct FitPoints {
  std::vector<Eigen::Vector3d> points;
  std::optional<Eigen::Vector3d> start, end;  ///< tangents there, of any length
  bool closed = false;                        ///< it goes on from the last point to the first
};

/// The cubic B-spline through the points, with continuous curvature: its parameter runs as the lengths of the
/// chords, its first derivative at an end is the unit vector of the tangent that is told, and where none is
/// its second one vanishes; where it is closed both go on over the seam (docs/mathematics.md, Fit points).
/// Points that repeat the one before count once. Nothing where fewer than two points are left, or three of a
/// closed one. O(n).
std::optional<SpaceCurve> curveThrough(const FitPoints& fit);

}  // namespace bw::dxf
