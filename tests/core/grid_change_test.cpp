// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Blocks of a design that are laid out by another grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/design/grid_change.h"
#include "bw/core/design/variables.h"

namespace bw {
namespace {

Design designOf(const char* text) {
  const Result<Design> design = parseDesign(text);
  EXPECT_TRUE(design) << design.error().message;
  return *design;
}

Design single() {
  return designOf(R"({"bladewright_design": 2,
    "sources": [{"id": "a", "surface": {"type": "formula", "x": [0, 600], "y": [0, 800], "formula": "100 + x/10"}}],
    "stock": [{"id": "block", "block": {"origin": [0, 0, 0], "size": [600, 800, 500]}}],
    "cuts": [{"id": "cut", "direction": "y", "stations": 9}]})");
}

Design with(const Design& design, std::size_t way, int count, const char* like) {
  const BlockGrid before = gridOf(design, design.block().placement.value()).value();
  const Result<Design> changed = withGrid(design, before, withCount(before, way, count, false), like);
  EXPECT_TRUE(changed) << changed.error().message;
  return *changed;
}

const Rectangle& over(const Design& design) {
  return std::get<FormulaSurface>(design.source().surface->shape).over;
}

/// The height of a surface over x, at a share of its way along y.
double heightOf(const SplineSurface& surface, double x, double share) {
  double from = surface.knotsU.front(), to = surface.knotsU.back();
  const double v = std::lerp(surface.knotsV.front(), surface.knotsV.back(), share);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (from + to);
    (surface.value(middle, v).x() < x ? from : to) = middle;
  }
  return surface.value(from, v).z();
}

TEST(GridChange, OneBlockBecomesThreeSideBySideAndOneAgain) {
  const Design design = single();
  const Design three = with(design, 0, 3, "block");
  ASSERT_EQ(three.stock.size(), 3u);
  EXPECT_EQ(three.stock[2].id, "column-3");
  EXPECT_EQ(three.stock[2].placement->origin, Eigen::Vector3d(1200, 0, 0));
  ASSERT_EQ(three.cuts.size(), 3u);
  EXPECT_EQ(three.cuts[2].id, "cut-column-3");
  EXPECT_EQ(three.cuts[2].sections.stations, 9);
  EXPECT_EQ(over(three).max, Eigen::Vector2d(1800, 800)) << "the surface goes on over all of them";
  EXPECT_EQ(*parseDesign(designToJson(three)), three) << "a file holds it";
  const Design one = with(three, 0, 1, "column-2");
  EXPECT_FALSE(one.grid);
  EXPECT_EQ(one.stock.size(), 1u);
  EXPECT_EQ(one.block().placement, design.block().placement);
  ASSERT_EQ(one.cuts.size(), 1u);
  EXPECT_EQ(one.cut().id, "cut");
  EXPECT_EQ(one.cut().block, one.block().id);
  EXPECT_EQ(one.sources, design.sources);
}

TEST(GridChange, ABlockOfAnyNameMayBecomeThree) {
  // Also one that is called as the single block of a grid would be.
  for (const char* id : {"block-1", "column-1", "A"}) {
    Design design = single();
    design.stock[0].id = design.cuts[0].block = id;
    design.cuts.push_back(design.cuts[0]);
    design.cuts[1].id = "other";
    const Design three = with(design, 0, 3, id);
    EXPECT_EQ(three.cuts.size(), 6u) << id;
    EXPECT_EQ(*parseDesign(designToJson(three)), three) << id;
    EXPECT_NE(designToJson(three).find("\"grid\""), std::string::npos) << id;
    const Design one = with(three, 0, 1, "column-2");
    EXPECT_EQ(one.cuts.size(), 2u) << id;
    EXPECT_EQ(one.cuts[0].id, "cut") << id;
  }
}

