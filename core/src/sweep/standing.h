// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "bw/core/surface/mesh.h"
#include "sweep/cut_rows.h"

namespace bw::sweep {

/// The points of a grid moved by half of `width` (mm, of each place) along its normals, to the side of it
/// that on the whole lies towards `kept`. Grids of one row or one column stay as they are.
template <class Width>
SurfaceGrid standing(SurfaceGrid swept, const Eigen::Vector3d& kept, const Width& width) {
  if (swept.rows < 2 || swept.columns < 2) return swept;
  const std::vector<Eigen::Vector3d> normals = swept.triangles().normals;
  const std::vector<double> areas = pointAreas(swept);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < normals.size(); ++i) mean += areas[i] * normals[i];
  const double half = mean.dot(kept) < 0 ? -0.5 : 0.5;
  for (std::size_t i = 0; i < normals.size(); ++i)
    swept.points[i] += half * width(swept.points[i]) * normals[i];
  return swept;
}

}  // namespace bw::sweep
