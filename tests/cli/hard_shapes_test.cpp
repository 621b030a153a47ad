// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Surfaces that no single sweep of a blade makes, as files: what is said of them is true, and no robot gets a
// program of them. And those with holes and notches through their faces, which one makes all the same.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax3.hxx>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

constexpr double kHalfLength = 350;  // of the panels along y, mm
constexpr double kHalfWidth = 300;   // across
constexpr double kTolerance = 2;     // of a job

/// A sheet of a cylinder along y, highest at x = 0, between angles from the top and places along y.
TopoDS_Shape sheet(double radius, double from, double to, double y0, double y1, double lift = 0) {
  const gp_Ax3 axis(gp_Pnt(0, y0, lift - radius), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1));
  return BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(axis, radius), from, to, 0, y1 - y0, 1e-7)
      .Face();
}

/// The same between places across.
TopoDS_Shape panel(double radius, double x0, double x1, double y0, double y1, double lift = 0) {
  return sheet(radius, std::asin(x0 / radius), std::asin(x1 / radius), y0, y1, lift);
}

/// A box that leaves of a panel a base up to y = −100 and two arms.
TopoDS_Shape notch() { return BRepPrimAPI_MakeBox(gp_Pnt(-150, -100, -300), gp_Pnt(150, 400, 300)).Shape(); }

/// A panel as of a cylinder, whose surface has a sharp ridge where `notch` is.
TopoDS_Shape ridged() {
  TColgp_Array2OfPnt points(1, 61, 1, 71);
  for (int i = 1; i <= 61; ++i)
    for (int j = 1; j <= 71; ++j) {
      const double x = -kHalfWidth + 10.0 * (i - 1), y = -kHalfLength + 10.0 * (j - 1);
      const double t = std::clamp((y + 95) / 60, 0.0, 1.0), risen = t * t * (3 - 2 * t);
      points.SetValue(i, j, gp_Pnt(x, y, -x * x / 1800 + risen * 120 * std::exp(-x * x / 2500)));
    }
  return BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(points).Surface(), 1e-6).Face();
}

std::string fileOf(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) builder.Add(all, shape);
  std::ostringstream text;
  BRepTools::Write(all, text);
  return text.str();
}

/// What `blade rationalize` says of it.
struct Said {
  Finished run;
  json report;
  std::set<std::string> errors, warnings;  ///< kinds
  bool programs = false;
  json summary() const { return report["summary"]; }
};

Said said(const Folder& folder, const std::string& file, const std::string& job) {
  Said result;
  result.run = blade({"rationalize", folder.write("shape.brep", file), "--job", folder.write("job.json", job),
                      "--out", folder / "out"});
  for (const std::string& name : folder.files())
    result.programs = result.programs || name.find(".mod") != std::string::npos;
  if (result.run.status > 1) return result;
  result.report = json::parse(slurp(folder / "out/report.json"));
  for (const json& issue : result.report["issues"])
    (issue["severity"] == "error" ? result.errors : result.warnings).insert(issue["kind"]);
  return result;
}

/// mm along y from the start of a panel to its last station.
double reach(const json& report) {
  double farthest = -1e300;
  for (const json& strip : report["strips"])
    for (const json& station : strip["stations"])
      farthest = std::max(farthest, station["frame"]["origin"][1].get<double>());
  return farthest + kHalfLength;
}

const std::string kAcross =
    R"("face": "all", "direction": "y", "blade": {"preset": "steel-tube-3-2.5", "length": 690}, "clearance": 30)";