TEST(GridChange, BlocksThatStayKeepTheirCuts) {
  Design two = with(single(), 0, 2, "block");
  two.cuts[1].sections.stations = 21;
  const Design four = with(two, 0, 4, "column-1");
  ASSERT_EQ(four.cuts.size(), 4u);
  EXPECT_EQ(four.cuts[1].sections.stations, 21);
  EXPECT_EQ(four.cuts[3].sections.stations, 9);
  const Design rows = with(two, 1, 2, "column-2");
  ASSERT_EQ(rows.cuts.size(), 4u);
  EXPECT_EQ(rows.cuts[0].id, "cut-column-1-row-1");
  EXPECT_EQ(rows.cuts[0].sections.stations, 9) << "it stays, by another name";
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(rows.cuts[i].sections.stations, 21) << i;
  EXPECT_EQ(over(rows).max, Eigen::Vector2d(1200, 1600));
}

TEST(GridChange, ACutOfOneBlockStaysInItWithNamesAndExpressions) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "n", "value": 7, "min": 2, "max": 40}],
    "sources": [{"id": "a", "surface": {"type": "formula", "formula": "100"}},
                {"id": "b", "surface": {"type": "formula", "formula": "150"}}],
    "grid": {"columns": 3, "names": {"column-2": "A2"}},
    "cuts": [{"id": "cut", "source": "a", "stations": "=n"},
             {"id": "cut2-A2", "source": "b", "block": "A2", "stations": "=n+1"}]})");
  ASSERT_EQ(design.cuts.size(), 4u);
  const auto ids = [](const Design& of) {
    std::vector<std::string> all;
    for (const Cut& cut : of.cuts) all.push_back(cut.block + "/" + cut.id);
    std::ranges::sort(all);
    return all;
  };
  const auto follows = [](const Design& of, const std::string& id) {
    const Design changed = withVariables(of, {{"n", 20}}).value();
    return *std::ranges::find(changed.cuts, id, &Cut::id)->sections.stations;
  };
  using Ids = std::vector<std::string>;
  const Design two = with(design, 0, 2, "A2");
  EXPECT_EQ(ids(two), (Ids{"A2/cut-A2", "A2/cut2-A2", "column-1/cut-column-1"}));
  EXPECT_EQ(follows(two, "cut-A2"), 20);
  EXPECT_EQ(follows(two, "cut2-A2"), 21);
  EXPECT_EQ(*parseDesign(designToJson(two)), two);
  const Design rows = with(design, 1, 2, "A2");
  EXPECT_EQ(rows.grid->names, (std::map<std::string, std::string>{{"column-2-row-1", "A2"}}));
  EXPECT_EQ(rows.cuts.size(), 7u);
  EXPECT_EQ(std::ranges::count(rows.cuts, std::string("b"), &Cut::source), 1);
  EXPECT_EQ(follows(rows, "cut2-A2"), 21);
  EXPECT_EQ(follows(rows, "cut-column-3-row-2"), 20);
  EXPECT_EQ(*parseDesign(designToJson(rows)), rows);
  // And back, as it was; one alone is the first, which never had it.
  EXPECT_EQ(with(rows, 1, 1, "A2"), design);
  const Design one = with(design, 0, 1, "A2");
  EXPECT_EQ(ids(one), Ids{"block-1/cut"});
  EXPECT_EQ(follows(one, "cut"), 20);
}

