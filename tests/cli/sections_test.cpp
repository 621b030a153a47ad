// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// From the curves of a CAD file to a design and what is cut by it.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

/// "0 LINE 8 walls 10 0": codes and values, a line each.
std::string groups(const std::string& words) {
  std::istringstream stream(words);
  std::string text, word;
  while (stream >> word) text += word + "\n";
  return text;
}

std::string drawing(const std::string& entities, int unit = 4) {
  return groups("0 SECTION 2 HEADER 9 $INSUNITS 70 " + std::to_string(unit) +
                " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

/// z of a gentle surface over 600 × 800 mm.
double height(double x, double y) {
  return 260 + 30 * std::sin(x / 600 * 3.14159265358979) + 15 * std::sin(x / 300 + y / 400);
}

/// A section across y as a polyline in space, from x to x.
std::string polyline(double y, double scale = 1, double from = 0, double to = 600,
                     const char* layer = "roof") {
  std::ostringstream text;
  text.precision(15);
  text << "0 POLYLINE 8 " << layer << " 66 1 70 8 10 0 20 0 30 0 ";
  for (int i = 0; i <= 200; ++i) {
    const double x = from + (to - from) * i / 200;
    text << "0 VERTEX 8 " << layer << " 70 32 10 " << x / scale << " 20 " << y / scale << " 30 "
         << height(x, y) / scale << " ";
  }
  text << "0 SEQEND 8 " << layer << " ";
  return text.str();
}

json surfaceOf(const std::string& design) { return json::parse(slurp(design))["sources"][0]["surface"]; }

TEST(SectionsFromCurves, BecomeADesignThatIsCut) {
  const Folder folder;
  const std::string file = folder.write("roof.dxf", drawing(polyline(0) + polyline(400, 1, 0, 250) +
                                                            polyline(400, 1, 250, 600) + polyline(800)));
  const std::string design = folder / "roof.bladewright";
  const Finished made = blade({"sections", file, "--out", design});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("4 curves of "), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("1 joined to others"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("the loft of 3 sections"), std::string::npos) << made.err;
  const json surface = surfaceOf(design);
  ASSERT_EQ(surface["sections"].size(), 3u);
  EXPECT_EQ(surface["sections"][1]["y"], 400.0);
  for (const json& section : surface["sections"])
    for (const json& point : section["spline"])
      EXPECT_NEAR(point[1].get<double>(), height(point[0], section["y"]), 0.01);
  const Finished cut = blade({"design", design, "--out", folder / "out"});
  EXPECT_EQ(cut.status, 0) << cut.err;
  const json report = json::parse(slurp(folder / "out/report.json"));
  for (const json& issue : report["issues"]) EXPECT_NE(issue["severity"], "error") << issue;
}

TEST(SectionsFromCurves, ADesignThatFollowsItsFileTakesOverItsChanges) {
  const Folder folder;
  const std::string wide = drawing(polyline(0) + polyline(400) + polyline(800)),
                    file = folder.write("roof.dxf", wide), design = folder / "made/roof.bladewright";
  std::filesystem::create_directories(folder / "made");
  const Finished made = blade({"sections", file, "--link", "--out", design});
  ASSERT_EQ(made.status, 0) << made.err;
  const json source = json::parse(slurp(design))["sources"][0];
  EXPECT_EQ(source["drawing"]["path"], "../roof.dxf");
  const Finished same = blade({"design", design, "--out", folder / "out"});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_EQ(same.err.find("has changed"), std::string::npos) << same.err;
  folder.write("roof.dxf", drawing(polyline(0) + polyline(200) + polyline(400) + polyline(800)));
  const Finished changed = blade({"design", design, "--out", folder / "out"});
  EXPECT_EQ(changed.status, 0) << changed.err;
  EXPECT_NE(changed.err.find("the drawing has changed since the design was saved and was read again"),
            std::string::npos)
      << changed.err;
  EXPECT_EQ(surfaceOf(folder / "out/design.bladewright")["sections"].size(), 4u);
  // What it would not be made as again is refused, and nothing written.
  for (const std::vector<std::string>& other :
       std::vector<std::vector<std::string>>{{"--points", "5"}, {"--kind", "ducks"}, {"--unit", "cm"}}) {
    std::vector<std::string> words = {"sections", file, "--link", "--out", folder / "other.bladewright"};
    words.insert(words.end(), other.begin(), other.end());
    const Finished refused = blade(words);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_NE(refused.err.find("leave out " + other.front() + ", or --link"), std::string::npos)
        << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "other.bladewright"));
  }
}

