// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The cuts of a design as a table, and back.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/core/design/cut_table.h"

namespace bw {
namespace {

/// A block with cuts of all sorts.
Design several() {
  const Result<Design> design = parseDesign(R"({"bladewright_design": 2,
    "variables": [{"name": "count", "value": 12, "min": 2, "max": 40}],
    "sources": [{"id": "one", "surface": {"type": "formula", "formula": "100"}},
                {"id": "two, or so", "surface": {"type": "formula", "formula": "x/4"}}],
    "stock": [{"id": "block-1"}, {"id": "block-2"}],
    "cuts": [{"id": "plain", "block": "block-1"},
             {"id": "all of it", "source": "two, or so", "block": "block-1", "face": [0], "direction": [0.6, 0.8, 0],
              "stations": {"spacing": 12.5}, "sections": "kernel", "face_up": "left", "turn_deg": 270,
              "keep": "right", "order": 3, "blade_length": 812.5, "offset": 7.5},
             {"id": "near", "block": "block-2", "near": [1, 2.5, -3], "direction": "x", "stations": 20}]})");
  EXPECT_TRUE(design) << design.error().message;
  return *design;
}

/// Blocks whose cuts are all of one surface.
Design plain() {
  const Result<Design> design = parseDesign(R"({"bladewright_design": 2,
    "variables": [{"name": "count", "value": 12, "min": 2, "max": 40}],
    "sources": [{"id": "one", "surface": {"type": "formula", "formula": "100"}}],
    "stock": [{"id": "block-1"}, {"id": "block-2"}],
    "cuts": [{"id": "a", "block": "block-1", "stations": "=2*count"}, {"id": "b", "block": "block-2"}]})");
  EXPECT_TRUE(design) << design.error().message;
  return *design;
}

std::string messageOf(const Result<Design>& design) { return design ? "" : design.error().message; }

TEST(CutTable, ComesBackAsItWas) {
  const Design design = several();
  const Result<Design> csv = withCutTable(design, cutTableCsv(design));
  ASSERT_TRUE(csv) << csv.error().message;
  EXPECT_EQ(csv->cuts, design.cuts);
  const Result<Design> json = withCutTable(design, cutTableJson(design));
  ASSERT_TRUE(json) << json.error().message;
  EXPECT_EQ(json->cuts, design.cuts);
  EXPECT_EQ(csv->sources, design.sources);
  EXPECT_EQ(csv->stock, design.stock);
}

TEST(CutTable, DesignsKeepWhatACutHas) {
  const Design design = several();
  const Cut& cut = design.cuts[1];
  EXPECT_EQ(cut.pose, (CutPose{BlockFace::left, 3}));
  EXPECT_EQ(cut.keep, KeptSide::right);
  EXPECT_EQ(cut.order, 3);
  EXPECT_EQ(cut.length, 812.5);
  EXPECT_EQ(cut.source, "two, or so");
  EXPECT_EQ(parseDesign(designToJson(design))->cuts, design.cuts);
  // What is as usual is not told, for versions that do not know it.
  const auto text = nlohmann::json::parse(designToJson(design));
  for (const char* key : {"face_up", "turn_deg", "keep", "order", "blade_length", "offset"}) {
    EXPECT_FALSE(text["cuts"][0].contains(key)) << key;
    EXPECT_TRUE(text["cuts"][1].contains(key)) << key;
  }
}

TEST(CutTable, TakesWhatSpreadsheetsMake) {
  const Design design = plain();
  const std::string table =
      "\xEF\xBB\xBFid;block;blade_length;direction;order\r\n"
      "\"a; b\";block-1;812,5;0 1 0;2\r\n"
      "c;block-2;;auto;\r\n"
      ";;;;\r\n";
  const Result<Design> made = withCutTable(design, table);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->cuts.size(), 2u);
  EXPECT_EQ(made->cuts[0].id, "a; b");
  EXPECT_EQ(made->cuts[0].length, 812.5) << "no thousands, no 8125";
  EXPECT_EQ(made->cuts[0].order, 2);
  EXPECT_TRUE(made->cuts[0].direction->isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(made->cuts[1].order);
  EXPECT_FALSE(made->cuts[1].direction);
}

