// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <vector>

#include "bw/core/base/frame.h"
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

inline constexpr double kChordRatio = 2e-4;  ///< sagitta of samples, of the size
inline constexpr int kChordDepth = 9;        ///< halvings of a curve's interval at most

/// Samples of a curve such that chords keep within `tolerance` of it, at most `kChordDepth` halvings deep.
/// `value(t)` gives a point; [first, last] is first divided evenly into `intervals`. `ts` ascend, ends
/// included; `points` lie at them.
template <class Point, class Value>
void sampleCurve(const Value& value, double first, double last, int intervals, double tolerance,
                 std::vector<double>& ts, std::vector<Point>& points) {
  const auto refine = [&](const auto& self, double ta, const Point& a, double tb, const Point& b,
                          int depth) -> void {
    const double tm = 0.5 * (ta + tb);
    const Point m = value(tm);
    if (depth > 0 && (m - 0.5 * (a + b)).norm() > tolerance) {
      self(self, ta, a, tm, m, depth - 1);
      self(self, tm, m, tb, b, depth - 1);
      return;
    }
    ts.push_back(tb);
    points.push_back(b);
  };
  ts.assign(1, first);
  points.assign(1, value(first));
  for (int i = 0; i < intervals; ++i) {
    const double tb = i + 1 == intervals ? last : first + (last - first) * (i + 1) / intervals;
    const double ta = ts.back();
    const Point a = points.back();
    refine(refine, ta, a, tb, value(tb), kChordDepth);
  }
}

/// Where from 0 to 1 the segment from a to b is nearest to p; 0 on one without length.
template <class Point>
double nearestOnSegment(const Point& p, const Point& a, const Point& b) {
  const Point d = b - a;
  const double length2 = d.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
}

/// True if the curve is straight whatever its range.
bool isLine(Handle(Geom2d_Curve) curve);
bool isLine(Handle(Geom_Curve) curve);

/// The way an edge bounds a face, in the parameters of its surface.
struct TrimEdge {
  int edge = -1;  ///< index of the model's edge
  Handle(Geom2d_Curve) curve;
  double first = 0, last = 0;
  int side = -1;           ///< of a natural face: 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1
  bool leftInside = true;  ///< the face lies to the left of the curve's direction

  Eigen::Vector2d value(double t) const;
};

/// The rectangle of parameters that a face lies in.
struct ParameterRange {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;

  double width() const { return u1 - u0; }
  double height() const { return v1 - v0; }
};

/// The borders of a face in the parameters of its surface, and what lies within them. Each border is a
/// polygon that follows its curve; within a band about the polygon the curve itself decides.
class FaceBorders {
 public:
  /// `range` holds the face; `patch` is its surface and need not outlive the call.
  FaceBorders(const TopoDS_Face& face, const SurfacePatch& patch, const ParameterRange& range);

  /// Numbers the edges: `edgeIndex(edge)` gives the model's number. Once only.
  template <class EdgeIndex>
  void numberEdges(EdgeIndex&& edgeIndex) {
    for (std::size_t i = 0; i < trimShapes_.size(); ++i) trims_[i].edge = edgeIndex(trimShapes_[i]);
    trimShapes_.clear();
  }

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

 private:
  void readTrims(const TopoDS_Face& face);
  void findNatural();
  void findWraps(const SurfacePatch& patch);
  void findScale(const SurfacePatch& patch);
  void closeLoops();
  void fillBins();
  void findInnerSides();
  bool evenOdd(const Eigen::Vector2d& uv) const;

  struct Segment {
    Eigen::Vector2d a, b;
    int trim;
    double ta, tb;
  };

  ParameterRange range_;
  bool natural_ = false, wrapsU_ = false, wrapsV_ = false;
  Eigen::Vector2d scale_ = Eigen::Vector2d::Ones();
  std::vector<TrimEdge> trims_;
  std::vector<TopoDS_Edge> trimShapes_;  // of trims_, until they are numbered
  std::vector<Segment> segments_;
  std::vector<std::vector<int>> bins_;  // segments by slices of v
  double band_ = 0;                     // mm within which the polygon is not trusted
};

}  // namespace bw::geometry