TEST(GridChange, EachCutHasItsExpressionsAlsoWhereItComesToTheSame) {
  const auto stationsOf = [](const Design& of) {
    std::vector<int> all;
    for (const Cut& cut : of.cuts) all.push_back(*cut.sections.stations);
    return all;
  };
  const auto placesOf = [](const Design& of) {
    std::map<std::string, std::string> texts;
    for (const auto& [place, bound] : of.bindings) texts[place] = bound.text;
    return texts;
  };
  using Texts = std::map<std::string, std::string>;
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "n", "value": 7, "min": 2, "max": 40}, {"name": "m", "value": 7, "min": 2, "max": 40}],
    "sources": [{"id": "a", "surface": {"type": "formula", "formula": "100"}}],
    "grid": {"columns": 3},
    "cuts": [{"id": "cut", "stations": "=n"},
             {"id": "cut-column-2", "block": "column-2", "stations": "=m", "offset": "=m - 7"}]})");
  EXPECT_EQ(stationsOf(design), (std::vector<int>{7, 7, 7}));
  EXPECT_EQ(placesOf(design), (Texts{{"/cuts/0/stations", "n"},
                                     {"/cuts/1/offset", "m - 7"},
                                     {"/cuts/1/stations", "m"},
                                     {"/cuts/2/stations", "n"}}));
  // It is written although its numbers are those of all, and follows its own variable.
  EXPECT_EQ(*parseDesign(designToJson(design)), design);
  const Design other = withVariables(design, {{"m", 9}}).value();
  EXPECT_EQ(stationsOf(other), (std::vector<int>{7, 9, 7}));
  EXPECT_EQ(withVariables(other, {{"m", 7}}).value(), design);
  EXPECT_EQ(stationsOf(withVariables(design, {{"n", 20}}).value()), (std::vector<int>{20, 7, 20}));
  // New blocks are told as the one that they are like.
  EXPECT_EQ(stationsOf(withVariables(with(design, 0, 4, "column-2"), {{"m", 9}}).value()),
            (std::vector<int>{7, 9, 7, 9}));
  EXPECT_EQ(stationsOf(withVariables(with(design, 0, 4, "column-1"), {{"m", 9}}).value()),
            (std::vector<int>{7, 9, 7, 7}));
  const Design one = with(design, 0, 1, "column-2");
  EXPECT_EQ(placesOf(one), (Texts{{"/cuts/0/stations", "n"}})) << "the first block is left, whose cut it is";
  EXPECT_EQ(*resolved(one), one);
  // Where blocks are told one by one nothing is lost.
  Design listed = design;
  listed.grid.reset();
  EXPECT_EQ(*parseDesign(designToJson(listed)), listed);
}

TEST(GridChange, MoreAreAsLargeAsTheLastOrShareWhatThereIs) {
  BlockGrid grid;
  grid.sizes[0] = {500, 700};
  grid.gaps[0] = {10};
  const BlockGrid more = withCount(grid, 0, 4, false);
  EXPECT_EQ(more.sizes[0], (std::vector<double>{500, 700, 700, 700}));
  EXPECT_EQ(more.gaps[0], (std::vector<double>{10, 10, 10}));
  EXPECT_EQ(more.extent(0), 2630);
  const BlockGrid shared = withCount(grid, 0, 3, true);
  EXPECT_EQ(shared.sizes[0].size(), 3u);
  EXPECT_NEAR(shared.extent(0), grid.extent(0), 1e-9);
}

TEST(GridChange, ASurfaceThatEndsElsewhereStays) {
  Design design = single();
  std::get<FormulaSurface>(design.source().surface->shape).over.max.x() = 580;
  EXPECT_EQ(over(with(design, 0, 3, "block")).max, Eigen::Vector2d(580, 800));
}

