// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Designs of several blocks: lists, and grids that stand for them.
#include "bw/core/design/block_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"

namespace bw {
namespace {

using Eigen::Vector3d;

std::string withGrid(const std::string& grid, const std::string& rest = "") {
  return R"({"bladewright_design": 2, "variables": [{"name": "width", "value": 600, "min": 100, "max": 900}],
             "sources": [{"id": "surface", "path": "wall.step"}], "grid": )" +
         grid + rest + "}";
}

Design read(const std::string& text) {
  const Result<Design> design = parseDesign(text);
  EXPECT_TRUE(design) << design.error().message;
  return design ? *design : Design();
}

void refused(const std::string& text, const std::vector<std::string>& words) {
  const Result<Design> design = parseDesign(text);
  ASSERT_FALSE(design) << text;
  EXPECT_EQ(design.error().code, ErrorCode::badInput);
  for (const std::string& word : words)
    EXPECT_NE(design.error().message.find(word), std::string::npos) << design.error().message;
}

TEST(BlockGrid, LaysBlocksOut) {
  BlockGrid grid;
  grid.origin = {100, 0, -50};
  grid.sizes = {{{600, 500}, {800}, {200, 300}}};
  grid.gaps = {{{10}, {}, {0}}};
  const std::vector<BlockGrid::Cell> cells = grid.cells();
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_EQ(grid.count(), 4u);
  EXPECT_EQ(cells[0].id, "column-1-layer-1");
  EXPECT_EQ(cells[1].id, "column-2-layer-1");
  EXPECT_EQ(cells[3].id, "column-2-layer-2");
  EXPECT_EQ(cells[3].placement.origin, Vector3d(710, 0, 150));
  EXPECT_EQ(cells[3].placement.size, Vector3d(500, 800, 300));
  EXPECT_EQ(grid.widestGap(), 10);
  grid.rotation = {0, 0, 90 * kDegree};
  EXPECT_LT((grid.cells()[1].placement.origin - Vector3d(100, 610, -50)).norm(), 1e-9);
}

TEST(BlockGrid, CallsBlocksByTheirNames) {
  const Design design =
      read(withGrid(R"({"columns": 3, "names": {"column-2": "A2"}})",
                    R"(, "cuts": [{"id": "cut"}, {"id": "cut-A2", "block": "A2", "stations": 9}])"));
  ASSERT_EQ(design.stock.size(), 3u);
  EXPECT_EQ(design.stock[1].id, "A2");
  EXPECT_EQ(design.cuts[1].id, "cut-A2");
  EXPECT_EQ(design.cuts[1].sections.stations, 9);
  EXPECT_EQ(read(designToJson(design)), design);
  refused(withGrid(R"({"columns": 3, "names": {"column-4": "A4"}})"), {"column-4", "none of that place"});
  refused(withGrid(R"({"columns": 3, "names": {"column-1": "A", "column-2": "A"}})"), {"\"A\"", "its own"});
  refused(withGrid(R"({"columns": 3, "names": {"column-1": "column-3"}})"), {"column-3", "its own"});
  refused(withGrid(R"({"columns": 3, "names": {"column-1": "a/b"}})"), {"names.column-1", "none of /"});
  refused(withGrid(R"({"columns": 3, "names": {"column-1": "A "}})"), {"no blank at its ends"});
  refused(withGrid(R"({"columns": 2, "names": {"column-1": "A-b", "column-2": "b"}})",
                   R"(, "cuts": [{"id": "cut"}, {"id": "cut-A"}])"),
          {"cut-A-b", "otherwise"});
  refused(withGrid(R"({"columns": 3, "names": {"column-1": 1}})"), {"must be a text"});
  refused(withGrid(R"({"columns": 3, "names": ["A"]})"), {"by the places of blocks"});
  refused(withGrid(R"({"columns": 3}, "cuts": [{"block": "A2"}])"), {"A2"});
}

TEST(BlockGrid, IsReadWithOneCutForEachBlock) {
  const Design design =
      read(withGrid(R"({"columns": 3, "sizes": {"columns": ["=width", 500, "=width"], "layers": 400}})",
                    R"(, "cuts": [{"id": "cut", "direction": "y", "stations": 33},
                                  {"id": "cut-column-2", "block": "column-2", "stations": 17}])"));
  ASSERT_TRUE(design.grid);
  ASSERT_EQ(design.stock.size(), 3u);
  EXPECT_EQ(design.stock[1].id, "column-2");
  EXPECT_EQ(design.stock[2].placement->origin, Vector3d(1100, 0, 0));
  EXPECT_EQ(design.stock[2].placement->size, Vector3d(600, 800, 400));
  ASSERT_EQ(design.cuts.size(), 3u);
  EXPECT_EQ(design.cuts[0].id, "cut-column-1");
  EXPECT_EQ(design.cuts[0].block, "column-1");
  EXPECT_EQ(design.cuts[0].source, "surface");
  EXPECT_EQ(design.cuts[0].sections.stations, 33);
  EXPECT_EQ(design.cuts[1].sections.stations, 17) << "one of its own";
  EXPECT_EQ(design.cuts[2].sections.stations, 33);
}

TEST(BlockGrid, IsWrittenAsItWasRead) {
  const Design design =
      read(withGrid(R"({"origin": [1, 2, 3], "rotation_deg": [0, 0, 30], "columns": 3, "rows": 2,
                        "sizes": {"columns": ["=width", 500, "=width"], "rows": 400},
                        "gaps": {"columns": [5, 0], "rows": 2}})",
                    R"(, "cuts": [{"id": "cut", "stations": 9}])"));
  const std::string text = designToJson(design);
  EXPECT_NE(text.find("\"grid\""), std::string::npos);
  EXPECT_EQ(text.find("\"stock\""), std::string::npos);
  EXPECT_NE(text.find("\"=width\""), std::string::npos);
  EXPECT_EQ(read(text), design);
  EXPECT_EQ(designToJson(read(text)), text);
  // A cut that was changed alone is told besides; a block that was moved makes lists of all.
  Design changed = design;
  changed.cuts[4].sections.stations = 21;
  const std::string more = designToJson(changed);
  EXPECT_NE(more.find("\"grid\""), std::string::npos);
  EXPECT_EQ(read(more).cuts, changed.cuts);
  changed.stock[2].placement->origin.z() += 1;
  const Design listed = read(designToJson(changed));
  EXPECT_FALSE(listed.grid);
  EXPECT_EQ(listed.stock, changed.stock);
  EXPECT_EQ(listed.cuts, changed.cuts);
  changed = design;
  changed.cuts.erase(changed.cuts.begin() + 1);
  EXPECT_EQ(read(designToJson(changed)).cuts, changed.cuts) << "a cut that was taken away stays away";
}

