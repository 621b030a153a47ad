// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Faces with holes and notches: sections go on across them on the surface under the face, and distances
// there are those from that surface.

#include <BRepAlgoAPI_Cut.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <gp.hxx>

#include "sheets.h"

namespace bw::geometry::test {
namespace {

TEST(Bridging, SectionsGoOnAcrossAWindow) {
  const Target whole = targetOf(sheet());
  const Target holed = targetOf(BRepAlgoAPI_Cut(sheet(), boxAt(-80, 80, -80, 80)).Shape());
  EXPECT_LT(holed.area(), whole.area() - 25000);
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut a = along(whole, route), b = along(holed, route);
    ASSERT_EQ(b.sections.size(), 15u);
    for (std::size_t i = 0; i < a.sections.size(); ++i) {
      EXPECT_NEAR(a.sections[i].curve().length(), b.sections[i].curve().length(), 1e-3) << i;
      for (const Eigen::Vector2d& p : b.sections[i].curve().sample(61)) {
        const PlanarCurve& straight = a.sections[i].curve();
        EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << i;
      }
    }
    EXPECT_NEAR(widestGap(b.findings), 160, 1) << "along the arc it is a little more than across";
    EXPECT_EQ(widestGap(a.findings), 0);
  }
}

TEST(Bridging, AndAcrossANotch) {
  const Target u = targetOf(BRepAlgoAPI_Cut(sheet(), boxAt(-150, 150, -100, 400)).Shape());
  const Cut cut = along(u);
  ASSERT_EQ(cut.sections.size(), 15u) << "none is left out";
  for (const Section& section : cut.sections)
    EXPECT_NEAR(section.curve().length(), 2 * kRadius * std::asin(300 / kRadius), 0.1);
  EXPECT_NEAR(widestGap(cut.findings), 2 * kRadius * std::asin(150 / kRadius), 0.1);
}

TEST(Bridging, AlsoWhereTheSurfaceRisesOverTheRestInBetween) {
  // The crest of a dome, cut out: the block around what is left has to hold it.
  const double radius = 900, half = std::asin(300 / radius);
  const gp_Ax3 axis(gp_Pnt(0, 0, -radius), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1));
  const TopoDS_Shape dome =
      BRepBuilderAPI_MakeFace(new Geom_SphericalSurface(axis, radius), -half, half, -half, half, 1e-7).Face();
  const Target holed = targetOf(BRepAlgoAPI_Cut(dome, boxAt(-150, 150, -150, 150)).Shape());
  const double below = holed.bounds().max.z();
  EXPECT_LT(below, -10);
  const Cut cut = along(holed);
  ASSERT_EQ(cut.sections.size(), 15u) << "none is left out";
  EXPECT_NEAR(cut.setup.block.frame.origin.z() + cut.setup.block.size.z(), 5, 0.1);
  EXPECT_NEAR(widestGap(cut.findings), 2 * radius * std::asin(150 / radius), 1);
  // Through the top of a given block that ends where the target does it goes out and comes back.
  CutSettings low;
  low.stations = 15;
  low.direction = Eigen::Vector3d::UnitY();
  low.block = BlockPlacement{{-300, -300, -150}, {600, 600, 150 + below}, {0, 0, 0}};
  const Cut over = cutOf(holed, low);
  ASSERT_EQ(over.sections.size(), 15u) << "none is left out";
  for (const Section& section : over.sections)
    for (const Eigen::Vector2d& p : section.curve().sample(61))
      EXPECT_NEAR((section.frame.toWorld(p) - Eigen::Vector3d(0, 0, -radius)).norm(), radius, 2e-3);
  EXPECT_NEAR(widestGap(over.findings), 2 * radius * std::asin(150 / radius), 1);
  // One of which the most of it lies above is told how much higher it has to be.
  low.block = BlockPlacement{{-300, -300, -150}, {600, 600, 120}, {0, 0, 0}};
  const Cut split = cutOf(holed, low);
  const auto several = std::ranges::find_if(
      split.findings, [](const Finding& f) { return std::holds_alternative<SectionBranches>(f.cause); });
  ASSERT_NE(several, split.findings.end());
  EXPECT_NEAR(std::get<SectionBranches>(several->cause).above, 30, 0.2);
  EXPECT_EQ(std::get<SectionBranches>(several->cause).below, 0);
  // One that is too narrow is not.
  low.block = BlockPlacement{{-300, -300, -150}, {250, 600, 120}, {0, 0, 0}};
  for (const Finding& finding : cutOf(holed, low).findings) {
    const auto* parts = std::get_if<SectionBranches>(&finding.cause);
    EXPECT_TRUE(!parts || parts->above == 0);
  }
}