TEST(GridChange, PointsOfSectionsStayOnTheBoundaries) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "sources": [{"id": "a", "surface": {"type": "sections", "sections": [
      {"y": 0, "spline": [[0, 100], [300, 150], [600, 200], [1200, 90]]},
      {"y": 800, "bezier": [[0, 100], [400, 150], [1200, 130]]}]}}],
    "grid": {"columns": 2, "sizes": {"columns": 600}}, "cuts": [{"id": "cut"}]})");
  const auto sections = [](const Design& of) {
    return std::get<SectionsSurface>(of.source().surface->shape).sections;
  };
  using Points = std::vector<Eigen::Vector2d>;
  // More columns: they go on in a mirror.
  const Design four = with(design, 0, 4, "column-1");
  EXPECT_EQ(sections(four)[0].points,
            (Points{{0, 100}, {300, 150}, {600, 200}, {1200, 90}, {1800, 200}, {2400, 90}}));
  EXPECT_EQ(sections(four)[1].points, (Points{{0, 100}, {800, 150}, {2400, 130}})) << "poles are stretched";
  // Fewer: what stays lies where it lay, for which it gets points beside its end.
  const Design again = with(four, 0, 2, "column-1");
  const Points back = sections(again)[0].points;
  ASSERT_EQ(back.size(), 6u);
  EXPECT_EQ(Points(back.begin(), back.begin() + 3), (Points{{0, 100}, {300, 150}, {600, 200}}));
  EXPECT_EQ(back[5], Eigen::Vector2d(1200, 90));
  const SplineSurface whole = splineOf(*four.source().surface).value(),
                      rest = splineOf(*again.source().surface).value();
  for (double x = 5; x < 1200; x += 30) EXPECT_NEAR(heightOf(rest, x, 0), heightOf(whole, x, 0), 0.5) << x;
  // Other sizes: what lies between boundaries keeps its share.
  BlockGrid other = *design.grid;
  other.sizes[0] = {500, 700};
  EXPECT_EQ(sections(*withGrid(design, *design.grid, other, "column-1"))[0].points,
            (Points{{0, 100}, {250, 150}, {500, 200}, {1200, 90}}));
  // A boundary without a point gets one where the surface is to end.
  Design bare = design;
  std::erase_if(std::get<SectionsSurface>(bare.source().surface->shape).sections[0].points,
                [](const Eigen::Vector2d& point) { return point.x() == 600; });
  const SplineSurface before = splineOf(*bare.source().surface).value();
  const auto heightAt = [&](double x) { return heightOf(before, x, 0); };
  const Points cut = sections(with(bare, 0, 1, "column-1"))[0].points;
  ASSERT_GE(cut.size(), 4u);
  EXPECT_EQ(cut[1], Eigen::Vector2d(300, 150));
  EXPECT_NEAR((cut.back() - Eigen::Vector2d(600, heightAt(600))).norm(), 0, 1e-6);
  EXPECT_GT(cut.back().y(), 155) << "the curve's height, not that of the last point before it";
  // What goes on behind it is a mirror down to such a boundary.
  const Points onward = sections(with(bare, 0, 3, "column-1"))[0].points;
  ASSERT_EQ(onward.size(), 4u);
  EXPECT_NEAR((onward[3] - Eigen::Vector2d(1800, heightAt(600))).norm(), 0, 1e-6);
  Design narrow = with(design, 0, 1, "column-1");
  std::get<SectionsSurface>(narrow.source().surface->shape).sections[0].points = {
      {0, 100}, {300, 150}, {600, 200}};
  EXPECT_EQ(sections(with(narrow, 0, 3, "column-1"))[0].points,
            (Points{{0, 100}, {300, 150}, {600, 200}, {900, 150}, {1200, 100}, {1500, 150}, {1800, 200}}));
  const Design rows = with(design, 1, 2, "column-1");
  ASSERT_EQ(sections(rows).size(), 3u);
  EXPECT_EQ(sections(rows)[2].y, 1600);
  EXPECT_EQ(sections(rows)[2].points, sections(design)[1].points);
}

TEST(GridChange, HeightsThatAreMirroredAreToldByTheirExpressions) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "low", "value": 100, "min": 0, "max": 300}, {"name": "high", "value": 200, "min": 0, "max": 300}],
    "sources": [{"id": "a", "surface": {"type": "sections", "sections": [
      {"y": 0, "spline": [[0, "=low"], [300, "=high - 20"], [600, "=high"]]},
      {"y": 800, "spline": [[0, 100], [600, "=high"]]}]}}],
    "grid": {"columns": 1, "rows": 2, "sizes": {"columns": 600, "rows": 400}}, "cuts": [{"id": "cut"}]})");
  const Design three = withVariables(with(design, 0, 3, "row-1"), {{"high", 250}, {"low", 120}}).value();
  const auto& sections = std::get<SectionsSurface>(three.source().surface->shape).sections;
  using Points = std::vector<Eigen::Vector2d>;
  EXPECT_EQ(sections[0].points,
            (Points{{0, 120}, {300, 230}, {600, 250}, {900, 230}, {1200, 120}, {1500, 230}, {1800, 250}}));
  EXPECT_EQ(sections[1].points, (Points{{0, 100}, {600, 250}, {1200, 100}, {1800, 250}}));
  EXPECT_EQ(*resolved(three), three);
}

