// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Holes and notches that take a whole face, or part one: sections go on on the surfaces that the faces of a
// target lie on together.

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>

#include "sheets.h"

namespace bw::geometry::test {
namespace {

TopoDS_Shape without(TopoDS_Shape shape, const std::vector<TopoDS_Shape>& tools) {
  for (const TopoDS_Shape& tool : tools) shape = BRepAlgoAPI_Cut(shape, tool).Shape();
  return shape;
}

/// An upright prism over a polygon of (x, y).
TopoDS_Shape prism(const std::vector<Eigen::Vector2d>& corners) {
  BRepBuilderAPI_MakePolygon polygon;
  for (const Eigen::Vector2d& corner : corners) polygon.Add(gp_Pnt(corner.x(), corner.y(), -300));
  polygon.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 600)).Shape();
}

/// Two arcs of 400 mm radius and 40°, and a plane of 100 mm between them that both touch, 700 mm along y.
TopoDS_Shape arcsAndPlane() {
  const double a = fromDegrees(40), m = fromDegrees(20);
  const auto onArc = [](double side, double angle) {
    return gp_Pnt(side * (50 + 400 * std::sin(angle)), -350, 400 * std::cos(angle) - 400);
  };
  BRepBuilderAPI_Sewing sewing(1e-5);
  const auto sweep = [&](const TopoDS_Edge& edge) {
    sewing.Add(BRepPrimAPI_MakePrism(edge, gp_Vec(0, 700, 0)).Shape());
  };
  for (const double side : {-1.0, 1.0})
    sweep(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(onArc(side, 0), onArc(side, m), onArc(side, a)).Value())
              .Edge());
  sweep(BRepBuilderAPI_MakeEdge(onArc(-1, 0), onArc(1, 0)).Edge());
  sewing.Perform();
  return sewing.SewedShape();
}

/// The sheet as 3 × 3 rectangles, without some of them; row by row from the first y, in each by x. `apart`:
/// each on a cylinder of its own, whose parameters begin elsewhere.
TopoDS_Shape rectangles(const std::vector<int>& left, bool apart) {
  const double half = std::asin(300 / kRadius);
  BRepBuilderAPI_Sewing sewing(1e-5);
  for (int k = 0; k < 9; ++k) {
    if (std::ranges::find(left, k) != left.end()) continue;
    const double turn = apart ? 0.7 * k : 0, shift = apart ? 40.0 * k : 0, way = apart && k % 2 ? -1 : 1;
    const gp_Ax3 axis(gp_Pnt(0, -350 + shift, -kRadius), gp_Dir(0, way, 0),
                      gp_Dir(std::sin(turn), 0, std::cos(turn)));
    // From angles about +y off the vertical, and places along y, to the parameters of this cylinder.
    const double u0 = way * (half * (2 * (k % 3) / 3.0 - 1) - turn),
                 u1 = way * (half * (2 * (k % 3 + 1) / 3.0 - 1) - turn);
    const double v0 = way * (700 * (k / 3) / 3.0 - shift), v1 = way * (700 * (k / 3 + 1) / 3.0 - shift);
    sewing.Add(BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axis, kRadius), std::min(u0, u1),
                                       std::max(u0, u1), std::min(v0, v1), std::max(v0, v1), 1e-7)
                   .Face());
  }
  sewing.Perform();
  return sewing.SewedShape();
}

/// Expects the sections of `parts` to be those of `whole`, wherever the blocks lie, by both routes.
void expectSections(const TopoDS_Shape& whole, const TopoDS_Shape& parts, int faces,
                    const std::string& what) {
  const Cut all = along(targetOf(whole, allFaces()));
  const Target target = targetOf(parts, allFaces());
  EXPECT_EQ(int(target.faces().size()), faces) << what;
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut cut = along(target, route);
    ASSERT_EQ(cut.sections.size(), 15u) << what << ": none is left out";
    for (std::size_t i = 0; i < cut.sections.size(); ++i) {
      const PlanarCurve &curve = cut.sections[i].curve(), &straight = all.sections[i].curve();
      EXPECT_NEAR(curve.length(), straight.length(), 0.1) << what << i;
      for (const Eigen::Vector2d& q : curve.sample(61)) {
        const Eigen::Vector2d p = all.sections[i].frame.toLocal(cut.sections[i].frame.toWorld(q)).head<2>();
        EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << what << i;
      }
    }
  }
}