TEST(BlockGrid, FollowsItsVariables) {
  const Design design = read(withGrid(R"({"columns": 3, "sizes": {"columns": "=width"}})"));
  EXPECT_EQ(design.cuts.size(), 3u);
  const Result<Design> wider = withVariables(design, {{"width", 700}});
  ASSERT_TRUE(wider) << wider.error().message;
  EXPECT_EQ(wider->stock[2].placement->origin.x(), 1400);
  EXPECT_EQ(wider->grid->sizes[0], std::vector<double>(3, 700));
  EXPECT_EQ(wider->cuts, design.cuts);
  EXPECT_FALSE(withVariables(design, {{"width", 7000}}));
}

TEST(BlockGrid, IsRefusedWhereItIsNone) {
  refused(withGrid(R"({"rows": 0})"), {"design.grid.rows is 0", "from 1 to 100"});
  refused(withGrid(R"({"columns": -2})"), {"design.grid.columns is -2"});
  refused(withGrid(R"({"columns": 2.5})"), {"design.grid.columns", "whole number"});
  refused(withGrid(R"({"columns": 2, "gaps": {"columns": -1}})"), {"design.grid.gaps.columns is -1"});
  refused(withGrid(R"({"columns": 3, "gaps": {"columns": [0, -4]}})"), {"gaps.columns[1] is -4"});
  refused(withGrid(R"({"columns": 3, "sizes": {"columns": [600, 600]}})"),
          {"sizes.columns has 2 numbers", "must have 3"});
  refused(withGrid(R"({"sizes": {"columns": []}})"), {"tells no columns"});
  refused(withGrid(R"({"sizes": {"rows": 0}})"), {"sizes.rows is 0", "between 1"});
  refused(withGrid(R"({"columns": 100, "rows": 50})"), {"5000 blocks", "there may be 2500"});
  refused(withGrid(R"({"columns": 2, "sizes": {"width": 3}})"), {"no key \"width\""});
  refused(withGrid(R"({"column": 2})"), {"did you mean \"columns\""});
  refused(withGrid("[3]"), {"design.grid"});
  refused(withGrid(R"({"columns": "=wide"})"), {"wide"});
  refused(withGrid(R"({"columns": 2})", R"(, "stock": [{"id": "a"}])"), {"twice", "grid"});
  refused(withGrid(R"({"columns": 2})", R"(, "cuts": [{"id": "cut", "block": "column-3"}])"),
          {"cuts[0].block names \"column-3\"", "did you mean \"column-"});
  refused(withGrid(R"({"columns": 2})", R"(, "cuts": [{"id": "cut"}, {"id": "cut"}])"), {"another entry"});
}

