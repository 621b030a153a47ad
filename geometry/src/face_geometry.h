// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <array>
#include <memory>
#include <vector>

#include "bw/core/frame.h"
#include "surface_patch.h"

namespace bw::geometry {

/// An edge of the model as a space curve, with samples close enough to follow it.
struct EdgeGeometry {
  TopoDS_Edge edge;
  Handle(Geom_Curve) curve;  ///< null for an edge that is a single point
  double first = 0, last = 0;
  std::vector<double> t;                ///< samples, ascending, ends included
  std::vector<Eigen::Vector3d> points;  ///< at t
  Bounds bounds;                        ///< of the samples
  double tolerance = 0;                 ///< mm, as the file states it

  explicit EdgeGeometry(const TopoDS_Edge& edge);
  bool degenerate() const { return curve.IsNull(); }
  Eigen::Vector3d value(double t) const;
  void second(double t, Eigen::Vector3d& p, Eigen::Vector3d& d1, Eigen::Vector3d& d2) const;
};

/// The way an edge bounds a face, in the parameters of its surface.
struct TrimEdge {
  int edge = -1;  ///< index of the model's edge
  Handle(Geom2d_Curve) curve;
  double first = 0, last = 0;
  int side = -1;           ///< of a natural face: 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1
  bool leftInside = true;  ///< the face lies to the left of the curve's direction

  Eigen::Vector2d value(double t) const;
};

/// A face ready for computing: its surface, its borders in parameters, and a grid of points fine enough to see its shape.
/// Immutable; may be used from several threads at once.
class FaceGeometry {
 public:
  /// `edgeIndex(edge)` gives the model's number of an edge. Throws Standard_Failure on a face without bounds.
  template <class EdgeIndex>
  static std::shared_ptr<const FaceGeometry> make(const TopoDS_Face& face, int index, EdgeIndex&& edgeIndex) {
    auto result = std::shared_ptr<FaceGeometry>(new FaceGeometry(face, index));
    for (std::size_t i = 0; i < result->trimShapes_.size(); ++i) {
      result->trims_[i].edge = edgeIndex(result->trimShapes_[i]);
    }
    result->trimShapes_.clear();
    return result;
  }

  int index() const { return index_; }
  const TopoDS_Face& face() const { return face_; }
  const SurfacePatch& patch() const { return patch_; }
  /// True if the outer side is against du × dv.
  bool reversed() const { return reversed_; }
  double u0() const { return u0_; }
  double u1() const { return u1_; }
  double v0() const { return v0_; }
  double v1() const { return v1_; }
  /// True if the face is the whole rectangle of its parameters.
  bool natural() const { return natural_; }
  /// True if u = u0 and u = u1 are the same line of the surface.
  bool wrapsU() const { return wrapsU_; }
  bool wrapsV() const { return wrapsV_; }
  const std::vector<TrimEdge>& trims() const { return trims_; }

  /// A rough size of one unit of u and of v, mm.
  const Eigen::Vector2d& scale() const { return scale_; }
  /// Whether the parameters lie within the borders. Exact to about 1e-7 mm.
  bool contains(const Eigen::Vector2d& uv) const;
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
  std::array<double, 2> extent(const Eigen::Vector3d& direction, const std::vector<EdgeGeometry>& edges) const;
  /// Unit normal on the outer side; zero where the surface has none.
  Eigen::Vector3d normal(double u, double v) const;
  /// Smallest and largest principal curvature over the grid, signed towards the outer side.
  std::array<double, 2> curvatureRange() const;

 private:
  FaceGeometry(const TopoDS_Face& face, int index);
  void readTrims();
  void findNatural();
  void closeLoops();
  void makeGrid();
  void measureArea();
  bool evenOdd(const Eigen::Vector2d& uv) const;

  struct Segment {
    Eigen::Vector2d a, b;
    int trim;
    double ta, tb;
  };

  int index_;
  TopoDS_Face face_;
  SurfacePatch patch_;
  bool reversed_ = false, natural_ = false, wrapsU_ = false, wrapsV_ = false;
  double u0_ = 0, u1_ = 0, v0_ = 0, v1_ = 0;
  Eigen::Vector2d scale_ = Eigen::Vector2d::Ones();
  std::vector<TrimEdge> trims_;
  std::vector<TopoDS_Edge> trimShapes_;
  std::vector<Segment> segments_;
  std::vector<std::vector<int>> bins_;  // segments by slices of v
  double band_ = 0;                     // mm within which the polygon is not trusted
  std::vector<double> gridU_, gridV_;
  std::vector<Eigen::Vector3d> grid_;
  std::vector<char> inside_;
  double area_ = 0;
};

}  // namespace bw::geometry