/// Expects distances from the surfaces of `parts` continued to be those from `whole`.
void expectDistances(const TopoDS_Shape& whole, const TopoDS_Shape& parts, const std::string& what) {
  const Target all = targetOf(whole, allFaces()), some = targetOf(parts, allFaces());
  const std::unique_ptr<SurfaceSampler> full = all.sampler(), sampler = some.sampler();
  for (const Section& section : along(all).sections)
    for (const Eigen::Vector2d& q : section.curve().sample(41))
      for (const double off : {0.0, 0.4, -0.4}) {
        const PlanarCurve& curve = section.curve();
        const Eigen::Vector2d t = curve.tangent(curve.nearestParameter(q));
        const Eigen::Vector3d p =
            section.frame.toWorld(Eigen::Vector2d(q + off * Eigen::Vector2d(-t.y(), t.x())));
        const auto expected = full->closest(p, nullptr), foot = sampler->closest(p, nullptr);
        ASSERT_TRUE(expected && foot);
        EXPECT_NEAR(sampler->offset(p, *foot), full->offset(p, *expected), 2e-3) << what << p.transpose();
      }
}

TEST(Carriers, ANotchThatTakesTheOuterFace) {
  const TopoDS_Shape two = sheetInParts({{0, 0}});
  for (const auto& [x0, x1, faces, width] :
       {std::tuple(-50.0, 400.0, 3, 350.0), {0.0, 400.0, 3, 300.0}, {-400.0, 90.0, 3, 390.0}}) {
    const TopoDS_Shape parts = without(two, {boxAt(x0, x1, -60, 60)});
    const std::string what = "notch from " + std::to_string(x0) + ", ";
    expectSections(sheet(), parts, faces, what);
    expectDistances(sheet(), parts, what);
    EXPECT_NEAR(longestExtension(along(targetOf(parts, allFaces())).findings), width, 16) << "along the arc";
  }
}

TEST(Carriers, AndTheFaceBesideIt) {
  const TopoDS_Shape parts = without(arcsAndPlane(), {boxAt(20, 600, -60, 60)});
  expectSections(arcsAndPlane(), parts, 4, "into the plane ");
  expectDistances(arcsAndPlane(), parts, "into the plane ");
  const TopoDS_Shape deeper = without(arcsAndPlane(), {boxAt(-600, 90, -60, 60)});
  expectSections(arcsAndPlane(), deeper, 5, "through the plane ");
  expectDistances(arcsAndPlane(), deeper, "through the plane ");
}

TEST(Carriers, ANotchThatPartsTheOuterFace) {
  // From the side askew to the edge between both faces and beyond: planes there meet the outer one twice.
  const TopoDS_Shape slot = prism({{400, 100}, {400, 130}, {-30, -50}, {-30, -80}});
  const TopoDS_Shape parts = without(sheetInParts({{0, 0}}), {slot});
  expectSections(sheet(), parts, 3, "slot ");
  expectDistances(sheet(), parts, "slot ");
  EXPECT_NEAR(widestGap(along(targetOf(parts, allFaces())).findings), 74.5, 1);
}

TEST(Carriers, AWindowOverAWholeStrip) {
  const TopoDS_Shape strips = sheetInParts({{-30, 0}, {30, 0}});
  for (const double half : {80.0, 30.0}) {
    const TopoDS_Shape parts = without(strips, {boxAt(-half, half, -80, 80)});
    expectSections(sheet(), parts, 4, "strip ");
    expectDistances(sheet(), parts, "strip ");
    EXPECT_NEAR(widestGap(along(targetOf(parts, allFaces())).findings), 2 * half, 1);
  }
}

TEST(Carriers, AWindowOverAStripOfAnotherSurface) {
  for (const auto& [x0, x1] : {std::pair(-90.0, 90.0), {-50.0, 50.0}, {-50.0, 90.0}, {-170.0, 60.0}}) {
    const TopoDS_Shape parts = without(arcsAndPlane(), {boxAt(x0, x1, -80, 80)});
    const std::string what = "window from " + std::to_string(x0) + " ";
    expectSections(arcsAndPlane(), parts, 4, what);
    expectDistances(arcsAndPlane(), parts, what);
    EXPECT_NEAR(widestGap(along(targetOf(parts, allFaces())).findings), x1 - x0, 8) << what;
  }
}

TEST(Carriers, InABlockThatHoldsAPartOfThem) {
  CutSettings settings;
  settings.stations = 31;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.block = BlockPlacement{{-150, -300, -100}, {300, 500, 150}};
  const Target whole = targetOf(sheet());
  for (const TopoDS_Shape& parts : {without(sheetInParts({{-30, 0}, {30, 0}}), {boxAt(-80, 80, -80, 80)}),
                                    without(sheetInParts({{0, 0}}), {boxAt(-50, 400, -60, 60)}),
                                    rectangles({4}, false), rectangles({5}, true)}) {
    const Target target = targetOf(parts, allFaces());
    for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
      settings.route = route;
      const Cut all = cutOf(whole, settings), cut = cutOf(target, settings);
      ASSERT_EQ(cut.sections.size(), 31u);
      for (std::size_t i = 0; i < cut.sections.size(); ++i)
        EXPECT_NEAR(cut.sections[i].curve().length(), all.sections[i].curve().length(), 0.1) << i;
    }
  }
}