TEST(GridChange, MirroredPointsStayOnBoundariesThatExpressionsMove) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "variables": [{"name": "width", "value": 600, "min": 100, "max": 900}],
    "sources": [{"id": "a", "surface": {"type": "sections", "sections": [
      {"y": 0, "spline": [[0, 100], ["=width", 200], ["=2*width", 100]]},
      {"y": 800, "spline": [[0, 100], [600, 200], [1200, 100]]}]}}],
    "grid": {"columns": 2, "rows": 1, "sizes": {"columns": "=width", "rows": 800}}, "cuts": [{"id": "cut"}]})");
  const Design four = with(design, 0, 4, "column-1");
  EXPECT_EQ(four.bindings.at("/sources/0/surface/sections/0/spline/4/0").text, "4*width");
  EXPECT_FALSE(four.bindings.contains("/sources/0/surface/sections/1/spline/4/0")) << "none is told so there";
  const Design wider = withVariables(four, {{"width", 700}}).value();
  EXPECT_EQ(std::get<SectionsSurface>(wider.source().surface->shape).sections[0].points,
            (std::vector<Eigen::Vector2d>{{0, 100}, {700, 200}, {1400, 100}, {2100, 200}, {2800, 100}}));
}

TEST(GridChange, JointsOfCubicsStayOnTheBoundariesInLine) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "sources": [{"id": "a", "surface": {"type": "sections", "sections": [
      {"y": 0, "bezier": [[0, 100], [200, 100], [500, 150], [600, 160], [750, 175], [1000, 90], [1200, 90]]},
      {"y": 800, "bezier": [[0, 100], [200, 100], [500, 150], [600, 160], [750, 175], [1000, 90], [1200, 90]]}]}}],
    "grid": {"columns": 2, "sizes": {"columns": 600}}, "cuts": [{"id": "cut"}]})");
  const auto chain = [](const Design& of) {
    return std::get<SectionsSurface>(of.source().surface->shape).sections[0].points;
  };
  const auto inLine = [](const std::vector<Eigen::Vector2d>& p, std::size_t joint) {
    const Eigen::Vector2d a = p[joint] - p[joint - 1], b = p[joint + 1] - p[joint];
    return a.normalized().dot(b.normalized()) > 1 - 1e-12;
  };
  BlockGrid other = *design.grid;
  other.sizes[0] = {500, 800};
  const auto moved = chain(*withGrid(design, *design.grid, other, "column-1"));
  ASSERT_EQ(moved.size(), 7u);
  EXPECT_EQ(moved[3], Eigen::Vector2d(500, 160));
  EXPECT_EQ(moved[6], Eigen::Vector2d(1300, 90));
  EXPECT_TRUE(inLine(moved, 3));
  const auto three = chain(with(design, 0, 3, "column-1"));
  ASSERT_EQ(three.size(), 10u);
  EXPECT_EQ(three[9], Eigen::Vector2d(1800, 160));
  EXPECT_TRUE(inLine(three, 3));
  EXPECT_TRUE(inLine(three, 6));
  EXPECT_EQ(chain(with(design, 0, 1, "column-1")).size(), 4u);
  // A cubic over two boundaries is divided where the surface is to end, and goes on from its height there.
  Design wide = design;
  for (SectionCurve& section : std::get<SectionsSurface>(wide.source().surface->shape).sections)
    section.points = {{0, 100},          {300, 180},  {600, 180}, {900, 140},
                      {1000, 380.0 / 3}, {1100, 100}, {1200, 100}};
  const SplineSurface before = splineOf(*wide.source().surface).value();
  const Design one = with(wide, 0, 1, "column-1");
  ASSERT_EQ(chain(one).size(), 4u);
  EXPECT_EQ(chain(one)[3].x(), 600);
  const SplineSurface after = splineOf(*one.source().surface).value();
  for (const double x : {0.0, 100.0, 300.0, 500.0, 599.0})
    EXPECT_NEAR(heightOf(after, x, 0.5), heightOf(before, x, 0.5), 1e-6) << x;
  const auto onward = chain(with(wide, 0, 3, "column-1"));
  EXPECT_NEAR(onward.back().y(), heightOf(before, 600, 0), 1e-6);
  EXPECT_EQ(onward.back().x(), 1800);
}

TEST(GridChange, KeyBladesStayOnTheBoundaries) {
  const Design design = designOf(R"({"bladewright_design": 2,
    "sources": [{"id": "a", "surface": {"type": "blades", "blades": [
      {"y": 0, "middle": [300, 200], "length_mm": 600}, {"y": 800, "middle": [300, 220], "length_mm": 600}]}}],
    "grid": {"rows": 1, "columns": 2, "sizes": {"columns": 600, "rows": 800}}, "cuts": [{"id": "cut"}]})");
  const Design rows = with(design, 1, 2, "column-1");
  const auto& blades = std::get<BladesSurface>(rows.source().surface->shape).blades;
  ASSERT_EQ(blades.size(), 3u);
  EXPECT_EQ(blades[2].y, 1600);
  EXPECT_EQ(blades[2].middle, Eigen::Vector2d(300, 220));
}

