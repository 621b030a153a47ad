// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design with one cut more or less.
#include <gtest/gtest.h>

#include "bw/core/design/cut_list.h"

namespace bw {
namespace {

Design designOf(const char* text) {
  const Result<Design> design = parseDesign(text);
  EXPECT_TRUE(design) << design.error().message;
  return *design;
}

BlockPlacement placed() { return {{10, 20, 30}, {600, 800, 500}, {0, 0, 0.1}}; }

TEST(CutList, AnotherCutHasASurfaceOfItsOwn) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "sources": [{"id": "a", "surface": {"type": "formula", "formula": "100"}}],
    "cuts": [{"id": "one", "direction": "y", "stations": 9, "order": 1}]})");
  const Result<AnotherCut> another = withAnotherCut(design, design.cut(), placed());
  ASSERT_TRUE(another);
  const Design& more = another->design;
  ASSERT_EQ(more.cuts.size(), 2u);
  EXPECT_EQ(more.cuts[0], design.cuts[0]);
  EXPECT_EQ(more.cuts[1].id, another->id);
  EXPECT_EQ(more.cuts[1].block, "block-1");
  EXPECT_EQ(more.cuts[1].sections.stations, 9);
  EXPECT_FALSE(more.cuts[1].order);
  const Source& own = more.sourceOf(more.cuts[1]);
  EXPECT_EQ(own.id, "surface-2");
  const Result<SplineSurface> surface = splineOf(*own.surface);
  ASSERT_TRUE(surface);
  // From three quarters of the height to a quarter, in the block's frame.
  const Box box = placed().box();
  EXPECT_NEAR(box.frame.toLocal(surface->value(surface->knotsU.front(), surface->knotsV.front())).z(), 375,
              1e-9);
  EXPECT_NEAR(box.frame.toLocal(surface->value(surface->knotsU.back(), surface->knotsV.back())).z(), 125,
              1e-9);
  EXPECT_EQ(*parseDesign(designToJson(more)), more) << "a file holds it";
}

TEST(CutList, OfAFileItIsOfTheSameFile) {
  const Design design = designOf(R"({"bladewright_design": 2, "sources": [{"path": "a.step"}],
                                     "cuts": [{"id": "cut-2", "face": 3}]})");
  const Result<AnotherCut> another = withAnotherCut(design, design.cut(), placed());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->design.sources, design.sources);
  EXPECT_EQ(another->design.cuts[1].source, design.source().id);
  EXPECT_EQ(another->design.cuts[1].face, FaceChoice());
  EXPECT_NE(another->id, "cut-2") << "that name is taken";
}

TEST(CutList, UnderAGridASurfaceOfItsOwnIsOfOneBlock) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "sources": [{"surface": {"type": "formula", "formula": "100"}}],
    "grid": {"columns": 3}, "cuts": [{"id": "cut", "stations": 9}]})");
  const Result<AnotherCut> another = withAnotherCut(design, design.cuts[1], placed());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->design.cuts.size(), 4u);
  EXPECT_EQ(another->id, "cut2-column-2");
  const auto made = std::ranges::find(another->design.cuts, another->id, &Cut::id);
  ASSERT_TRUE(made != another->design.cuts.end());
  EXPECT_EQ(made->block, "column-2");
  EXPECT_EQ(*parseDesign(designToJson(another->design)), another->design) << "a file tells it by the grid";
  // With it goes its surface.
  ASSERT_TRUE(mayGo(another->design, *made));
  EXPECT_EQ(withoutCut(another->design, *made), design);
  EXPECT_FALSE(mayGo(design, design.cuts[1]));
}

TEST(CutList, UnderAGridEachBlockGetsOneOfAFile) {
  const Design design = designOf(R"({"bladewright_design": 2, "sources": [{"path": "hall.step"}],
    "grid": {"columns": 3}, "cuts": [{"id": "cut", "stations": 9}]})");
  const Result<AnotherCut> another = withAnotherCut(design, design.cuts[1], placed());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->design.cuts.size(), 6u);
  EXPECT_EQ(another->id, "cut2-column-2");
  EXPECT_EQ(*parseDesign(designToJson(another->design)), another->design);
  const auto made = std::ranges::find(another->design.cuts, another->id, &Cut::id);
  ASSERT_TRUE(mayGo(another->design, *made));
  EXPECT_EQ(withoutCut(another->design, *made), design) << "those of the other blocks go with it";
}

