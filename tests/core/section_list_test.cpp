// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/section_list.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/core/shape/key_blades.h"

namespace bw {

namespace {

using nlohmann::json;

Design designOf(const char* sections) {
  const json object = {
      {"bladewright_design", 2},
      {"variables", {{{"name", "a"}, {"value", 40}, {"min", 0}, {"max", 80}}}},
      {"sources", {{{"surface", {{"type", "sections"}, {"sections", json::parse(sections)}}}}}}};
  Result<Design> design = parseDesign(object.dump());
  EXPECT_TRUE(design) << design.error().message;
  return design.value_or(Design{});
}

const std::vector<SectionCurve>& sectionsOf(const Design& design) {
  return std::get<SectionsSurface>(design.source().surface->shape).sections;
}

/// The largest distance between two surfaces at the same shares of their length along x, at some y.
double apart(const Design& a, const Design& b) {
  const auto rows = [](const Design& design) {
    const SplineSurface spline = splineOf(*design.source().surface).value();
    std::vector<Eigen::Vector3d> points;
    const double first = spline.value(0, 0).y(), last = spline.value(0, 1).y();
    for (int i = 0; i <= 8; ++i) {
      double from = 0, to = 1;
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (from + to);
        (spline.value(0, middle).y() < first + (last - first) * i / 8 ? from : to) = middle;
      }
      for (int j = 0; j <= 20; ++j) points.push_back(spline.value(j / 20.0, from));
    }
    return points;
  };
  const auto p = rows(a), q = rows(b);
  double most = 0;
  for (std::size_t i = 0; i < p.size(); ++i) most = std::max(most, (p[i] - q[i]).norm());
  return most;
}

const char* const kBezier = R"([
  {"y": 0, "bezier": [[0, 200], [200, 260], [400, 260], [600, 200]]},
  {"y": 300, "bezier": [[0, 210], [200, "=200 + a"], [400, 280], [600, 190]]},
  {"y": 800, "bezier": [[0, 180], [200, 250], [400, 230], [600, "=5*a"]]}])";
const char* const kSpline = R"([
  {"y": 0, "spline": [[0, 200], [200, 260], [400, 260], [600, 200]]},
  {"y": 300, "spline": [[0, 210], [150, "=200 + a"], [400, 280], [600, 190]]},
  {"y": 800, "spline": [[0, 180], [200, 250], [400, 230], [600, 200]]}])";

}  // namespace

TEST(SectionList, AnotherSectionLiesOnTheLoft) {
  for (const char* text : {kBezier, kSpline}) {
    const Design before = designOf(text);
    const Design after = withSectionAfter(before, 0, 0).value();
    ASSERT_EQ(sectionsOf(after).size(), 4u);
    EXPECT_EQ(sectionsOf(after)[1].y, 150);
    EXPECT_EQ(sectionsOf(after)[1].kind, sectionsOf(before)[0].kind);
    EXPECT_EQ(sectionsOf(after)[1].points.size(), 4u);
    EXPECT_LT(apart(before, after), 5) << text;  // of a place, which moves along the surface, too
    // Expressions go with their sections.
    const std::string key = kSectionKinds[int(sectionsOf(before)[0].kind)];
    EXPECT_EQ(after.bindings.size(), before.bindings.size());
    EXPECT_EQ(after.bindings.at("/sources/0/surface/sections/2/" + key + "/1/1").text, "200 + a");
    EXPECT_EQ(withVariables(after, {{"a", 50}}).value().source().surface.has_value(), true);
    EXPECT_EQ(sectionsOf(withVariables(after, {{"a", 50}}).value())[2].points[1].y(), 250);
    EXPECT_EQ(withoutSection(after, 0, 1).value(), before);
  }
}

TEST(SectionList, BeyondTheLastOneItGoesOn) {
  const Design before = designOf(kBezier);
  const Design after = withSectionAfter(before, 0, 2).value();
  ASSERT_EQ(sectionsOf(after).size(), 4u);
  EXPECT_EQ(sectionsOf(after)[3].y, 1300);
  EXPECT_EQ(sectionsOf(after)[3].points, sectionsOf(before)[2].points);
  EXPECT_EQ(withoutSection(after, 0, 3).value(), before);
}

TEST(SectionList, ALoftKeepsTwoSections) {
  const Design two = withoutSection(designOf(kBezier), 0, 1).value();
  EXPECT_EQ(two.bindings.size(), 1u);
  EXPECT_EQ(two.bindings.count("/sources/0/surface/sections/1/bezier/3/1"), 1u);
  EXPECT_EQ(withoutSection(two, 0, 0).error().message,
            "a loft keeps two sections, so none of these can be taken away");
}

