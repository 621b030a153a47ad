// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "scene/render/polyline.h"

namespace bw::scene {

/// Unit normals from the triangles around each point, weighted by area.
std::vector<Eigen::Vector3d> pointNormals(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles);

/// Edges that only one triangle has.
Segments boundaryEdges(const std::vector<Eigen::Vector3d>& points,
                       const std::vector<std::array<int, 3>>& triangles);

}  // namespace bw::scene
