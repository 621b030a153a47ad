// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/mesh_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace bw::scene {

std::vector<Eigen::Vector3d> pointNormals(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d& p = points[std::size_t(a)];
    const Eigen::Vector3d area = (points[std::size_t(b)] - p).cross(points[std::size_t(c)] - p);
    for (const int corner : {a, b, c}) normals[std::size_t(corner)] += area;
  }
  for (Eigen::Vector3d& n : normals) {
    const double length = n.norm();
    n = length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::UnitZ();
  }
  return normals;
}

Segments boundaryEdges(const std::vector<Eigen::Vector3d>& points,
                       const std::vector<std::array<int, 3>>& triangles) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges.push_back((std::uint64_t(std::uint32_t(a)) << 32) | std::uint32_t(b));
    }
  }
  std::sort(edges.begin(), edges.end());
  Segments result;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t next = i + 1;
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    if (next == i + 1)
      result.emplace_back(points[std::size_t(edges[i] >> 32)], points[std::size_t(edges[i] & 0xFFFFFFFFu)]);
    i = next;
  }
  return result;
}

}  // namespace bw::scene