TEST(HardShapes, OfAUWhoseArmsLieApartTheBaseIsCutAndTheRestIsTold) {
  // The arms are other surfaces than the base, and neither of them leads to the other.
  for (const double base : {250.0, 46.0}) {
    const Folder folder;
    const double seam = base - kHalfLength;
    const Said u = said(folder,
                        fileOf({panel(900, -kHalfWidth, kHalfWidth, -kHalfLength, seam),
                                panel(1000, -kHalfWidth, -150, seam, kHalfLength, -2),
                                panel(1000, 150, kHalfWidth, seam, kHalfLength, -22)}),
                        "{" + kAcross + "}");
    ASSERT_EQ(u.run.status, 1) << u.run.err;
    EXPECT_TRUE(u.errors.contains("coverage")) << u.run.err;
    EXPECT_TRUE(u.warnings.contains("section-branches")) << u.run.err;
    EXPECT_FALSE(u.programs);
    const auto arc = [](double radius, double from, double to) {
      return radius * (std::asin(to / radius) - std::asin(from / radius));
    };
    const double width = arc(900, -kHalfWidth, kHalfWidth), arms = 2 * arc(1000, 150, kHalfWidth);
    const double all = width * base + arms * (2 * kHalfLength - base);
    const double cut = width * std::min(base, reach(u.report) + kTolerance);
    EXPECT_NEAR(u.summary()["covered_percent"].get<double>(), 100 * cut / all, 1);
    // The motion that is there makes what was shown, and is not to be run.
    const Finished run = blade({"simulate", folder / "out"});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_NE(run.err.find("is not cut"), std::string::npos) << run.err;
    const json surface = json::parse(run.out)["surface"];
    EXPECT_LE(surface["deviation_to_design_max_mm"], 0.1);
    EXPECT_LE(surface["deviation_to_design_at_targets_max_mm"], 0.05);
    EXPECT_NEAR(surface["deviation_to_target_max_mm"].get<double>(),
                u.summary()["program_deviation_max_mm"].get<double>(), 0.1);
  }
}

TEST(HardShapes, AUWhoseArmsLeadToEachOtherIsCutAcrossTheGap) {
  const Folder folder;
  const double seam = 46 - kHalfLength;
  const Said u = said(folder,
                      fileOf({panel(900, -kHalfWidth, kHalfWidth, -kHalfLength, seam),
                              panel(1000, -kHalfWidth, -150, seam, kHalfLength, -2),
                              panel(1000, 150, kHalfWidth, seam, kHalfLength, -2)}),
                      "{" + kAcross + "}");
  EXPECT_TRUE(u.programs) << u.run.err;
  EXPECT_NEAR(u.summary()["covered_percent"].get<double>(), 100, 0.1);
  EXPECT_FALSE(u.warnings.contains("section-branches")) << u.run.err;
}

