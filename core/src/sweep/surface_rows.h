// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/plane_family.h"

namespace bw::sweep {

/// A cut surface whose rows lie in planes of a family, in the order of travel: places are looked for in their
/// own plane, between two rows. Keeps a reference to the grid, of two rows and four columns at least.
class SurfaceRows {
 public:
  SurfaceRows(const SurfaceGrid& cut, const PlaneFamily& planes);

  /// Where a place is, mm.
  struct Seen {
    double across = 0;    ///< before the first row or after the last one
    double beside = 0;    ///< beyond an end of the row, along it; 0 where there is surface over it
    double distance = 0;  ///< from the row, which goes on beyond its ends for the width of a column
  };
  Seen look(const Eigen::Vector3d& place) const;

  /// How far a place is from the surface, whatever plane its nearest point lies in, mm; `within`, where it is
  /// not nearer than that. The surface is that of triangles between the points of the grid.
  double distance(const Eigen::Vector3d& place, double within) const;

 private:
  const SurfaceGrid& cut_;
  PlaneFamily planes_;
  std::vector<double> levels_;
};

}  // namespace bw::sweep
