// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <TopoDS_Face.hxx>

#include <array>
#include <memory>
#include <vector>

#include "bw/core/base/frame.h"
#include "face_borders.h"
#include "surface_patch.h"

namespace bw::geometry {

/// Principal curvatures over the grid of a face, 1/mm, signed towards the outer side.
struct CurvatureRange {
  double min = 0, max = 0;
  double lesser = 0;  ///< the largest absolute value of the flatter of the two: 0 for a developable face
};

/// A face ready for computing: its surface, its borders in parameters, and a grid of points fine enough to
/// see its shape. Immutable; may be used from several threads at once.
class FaceGeometry {
 public:
  /// `edgeIndex(edge)` gives the model's number of an edge. Throws Standard_Failure on a face without bounds.
  template <class EdgeIndex>
  static std::shared_ptr<const FaceGeometry> make(const TopoDS_Face& face, int index, EdgeIndex&& edgeIndex) {
    auto result = std::shared_ptr<FaceGeometry>(new FaceGeometry(face, index));
    result->borders_.numberEdges(edgeIndex);
    return result;
  }

  int index() const { return index_; }
  const TopoDS_Face& face() const { return face_; }
  const SurfacePatch& patch() const { return patch_; }
  /// True if the outer side is against du × dv.
  bool reversed() const { return reversed_; }
  double u0() const { return range_.u0; }
  double u1() const { return range_.u1; }
  double v0() const { return range_.v0; }
  double v1() const { return range_.v1; }
  /// True if the face is the whole rectangle of its parameters.
  bool natural() const { return borders_.natural(); }
  /// True if u = u0 and u = u1 are the same line of the surface.
  bool wrapsU() const { return borders_.wrapsU(); }
  bool wrapsV() const { return borders_.wrapsV(); }
  const std::vector<TrimEdge>& trims() const { return borders_.trims(); }

  /// A rough size of one unit of u and of v, mm.
  const Eigen::Vector2d& scale() const { return borders_.scale(); }
  /// Whether the parameters lie within the borders. Exact to about 1e-7 mm.
  bool contains(const Eigen::Vector2d& uv) const { return borders_.contains(uv); }
  /// Brings periodic parameters into the range of the face.
  Eigen::Vector2d wrapped(Eigen::Vector2d uv) const;

  const std::vector<double>& gridU() const { return gridU_; }
  const std::vector<double>& gridV() const { return gridV_; }
  const Eigen::Vector3d& gridPoint(int i, int j) const { return grid_[std::size_t(i) * gridV_.size() + j]; }
  bool gridInside(int i, int j) const { return inside_[std::size_t(i) * gridV_.size() + j] != 0; }

  double area() const { return area_; }
  /// Tight bounds of the trimmed face. `edges` are the model's.
  Bounds bounds(const std::vector<EdgeGeometry>& edges) const;
  /// Smallest and largest value of direction · point on the trimmed face, to about 1e-6 mm.
  std::array<double, 2> extent(const Eigen::Vector3d& direction,
                               const std::vector<EdgeGeometry>& edges) const;
  /// Unit normal on the outer side; zero where the surface has none.
  Eigen::Vector3d normal(double u, double v) const;
  /// The same where the first derivatives are known.
  Eigen::Vector3d normal(const Jet& jet) const;
  /// True where the lines of one parameter run together, so that nothing can be said by their derivatives.
  bool pole(const Jet& jet) const;
  CurvatureRange curvatureRange() const;

 private:
  FaceGeometry(const TopoDS_Face& face, int index);
  void makeGrid();
  void measureArea();

  int index_;
  TopoDS_Face face_;
  SurfacePatch patch_;
  bool reversed_ = false;
  ParameterRange range_;
  FaceBorders borders_;
  std::vector<double> gridU_, gridV_;
  std::vector<Eigen::Vector3d> grid_;
  std::vector<char> inside_;
  double area_ = 0;
};

}  // namespace bw::geometry