TEST(HardShapes, ADomeWithAnOculusIsCutOverIt) {
  // Its surface ends with the face: nothing is known of what lies in the hole.
  const double radius = 800, hole = 120, rim = 280;
  Handle(Geom_Surface) sphere =
      new Geom_SphericalSurface(gp_Ax3(gp_Pnt(0, 0, -radius), gp_Dir(0, 0, 1)), radius);
  Handle(Geom_Surface) ring = new Geom_RectangularTrimmedSurface(
      sphere, 0, 2 * std::numbers::pi, std::acos(rim / radius), std::acos(hole / radius));
  const Folder folder;
  const Said dome =
      said(folder, fileOf({BRepBuilderAPI_MakeFace(GeomConvert::SurfaceToBSplineSurface(ring), 1e-7).Face()}),
           R"({"direction": "y"})");
  EXPECT_EQ(dome.run.status, 0) << dome.run.err;
  EXPECT_TRUE(dome.programs);
  EXPECT_LT(dome.summary()["deviation_max_mm"], 0.2);
  EXPECT_NEAR(dome.summary()["covered_percent"].get<double>(), 100, 0.1);
  const Finished run = blade({"simulate", folder / "out"});
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(HardShapes, WhatLiesOutsideOfTheBlockIsTold) {
  // A quarter of the panel in a block that is given.
  const TopoDS_Shape whole = panel(900, -kHalfWidth, kHalfWidth, -kHalfLength, kHalfLength);
  {
    const Folder folder;
    const Said part =
        said(folder, fileOf({whole}),
             R"({"direction": "y", "block": {"origin": [0, 0, -250], "size": [330, 400, 280]}})");
    EXPECT_EQ(part.run.status, 0) << part.run.err;
    EXPECT_TRUE(part.warnings.contains("coverage")) << part.run.err;
    EXPECT_NEAR(part.summary()["outside_percent"].get<double>(), 75, 0.1);
    EXPECT_NEAR(part.summary()["covered_percent"].get<double>(), 100, 0.1);
    EXPECT_NE(part.run.err.find("lies outside of the block, up to "), std::string::npos) << part.run.err;
    EXPECT_NE(part.run.err.find(" of the surface in the block covered"), std::string::npos) << part.run.err;
    EXPECT_NE(part.run.err.find("75 % of it lies outside"), std::string::npos) << part.run.err;
  }
  // One that is made around it holds all of it.
  const Folder folder;
  const Said all = said(folder, fileOf({whole}), R"({"direction": "y"})");
  EXPECT_EQ(all.summary()["outside_percent"], 0);
  EXPECT_TRUE(all.warnings.empty()) << all.run.err;
}

TEST(HardShapes, OfASheetThatLeansTheWeightPullsAsItsBlockLies) {
  // It lies on the sheet's back, and leans with it; in the cell it lies flat.
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 1, 0)), std::numbers::pi / 3);
  const std::string file =
      fileOf({BRepBuilderAPI_Transform(panel(900, -kHalfWidth, kHalfWidth, -kHalfLength, kHalfLength), turn)
                  .Shape()});
  const Folder folder;
  const Said own = said(folder, file, R"({"direction": "y"})");
  EXPECT_FALSE(own.warnings.contains("weight")) << own.run.err;
  EXPECT_EQ(own.run.status, 0) << own.run.err;
  // Where another way is asked for that is told.
  const Folder second;
  const Said leaning = said(second, file, R"({"direction": "y", "up": [0, 0, 1]})");
  EXPECT_TRUE(leaning.warnings.contains("weight")) << leaning.run.err;
  EXPECT_NE(leaning.run.err.find("up is 60° off"), std::string::npos) << leaning.run.err;
  const Folder third;
  const Said told = said(third, file, R"({"direction": "y", "up": [0.8660254, 0, 0.5]})");
  EXPECT_FALSE(told.warnings.contains("weight")) << told.run.err;
  EXPECT_EQ(told.run.status, 0) << told.run.err;
  EXPECT_NEAR(told.summary()["deviation_max_mm"].get<double>(),
              own.summary()["deviation_max_mm"].get<double>(), 1e-4);
}

TEST(HardShapes, OfAFileInMetresTheSizeIsAskedAbout) {
  const Folder folder;
  const Said small = said(folder, fileOf({panel(0.9, -0.3, 0.3, -0.35, 0.35)}), R"({"direction": "y"})");
  EXPECT_NE(small.run.err.find("its file being read in"), std::string::npos) << small.run.err;
}

TEST(HardShapes, AUOfOneSurfaceIsCutOnTheSurfaceContinued) {
  const Folder folder;
  const Said u = said(
      folder,
      fileOf(
          {BRepAlgoAPI_Cut(panel(900, -kHalfWidth, kHalfWidth, -kHalfLength, kHalfLength), notch()).Shape()}),
      "{" + kAcross + "}");
  EXPECT_EQ(u.run.status, 0) << u.run.err;
  EXPECT_NEAR(u.summary()["covered_percent"].get<double>(), 100, 0.1);
  EXPECT_TRUE(u.programs);
}

