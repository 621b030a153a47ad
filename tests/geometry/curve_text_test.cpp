// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves in STEP, read by OpenCASCADE.

#include <gtest/gtest.h>

#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <cmath>
#include <sstream>

#include "bw/geometry/export.h"

namespace bw::geometry::test {
namespace {

std::vector<TopoDS_Edge> edgesOf(const std::string& step) {
  STEPControl_Reader reader;
  std::istringstream stream(step);
  EXPECT_EQ(reader.ReadStream("curves", stream), IFSelect_RetDone);
  reader.TransferRoots();
  std::vector<TopoDS_Edge> edges;
  for (TopExp_Explorer at(reader.OneShape(), TopAbs_EDGE); at.More(); at.Next())
    edges.push_back(TopoDS::Edge(at.Current()));
  return edges;
}

TEST(CurveText, IsReadAsSplinesThroughThePoints) {
  NamedCurve wave{"wave", {}}, corner{"corner \u00e4", {}}, line{"line", {{0, 0, 0}, {1, 2, 3}}};
  for (int i = 0; i <= 60; ++i) wave.points.emplace_back(10.0 * i, 30 * std::sin(i / 9.0), 100 + 0.2 * i);
  for (int i = 0; i <= 20; ++i) corner.points.emplace_back(5.0 * i, 0, 50 - std::abs(5.0 * i - 50));
  const NamedCurve nowhere{"nowhere", {{1, 1, 1}, {1, 1, 1}}};
  const NamedCurve curves[] = {wave, corner, line, nowhere};
  const std::string text = curvesStepText(curves, "all").value();
  EXPECT_EQ(text, curvesStepText(curves, "all").value());
  const std::vector<TopoDS_Edge> edges = edgesOf(text);
  ASSERT_EQ(edges.size(), 4u) << "the corner parts its curve; two points in one place are no curve";
  double first = 0, last = 0;
  const auto onEdge = [&](const Eigen::Vector3d& p, const TopoDS_Edge& edge) {
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const GeomAPI_ProjectPointOnCurve foot(gp_Pnt(p.x(), p.y(), p.z()), curve, first, last);
    const auto to = [&](double t) { return curve->Value(t).Distance(gp_Pnt(p.x(), p.y(), p.z())); };
    return std::min({foot.NbPoints() > 0 ? foot.LowerDistance() : 1e9, to(first), to(last)});
  };
  for (const Eigen::Vector3d& p : wave.points) EXPECT_LT(onEdge(p, edges[0]), 1e-6);
  // Between the points it is the smooth curve, not its chords.
  EXPECT_LT(onEdge({305, 30 * std::sin(30.5 / 9.0), 106.1}, edges[0]), 2e-3);
  for (const Eigen::Vector3d& p : corner.points)
    EXPECT_LT(std::min(onEdge(p, edges[1]), onEdge(p, edges[2])), 1e-6);
}

}  // namespace
}  // namespace bw::geometry::test