TEST(SectionList, AnotherPoleLeavesABezierCurveAsItIs) {
  const Design before = designOf(kBezier);
  std::size_t added = 0;
  const Design after = withPointAfter(before, 0, 2, 2, &added).value();
  EXPECT_EQ(added, 3u);
  ASSERT_EQ(sectionsOf(after)[2].points.size(), 7u);
  EXPECT_EQ(sectionsOf(after)[2].points[3], Eigen::Vector2d(300, 227.5));
  EXPECT_EQ(after.bindings.at("/sources/0/surface/sections/2/bezier/6/1").text, "5*a");
  EXPECT_LT(apart(before, after), 0.5);
  // The joint goes again, and the curve is what it was.
  for (const std::size_t pole : {2, 3, 4}) {
    const Design again = withoutPoint(after, 0, 2, pole).value();
    ASSERT_EQ(sectionsOf(again)[2].points.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((sectionsOf(again)[2].points[i] - sectionsOf(before)[2].points[i]).norm(), 1e-9);
    EXPECT_EQ(again.bindings, before.bindings);
  }
  EXPECT_EQ(sectionsOf(withoutPoint(after, 0, 2, 0).value())[2].points.front(), Eigen::Vector2d(300, 227.5));
  EXPECT_EQ(sectionsOf(withoutPoint(after, 0, 2, 6).value())[2].points.back(), Eigen::Vector2d(300, 227.5));
}

TEST(SectionList, AnotherPointOfASplineLiesOnIt) {
  const Design before = designOf(kSpline);
  std::size_t added = 0;
  const Design after = withPointAfter(before, 0, 1, 0, &added).value();
  EXPECT_EQ(added, 1u);
  ASSERT_EQ(sectionsOf(after)[1].points.size(), 5u);
  EXPECT_EQ(after.bindings.at("/sources/0/surface/sections/1/spline/2/1").text, "200 + a");
  EXPECT_LT(apart(before, after), 2);
  EXPECT_EQ(withoutPoint(after, 0, 1, 1).value(), before);
  // Before the last one where there is none beyond.
  EXPECT_EQ(withPointAfter(before, 0, 1, 3, &added).value().source().surface.has_value(), true);
  EXPECT_EQ(added, 3u);
}

TEST(SectionList, ACurveKeepsTwoPoints) {
  Design design = designOf(kSpline);
  design = withoutPoint(design, 0, 0, 1).value();
  design = withoutPoint(design, 0, 0, 1).value();
  EXPECT_EQ(withoutPoint(design, 0, 0, 1).error().message,
            "section 1 keeps two points, so none can be taken away");
}

TEST(SectionList, ASectionIsRepeatedWithItsExpressions) {
  const Design before = designOf(kBezier);
  const Design after = withEntryRepeated(before, 0, 1).value();
  ASSERT_EQ(sectionsOf(after).size(), 4u);
  EXPECT_EQ(sectionsOf(after)[2].y, 550);
  EXPECT_EQ(sectionsOf(after)[2].points, sectionsOf(before)[1].points);
  EXPECT_EQ(sectionsOf(after)[2].kind, sectionsOf(before)[1].kind);
  EXPECT_EQ(sectionsOf(after)[3], sectionsOf(before)[2]);
  EXPECT_EQ(after.bindings.size(), before.bindings.size() + 1);
  const Design other = withVariables(after, {{"a", 50}}).value();
  EXPECT_EQ(sectionsOf(other)[1].points[1].y(), 250);
  EXPECT_EQ(sectionsOf(other)[2].points[1].y(), 250) << "both follow";
  EXPECT_EQ(sectionsOf(other)[3].points[3].y(), 250) << "and the one behind them";
  EXPECT_EQ(withoutSection(after, 0, 2).value(), before);
  EXPECT_EQ(sectionsOf(withEntryRepeated(before, 0, 2).value())[3].y, 1300) << "beyond the last";
  Design full = before;
  auto& sections = std::get<SectionsSurface>(full.sources[0].surface->shape).sections;
  while (sections.size() < std::size_t(SectionsSurface::kMost)) {
    sections.push_back(sections.back());
    sections.back().y += 10;
  }
  EXPECT_EQ(withEntryRepeated(full, 0, 1).error().message,
            "the surface has 200 sections, as many as it may have");
}

TEST(SectionList, AShapeIsCopiedWithItsExpressionsButNotItsPlace) {
  const Design before = designOf(R"([
    {"y": "=a", "bezier": [[0, 200], [200, "=220 + a"], [400, 260], [600, 200]]},
    {"y": 300, "spline": [[0, 210], [150, "=200 + a"], [250, 250], [400, 280], [600, 190]]},
    {"y": "=760 + a", "bezier": [[0, 180], [200, 250], [400, 230], [600, "=5*a"]]}])");
  ASSERT_EQ(before.bindings.size(), 5u);
  const Design after = withShapeCopied(before, 0, 1, {0, 2});
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(sectionsOf(after)[i].points, sectionsOf(before)[1].points);
    EXPECT_EQ(sectionsOf(after)[i].kind, SectionCurve::Kind::spline);
    EXPECT_EQ(sectionsOf(after)[i].y, sectionsOf(before)[i].y);
  }
  EXPECT_EQ(after.bindings.size(), 5u) << "two places, and three heights that are told alike";
  const Design other = withVariables(after, {{"a", 50}}).value();
  for (const std::size_t i : {0, 1, 2}) EXPECT_EQ(sectionsOf(other)[i].points[1].y(), 250);
  EXPECT_EQ(sectionsOf(other)[0].y, 50);
  EXPECT_EQ(sectionsOf(other)[2].y, 810);
  EXPECT_EQ(withShapeCopied(before, 0, 1, {1}), before);
  // Rows of poles.
  const json object = {
      {"bladewright_design", 2},
      {"variables", {{{"name", "a"}, {"value", 40}, {"min", 0}, {"max", 80}}}},
      {"sources",
       {{{"surface",
          {{"type", "poles"}, {"x", {0, 600}}, {"y", {0, 800}}, {"degree", {1, 1}}, {"poles", json::parse(R"([
         [200, "=200 + a"], [{"height": "=a", "moved": [5, 0]}, 230], ["=3*a", 240]])")}}}}}}};
  const Result<Design> grid = parseDesign(object.dump());
  ASSERT_TRUE(grid) << grid.error().message;
  const Design rows = withShapeCopied(*grid, 0, 1, {0, 2});
  const auto& poles = std::get<PolesSurface>(rows.source().surface->shape);
  for (const int row : {0, 2})
    for (const int column : {0, 1}) EXPECT_EQ(poles.at(row, column), poles.at(1, column));
  EXPECT_EQ(rows.bindings.size(), 3u);
  const Design lifted = withVariables(rows, {{"a", 50}}).value();
  for (const int row : {0, 1, 2})
    EXPECT_EQ(std::get<PolesSurface>(lifted.source().surface->shape).at(row, 0).height, 50);
}

TEST(SectionList, KeyBladesComeAndGoWithTheExpressionsOfTheOthersKept) {
  const json object = {{"bladewright_design", 2},
                       {"variables", {{{"name", "a"}, {"value", 40}, {"min", 0}, {"max", 80}}}},
                       {"sources", {{{"surface", {{"type", "blades"}, {"blades", json::parse(R"([
             {"y": 0, "middle": [300, "=200 + a"], "length_mm": 620, "bend": -0.4},
             {"y": 300, "middle": [310, 250], "angle_deg": "=a/10", "length_mm": 630, "bend": -0.6},
             {"y": 800, "middle": [300, "=230 + a"], "length_mm": 610, "bend": -0.2, "force": [-2, "=a/20"]}])")}}}}}}};
  const Result<Design> read = parseDesign(object.dump());
  ASSERT_TRUE(read) << read.error().message;
  const Design& before = *read;
  ASSERT_EQ(before.bindings.size(), 4u);
  const auto blades = [](const Design& design) {
    return std::get<BladesSurface>(design.source().surface->shape).blades;
  };
  const Design after = withBladeAfter(before, 0, 0).value();
  ASSERT_EQ(blades(after).size(), 4u);
  EXPECT_EQ(blades(after)[1].y, 150);
  EXPECT_EQ(blades(after)[1], BladeSweep::through(blades(before))->at(150)) << "the blade that was there";
  EXPECT_EQ(after.bindings.size(), 4u);
  EXPECT_EQ(after.bindings.at("/sources/0/surface/blades/2/angle_deg").text, "a/10");
  EXPECT_EQ(after.bindings.at("/sources/0/surface/blades/3/force/1").text, "a/20");
  const Design other = withVariables(after, {{"a", 50}}).value();
  EXPECT_EQ(blades(other)[0].middle.y(), 250);
  EXPECT_EQ(blades(other)[3].middle.y(), 280);
  EXPECT_EQ(blades(other)[1], blades(after)[1]) << "the new one is free";
  EXPECT_EQ(withoutBlade(after, 0, 1).value(), before);
  // Once more as it is, and another one's numbers.
  const Design twice = withEntryRepeated(before, 0, 1).value();
  EXPECT_EQ(blades(twice)[2].y, 550);
  EXPECT_EQ(blades(twice)[2].angle, blades(before)[1].angle);
  EXPECT_EQ(twice.bindings.size(), 5u);
  EXPECT_EQ(twice.bindings.at("/sources/0/surface/blades/2/angle_deg").text, "a/10");
  EXPECT_EQ(withoutBlade(twice, 0, 2).value(), before);
  const Design alike = withShapeCopied(before, 0, 2, {0});
  EXPECT_EQ(blades(alike)[0].force, blades(before)[2].force);
  EXPECT_EQ(blades(alike)[0].y, 0);
  EXPECT_EQ(alike.bindings.at("/sources/0/surface/blades/0/middle/1").text, "230 + a");
  EXPECT_EQ(alike.bindings.at("/sources/0/surface/blades/0/force/1").text, "a/20");
  const Design without = withoutBlade(before, 0, 1).value();
  EXPECT_EQ(without.bindings.size(), 3u) << "that of the one that went is gone";
  EXPECT_EQ(without.bindings.at("/sources/0/surface/blades/1/middle/1").text, "230 + a");
  EXPECT_EQ(withoutBlade(without, 0, 0).error().message,
            "a surface keeps two key blades, so none of these can be taken away");
}

}  // namespace bw
