// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// CAD files as architects have them, from the command line.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.h"
#include "step_merge.h"

namespace bw::test {

using nlohmann::json;

namespace {

/// The saddle (600 × 800) and the cap of a sphere (600 × 600) in one file.
std::string saddleAndCap() { return mergedStep({slurp(example("saddle")), slurp(example("sphere-cap"))}); }

json info(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"info"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Finished run = blade(all);
  EXPECT_EQ(run.status, 0) << run.err;
  return json::parse(run.out);
}

json reportOf(const Folder& folder, const std::string& file, const std::string& job) {
  const Finished run =
      blade({"rationalize", file, "--job", folder.write("job.json", job), "--out", folder / "out"});
  EXPECT_LE(run.status, 1) << run.err;
  return json::parse(slurp(folder / "out/report.json"));
}

}  // namespace

TEST(CadFiles, InfoKeepsItsKeysAndTellsBendingSectionsAndGroups) {
  const Folder folder;
  const json object = info({folder.write("two.step", saddleAndCap())});
  for (const char* key :
       {"file", "format", "unit", "solids", "shells", "faces", "edges", "bounds_mm", "healing", "face_list",
        "read_as", "left_out", "sewing_mm", "curved_tolerance_mm", "groups"})
    EXPECT_TRUE(object.contains(key)) << key;
  EXPECT_EQ(object["curved_tolerance_mm"], 0.1);
  ASSERT_EQ(object["face_list"].size(), 2u);
  const json& cap = object["face_list"][1];
  for (const char* key : {"index", "type", "bounds_mm", "size_mm", "area_mm2", "curvature_range"})
    EXPECT_TRUE(cap.contains(key)) << key;
  EXPECT_EQ(cap["name"], "sphere-cap");
  EXPECT_EQ(cap["curved"], "doubly");
  EXPECT_NEAR(cap["min_radius_mm"].get<double>(), 900, 1e-3);
  ASSERT_EQ(cap["sections"].size(), 2u);
  EXPECT_NEAR(cap["sections"][0]["lengths_mm"][0].get<double>(), 611.7, 0.2);
  EXPECT_EQ(object["groups"].size(), 2u);
  EXPECT_EQ(object["groups"][0]["faces"], json({0}));
}

TEST(CadFiles, UnitOfTheJobAndOfInfoOverrulesTheFile) {
  const Folder folder;
  const json object = info({example("saddle"), "--unit", "in"});
  EXPECT_EQ(object["unit"], "mm");
  EXPECT_EQ(object["read_as"], "in");
  EXPECT_NEAR(object["bounds_mm"]["max"][0].get<double>(), 300 * 25.4, 1e-6);
  EXPECT_EQ(blade({"info", example("saddle"), "--unit", "inch"}).status, 2);
  EXPECT_EQ(blade({"info", example("saddle"), "--sewing", "-1"}).status, 2);
  // A panel drawn in metres whose file says millimetres: 0.6 × 0.8.
  const std::string small =
      replaced(slurp(example("saddle")), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)");
  const json report = reportOf(folder, folder.write("m.step", small), R"({"unit": "mm", "stations": 8})");
  EXPECT_NEAR(report["target"]["bounds_mm"][1][0].get<double>(), 300, 1e-6);
}

TEST(CadFiles, FacesAreChosenByNameNearPointAndGroup) {
  const Folder folder;
  const std::string file = folder.write("two.step", saddleAndCap());
  for (const char* choice :
       {R"("face": "sphere-cap")", R"("near": [0, 0, 106])", R"("face": {"group": 1})", R"("face": [1])"})
    EXPECT_EQ(reportOf(folder, file, std::string("{\"stations\": 8, ") + choice + "}")["target"]["face"], 1)
        << choice;
  const Finished wrong = blade({"rationalize", file, "--job",
                                folder.write("w.json", R"({"face": "spere-cap"})"), "--out", folder / "w"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean \"sphere-cap\"?"), std::string::npos) << wrong.err;
}

TEST(CadFiles, WhatWasLeftOutAndWhichFaceWasTakenIsToldInTheReport) {
  const Folder folder;
  std::string file =
      mergedStep({slurp(example("saddle")), slurp(example("sphere-cap")), slurp(example("torus-patch"))});
  const std::string surface = "B_SPLINE_SURFACE_WITH_KNOTS('',";
  file.replace(file.find(surface), surface.size(), surface + "'x',");
  const json report =
      reportOf(folder, folder.write("damaged.step", file), R"({"stations": 8, "near": [0, 0, 106]})");
  std::string leftOut, taken;
  for (const json& issue : report["issues"]) {
    if (issue["kind"] == "left-out") leftOut = issue["message"];
    if (issue["kind"] == "face") taken = issue["message"];
  }
  EXPECT_NE(leftOut.find("1 of 3 faces is left out (#"), std::string::npos) << leftOut;
  EXPECT_NE(taken.find("\"sphere-cap\""), std::string::npos) << taken;
}

TEST(CadFiles, NothingUsableIsAnUnreadableFile) {
  const Folder folder;
  const std::string file = replaced(slurp(example("saddle")), "B_SPLINE_SURFACE_WITH_KNOTS('',", "PLANE('',");
  const Finished run = blade({"info", folder.write("nothing.step", file)});
  EXPECT_EQ(run.status, 4);
  EXPECT_NE(run.err.find("nothing.step"), std::string::npos) << run.err;
}

}  // namespace bw::test
