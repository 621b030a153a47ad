// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace bw {

const Field* SurfaceGrid::field(const std::string& name) const {
  const auto it = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return it == fields.end() ? nullptr : &*it;
}

TriangleMesh SurfaceGrid::triangles() const {
  TriangleMesh mesh;
  if (rows < 2 || columns < 2) return mesh;
  mesh.points = points;
  mesh.normals.resize(points.size());
  mesh.triangles.reserve(std::size_t(rows - 1) * (columns - 1) * 2);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Eigen::Vector3d du = at(r, std::min(c + 1, columns - 1)) - at(r, std::max(c - 1, 0));
      const Eigen::Vector3d dv = at(std::min(r + 1, rows - 1), c) - at(std::max(r - 1, 0), c);
      // Rows advance along the section's normal n = x × y, so the outer side y is dv × du.
      const Eigen::Vector3d n = dv.cross(du);
      const double length = n.norm();
      mesh.normals[std::size_t(r) * columns + c] =
          length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::UnitZ();
      if (r + 1 < rows && c + 1 < columns) {
        const int a = r * columns + c, b = a + 1, d = a + columns, e = d + 1;
        mesh.triangles.push_back({a, d, e});
        mesh.triangles.push_back({a, e, b});
      }
    }
  }
  return mesh;
}

}  // namespace bw
