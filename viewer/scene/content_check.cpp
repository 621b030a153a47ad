// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/content_check.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace bw::scene {

void cleanMesh(TriangleMesh& mesh) {
  const int count = int(mesh.points.size());
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    return std::any_of(t.begin(), t.end(), [&](int i) {
      return i < 0 || i >= count || !mesh.points[std::size_t(i)].allFinite();
    });
  });
  // Points that no triangle uses must still be numbers, for the bounds and for the graphics card.
  for (Eigen::Vector3d& p : mesh.points) {
    if (!p.allFinite())
      p = mesh.triangles.empty() ? Eigen::Vector3d::Zero() : mesh.points[std::size_t(mesh.triangles[0][0])];
  }
  if (mesh.normals.size() != mesh.points.size()) mesh.normals.clear();
  if (mesh.triangles.empty()) mesh = {};
}

bool sound(const FaceMesh& faces) {
  const TriangleMesh& mesh = faces.mesh;
  const int count = int(mesh.points.size());
  return !mesh.triangles.empty() && faces.faces.size() == mesh.triangles.size() &&
         (mesh.normals.empty() || mesh.normals.size() == mesh.points.size()) &&
         std::all_of(faces.faces.begin(), faces.faces.end(), [](int face) { return face >= 0; }) &&
         std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); }) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const std::array<int, 3>& t) {
           return std::all_of(t.begin(), t.end(), [&](int i) { return i >= 0 && i < count; });
         });
}

std::vector<double> pointAreas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& {
      return mesh.points[std::size_t(triangle[i])];
    };
    const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (const int i : triangle) areas[std::size_t(i)] += area / 3;
  }
  return areas;
}

}  // namespace bw::scene
