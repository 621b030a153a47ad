// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <vector>

#include "bw/core/base/frame.h"

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

}  // namespace bw::geometry