TEST(Bridging, AndBeyondStepsOfTheSides) {
  const Cut whole = along(targetOf(sheet()));
  EXPECT_EQ(longestExtension(whole.findings), 0);
  const double all = 2 * kRadius * std::asin(300 / kRadius);
  const double piece = all / 2 - kRadius * std::asin(180 / kRadius);
  // A notch of the left side; the right one; corners at the start, at the end; all four at once.
  for (const std::vector<TopoDS_Shape>& cuts : {std::vector<TopoDS_Shape>{boxAt(-400, -180, -60, 140)},
                                                {boxAt(180, 400, -60, 140)},
                                                {boxAt(-400, -180, -400, -100)},
                                                {boxAt(180, 400, 100, 400)},
                                                {boxAt(-400, -180, -400, -200), boxAt(180, 400, -400, -200),
                                                 boxAt(-400, -180, 200, 400), boxAt(180, 400, 200, 400)}}) {
    TopoDS_Shape shape = sheet();
    for (const TopoDS_Shape& tool : cuts) shape = BRepAlgoAPI_Cut(shape, tool).Shape();
    for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
      const Cut cut = along(targetOf(shape), route);
      ASSERT_EQ(cut.sections.size(), 15u);
      for (std::size_t i = 0; i < cut.sections.size(); ++i) {
        const PlanarCurve &curve = cut.sections[i].curve(), &straight = whole.sections[i].curve();
        EXPECT_NEAR(curve.length(), all, 0.1) << i;
        for (const Eigen::Vector2d& p : curve.sample(61))
          EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << i;
      }
      EXPECT_NEAR(longestExtension(cut.findings), piece, 1);
    }
  }
}

TEST(Bridging, NotAlongBordersThatAreNoSteps) {
  // Sides that run in by 30° and out again are the outline that somebody drew.
  BRepBuilderAPI_MakePolygon triangle(gp_Pnt(-400, -300, -300), gp_Pnt(-180, 0, -300),
                                      gp_Pnt(-400, 300, -300), true);
  const TopoDS_Shape wedge =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(triangle.Wire()).Face(), gp_Vec(0, 0, 600)).Shape();
  const Cut cut = along(targetOf(BRepAlgoAPI_Cut(sheet(), wedge).Shape()));
  ASSERT_EQ(cut.sections.size(), 15u);
  EXPECT_EQ(longestExtension(cut.findings), 0);
  EXPECT_LT(cut.sections[7].curve().length(), 500);
}

TEST(Bridging, NorWhereTheSurfaceEnds) {
  // A plane is as large as the box around its face; beyond that nothing is known of it.
  const Target target = targetOf(BRepAlgoAPI_Cut(sheet(), boxAt(-400, -180, -60, 140)).Shape());
  const Target smaller = targetOf(BRepAlgoAPI_Cut(sheet(), boxAt(-400, -180, -400, 400)).Shape());
  EXPECT_GT(longestExtension(along(target).findings), 100);
  EXPECT_EQ(longestExtension(along(smaller).findings), 0);
}

TEST(Bridging, NotWhereAnotherFaceGoesOn) {
  // The window is filled by a face of its own, of the same file: with it there is nothing to be bridged.
  TopTools_ListOfShape faces, tools;
  faces.Append(sheet());
  tools.Append(boxAt(-80, 80, -80, 80));
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(faces);
  splitter.SetTools(tools);
  splitter.Build();
  FaceChoice all;
  all.kind = FaceChoice::Kind::all;
  const Cut both = along(targetOf(splitter.Shape(), all));
  ASSERT_EQ(both.sections.size(), 15u);
  EXPECT_EQ(widestGap(both.findings), 0);
  const Cut frame = along(targetOf(splitter.Shape()));
  ASSERT_EQ(frame.sections.size(), 15u);
  EXPECT_GT(widestGap(frame.findings), 159) << "the frame alone";
}