TEST(SectionsFromCurves, OurOwnCurvesAreReadBack) {
  const Folder folder;
  const std::string design = folder / "bump.bladewright", out = folder / "out";
  ASSERT_EQ(blade({"example", "bump", "--out", design}).status, 0);
  ASSERT_EQ(blade({"design", design, "--out", out}).status, 0);
  for (const std::string& file : {out + "/curves.dxf", out + "/curves.step"}) {
    const Finished whole = blade({"sections", file, "--out", folder / "a.bladewright"});
    EXPECT_EQ(whole.status, 2) << file;
    EXPECT_NE(whole.err.find("is closed"), std::string::npos) << whole.err;
    const Finished sides = blade({"sections", file, "--curves", "1,2", "--out", folder / "b.bladewright"});
    EXPECT_EQ(sides.status, 0) << file << sides.err;
    EXPECT_EQ(surfaceOf(folder / "b.bladewright")["sections"].size(), 2u);
  }
}

TEST(SectionsFromCurves, UnitsLayersKindsAndNumbersOfPoints) {
  const Folder folder;
  const std::string all = polyline(0, 25.4) + polyline(800, 25.4) + polyline(1200, 25.4, 0, 600, "other");
  const std::string file = folder.write("inch.dxf", drawing(all, 1)), design = folder / "a.bladewright";
  ASSERT_EQ(blade({"sections", file, "--layer", "roof", "--out", design}).status, 0);
  EXPECT_EQ(surfaceOf(design)["sections"].size(), 2u);
  EXPECT_NEAR(surfaceOf(design)["sections"][1]["y"].get<double>(), 800, 1e-9);
  const Finished none = blade({"sections", file, "--layer", "rooff", "--out", design});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("did you mean \"roof\"?"), std::string::npos) << none.err;
  const Finished asMm = blade({"sections", file, "--unit", "mm", "--out", design});
  EXPECT_EQ(asMm.status, 0) << asMm.err;
  EXPECT_NE(asMm.err.find("taken in mm, the file states inch"), std::string::npos) << asMm.err;
  EXPECT_NEAR(surfaceOf(design)["sections"][1]["y"].get<double>(), 800 / 25.4, 1e-9);
  const Finished three = blade({"sections", file, "--points", "3", "--out", design});
  EXPECT_EQ(three.status, 1) << "the tolerance is not kept, and told: " << three.err;
  for (const json& section : surfaceOf(design)["sections"]) EXPECT_EQ(section["spline"].size(), 3u);
  for (const char* kind : {"bezier", "ducks"}) {
    EXPECT_EQ(blade({"sections", file, "--kind", kind, "--out", design}).status, 0);
    EXPECT_TRUE(surfaceOf(design)["sections"][0].contains(kind));
  }
  EXPECT_NE(
      blade({"sections", file, "--kind", "beziers", "--out", design}).err.find("did you mean \"bezier\"?"),
      std::string::npos);
  EXPECT_NE(blade({"sections", file, "--unit", "yd", "--out", design}).err.find("mm, cm, m and in"),
            std::string::npos);
  for (const std::string other : {"9", "0"}) {
    const std::string told = blade({"sections", file, "--curves", "1," + other, "--out", design}).err;
    EXPECT_NE(told.find("there is no curve " + other + "; they are numbered from 1 to "), std::string::npos)
        << told;
  }
  const Finished unknown =
      blade({"sections", folder.write("mm.dxf", drawing(polyline(0) + polyline(800), 0)), "--out", design});
  EXPECT_EQ(unknown.status, 0);
  EXPECT_NE(unknown.err.find("the file states no unit; --unit gives another"), std::string::npos)
      << unknown.err;
}

