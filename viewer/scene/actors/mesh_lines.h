// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/surface/mesh.h"
#include "bw/scene/scene.h"
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

/// What a plane meets: the foam it cuts through and the line of the cut surface in it.
struct SectionCap {
  Polyline outline;  ///< of the block, closed without repeating its first point; empty if the plane misses it
  Segments cut;      ///< of the cut surface
  Segments hatch;    ///< the two pieces of foam on either side of the cut, hatched across each other
};

/// Cuts block and surface by a plane. `spacing` is the distance of the hatching's lines, mm. A surface that
/// ends inside the block by less than a hundredth of its diagonal counts as cutting it through.
SectionCap sectionCap(const Box& block, const TriangleMesh& cut, const SectionPlane& plane, double spacing);

}  // namespace bw::scene