TEST(Bridging, DistancesAreFromTheSurfaceContinued) {
  const Target holed = targetOf(BRepAlgoAPI_Cut(sheet(), boxAt(-80, 80, -80, 80)).Shape());
  const std::unique_ptr<SurfaceSampler> sampler = holed.sampler();
  for (const double off : {0.0, 0.5, -0.5, 12.0, -12.0})
    for (const double angle : {0.0, 0.03, -0.07})
      for (const double y : {0.0, 35.0, -60.0}) {
        const double r = kRadius + off;
        const Eigen::Vector3d p(r * std::sin(angle), y, r * std::cos(angle) - kRadius);
        const auto foot = sampler->closest(p, nullptr);
        ASSERT_TRUE(foot);
        EXPECT_GT(foot->distance, 15) << "its border is far";
        EXPECT_TRUE(foot->onBoundary);
        EXPECT_NEAR(sampler->offset(p, *foot), off, 1e-6);
      }
  // Beyond the sheet, which is bent on as it is at its end; never farther than the border is.
  const auto place = [](double angle, double off) {
    return Eigen::Vector3d((kRadius + off) * std::sin(angle), 0, (kRadius + off) * std::cos(angle) - kRadius);
  };
  const double end = std::asin(300 / kRadius);
  for (const double beyond : {0.5, 5.0, 50.0})
    for (const double off : {0.2, -0.4}) {
      const Eigen::Vector3d p = place(end + beyond / kRadius, off);
      const auto foot = sampler->closest(p, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(sampler->offset(p, *foot), off, 1e-5) << beyond;
      EXPECT_NEAR(foot->distance, (p - place(end, 0)).norm(), 1e-6);
    }
}

TEST(Bridging, DistancesAcrossAGapThatSewingClosedAreFromTheSurfaceContinued) {
  const auto face = [](double x0, double x1) {
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(x0, 0, 0.01 * x0), gp_Pnt(x1, 0, 0.01 * x1),
                                    gp_Pnt(x1, 500, 0.01 * x1), gp_Pnt(x0, 500, 0.01 * x0), true);
    return BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
  };
  std::ostringstream text;
  BRepTools::Write(together({face(0, 300), face(310, 600)}), text);
  ReadOptions options;
  options.sewing = 20;
  const auto model = CadModel::readBytes(text.str(), "halves.brep", {}, options);
  ASSERT_TRUE(model);
  const Target target = Target::make(*model, allFaces()).value();
  const auto sampler = target.sampler();
  const Eigen::Vector3d up = Eigen::Vector3d(-0.01, 0, 1).normalized();
  for (const double x : {250.0, 301.0, 305.0, 309.5, 400.0})
    for (const double off : {0.0, 0.4, -3.0}) {
      const Eigen::Vector3d p = Eigen::Vector3d(x, 250, 0.01 * x) + off * up;
      const auto foot = sampler->closest(p, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(sampler->offset(p, *foot), off, 1e-6) << x;
    }
}

TEST(Sections, OfFacesThatMeetInAVertexOfThePlaneAreWhole) {
  // The plane of the middle station touches two of the four parts in the vertex alone.
  expectWhole(sheetInParts({{0, 40.6}, {0, -40.6}}), 4, "diagonals ");
  const gp_Pnt middle(0, 0, 0);
  const gp_Pnt corners[] = {{-300, -350, 0}, {300, -350, 0}, {300, 350, 0}, {-300, 350, 0}};
  std::vector<TopoDS_Shape> triangles;
  for (int k = 0; k < 4; ++k) {
    BRepBuilderAPI_MakePolygon wire(middle, corners[k], corners[(k + 1) % 4], true);
    triangles.push_back(BRepBuilderAPI_MakeFace(wire.Wire(), true).Face());
  }
  const Target flat = targetOf(together(triangles), allFaces());
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut cut = along(flat, route);
    ASSERT_EQ(cut.sections.size(), 15u);
    for (const Section& section : cut.sections) EXPECT_NEAR(section.curve().length(), 600, 1e-6);
  }
}

