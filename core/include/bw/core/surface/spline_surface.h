// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"

namespace bw {

/// The `degree` + 1 ≤ 4 basis functions that do not vanish over knots[span] ≤ t < knots[span + 1] (Cox–de
/// Boor); flat knots.
std::array<double, 4> splineBasis(const std::vector<double>& knots, int degree, int span, double t);

/// Clamped flat knots for interpolation at ascending `t`: the parameters themselves without the second and
/// the last but one (not-a-knot) for a cubic, averages for lower degrees.
std::vector<double> interpolationKnots(const std::vector<double>& t, int degree);

/// A non-rational tensor-product B-spline surface as plain numbers: how a cut surface crosses to CAD. u runs
/// along the blade, v along the cutting direction.
struct SplineSurface {
  int degreeU = 3, degreeV = 3;
  std::vector<double> knotsU, knotsV;  ///< flat, with multiplicity, clamped
  int polesU = 0, polesV = 0;
  std::vector<Eigen::Vector3d> poles;  ///< polesV rows of polesU, row-major

  Eigen::Vector3d value(double u, double v) const;
};

/// What lays a surface through all points of a grid (`bw::geometry::loft`), at the parameters 0…1 in u,
/// evenly, and `rowParameters` in v.
using Loft =
    std::function<Result<SplineSurface>(const SurfaceGrid& grid, const std::vector<double>& rowParameters)>;

}  // namespace bw