TEST(CutList, UnderAGridExpressionsStayWithTheirCuts) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "n", "value": 7, "min": 2, "max": 40}],
    "sources": [{"surface": {"type": "formula", "formula": "100"}}],
    "grid": {"columns": 2}, "cuts": [{"id": "cut", "stations": "=n"}, {"id": "more", "stations": "=n+1"},
      {"id": "cut-column-2", "block": "column-2", "stations": "=n+2"}]})");
  ASSERT_EQ(design.bindings.size(), 4u) << "each cut has its own";
  const auto stations = [](const Design& of, const std::string& id) {
    const Result<Design> changed = withVariables(of, {{"n", 20}});
    EXPECT_TRUE(changed);
    return std::ranges::find(changed->cuts, id, &Cut::id)->sections.stations;
  };
  const Result<AnotherCut> another = withAnotherCut(design, design.cuts[0], placed());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->design.cuts.size(), design.cuts.size() + 1);
  EXPECT_EQ(stations(another->design, another->id), 20) << "its numbers are told as those of the cut beside";
  EXPECT_EQ(stations(another->design, "cut-column-1"), 20);
  EXPECT_EQ(stations(another->design, "more-column-1"), 21);
  EXPECT_EQ(stations(another->design, "cut-column-2"), 22);
  const Design fewer =
      withoutCut(design, *std::ranges::find(design.cuts, std::string("more-column-2"), &Cut::id));
  EXPECT_EQ(fewer.cuts.size(), 2u);
  EXPECT_EQ(fewer.bindings.size(), 2u);
  EXPECT_EQ(stations(fewer, "cut-column-1"), 20);
  EXPECT_EQ(stations(fewer, "cut-column-2"), 22);
  // A block that would have none keeps its own.
  EXPECT_FALSE(mayGo(fewer, fewer.cuts[0]));
}

TEST(CutList, WithoutACutWhatStandsBehindKeepsItsExpressions) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "n", "value": 7, "min": 2, "max": 40}, {"name": "h", "value": 50, "min": 0, "max": 90}],
    "sources": [{"id": "a", "surface": {"type": "formula", "formula": "100"}},
                {"id": "b", "surface": {"type": "poles", "poles": [["=h",1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1]]}},
                {"id": "c", "surface": {"type": "poles", "poles": [["=2*h",1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1],[1,1,1,1]]}}],
    "cuts": [{"id": "one", "source": "a"}, {"id": "two", "source": "b", "stations": "=n"},
             {"id": "three", "source": "c", "stations": "=n+1"}]})");
  ASSERT_EQ(design.bindings.size(), 4u);
  ASSERT_TRUE(mayGo(design, design.cuts[1]));
  const Design fewer = withoutCut(design, design.cuts[1]);
  ASSERT_EQ(fewer.cuts.size(), 2u);
  ASSERT_EQ(fewer.sources.size(), 2u);
  EXPECT_EQ(fewer.bindings.size(), 2u);
  const Result<Design> changed = withVariables(fewer, {{"n", 9}, {"h", 10}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(changed->cuts[1].sections.stations, 10);
  EXPECT_EQ(std::get<PolesSurface>(changed->sources[1].surface->shape).at(0, 0).height, 20);
}

TEST(CutList, TheLastCutOfABlockStays) {
  const Design design = designOf(R"({"bladewright_design": 2, "stock": [{"id": "a"}, {"id": "b"}],
    "cuts": [{"id": "one", "block": "a"}, {"id": "two", "block": "b"}, {"id": "three", "block": "b"}]})");
  EXPECT_FALSE(mayGo(design, design.cuts[0]));
  EXPECT_TRUE(mayGo(design, design.cuts[1]));
  EXPECT_EQ(withoutCut(design, design.cuts[1]).sources.size(), 1u) << "the file stays";
}

}  // namespace
}  // namespace bw
