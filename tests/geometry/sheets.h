// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/base/units.h"
#include "shapes.h"

namespace bw::geometry::test {

inline constexpr double kRadius = 900;

/// A sheet of a cylinder along y, 600 mm across and 700 mm long, its middle at the origin and highest there.
inline TopoDS_Shape sheet() {
  const gp_Ax3 axis(gp_Pnt(0, -350, -kRadius), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1));
  const double half = std::asin(300 / kRadius);
  return BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axis, kRadius), -half, half, 0, 700, 1e-7)
      .Face();
}

inline TopoDS_Shape boxAt(double x0, double x1, double y0, double y1) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x0, y0, -300), gp_Pnt(x1, y1, 300)).Shape();
}

inline Target targetOf(const TopoDS_Shape& shape, const FaceChoice& choice = {}) {
  std::ostringstream text;
  BRepTools::Write(shape, text);
  auto model = CadModel::readBytes(text.str(), "sheet.brep");
  EXPECT_TRUE(model) << model.error().message;
  auto target = Target::make(*model, choice);
  EXPECT_TRUE(target) << target.error().message;
  return std::move(*target);
}

/// Sections across y.
inline Cut along(const Target& target, SectionRoute route = SectionRoute::traced) {
  CutSettings settings;
  settings.stations = 15;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.route = route;
  return cutOf(target, settings);
}

inline double widestGap(const Findings& findings) {
  double widest = 0;
  for (const Finding& finding : findings)
    if (const auto* bridged = std::get_if<SectionBridged>(&finding.cause))
      widest = std::max(widest, bridged->width);
  return widest;
}

inline double longestExtension(const Findings& findings) {
  double longest = 0;
  for (const Finding& finding : findings)
    if (const auto* extended = std::get_if<SectionExtended>(&finding.cause))
      longest = std::max(longest, extended->length);
  return longest;
}

/// The sheet in parts, split by planes that contain z: through (x, 0) at so many degrees from the y axis.
inline TopoDS_Shape sheetInParts(const std::vector<std::pair<double, double>>& splits) {
  TopTools_ListOfShape faces, tools;
  faces.Append(sheet());
  for (const auto& [x, degrees] : splits) {
    const double a = fromDegrees(degrees);
    tools.Append(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(x, 0, 0), gp_Dir(std::cos(a), -std::sin(a), 0)), -2000,
                                         2000, -2000, 2000)
                     .Face());
  }
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(faces);
  splitter.SetTools(tools);
  splitter.Build();
  return splitter.Shape();
}

inline TopoDS_Compound together(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) builder.Add(all, shape);
  return all;
}

inline FaceChoice allFaces() {
  FaceChoice all;
  all.kind = FaceChoice::Kind::all;
  return all;
}

/// Expects the sections of `parts` to be those of the whole sheet.
inline void expectWhole(const TopoDS_Shape& parts, int faces, const std::string& what) {
  const Cut whole = along(targetOf(sheet()));
  const Target target = targetOf(parts, allFaces());
  ASSERT_EQ(int(target.faces().size()), faces) << what;
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut cut = along(target, route);
    ASSERT_EQ(cut.sections.size(), 15u) << what << ": none is left out";
    for (std::size_t i = 0; i < cut.sections.size(); ++i) {
      const PlanarCurve &curve = cut.sections[i].curve(), &straight = whole.sections[i].curve();
      EXPECT_NEAR(curve.length(), straight.length(), 0.1) << what << i;
      for (const Eigen::Vector2d& p : curve.sample(61))
        EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << what << i;
    }
  }
}

/// An arc of 300 mm radius and 30° and its tangent, 300 mm long, along y.
inline TopoDS_Shape arcAndTangent() {
  const gp_Ax3 axis(gp_Pnt(0, -350, -300), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1));
  const double half = kPi / 6;
  const TopoDS_Face arc =
      BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axis, 300), -half, half, 0, 700, 1e-7).Face();
  const gp_Pnt end(300 * std::sin(half), -350, 300 * std::cos(half) - 300);
  BRepBuilderAPI_MakePolygon edge(
      end, gp_Pnt(end.X() + 300 * std::cos(half), -350, end.Z() - 300 * std::sin(half)));
  BRepBuilderAPI_Sewing sewing(1e-4);
  sewing.Add(arc);
  sewing.Add(BRepPrimAPI_MakePrism(edge.Edge(), gp_Vec(0, 700, 0)).Shape());
  sewing.Perform();
  return sewing.SewedShape();
}

}  // namespace bw::geometry::test
