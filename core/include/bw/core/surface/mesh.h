// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace bw {

/// Triangles in the file's frame, mm; corners of a triangle are counter-clockwise seen from its outer side.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< one unit normal a point, or empty
  std::vector<std::array<int, 3>> triangles;
};

/// Triangles of many faces, each with the face that it belongs to. Faces share no points.
struct FaceMesh {
  TriangleMesh mesh;
  std::vector<int> faces;  ///< one a triangle: the index of its face, in the order of the file
};

/// One scalar a point. `name` is the stable word ("deviation"), `title` what the legend says, `unit` its unit
/// ("mm", "°", "").
struct Field {
  std::string name;
  std::string title;
  std::string unit;
  std::vector<double> values;
};

/// A grid of points on a surface: `rows` × `columns`, row-major; a row runs along the blade, a column along
/// the cutting direction.
struct SurfaceGrid {
  int rows = 0;
  int columns = 0;
  std::vector<Eigen::Vector3d> points;
  std::vector<Field> fields;  ///< each with rows × columns values

  const Eigen::Vector3d& at(int row, int column) const { return points[std::size_t(row) * columns + column]; }
  /// The field of that name, or null.
  const Field* field(const std::string& name) const;
  /// The grid as triangles, with point normals from central differences; same point order.
  TriangleMesh triangles() const;
};

}  // namespace bw