TEST(SectionsFromCurves, ALayerIsTakenWhateverLiesOnOthers) {
  const Folder folder;
  const std::string file = folder.write(
      "walls.dxf", drawing("0 CIRCLE 8 holes 10 0 20 0 40 5 " + polyline(0) + polyline(800) +
                           polyline(100, 1, 0, 600, "ceiling") + polyline(700, 1, 0, 600, "ceiling")));
  const std::string design = folder / "a.bladewright";
  const Finished all = blade({"sections", file, "--out", design});
  EXPECT_EQ(all.status, 2);
  EXPECT_NE(all.err.find("curve 1, a circle on the layer holes"), std::string::npos) << all.err;
  EXPECT_NE(all.err.find("its layers are ceiling (2 curves), holes (1 curve) and roof (2 curves), of which "
                         "--layer takes some"),
            std::string::npos)
      << all.err;
  EXPECT_EQ(blade({"sections", file, "--layer", "ceiling", "--out", design}).status, 0);
  EXPECT_EQ(surfaceOf(design)["sections"][0]["y"], 100.0);
  EXPECT_EQ(blade({"sections", file, "--curves", "2-3", "--out", design}).status, 0);
  EXPECT_EQ(surfaceOf(design)["sections"][1]["y"], 800.0);
  const Finished circle = blade({"sections", file, "--curves", "1,2", "--out", design});
  EXPECT_EQ(circle.status, 2);
  EXPECT_NE(circle.err.find("is closed"), std::string::npos) << circle.err;
}

TEST(SectionsFromCurves, SplinesByFitPointsAloneBecomeSections) {
  const Folder folder;
  std::string all;
  for (const int y : {0, 400, 800}) {
    std::ostringstream text;
    text << "0 SPLINE 8 roof 70 8 71 3 72 0 73 0 74 13 ";
    for (int x = 0; x <= 600; x += 50) text << "11 " << x << " 21 " << y << " 31 " << height(x, y) << " ";
    all += text.str();
  }
  const std::string design = folder / "roof.bladewright";
  const Finished made = blade({"sections", folder.write("roof.dxf", drawing(all)), "--out", design});
  ASSERT_EQ(made.status, 0) << made.err;
  const json surface = surfaceOf(design);
  ASSERT_EQ(surface["sections"].size(), 3u);
  for (const json& section : surface["sections"])
    for (const json& point : section["spline"])
      EXPECT_NEAR(point[1].get<double>(), height(point[0], section["y"]), 0.05);
}

TEST(SectionsFromCurves, TheSameBytesForAnyNumberOfThreads) {
  const Folder folder;
  std::string all;
  for (int y = 0; y <= 800; y += 100) all += polyline(y);
  const std::string file = folder.write("roof.dxf", drawing(all));
  for (const char* threads : {"1", "2", "5"})
    ASSERT_EQ(blade({"sections", file, "--threads", threads, "--out",
                     folder / (std::string(threads) + ".bladewright")})
                  .status,
              0);
  EXPECT_EQ(slurp(folder / "2.bladewright"), slurp(folder / "1.bladewright"));
  EXPECT_EQ(slurp(folder / "5.bladewright"), slurp(folder / "1.bladewright"));
}

TEST(SectionsFromCurves, WhatGivesNoDesignIsToldAndWritesNothing) {
  const Folder folder;
  const std::string out = folder / "a.bladewright";
  const auto refused = [&](const std::string& name, const std::string& bytes, int status,
                           const std::string& part) {
    const Finished run = blade({"sections", folder.write(name, bytes), "--out", out});
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err << "\nin place of: " << part;
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  const std::string whole = drawing(polyline(0) + polyline(800));
  refused("one.dxf", drawing(polyline(0)), 2, "there is one curve, curve 1 (roof)");
  refused("circle.dxf", drawing(polyline(0) + "0 CIRCLE 8 holes 10 0 20 0 40 5"), 2,
          "a circle on the layer holes");
  refused("binary.dxf", "AutoCAD Binary DXF\n", 4, "what a binary DXF file begins with is damaged");
  refused("short.dxf", whole.substr(0, whole.size() / 2), 4, "cannot read");
  refused("faces.step", slurp(example("saddle")), 2, "no curves beside its");
  refused("nothing.step", "nothing", 4, "its content is not STEP");
  refused("empty.dxf", "", 4, "is empty");
  EXPECT_EQ(blade({"sections", folder / "one.dxf", "--out", folder / "a.step"}).status, 2);
  EXPECT_EQ(blade({"sections", folder / "gone.dxf", "--out", out}).status, 4);
}

}  // namespace
}  // namespace bw::test
