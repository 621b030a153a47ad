// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The lines of a solid as they are seen from one side, by a depth buffer.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "bw/core/parts/crease.h"
#include "bw/core/surface/mesh.h"

namespace bw::drawings {

using Point = Eigen::Vector2d;

/// A parallel projection along −`toward`; the three are orthonormal.
struct View {
  Eigen::Vector3d right, up;
  Eigen::Vector3d toward;  ///< to the eye

  /// From a direction, z upright in the picture; `toward` must not be along z.
  static View from(const Eigen::Vector3d& toward);
  Point flat(const Eigen::Vector3d& p) const { return {p.dot(right), p.dot(up)}; }
  double depth(const Eigen::Vector3d& p) const { return p.dot(toward); }
};

/// A solid by its triangles, with the edges at which its faces meet at an angle.
class Solid {
 public:
  /// Faces of `mesh` may share no points, if they have the same ones where they meet. Needs its normals.
  explicit Solid(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  const std::vector<Polyline>& edges() const { return edges_; }
  /// Where smooth faces turn away from the eye.
  std::vector<Polyline> outlines(const View& view) const;
  /// Whether a point lies in it.
  bool contains(const Eigen::Vector3d& p) const;

 private:
  TriangleMesh mesh_;
  std::vector<int> joined_;  ///< of each point, the number that it shares with those at the same place
  std::vector<Polyline> edges_;
};

/// Lines in the plane of the view, mm.
struct SeenLines {
  std::vector<std::vector<Point>> seen, hidden;
};

/// What of lines is seen past the solid, to 1/600 of its extent. Holds what lies nearest to the eye.
class DepthBuffer {
 public:
  DepthBuffer(const TriangleMesh& mesh, const View& view);
  /// Of lines in space: those that nothing hides, and the rest.
  SeenLines lines(const std::vector<Polyline>& lines) const;
  /// What of lines lies on the surface that is seen, and not above or below it.
  std::vector<std::vector<Point>> onSurface(const std::vector<Polyline>& lines) const;

 private:
  struct Reach {
    double low, high;  ///< depths about a place; −infinity where nothing is
  };
  Reach about(const Point& p) const;

  View view_;
  Point corner_ = Point::Zero();
  double pixel_ = 1, slack_ = 0;  ///< mm
  int columns_ = 0, rows_ = 0;
  std::vector<double> depths_;
};

/// Lines with fewer points, none farther than `within` from those left out.
std::vector<Point> simplified(const std::vector<Point>& line, double within);

}  // namespace bw::drawings