TEST(HardShapes, NotchesAndWindowsThroughFacesAreCutOnTheSurfaceContinued) {
  const auto without = [](TopoDS_Shape shape, const std::vector<std::vector<gp_Pnt>>& outlines) {
    for (const std::vector<gp_Pnt>& corners : outlines) {
      BRepBuilderAPI_MakePolygon outline;
      for (const gp_Pnt& corner : corners) outline.Add(corner);
      outline.Close();
      const TopoDS_Shape tool =
          BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), gp_Vec(0, 0, 600)).Shape();
      shape = BRepAlgoAPI_Cut(shape, tool).Shape();
    }
    return shape;
  };
  const auto rectangle = [](double x0, double x1, double y0, double y1) {
    return std::vector<gp_Pnt>{{x0, y0, -300}, {x1, y0, -300}, {x1, y1, -300}, {x0, y1, -300}};
  };
  const auto strip = [](double x0, double x1) { return panel(900, x0, x1, -kHalfLength, kHalfLength); };
  const std::vector<gp_Pnt> window = rectangle(-80, 80, -80, 80), notch = rectangle(0, 400, -60, 60);
  const std::vector<gp_Pnt> left = {{-310, 150, -300}, {0, 350, -300}, {0, 400, -300}, {-310, 400, -300}},
                            right = {{310, 150, -300}, {310, 400, -300}, {0, 400, -300}, {0, 350, -300}};
  const std::vector<std::pair<std::string, std::vector<TopoDS_Shape>>> files = {
      {"a notch that takes one of two faces",
       {strip(-kHalfWidth, 0), without(strip(0, kHalfWidth), {notch})}},
      {"a window over the whole strip between two faces",
       {without(strip(-kHalfWidth, -30), {window}), without(strip(-30, 30), {window}),
        without(strip(30, kHalfWidth), {window})}},
      {"a rectangle that is missing among others",
       {panel(900, -300, -100, -350, 350), panel(900, 100, 300, -350, -100), panel(900, 100, 300, -100, 100),
        panel(900, 100, 300, 100, 350), panel(900, -100, 100, -350, -100), panel(900, -100, 100, 100, 350)}},
      {"a point at the end", {without(strip(-kHalfWidth, kHalfWidth), {left, right})}}};
  for (const auto& [what, shapes] : files) {
    const Folder folder;
    const Said result = said(folder, fileOf(shapes), "{" + kAcross + "}");
    ASSERT_EQ(result.run.status, 0) << what << result.run.err;
    EXPECT_NEAR(result.summary()["covered_percent"].get<double>(), 100, 0.1) << what;
    EXPECT_LT(result.summary()["deviation_max_mm"].get<double>(), 0.1) << what;
    EXPECT_TRUE(result.programs) << what;
    const Finished run = blade({"simulate", folder / "out"});
    EXPECT_EQ(run.status, 0) << what << run.err;
    EXPECT_LE(json::parse(run.out)["surface"]["deviation_to_target_max_mm"], 0.15) << what;
  }
}

TEST(HardShapes, OfAUWhoseGapNoBladeCrossesWhatItMissesIsTold) {
  const Folder folder;
  const Said u = said(folder, fileOf({BRepAlgoAPI_Cut(ridged(), notch()).Shape()}), "{" + kAcross + "}");
  ASSERT_EQ(u.run.status, 1) << u.run.err;
  EXPECT_TRUE(u.errors.contains("coverage")) << u.run.err;
  EXPECT_TRUE(u.warnings.contains("section-branches")) << u.run.err;
  EXPECT_FALSE(u.programs);
  // Of z = −x²/1800.
  const auto arc = [](double to) {
    const double slope = to / 900;
    return 450 * (slope * std::hypot(1, slope) + std::asinh(slope));
  };
  const double width = 2 * arc(kHalfWidth), arms = width - 2 * arc(150), base = 250;
  const double all = width * base + arms * (2 * kHalfLength - base);
  const double reached = reach(u.report) + kTolerance;
  const double cut = width * std::min(base, reached) + arms * std::max(0.0, reached - base);
  EXPECT_NEAR(u.summary()["covered_percent"].get<double>(), 100 * cut / all, 1.1);
}

TEST(HardShapes, AVaultThatCurlsBackIsNoSweepOfOneBlade) {
  const Folder folder;
  const double half = 150 * std::numbers::pi / 180;
  const Said vault = said(
      folder, fileOf({sheet(100, -half, half, -150, 150)}),
      R"({"direction": "y", "stations": 9, "clearance": 20, "blade": {"section": "flat", "width": 10, "thickness": 0.2,
                              "young_modulus": 200000, "yield_stress": 2000, "length": 800}})");
  ASSERT_EQ(vault.run.status, 1) << vault.run.err;
  EXPECT_TRUE(vault.errors.contains("crossing")) << vault.run.err;
  EXPECT_NEAR(vault.summary()["covered_percent"].get<double>(), 100, 1) << "as a surface it is all there";
  EXPECT_FALSE(vault.programs);
}

}  // namespace
}  // namespace bw::test
