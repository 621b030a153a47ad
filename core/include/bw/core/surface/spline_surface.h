// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"

namespace bw {

/// A non-rational tensor-product B-spline surface as plain numbers: how a cut surface crosses to CAD. u runs
/// along the blade, v along the cutting direction.
struct SplineSurface {
  int degreeU = 3, degreeV = 3;
  std::vector<double> knotsU, knotsV;  ///< flat, with multiplicity, clamped
  int polesU = 0, polesV = 0;
  std::vector<Eigen::Vector3d> poles;  ///< polesV rows of polesU, row-major

  Eigen::Vector3d value(double u, double v) const;
};

/// The cubic B-spline surface through all points of `grid` (rows × columns, both ≥ 2). Parameters are 0…1 in
/// u (uniform) and `rowParameters` in v (strictly ascending; chord length for a skin). Natural cubic
/// interpolation with not-a-knot ends; degree falls to rows − 1 for fewer than four rows. Fails on coincident
/// parameters.
Result<SplineSurface> interpolateGrid(const SurfaceGrid& grid, const std::vector<double>& rowParameters);

}  // namespace bw
