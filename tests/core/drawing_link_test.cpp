// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a design tells of the drawing that its surface was made of.
#include "bw/core/design/drawing_link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/files/file_set.h"
#include "read_design.h"

namespace bw {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Design linkedDesign() {
  Design design;
  DesignedSurface surface;
  surface.shape = SectionsSurface{{{0, SectionCurve::Kind::spline, {{0, 200}, {300, 220}, {600, 200}}},
                                   {800, SectionCurve::Kind::spline, {{0, 210}, {300, 250}, {600, 190}}}}};
  // Degrees of such angles are not those that are read again to the last digit.
  surface.rotation = {0.1, std::atan2(3.0, 7.0), -1.0 / 3};
  design.source().surface = surface;
  DrawingLink link{"walls.dxf", "roof", fingerprintOf("drawing"), surfaceMark(surface)};
  link.block = BlockPlacement{{1, 2, 3}, {600, 800, 500}, {0, 0, 0.25}};
  link.direction = {0.6, 0.8, 0};
  link.length = 900;
  design.source().drawing = link;
  return design;
}

}  // namespace

TEST(DrawingLink, IsKeptByTheFile) {
  const Design design = linkedDesign();
  const std::string text = designToJson(design);
  const Design read = test::designOf(text);
  ASSERT_TRUE(read.source().drawing);
  EXPECT_EQ(read.source().drawing->layer, "roof");
  EXPECT_EQ(read.source().drawing->read, design.source().drawing->read);
  EXPECT_EQ(read.source().drawing->length, 900);
  EXPECT_EQ(read.source().drawing->direction, design.source().drawing->direction);
  EXPECT_EQ(designToJson(read), text);
  EXPECT_TRUE(isAsDrawn(*read.source().drawing, *read.source().surface)) << "no hand was there";
  EXPECT_TRUE(isAsDrawn(*design.source().drawing, *design.source().surface));
  // All layers together, and none.
  Design all = design;
  all.source().drawing->layer.reset();
  EXPECT_FALSE(test::designOf(designToJson(all)).source().drawing->layer);
  all.source().drawing->layer = "";
  EXPECT_EQ(test::designOf(designToJson(all)).source().drawing->layer, "");
  all.source().drawing.reset();
  EXPECT_EQ(designToJson(all).find("drawing"), std::string::npos);
  // It is no setting.
  EXPECT_TRUE(differences(design, all).empty());
}

TEST(DrawingLink, KnowsASurfaceThatAHandHasChanged) {
  Design design = test::designOf(designToJson(linkedDesign()));
  auto& loft = std::get<SectionsSurface>(design.source().surface->shape);
  loft.sections[0].points[1].y() += 1e-9;
  EXPECT_FALSE(isAsDrawn(*design.source().drawing, *design.source().surface));
  loft.sections[0].points[1].y() = 220;
  EXPECT_TRUE(isAsDrawn(*design.source().drawing, *design.source().surface));
  design.source().surface->origin.x() = 1;
  EXPECT_FALSE(isAsDrawn(*design.source().drawing, *design.source().surface));
}

TEST(DrawingLink, LiesBesideTheDesign) {
  const fs::path folder = fs::temp_directory_path() / "bw-drawing-link";
  fs::create_directories(folder / "cad");
  Design design = linkedDesign();
  design.source().drawing->path = folder / "cad" / "walls.dxf";
  design = withVersion(design, "first").value();
  ASSERT_TRUE(saveDesign(design, folder / "roof.bladewright"));
  const Result<Design> read = loadDesign(folder / "roof.bladewright");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->source().drawing->path, folder / "cad" / "walls.dxf");
  EXPECT_EQ(read->versions.front().design->source().drawing->path, folder / "cad" / "walls.dxf");
  const std::string text = readFile(folder / "roof.bladewright").value();
  EXPECT_NE(text.find("\"path\": \"cad/walls.dxf\""), std::string::npos);
  EXPECT_EQ(text.find(folder.string()), std::string::npos);
  fs::remove_all(folder);
}

TEST(DrawingLink, ThatCannotBeIsRefused) {
  const auto message = [](const auto& change) {
    json design = json::parse(designToJson(linkedDesign()));
    change(design["sources"][0]);
    return test::errorOf(design);
  };
  const auto says = [&](const auto& change, const std::string& part) {
    const std::string all = message(change);
    EXPECT_NE(all.find(part), std::string::npos) << all;
  };
  says([](json& source) { source["drawing"].erase("path"); }, "drawing needs the key path");
  says([](json& source) { source["drawing"]["fingerprint"] = "x"; }, "drawing.fingerprint is damaged");
  says([](json& source) { source["drawing"].erase("surface"); }, "drawing needs the key surface");
  says([](json& source) { source["drawing"]["layr"] = "x"; }, "did you mean \"layer\"?");
  says([](json& source) { source["drawing"] = 7; }, "drawing");
  says(
      [](json& source) {
        source.erase("surface");
        source["path"] = "roof.step";
      },
      "has the key drawing but no surface that was made of it");
}

}  // namespace bw