TEST(Bridging, AcrossAWindowOverTheEdgeOfTwoFaces) {
  const auto windowIn = [](const TopoDS_Shape& shape) {
    return BRepAlgoAPI_Cut(shape, boxAt(-80, 80, -80, 80)).Shape();
  };
  for (const auto& [x, degrees] : {std::pair(0.0, 0.0), {37.0, 0.0}, {0.0, 20.0}, {10.0, -35.0}}) {
    const TopoDS_Shape holed = windowIn(sheetInParts({{x, degrees}}));
    expectWhole(holed, 2, "at " + std::to_string(degrees) + "° ");
    EXPECT_NEAR(widestGap(along(targetOf(holed, allFaces())).findings), 160, 1);
  }
}

TEST(Bridging, AndNotchesOverTwoFaces) {
  const auto cutFrom = [](const TopoDS_Shape& shape, const TopoDS_Shape& tool) {
    return BRepAlgoAPI_Cut(shape, tool).Shape();
  };
  expectWhole(cutFrom(sheetInParts({{0, 0}}), boxAt(-150, 150, -100, 400)), 2, "from the end ");
  expectWhole(cutFrom(sheetInParts({{0, 15}}), boxAt(-150, 150, -100, 400)), 2, "from the end, askew ");
}

TEST(Bridging, WhereOneCarrierGoesOverIntoAnother) {
  const Cut whole = along(targetOf(arcAndTangent(), allFaces()));
  const Target holed =
      targetOf(BRepAlgoAPI_Cut(arcAndTangent(), boxAt(40, 170, -80, 80)).Shape(), allFaces());
  ASSERT_EQ(holed.faces().size(), 2u);
  const Cut cut = along(holed);
  ASSERT_EQ(whole.sections.size(), 15u);
  ASSERT_EQ(cut.sections.size(), 15u);
  for (std::size_t i = 0; i < cut.sections.size(); ++i)
    for (const Eigen::Vector2d& q : cut.sections[i].curve().sample(61)) {
      // The block may lie elsewhere: in the frame of the whole.
      const Eigen::Vector2d p = whole.sections[i].frame.toLocal(cut.sections[i].frame.toWorld(q)).head<2>();
      const PlanarCurve& straight = whole.sections[i].curve();
      EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << i;
    }
  EXPECT_GT(widestGap(cut.findings), 130);
  // Deviation there is from whichever of both goes on.
  const std::unique_ptr<SurfaceSampler> sampler = holed.sampler();
  for (const Eigen::Vector2d& q : whole.sections[7].curve().sample(101))
    for (const double off : {0.0, 0.4, -0.4}) {
      const PlanarCurve& curve = whole.sections[7].curve();
      const Eigen::Vector2d t = curve.tangent(curve.nearestParameter(q));
      const Eigen::Vector3d p =
          whole.sections[7].frame.toWorld(Eigen::Vector2d(q + off * Eigen::Vector2d(-t.y(), t.x())));
      const auto foot = sampler->closest(p, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_NEAR(std::abs(sampler->offset(p, *foot)), std::abs(off), 2e-3) << q.x();
    }
}

TEST(Bridging, OverASlotThatPartsTheSheet) {
  const Cut whole = along(targetOf(sheet()));
  for (const double half : {1.0, 20.0}) {
    const TopoDS_Shape parted =
        BRepAlgoAPI_Cut(sheetInParts({{0, 0}}), boxAt(-half, half, -400, 400)).Shape();
    for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
      const Cut cut = along(targetOf(parted, allFaces()), route);
      ASSERT_EQ(cut.sections.size(), 15u) << half << ": none is left out";
      EXPECT_NEAR(widestGap(cut.findings), 2 * half, 0.1);
      for (std::size_t i = 0; i < cut.sections.size(); ++i) {
        const PlanarCurve &curve = cut.sections[i].curve(), &straight = whole.sections[i].curve();
        EXPECT_NEAR(curve.length(), straight.length(), 0.01);
        for (const Eigen::Vector2d& p : curve.sample(201))
          EXPECT_LT((straight.value(straight.nearestParameter(p)) - p).norm(), 2e-3) << i;
      }
    }
    // A block that ends below both rims is told how much higher it has to be.
    CutSettings low;
    low.stations = 15;
    low.direction = Eigen::Vector3d::UnitY();
    low.block = BlockPlacement{{-300, -350, -150}, {600, 700, 147}, {0, 0, 0}};
    const Target target = targetOf(parted, allFaces());
    Findings findings;
    const auto setup = resolveSetup(target, low, findings);
    ASSERT_TRUE(setup);
    EXPECT_FALSE(cutSections(target, *setup, low, {}, findings));
    const auto several = std::ranges::find_if(
        findings, [](const Finding& f) { return std::holds_alternative<SectionBranches>(f.cause); });
    ASSERT_NE(several, findings.end());
    EXPECT_NEAR(std::get<SectionBranches>(several->cause).above, 3, 0.3);
    EXPECT_EQ(std::get<SectionBranches>(several->cause).below, 0);
  }
}