TEST(CutTable, CellsMayBeExpressions) {
  const Result<Design> made = withCutTable(plain(), "id,block,stations\na,block-1,=2*count\nb,block-2,5\n");
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->cuts[0].sections.stations, 24);
  EXPECT_EQ(made->bindings.size(), 1u);
}

TEST(CutTable, HoldsTheExpressionsOfItsNumbers) {
  const Design design = plain();
  EXPECT_NE(cutTableCsv(design).find("=2*count"), std::string::npos) << cutTableCsv(design);
  for (const std::string& table : {cutTableCsv(design), cutTableJson(design)}) {
    const Result<Design> made = withCutTable(design, table);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(*made, design);
  }
}

TEST(CutTable, OfSeveralSurfacesEachCutNamesItsOwn) {
  const Result<Design> made = withCutTable(several(), "id,block\na,block-1\nb,block-2\n");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("cut 1 of the table names no source"), std::string::npos)
      << made.error().message;
}

TEST(CutTable, UnderAGridEachCutNamesItsBlock) {
  const Result<Design> design = parseDesign(R"({"bladewright_design": 2,
    "variables": [{"name": "n", "value": 9, "min": 2, "max": 40}],
    "sources": [{"surface": {"type": "formula", "formula": "100"}}],
    "grid": {"columns": 3}, "cuts": [{"id": "cut", "stations": "=n"}]})");
  ASSERT_TRUE(design);
  const std::string table = cutTableCsv(*design);
  EXPECT_NE(table.find("\ncolumn-3,cut-column-3,"), std::string::npos) << table;
  EXPECT_NE(table.find(",direction,planes,"), std::string::npos) << table;
  EXPECT_NE(table.find(",parallel,"), std::string::npos) << table;
  const Result<Design> made = withCutTable(*design, table);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->cuts, design->cuts);
  EXPECT_EQ(made->bindings, design->bindings) << "its expressions come back, too";
}

TEST(CutTable, TellsTheExpressionsOfADirection) {
  const Result<Design> design = parseDesign(R"({"bladewright_design": 2,
    "variables": [{"name": "lean", "value": 0.1, "min": 0, "max": 1}],
    "sources": [{"surface": {"type": "formula", "formula": "100"}}],
    "cuts": [{"id": "cut", "direction": ["=lean", 1, 0]}]})");
  ASSERT_TRUE(design) << design.error().message;
  for (const std::string& table : {cutTableCsv(*design), cutTableJson(*design)}) {
    const Result<Design> made = withCutTable(*design, table);
    ASSERT_TRUE(made) << made.error().message << table;
    EXPECT_EQ(made->bindings, design->bindings) << table;
  }
}

TEST(CutTable, WhatIsWrongIsNamed) {
  const Design design = plain();
  const auto says = [&](const std::string& table, const char* words) {
    const Result<Design> made = withCutTable(design, table);
    ASSERT_FALSE(made) << table;
    EXPECT_EQ(made.error().code, ErrorCode::badInput);
    EXPECT_NE(messageOf(made).find(words), std::string::npos) << messageOf(made);
  };
  says("id,block\n\xE4,block-1\n", "save it as CSV UTF-8");
  says("\xFF\xFEi", "save it as CSV UTF-8");
  says("", "one line a cut");
  says("id,block\n", "one line a cut");
  says("id,blok\na,block-1\n", "did you mean \"block\"?");
  says("id,id\na,b\n", "stands twice");
  says("id,block\na,block-1,3\n", "3 cells, but there are 2 columns");
  says("id,block\n\"a,block-1\n", "inside of a quote");
  says("id,block\na,block-9\n", "names \"block-9\"");
  says("id,block,source\na,block-1,on\n", "names \"on\"");
  says("id,block,turn_deg\na,block-1,45\n", "0, 90, 180 or 270, not 45");
  says("id,block,turn_deg\na,block-1,\"0,5\"\n", "turn_deg");
  says("id,block,face_up\na,block-1,lid\n", "face_up");
  says("id,block,keep\na,block-1,belo\n", "below");
  says("id,block,order\na,block-1,0\n", "order");
  says("id,block,blade_length\na,block-1,5\n", "blade_length");
  says("id,block\na,block-1\na,block-2\n", "as that of another entry");
  says("[]", "1 to 10000");
  says("{\"cut\": []}", "the key cuts alone");
  says("{", "table");
}

}  // namespace
}  // namespace bw
