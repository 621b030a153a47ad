// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "edge_geometry.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>

#include "occt.h"

namespace bw::geometry {

EdgeGeometry::EdgeGeometry(const TopoDS_Edge& shape) : edge(shape), tolerance(BRep_Tool::Tolerance(shape)) {
  if (BRep_Tool::Degenerated(shape)) return;
  curve = BRep_Tool::Curve(shape, first, last);
  if (curve.IsNull()) return;
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last) || !(last > first)) {
    curve.Nullify();
    return;
  }
  const auto at = [this](double s) { return value(s); };
  if (isLine(curve)) {
    sampleCurve<Eigen::Vector3d>(at, first, last, 1, 1.0, t, points);
  } else {
    sampleCurve<Eigen::Vector3d>(at, first, last, 16, 1e300, t, points);
    for (const auto& p : points) bounds.add(p);
    sampleCurve<Eigen::Vector3d>(at, first, last, 16, kChordRatio * bounds.size().norm(), t, points);
  }
  for (const auto& p : points) bounds.add(p);
}

Eigen::Vector3d EdgeGeometry::value(double s) const {
  gp_Pnt p;
  curve->D0(s, p);
  return toEigen(p);
}

void EdgeGeometry::second(double s, Eigen::Vector3d& p, Eigen::Vector3d& d1, Eigen::Vector3d& d2) const {
  gp_Pnt q;
  gp_Vec a, b;
  curve->D2(s, q, a, b);
  p = toEigen(q);
  d1 = toEigen(a);
  d2 = toEigen(b);
}

bool isLine(Handle(Geom2d_Curve) curve) {
  while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom2d_Line));
}

bool isLine(Handle(Geom_Curve) curve) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom_Line));
}

}  // namespace bw::geometry