namespace {

/// A dome of a sphere of 800 mm without what lies nearer to its pole than `hole` mm, as far out as `base`.
Handle(Geom_Surface) domeSurface() {
  return new Geom_SphericalSurface(gp_Ax3(gp_Pnt(0, 0, -800), gp::DZ()), 800);
}

/// Expects sections to lie on that sphere, over its hole, too, and distances there to be those from it.
void expectOnSphere(const Target& ring, double hole, double within) {
  CutSettings settings;
  settings.stations = 15;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.block = BlockPlacement{{-200, -200, -120}, {400, 400, 150}, {0, 0, 0}};
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    settings.route = route;
    const Cut cut = cutOf(ring, settings);
    ASSERT_EQ(cut.sections.size(), 15u) << hole << ": none is left out";
    EXPECT_NEAR(widestGap(cut.findings), 2 * hole, 0.02 * hole) << "of the middle one";
    for (const Section& section : cut.sections) {
      ASSERT_GE(section.chosen, 0);
      for (const Eigen::Vector2d& p : section.curve().sample(201))
        EXPECT_NEAR((section.frame.toWorld(p) - Eigen::Vector3d(0, 0, -800)).norm(), 800, 2e-3) << hole;
    }
  }
  const std::unique_ptr<SurfaceSampler> sampler = ring.sampler();
  for (const double off : {0.0, 1.5, -1.5})
    for (const double part : {0.1, 0.5, 0.9}) {
      const double angle = std::asin(part * hole / 800);
      const Eigen::Vector3d p((800 + off) * std::sin(angle), 0, (800 + off) * std::cos(angle) - 800);
      const auto foot = sampler->closest(p, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_TRUE(foot->onBoundary);
      EXPECT_NEAR(sampler->offset(p, *foot), off, within) << part * hole;
    }
}

}  // namespace

TEST(Bridging, OverAHoleAtThePoleOfASphere) {
  for (const double hole : {15.0, 60.0, 140.0, 180.0}) {
    const double from = std::acos(280.0 / 800), to = std::acos(hole / 800);
    const TopoDS_Face sphere = BRepBuilderAPI_MakeFace(domeSurface(), 0, 2 * M_PI, from, to, 1e-7).Face();
    expectOnSphere(targetOf(sphere), hole, 0.002);
    // As other modellers write it: the surface ends with the face.
    Handle(Geom_Surface) ring = new Geom_RectangularTrimmedSurface(domeSurface(), 0, 2 * M_PI, from, to);
    const TopoDS_Face spline =
        BRepBuilderAPI_MakeFace(GeomConvert::SurfaceToBSplineSurface(ring), 1e-7).Face();
    expectOnSphere(targetOf(spline), hole, 0.002);
  }
}

namespace {

TopoDS_Face floorOf(double x0, double x1, double z0, double z1) {
  BRepBuilderAPI_MakePolygon border(gp_Pnt(x0, -300, z0), gp_Pnt(x1, -300, z1), gp_Pnt(x1, 300, z1),
                                    gp_Pnt(x0, 300, z0), true);
  return BRepBuilderAPI_MakeFace(border.Wire()).Face();
}

}  // namespace

