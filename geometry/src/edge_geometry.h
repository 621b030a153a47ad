// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>

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

}  // namespace bw::geometry
