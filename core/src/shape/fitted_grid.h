// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::shape {

/// The points (x, z) of a surface in the plane across the travel at y, at ascending parameters u.
using RowOf =
    std::function<Result<void>(double y, std::span<const double> u, std::span<Eigen::Vector2d> out)>;

/// Such points in space, of surfaces whose planes turn.
using SpaceRowOf =
    std::function<Result<void>(double y, std::span<const double> u, std::span<Eigen::Vector3d> out)>;

/// Parameters at which a surface is asked for: each stretch between two of `breaks` has `parts` even ones.
struct Places {
  std::vector<double> breaks;
  int parts = 1;
  /// The spline is held against the surface at places no further apart than this, once it is near at a few
  /// of each part.
  double widest = std::numeric_limits<double>::infinity();
  std::vector<double> all() const;
};

/// A surface as a bicubic spline whose parameters are u and y.
struct FittedGrid {
  SplineSurface spline;
  double miss = 0;                                  ///< mm, the largest distance found at one pair of them
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< (u, y) of that
};

/// The not-a-knot interpolant of a surface on a grid that is halved along u and along y where it misses the
/// surface by more than `tolerance`, mm, between its places, until it does not or would have more than `most`
/// places one way: then the miss is above the tolerance (docs/mathematics.md, Designed surfaces).
/// Errors: those of `rowOf`.
Result<FittedGrid> fittedGrid(const RowOf& rowOf, Places u, Places y, double tolerance, int most);
Result<FittedGrid> fittedGrid(const SpaceRowOf& rowOf, Places u, Places y, double tolerance, int most);

}  // namespace bw::shape