TEST(Carriers, RectanglesThatAreNotThere) {
  for (const bool apart : {false, true})
    for (const std::vector<int>& left :
         {std::vector<int>{4}, {5}, {3}, {0}, {8}, {1}, {4, 5}, {0, 2, 6, 8}}) {
      const TopoDS_Shape parts = rectangles(left, apart);
      const std::string what = "without " + std::to_string(left.front()) + " ";
      expectSections(sheet(), parts, 9 - int(left.size()), what);
      expectDistances(sheet(), parts, what);
    }
}

TEST(Carriers, APointIsWidenedUntilItHoldsABlade) {
  const auto pointed = [](const TopoDS_Shape& shape, double start) {
    return without(shape, {prism({{310, start}, {310, 360}, {0, 360}, {0, 350}, {300, start}}),
                           prism({{-310, start}, {-310, 360}, {0, 360}, {0, 350}, {-300, start}})});
  };
  for (const double start : {150.0, -340.0})
    for (const TopoDS_Shape& parts : {pointed(sheet(), start), pointed(sheetInParts({{0, 0}}), start)})
      for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
        const Cut cut = along(targetOf(parts, allFaces()), route);
        ASSERT_EQ(cut.sections.size(), 15u) << "the last one has 0.1 mm of its own";
        double longest = 0;
        for (const Section& section : cut.sections) longest = std::max(longest, section.curve().length());
        EXPECT_NEAR(cut.sections[14].curve().length(), 0.0101 * longest, 0.05);
        EXPECT_NEAR(longestExtension(cut.findings), 0.005 * longest, 0.2);
        for (const Eigen::Vector2d& q : cut.sections[14].curve().sample(21)) {
          const Eigen::Vector3d p = cut.sections[14].frame.toWorld(q);
          EXPECT_NEAR(std::hypot(p.x(), p.z() + kRadius), kRadius, 1e-3);
        }
      }
}

TEST(Carriers, ToOneSideWhereTheSurfaceEndsOnTheOther) {
  const TopoDS_Shape parts = without(sheet(), {prism({{310, -100}, {310, 360}, {-300, 360}, {-300, 350}})});
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut cut = along(targetOf(parts), route);
    ASSERT_EQ(cut.sections.size(), 15u);
    EXPECT_NEAR(longestExtension(cut.findings), 0.0101 * 2 * kRadius * std::asin(300 / kRadius), 0.4);
  }
}

TEST(Carriers, NotAPointAtWhichTheSurfaceEndsToo) {
  // The whole of a spline over a triangle: two sides of its rectangle meet in the point.
  const std::string fan = stepOf([](double u, double v) {
    const double x = 300 * (2 * u - 1) * (1 - v), y = 700 * v;
    return Eigen::Vector3d(x, y, -x * x / 1800);
  });
  const Cut cut = along(targetOf(fan));
  EXPECT_EQ(longestExtension(cut.findings), 0);
  EXPECT_TRUE(std::ranges::any_of(
      cut.findings, [](const Finding& f) { return std::holds_alternative<SectionShort>(f.cause); }));
}

TEST(Carriers, DistancesAtTheSideOfAMissingCornerWhereTheNormalLeansOut) {
  // A sheet of a sphere: beside the plane of its first and last section the normals lean out of it.
  const gp_Ax3 axis(gp_Pnt(0, 0, -kRadius), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1));
  const TopoDS_Shape whole =
      BRepBuilderAPI_MakeFace(new Geom_SphericalSurface(axis, kRadius), -0.35, 0.35, -0.4, 0.4, 1e-7).Face();
  TopTools_ListOfShape faces, tools;
  faces.Append(whole);
  tools.Append(
      BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)), -2000, 2000, -2000, 2000).Face());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(faces);
  splitter.SetTools(tools);
  splitter.Build();
  for (const auto& [y0, y1] : {std::pair(120.0, 900.0), {-60.0, 60.0}})
    expectDistances(whole, without(splitter.Shape(), {boxAt(0, 900, y0, y1)}), "of a sphere ");
}

TEST(Carriers, NotWhereNothingIsLeftOfASurface) {
  // A notch of the end over the plane between both arcs: of the plane nothing is left beyond its start.
  const TopoDS_Shape parts = without(arcsAndPlane(), {boxAt(-90, 90, -100, 400)});
  const Cut cut = along(targetOf(parts, allFaces()));
  EXPECT_LT(cut.sections.size(), 15u);
  EXPECT_TRUE(std::ranges::any_of(
      cut.findings, [](const Finding& f) { return std::holds_alternative<SectionBranches>(f.cause); }));
}

}  // namespace
}  // namespace bw::geometry::test
