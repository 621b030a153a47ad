// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "scene/render/polyline.h"

namespace bw::scene {

/// Where a field, linear on each triangle, takes one of `levels`. Triangles with a non-finite value are left
/// out.
Segments isolines(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::array<int, 3>>& triangles, const std::vector<double>& values,
                  const std::vector<double>& levels);

/// A line of equal value in one piece.
struct Isoline {
  double level = 0;
  Polyline line;  ///< the first point again at the end where it is closed
};

/// The same joined to lines, longest first within each level, levels in the order given.
std::vector<Isoline> joinedIsolines(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<std::array<int, 3>>& triangles,
                                    const std::vector<double>& values, const std::vector<double>& levels);

/// Unit normals from the triangles around each point, weighted by area.
std::vector<Eigen::Vector3d> pointNormals(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles);

/// Edges that only one triangle has.
Segments boundaryEdges(const std::vector<Eigen::Vector3d>& points,
                       const std::vector<std::array<int, 3>>& triangles);

}  // namespace bw::scene