TEST(BlockGrid, MayBeLarge) {
  const Design design =
      read(withGrid(R"({"columns": 50, "rows": 50, "sizes": {"columns": 100, "rows": 100}})"));
  EXPECT_EQ(design.stock.size(), 2500u);
  EXPECT_EQ(design.cuts.size(), 2500u);
  EXPECT_EQ(design.stock.back().id, "column-50-row-50");
  EXPECT_EQ(read(designToJson(design)), design);
}

TEST(Blocks, AreReadAsALists) {
  const Design design = read(
      R"({"bladewright_design": 2, "sources": [{"path": "a.step"}],
          "stock": [{"id": "left", "block": {"origin": [0, 0, 0], "size": [600, 800, 500]}},
                    {"block": {"origin": [600, 0, 0], "size": [600, 800, 500]}}],
          "cuts": [{"block": "left", "stations": 9}, {"id": "other", "block": "block-2"}]})");
  ASSERT_EQ(design.stock.size(), 2u);
  EXPECT_EQ(design.stock[1].id, "block-2");
  ASSERT_EQ(design.cuts.size(), 2u);
  EXPECT_EQ(design.cuts[0].id, "cut-1");
  EXPECT_EQ(design.cuts[0].block, "left");
  EXPECT_EQ(design.cuts[1].block, "block-2");
  EXPECT_FALSE(design.grid);
  EXPECT_EQ(read(designToJson(design)), design);
  const auto with = [](const std::string& stock, const std::string& cuts) {
    return R"({"bladewright_design": 2, "stock": )" + stock + R"(, "cuts": )" + cuts + "}";
  };
  refused(with(R"([{"id": "a"}, {"id": "a"}])", R"([{"block": "a"}])"), {"stock[1].id is \"a\""});
  refused(with(R"([{"id": "a"}, {"id": "b"}])", R"([{"id": "cut"}])"), {"cuts[0] needs the key block"});
  refused(with(R"([{"id": "left"}, {"id": "b"}])", R"([{"block": "lef"}])"),
          {"names \"lef\"", "did you mean \"left\""});
  refused(with("[]", R"([{"id": "cut"}])"), {"design.stock", "1 to 2500"});
}

TEST(Blocks, AreJoinedAsTheProcessSays) {
  const Design plain = read(R"({"bladewright_design": 2})");
  EXPECT_EQ(plain.process.join, Join::tangentPlanes);
  EXPECT_EQ(plain.process.jointGap, 0.1);
  EXPECT_EQ(plain.process.jointKink, 1);
  const Design design = read(
      R"({"bladewright_design": 2, "process": {"join": {"type": "none", "gap_mm": 0.5, "kink_deg": 2}}})");
  EXPECT_EQ(design.process.join, Join::none);
  EXPECT_EQ(design.process.jointGap, 0.5);
  EXPECT_EQ(design.process.jointKink, 2);
  EXPECT_EQ(read(designToJson(design)), design);
  refused(R"({"bladewright_design": 2, "process": {"join": {"type": "tangent"}}})", {"tangent-planes"});
  refused(R"({"bladewright_design": 2, "process": {"join": {"gap_mm": -1}}})", {"gap_mm is -1"});
}

}  // namespace
}  // namespace bw