TEST(Bridging, OverASlotBesideWhichTheSheetHasKinks) {
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (const TopoDS_Face& face : {floorOf(-300, -200, 20, 0), floorOf(-200, -20, 0, 0),
                                  floorOf(20, 150, 0, 0), floorOf(150, 300, 0, 30)})
    sewing.Add(face);
  sewing.Perform();
  const Target target = targetOf(sewing.SewedShape(), allFaces());
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    const Cut cut = along(target, route);
    ASSERT_EQ(cut.sections.size(), 15u);
    for (const Section& section : cut.sections) {
      ASSERT_GE(section.chosen, 0);
      EXPECT_NEAR(section.curve().length(), std::hypot(100, 20) + 350 + std::hypot(150, 30), 1e-3);
      for (const double x : {-200.0, 150.0}) {
        const Eigen::Vector2d kink =
            section.frame.toLocal(Eigen::Vector3d(x, section.frame.origin.y(), 0)).head<2>();
        const PlanarCurve& curve = section.curve();
        EXPECT_LT((curve.value(curve.nearestParameter(kink)) - kink).norm(), 1e-3);
      }
    }
  }
}

TEST(Bridging, OverASlotWithCornersInThePlanesOfStations) {
  // Teeth whose corners lie in the planes of the stations, as nearly as numbers tell.
  const TopoDS_Face whole = floorOf(-300, 300, 0, 0);
  for (const double shift : {0.0, 1e-12, -1e-12, 1e-10, -1e-10}) {
    BRepBuilderAPI_MakePolygon slot;
    for (int k = 0; k <= 12; ++k) slot.Add(gp_Pnt(k % 2 ? 10 : -30, -300 + 50 * k + shift, -100));
    for (int k = 12; k >= 0; --k) slot.Add(gp_Pnt(k % 2 ? 15 : 50, -300 + 50 * k + shift, -100));
    slot.Close();
    const TopoDS_Shape tool =
        BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(slot.Wire()).Face(), gp_Vec(0, 0, 200)).Shape();
    const Target target = targetOf(BRepAlgoAPI_Cut(whole, tool).Shape(), allFaces());
    CutSettings settings;
    settings.stations = 25;
    settings.direction = Eigen::Vector3d::UnitY();
    const Cut cut = cutOf(target, settings);
    ASSERT_EQ(cut.sections.size(), 25u) << shift;
    for (const Section& section : cut.sections) {
      ASSERT_GE(section.chosen, 0) << shift << " " << section.index;
      EXPECT_NEAR(section.curve().length(), 600, 1e-3);
    }
    // Beside a tooth that is the face's farthest place distances are those from its surface.
    const std::unique_ptr<SurfaceSampler> sampler = target.sampler();
    for (const double y : {-200.0, -199.98, -200.02, -199.0, -150.0})
      for (const double x : {-10.0, 0.0, 12.0, 40.0}) {
        const Eigen::Vector3d p(x, y, 0.25);
        const auto foot = sampler->closest(p, nullptr);
        ASSERT_TRUE(foot);
        EXPECT_NEAR(std::abs(sampler->offset(p, *foot)), 0.25, 1e-6) << x << " " << y;
      }
  }
}

TEST(Bridging, NotBetweenFacesThatLeadElsewhere) {
  // Two roofs that do not meet over the gap, and two floors at different heights.
  for (const auto& [one, other] : {std::pair(floorOf(-300, -50, 0, 60), floorOf(50, 300, 60, 0)),
                                   {floorOf(-300, -20, 0, 0), floorOf(20, 300, 5, 5)}}) {
    const Target parted = targetOf(together({one, other}), allFaces());
    Findings findings;
    const auto setup = resolveSetup(parted, {{}, Eigen::Vector3d::UnitY()}, findings);
    ASSERT_TRUE(setup);
    EXPECT_FALSE(cutSections(parted, *setup, {9, {}}, {}, findings));
    EXPECT_TRUE(std::ranges::any_of(
        findings, [](const Finding& f) { return std::holds_alternative<SectionBranches>(f.cause); }));
  }
}

}  // namespace
}  // namespace bw::geometry::test