TEST(GridChange, ExpressionsOfLengthsThatGoGoWithThem) {
  const Design design =
      designOf(R"({"bladewright_design": 2, "variables": [{"name": "w", "value": 600, "min": 1, "max": 900}],
    "sources": [{"id": "a", "surface": {"type": "formula", "x": [0, 1800], "y": [0, 800], "formula": "100"}}],
    "grid": {"sizes": {"columns": ["=w", 500, "=w/2"], "rows": "=w + 200", "layers": "=w - 100"},
             "gaps": {"columns": "=w/100"}}, "cuts": [{"id": "cut"}]})");
  const auto placesOf = [](const Design& of) {
    std::vector<std::string> places;
    for (const auto& [place, bound] : of.bindings) places.push_back(place);
    return places;
  };
  // One for all goes on for those that there are.
  const Design two = with(design, 0, 2, "column-1");
  EXPECT_EQ(placesOf(two), (std::vector<std::string>{"/grid/gaps/columns", "/grid/sizes/columns/0",
                                                     "/grid/sizes/layers", "/grid/sizes/rows"}));
  EXPECT_EQ(*resolved(two), two);
  const Design rows = with(two, 1, 3, "column-1");
  EXPECT_EQ(rows.bindings, two.bindings);
  EXPECT_EQ(withVariables(rows, {{"w", 700}})->grid->sizes[1], (std::vector<double>{900, 900, 900}));
  // A single column has no gaps.
  const Design one = with(rows, 0, 1, "column-1-row-1");
  EXPECT_EQ(placesOf(one),
            (std::vector<std::string>{"/grid/sizes/columns/0", "/grid/sizes/layers", "/grid/sizes/rows"}));
  EXPECT_EQ(*resolved(one), one);
}

TEST(GridChange, ExpressionsOfOneBlockAreThoseOfAGridAndBack) {
  const Design design =
      designOf(R"({"bladewright_design": 2, "variables": [{"name": "w", "value": 600, "min": 1, "max": 900}],
    "sources": [{"id": "a", "surface": {"type": "formula", "x": [0, 600], "y": [0, 800], "formula": "100"}}],
    "stock": [{"id": "block", "block": {"origin": ["=w/6", 0, 0], "size": ["=w", 800, "=w - 100"], "rotation_deg": [0, 0, "=w/20"]}}],
    "cuts": [{"id": "cut"}]})");
  const Design three = with(design, 0, 3, "block");
  const Design wider = withVariables(three, {{"w", 700}}).value();
  EXPECT_EQ(wider.grid->sizes[0], (std::vector<double>{700, 700, 700}));
  EXPECT_EQ(wider.grid->sizes[2], (std::vector<double>{600}));
  EXPECT_NEAR(wider.grid->origin.x(), 700.0 / 6, 1e-9);
  EXPECT_NEAR(wider.grid->rotation.z(), 35 * kDegree, 1e-12);
  const Design one = with(three, 0, 1, "column-2");
  EXPECT_EQ(one.bindings, design.bindings);
  EXPECT_EQ(*resolved(one), one);
}

TEST(GridChange, TooManyAreRefused) {
  const Design design = single();
  const BlockGrid before = gridOf(design, *design.block().placement).value();
  BlockGrid many = withCount(withCount(before, 0, 100, false), 1, 26, false);
  const Result<Design> changed = withGrid(design, before, many, "block");
  ASSERT_FALSE(changed);
  EXPECT_NE(changed.error().message.find("2600 blocks are too many"), std::string::npos);
  many = before;
  many.sizes[0] = {0};
  EXPECT_FALSE(withGrid(design, before, many, "block"));
}

TEST(GridChange, BlocksThatAreListedHaveNoGrid) {
  Design design = single();
  design.stock.push_back({"other", design.block().placement});
  EXPECT_FALSE(gridOf(design, {}));
}

}  // namespace
}  // namespace bw
