// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>

#include "bw/scene/navigation.h"
#include "scene/actors/grid_lines.h"
#include "scene/actors/mesh_lines.h"
#include "scene/camera/picking.h"
#include "scene/legend/legend_range.h"
#include "scene/render/polyline.h"
#include "scene/render/text_wrap.h"
#include "scene_sample.h"

namespace {

using namespace bw;
using namespace bw::scene;

double luminance(const Rgb& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

/// A grid of level points 10 mm apart along its rows, of which row r lies at `rows[r]`.
SurfaceGrid levelGrid(const std::vector<double>& rows, int columns) {
  SurfaceGrid grid;
  grid.rows = int(rows.size());
  grid.columns = columns;
  for (const double y : rows)
    for (int c = 0; c < columns; ++c) grid.points.emplace_back(10.0 * c, y, 0);
  return grid;
}

/// Rows some 10 mm apart.
std::vector<double> unevenRows(int count) {
  std::vector<double> rows;
  for (int r = 0; r < count; ++r) rows.push_back(10 * r + 4 * std::sin(7.0 * r));
  return rows;
}

KeptLines kept(const SurfaceGrid& grid, const std::vector<double>* values = nullptr, double gap = 0) {
  return unseenLines(grid, std::vector<Eigen::Vector3d>(grid.points.size(), Eigen::Vector3d::UnitZ()), values,
                     {0.1, 0.01, 0.5, gap});
}

TEST(UnseenLines, AreAllBetweenTheBordersOfALevelGrid) {
  const SurfaceGrid grid = levelGrid(unevenRows(50), 20);
  std::vector<double> values;  // that rise evenly
  for (const Eigen::Vector3d& p : grid.points) values.push_back(0.3 * p.x() - 0.7 * p.y());
  EXPECT_EQ(kept(grid), (KeptLines{{0, 49}, {0, 19}}));
  EXPECT_EQ(kept(grid, &values), (KeptLines{{0, 49}, {0, 19}}));
}

TEST(UnseenLines, AreNoneThatAPlaceANormalOrAValueTells) {
  SurfaceGrid grid = levelGrid(unevenRows(50), 20);
  const std::size_t at = 17 * 20 + 5;
  const KeptLines spot{{0, 16, 17, 18, 49}, {0, 4, 5, 6, 19}};
  std::vector<double> values(grid.points.size(), 0.0);
  values[at] = 20;
  EXPECT_EQ(kept(grid, &values), spot);
  values[at] = 0.4;  // which is not seen
  EXPECT_EQ(kept(grid, &values), (KeptLines{{0, 49}, {0, 19}}));
  std::vector<Eigen::Vector3d> normals(grid.points.size(), Eigen::Vector3d::UnitZ());
  normals[at] = Eigen::Vector3d(0.4, 0, 1).normalized();
  EXPECT_EQ(unseenLines(grid, normals, nullptr, {0.1, 0.01, 0, 0}), spot);
  grid.points[at].z() = 4;
  EXPECT_EQ(kept(grid), spot);
  // Between lines as close as that nothing is asked.
  EXPECT_EQ(kept(grid, nullptr, 1000), (KeptLines{{0, 49}, {0, 19}}));
}

TEST(UnseenLines, AreNoneBesideWhatIsNoNumber) {
  for (const double none : {std::nan(""), double(INFINITY)}) {
    SurfaceGrid grid = levelGrid(unevenRows(9), 9);
    grid.points[4 * 9 + 4].z() = none;
    EXPECT_EQ(kept(grid), (KeptLines{{0, 3, 4, 5, 8}, {0, 3, 4, 5, 8}}));
    grid = levelGrid(unevenRows(9), 9);
    std::vector<double> values(grid.points.size(), 1.0);
    values[0] = none;
    EXPECT_EQ(kept(grid, &values), (KeptLines{{0, 1, 8}, {0, 1, 8}}));
  }
}

TEST(UnseenLines, LeaveThePlacesOfAWaveWhereTheyAre) {
  SurfaceGrid grid = levelGrid(unevenRows(200), 3);
  for (Eigen::Vector3d& p : grid.points) p.z() = 30 * std::sin(p.y() / 150);
  const std::vector<int> rows = kept(grid).rows;
  EXPECT_LT(rows.size(), 100u);
  EXPECT_GT(rows.size(), 20u);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    for (int r = rows[k] + 1; r < rows[k + 1]; ++r) {
      const Eigen::Vector3d a = grid.at(rows[k], 1), way = grid.at(rows[k + 1], 1) - a;
      EXPECT_LE((grid.at(r, 1) - a).cross(way).norm() / way.norm(), 0.1);
    }
}

double spread(const Rgb& c) { return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}); }

TEST(ColorMaps, SequentialMapsGrowLighterAllTheWay) {
  for (const auto map : {viridis, cividis}) {
    double before = -1;
    for (int i = 0; i <= 200; ++i) {
      const double now = luminance(map(i / 200.0));
      EXPECT_GT(now, before);
      before = now;
    }
  }
}

TEST(ColorMaps, EndsAreThoseOfTheDefinition) {
  EXPECT_NEAR(viridis(0).r, 0x44 / 255.0, 1e-3);
  EXPECT_NEAR(viridis(0).b, 0x54 / 255.0, 1e-3);
  EXPECT_NEAR(viridis(1).r, 0xFD / 255.0, 1e-3);
  EXPECT_NEAR(viridis(1).b, 0x25 / 255.0, 1e-3);
  EXPECT_NEAR(viridis(7).g, viridis(1).g, 1e-12);
  EXPECT_NEAR(viridis(std::nan("")).g, viridis(0).g, 1e-12);
}

TEST(ColorMaps, DeviationIsPaleWithinTheToleranceStepsThereAndSaturates) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_LT(spread(deviationColor(0, 2, 6)), 0.02);
    double before = spread(deviationColor(0, 2, 6));
    for (double v = 0.2; v <= 2; v += 0.1) {
      const Rgb c = deviationColor(sign * v, 2, 6);
      EXPECT_GT(spread(c), before) << v;
      EXPECT_GT(luminance(c), 0.5) << v;
      before = spread(c);
    }
    // Half of the tolerance is seen on the screen: more than a tenth of the range of a channel.
    EXPECT_GT(spread(deviationColor(sign * 1, 2, 6)), 0.1);
    EXPECT_GT(spread(deviationColor(sign * 2.001, 2, 6)), before + 0.15);
    EXPECT_LT(luminance(deviationColor(sign * 2.001, 2, 6)), 0.3);
    EXPECT_EQ(deviationColor(sign * 6, 2, 6).g, deviationColor(sign * 60, 2, 6).g);
    double bright = 2;
    for (double v = 2.01; v <= 6; v += 0.1) {
      const double now = luminance(deviationColor(sign * v, 2, 6));
      EXPECT_LT(now, bright);
      bright = now;
    }
  }
  EXPECT_GT(deviationColor(3, 2, 6).r, deviationColor(3, 2, 6).b);
  EXPECT_GT(deviationColor(-3, 2, 6).b, deviationColor(-3, 2, 6).r);
  EXPECT_GT(deviationColor(1, 2, 6).r, deviationColor(1, 2, 6).b);
  EXPECT_GT(deviationColor(-1, 2, 6).b, deviationColor(-1, 2, 6).r);
}

TEST(ColorMaps, ScaleThatEndsOrBeginsWithinTheToleranceShowsAllOfThePaleColours) {
  EXPECT_NEAR(spread(deviationColor(0.3, 2, 0.3)), spread(deviationColor(2, 2, 6)), 1e-9);
  const ColorMap aside{"deviation", {0.5, 0.6}, 2, {}};
  EXPECT_LT(spread(aside.at(0.5)), 0.02);
  EXPECT_GT(spread(aside.at(0.6)), 0.2);
  const ColorMap below{"deviation", {-9, -5}, 2, {}};
  EXPECT_GT(std::abs(luminance(below.at(-5)) - luminance(below.at(-9))), 0.1);
}

TEST(ColorMaps, BeyondTheLimitIsRedAndUpToItTheScaleStaysTheSame) {
  const ColorMap map{"curvature", {0, 1.5}, 0, 1.0}, within{"curvature", {0, 1}, 0, 1.0};
  EXPECT_GT(map.at(1.01).r, map.at(1.01).b + 0.5);
  EXPECT_LT(spread(map.at(0.5)), 0.3);
  EXPECT_EQ(map.at(0.5).g, within.at(0.5).g);
  const ColorMap stress{"stress", {0, 500}, 0, 400.0};
  EXPECT_GT(stress.at(401).r, stress.at(401).b + 0.5);
}

TEST(TextWrap, WrapsItsWordsAndEndsInAnEllipsis) {
  EXPECT_EQ(wrapped("one two  three", 7, 4), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("one two three four", 7, 2), (std::vector<std::string>{"one two", "three \u2026"}));
  EXPECT_EQ(wrapped("unbreakable", 4, 2), (std::vector<std::string>{"unbreakable"}));
  EXPECT_TRUE(wrapped("", 4, 2).empty());
}

TEST(Ticks, StepsAreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(roundStep(10, 5), 2);
  EXPECT_DOUBLE_EQ(roundStep(0.73, 6), 0.1);
  EXPECT_DOUBLE_EQ(roundStep(670, 8), 100);
  EXPECT_DOUBLE_EQ(roundStep(0, 8), 1);
  for (double span = 1e-6; span < 1e7; span *= 1.37) {
    const double step = roundStep(span, 6);
    EXPECT_GE(span / step, 3.5);
    EXPECT_LE(span / step, 9.5);
  }
}

TEST(Ticks, RangesHoldTheDataWithRoundEnds) {
  EXPECT_EQ(roundRange(0, 28, 6), std::make_pair(0.0, 30.0));
  EXPECT_EQ(roundRange(0, 30, 6), std::make_pair(0.0, 30.0));
  const auto [low, high] = roundRange(3, 3, 6);
  EXPECT_LT(low, 3);
  EXPECT_GT(high, 3);
  const Ticks ticks = ticksIn(-0.35, 0.4, 6);
  EXPECT_EQ(ticks.decimals, 1);
  ASSERT_EQ(ticks.values.size(), 8u);
  EXPECT_NEAR(ticks.values.front(), -0.3, 1e-12);
  EXPECT_NEAR(ticks.values.back(), 0.4, 1e-12);
  EXPECT_TRUE(ticksIn(1, 1, 6).values.empty());
}

TEST(Ticks, TextsHaveATrueMinusAndAPlusWhereAsked) {
  EXPECT_EQ(tickText(-1.5, 1, true), "\u22121.5");
  EXPECT_EQ(tickText(1.5, 1, true), "+1.5");
  EXPECT_EQ(tickText(1.5, 1, false), "1.5");
  EXPECT_EQ(tickText(0, 1, true), "0.0");
  EXPECT_EQ(tickText(-0.0001, 1, true), "0.0");
}

TEST(LegendRange, DeviationIsSymmetricAndFollowsTheDataDownToATenthOfTheTolerance) {
  Style style;
  style.tolerance = 2;
  const auto range = [&](double min, double max) {
    return legendRangeOf("deviation", {min, max, 10}, style);
  };
  EXPECT_EQ(range(-13, 0.5), std::make_pair(-15.0, 15.0));
  EXPECT_EQ(range(-1.3, 0.5), std::make_pair(-2.0, 2.0));
  EXPECT_EQ(range(-0.08, 0.03), std::make_pair(-0.2, 0.2));
  EXPECT_EQ(range(-1e-9, 1e-12), std::make_pair(-0.2, 0.2));
  EXPECT_NEAR(range(-0.35, 0.5).second, 0.6, 1e-12);
  style.tolerance = 0;
  EXPECT_GT(range(0, 0).second, 0);
}

TEST(LegendRange, LimitsRunFromZeroAndTheRelativeSpeedToOne) {
  const Style style;
  EXPECT_EQ(legendRangeOf("curvature", {0.31, 0.52, 10}, style, 1.0), std::make_pair(0.0, 1.0));
  EXPECT_EQ(legendRangeOf("curvature", {0.31, 1.4, 10}, style, 1.0), std::make_pair(0.0, 7 * 0.2));
  EXPECT_EQ(legendRangeOf("stress", {100, 130, 10}, style, 416.0), std::make_pair(0.0, 416.0));
  EXPECT_EQ(legendRangeOf("relative_speed", {0.98, 1, 10}, style), std::make_pair(0.0, 1.0));
}

TEST(LegendRange, RoundingErrorsMakeNoPicture) {
  const Style style;
  EXPECT_EQ(legendRangeOf("angle", {4, 28, 10}, style), std::make_pair(0.0, 30.0));
  EXPECT_EQ(legendRangeOf("angle", {24, 28, 10}, style), std::make_pair(24.0, 28.0));
  for (const char* field : {"speed", "angle", "relative_speed", "unheard"}) {
    for (const double level : {0.0, 1e-12, 0.3, 1.0, 20.0, 12345.0}) {
      for (const double noise : {0.0, 1e-15, 1e-9}) {
        const auto [low, high] = legendRangeOf(field, {level * (1 - noise), level, 10}, style);
        EXPECT_GE(high - low, 0.0999 * level) << field << level;
        EXPECT_GE(high - low, 1e-3) << field << level;
        EXPECT_LE(low, level * (1 - noise));
        EXPECT_GE(high, level * (1 - 1e-9));
        EXPECT_GE(low, 0) << field << level;
      }
    }
  }
  EXPECT_EQ(legendRangeOf("speed", {19.9999994, 20, 10}, style), std::make_pair(18.0, 20.0));
}

TEST(LegendRange, WishedEndsKeepAScale) {
  const FieldSummary angle{4, 28, 10};
  const auto range = [&](std::optional<double> low, std::optional<double> high) {
    Style style;
    style.rangeMin = low;
    style.rangeMax = high;
    return legendRangeOf("angle", angle, style);
  };
  EXPECT_EQ(range(5, 17.5), std::make_pair(5.0, 17.5));
  EXPECT_EQ(range(17.5, 5), std::make_pair(5.0, 17.5));
  EXPECT_EQ(range(5, 5), std::make_pair(5.0, 35.0));
  EXPECT_EQ(range(30, {}), std::make_pair(30.0, 60.0));
  EXPECT_NEAR(range(29.999, {}).second, 59.999, 1e-9);
  EXPECT_EQ(range({}, -5), std::make_pair(-35.0, -5.0));
  EXPECT_EQ(range(0, 1e-7), std::make_pair(0.0, 1e-7));
}

TEST(Isolines, LieOnTheLevelsOfALinearField) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> values;
  const int n = 12;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      points.emplace_back(i, j, 0.1 * i * j);
      values.push_back(0.7 * i + 0.31 * j);
      if (i == n || j == n) continue;
      const int a = j * (n + 1) + i;
      triangles.push_back({a, a + 1, a + n + 2});
      triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  const Segments segments = isolines(points, triangles, values, {6, 3});
  double length = 0;
  for (const auto& [p, q] : segments) {
    for (const Eigen::Vector3d& end : {p, q}) {
      const double value = 0.7 * end.x() + 0.31 * end.y();
      EXPECT_LT(std::min(std::abs(value - 3), std::abs(value - 6)), 1e-9);
    }
    length += (q - p).head<2>().norm();
  }
  // The straight lines 0.7 x + 0.31 y = 3 and = 6 within the square.
  const auto inside = [&](double level) {
    const Eigen::Vector2d a(level / 0.7, 0);
    const double yTop = std::min(12.0, level / 0.31);
    return (Eigen::Vector2d((level - 0.31 * yTop) / 0.7, yTop) - a).norm();
  };
  EXPECT_NEAR(length, inside(3) + inside(6), 1e-9);
}

TEST(Isolines, JoinToWholeLinesOpenAndClosed) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<double> radius;
  const int n = 30;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      points.emplace_back(i - 15.2, j - 14.7, 0);
      radius.push_back(points.back().norm());
      if (i == n || j == n) continue;
      const int a = j * (n + 1) + i;
      triangles.push_back({a, a + 1, a + n + 2});
      triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  const std::vector<Isoline> lines = joinedIsolines(points, triangles, radius, {18, 5, 10});
  // Two closed circles, and four arcs in the corners.
  ASSERT_EQ(lines.size(), 6u);
  for (const Isoline& isoline : lines) {
    const bool closed = (isoline.line.front() - isoline.line.back()).norm() < 1e-12;
    EXPECT_EQ(closed, isoline.level < 15) << isoline.level;
    for (std::size_t i = 0; i + 1 < isoline.line.size(); ++i)
      EXPECT_LT((isoline.line[i + 1] - isoline.line[i]).norm(), 1.5);
    for (const Eigen::Vector3d& p : isoline.line) EXPECT_NEAR(p.norm(), isoline.level, 0.1);
  }
  EXPECT_EQ(lines[0].level, 5);
  EXPECT_GT(lines[1].line.size(), 50u);
}

TEST(Isolines, LeaveOutTrianglesWithoutANumber) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(isolines(points, {{0, 1, 2}}, {0, 1, 1}, {0.5}).size(), 1u);
  EXPECT_TRUE(isolines(points, {{0, 1, 2}}, {0, std::nan(""), 1}, {0.5}).empty());
  EXPECT_TRUE(isolines(points, {{0, 1, 2}}, {0.5, 0.5, 0.5}, {0.5}).empty());
}

TEST(TriangleTree, FindsWhatASearchThroughAllFinds) {
  const Content content = test::sampleContent();
  const TriangleMesh& mesh = *content.first<TriangleMesh>();
  const TriangleTree tree(mesh.points, mesh.triangles);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    // From anywhere, towards the panel or past it.
    const Eigen::Vector3d from(300 + 900 * unit(random), 300 + 900 * unit(random), 120 + 500 * unit(random));
    const Eigen::Vector3d to(300 + 400 * unit(random), 335 + 450 * unit(random), 120);
    const Ray ray{from, (to - from).normalized()};
    double best = 1e300;
    for (const auto& [a, b, c] : mesh.triangles) {
      Eigen::Matrix3d m;
      m << mesh.points[std::size_t(b)] - mesh.points[std::size_t(a)],
          mesh.points[std::size_t(c)] - mesh.points[std::size_t(a)], -ray.direction;
      if (std::abs(m.determinant()) < 1e-12) continue;
      const Eigen::Vector3d uvt = m.partialPivLu().solve(ray.origin - mesh.points[std::size_t(a)]);
      if (uvt.x() >= 0 && uvt.y() >= 0 && uvt.x() + uvt.y() <= 1 && uvt.z() > 0)
        best = std::min(best, uvt.z());
    }
    const std::optional<RayHit> hit = tree.firstHit(ray);
    EXPECT_EQ(hit.has_value(), best < 1e300);
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, best, 1e-6);
    EXPECT_NEAR(hit->weights.sum(), 1, 1e-12);
    const auto& corners = mesh.triangles[std::size_t(hit->triangle)];
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) p += hit->weights[k] * mesh.points[std::size_t(corners[std::size_t(k)])];
    EXPECT_LT((p - ray.at(hit->t)).norm(), 1e-6);
  }
  EXPECT_GT(hits, 30);
  EXPECT_LT(hits, 60);
  const std::vector<Eigen::Vector3d> none;
  const std::vector<std::array<int, 3>> noTriangles;
  EXPECT_FALSE(TriangleTree(none, noTriangles).firstHit({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}));
}

TEST(Projection, PixelAndRayAreInverse) {
  for (const bool parallel : {false, true}) {
    const Projection view({400, -900, 700}, {300, 300, 100}, {0, 0, 1}, 30, parallel, 350, 1280, 800);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(600, 100, 50), Eigen::Vector3d(-40, 700, 250)}) {
      const Eigen::Vector3d pixel = view.toPixel(p);
      const Ray ray = view.ray(pixel.x(), pixel.y());
      EXPECT_LT((p - ray.origin).cross(ray.direction).norm(), 1e-9 * 1000);
    }
    const Eigen::Vector3d middle = view.toPixel({300, 300, 100});
    EXPECT_NEAR(middle.x(), 640, 1e-9);
    EXPECT_NEAR(middle.y(), 400, 1e-9);
  }
}

TEST(MovingBlade, LiesBetweenItsNeighbours) {
  const std::vector<Polyline> blades{{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}},
                                     {{0, 5, 0}, {10, 5, 2}, {20, 5, 0}}};
  const Polyline middle = bladeAt(blades, 0.25);
  ASSERT_EQ(middle.size(), 3u);
  EXPECT_LT((middle[1] - Eigen::Vector3d(10, 1.25, 0.5)).norm(), 1e-12);
  EXPECT_EQ(bladeAt(blades, 1), blades[1]);
  EXPECT_EQ(bladeAt(blades, 99), blades[1]);
  EXPECT_TRUE(bladeAt(blades, -1).empty());
  EXPECT_TRUE(bladeAt({}, 0).empty());
}

TEST(MovingBlade, JoinsLinesOfDifferentCountsByLength) {
  const std::vector<Polyline> blades{{{0, 0, 0}, {30, 0, 0}},
                                     {{0, 6, 0}, {10, 6, 0}, {20, 6, 0}, {30, 6, 0}}};
  const Polyline middle = bladeAt(blades, 0.5);
  ASSERT_EQ(middle.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT((middle[k] - Eigen::Vector3d(10.0 * double(k), 3, 0)).norm(), 1e-12);
}

TEST(Dashes, CoverTheLineInTheirProportion) {
  const auto pieces = dashes({{0, 0, 0}, {7, 0, 0}, {30, 0, 0}}, 3, 2);
  double length = 0;
  for (const auto& [a, b] : pieces) length += (b - a).norm();
  EXPECT_NEAR(length, 18, 1e-9);
  EXPECT_LT(pieces.front().first.norm(), 1e-12);
  EXPECT_TRUE(dashes({{0, 0, 0}}, 3, 2).empty());
  EXPECT_TRUE(dashes({{0, 0, 0}, {1, 0, 0}}, 0, 2).empty());
}

TEST(Blades, AreCutAtTheFacesOfTheBlock) {
  Box block;
  block.size = {10, 10, 10};
  const Polyline blade{{-5, 5, 5}, {2, 5, 5}, {8, 5, 5}, {16, 5, 5}};
  const auto outside = clipped(blade, block, Side::outside);
  ASSERT_EQ(outside.size(), 2u);
  EXPECT_NEAR(outside[0].back().x(), 0, 1e-12);
  EXPECT_NEAR(outside[1].front().x(), 10, 1e-12);
  EXPECT_NEAR(outside[1].back().x(), 16, 1e-12);
  const auto inside = clipped(blade, block, Side::inside);
  ASSERT_EQ(inside.size(), 1u);
  ASSERT_EQ(inside[0].size(), 4u);
  EXPECT_NEAR(inside[0].front().x(), 0, 1e-12);
  EXPECT_NEAR(inside[0].back().x(), 10, 1e-12);
  // One edge that runs through the whole block, or past it.
  EXPECT_EQ(clipped({{-5, 5, 5}, {16, 5, 5}}, block, Side::outside).size(), 2u);
  EXPECT_EQ(clipped({{-5, 5, 5}, {16, 5, 5}}, block, Side::inside).size(), 1u);
  EXPECT_EQ(clipped({{-5, 50, 5}, {16, 50, 5}}, block, Side::outside).size(), 1u);
  EXPECT_TRUE(clipped({{-5, 50, 5}, {16, 50, 5}}, block, Side::inside).empty());
  // In, out and in again.
  EXPECT_EQ(clipped({{1, 1, 5}, {1, 20, 5}, {8, 20, 5}, {8, 1, 5}}, block, Side::inside).size(), 2u);
  EXPECT_EQ(clipped({{1, 1, 5}, {1, 20, 5}, {8, 20, 5}, {8, 1, 5}}, block, Side::outside).size(), 1u);
}

TEST(Blades, ExtensionsRunFromTheStationOutwards) {
  const Polyline blade{{-5, 5, 5}, {1, 5, 5}, {5, 5, 5}, {9, 5, 5}, {16, 5, 5}},
      station{{1, 5, 5}, {9, 5, 5}};
  const auto beyond = beyondStation(blade, station);
  ASSERT_EQ(beyond.size(), 2u);
  EXPECT_NEAR(beyond[0].front().x(), 1, 1e-12);
  EXPECT_NEAR(beyond[0].back().x(), -5, 1e-12);
  EXPECT_NEAR(beyond[1].front().x(), 9, 1e-12);
  EXPECT_NEAR(beyond[1].back().x(), 16, 1e-12);
  EXPECT_EQ(beyondStation(blade, {}), std::vector<Polyline>{blade});
  EXPECT_TRUE(beyondStation({}, station).empty());
}

TEST(Mesh, BoundaryOfASquareAndItsNormals) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(boundaryEdges(points, triangles).size(), 4u);
  for (const Eigen::Vector3d& n : pointNormals(points, triangles))
    EXPECT_LT((n - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

Camera sampleCamera() {
  Camera camera;
  camera.focus = {300, 300, 100};
  camera.position = {1100, -700, 600};
  const Eigen::Vector3d forward = (camera.focus - camera.position).normalized();
  camera.up = forward.cross(Eigen::Vector3d::UnitZ()).cross(forward).normalized();
  camera.parallelScale = 300;
  return camera;
}

Eigen::Vector2d pixelOf(const Camera& camera, const Eigen::Vector3d& p) {
  return Projection(camera.position, camera.focus, camera.up, camera.viewAngle, camera.parallel,
                    camera.parallelScale, 1000, 700)
      .toPixel(p)
      .head<2>();
}

TEST(Navigation, OrbitKeepsThePivotInItsPlaceAndTheHorizonLevel) {
  for (const bool parallel : {false, true}) {
    Camera camera = sampleCamera();
    camera.parallel = parallel;
    const Eigen::Vector3d pivot(500, 200, 160);
    for (const auto& [azimuth, elevation] :
         {std::pair{0.4, 0.1}, std::pair{-1.3, -0.6}, std::pair{3.0, 0.3}}) {
      const Camera turned = orbit(camera, pivot, azimuth, elevation);
      EXPECT_LT((pixelOf(turned, pivot) - pixelOf(camera, pivot)).norm(), 1e-6);
      EXPECT_NEAR((turned.focus - turned.position).cross(turned.up).z(), 0, 1e-9);
      EXPECT_GT(turned.up.z(), 0);
      // Back again.
      const Camera back = orbit(orbit(camera, pivot, azimuth, 0), pivot, -azimuth, 0);
      EXPECT_LT((back.position - camera.position).norm(), 1e-9);
    }
  }
}

TEST(Navigation, OrbitStopsAtThePolesAndComesBack) {
  const Camera camera = sampleCamera();
  const Camera top = orbit(camera, camera.focus, 0, 10);
  EXPECT_NEAR((top.position - top.focus).normalized().z(), 1, 1e-12);
  EXPECT_NEAR(top.up.norm(), 1, 1e-12);
  const double elevation = std::asin((camera.position - camera.focus).normalized().z());
  const Camera back = orbit(top, top.focus, 0, elevation - std::acos(-1.0) / 2);
  EXPECT_LT((back.position - camera.position).norm(), 1e-6);
}

TEST(Navigation, ZoomKeepsTheAnchorInItsPlaceWithinItsLimits) {
  for (const bool parallel : {false, true}) {
    Camera camera = sampleCamera();
    camera.parallel = parallel;
    const Eigen::Vector3d anchor(500, 100, 90), other(200, 500, 90);
    const Camera near = zoom(camera, anchor, 1.5, 1, 1e5);
    EXPECT_LT((pixelOf(near, anchor) - pixelOf(camera, anchor)).norm(), 1e-6);
    EXPECT_GT((pixelOf(near, other) - pixelOf(near, anchor)).norm(),
              1.3 * (pixelOf(camera, other) - pixelOf(camera, anchor)).norm());
    EXPECT_NEAR(pixelSize(zoom(camera, camera.focus, 2, 1, 1e5), 700), 0.5 * pixelSize(camera, 700), 1e-9);
    EXPECT_GE((zoom(camera, anchor, 1e9, 50, 1e5).position - zoom(camera, anchor, 1e9, 50, 1e5).focus).norm(),
              49.9);
    EXPECT_EQ(zoom(camera, anchor, -1, 1, 1e5).position, camera.position);
  }
}

TEST(Navigation, MoveBetweenTwoViewsKeepsTheHorizonAndEndsExactly) {
  const Camera a = sampleCamera();
  Camera top = a;
  top.position = top.focus + 700 * Eigen::Vector3d::UnitZ();
  top.up = Eigen::Vector3d::UnitY();
  for (int i = 0; i <= 20; ++i) {
    const Camera camera = between(a, top, eased(i / 20.0));
    EXPECT_NEAR((camera.focus - camera.position).normalized().cross(camera.up).z(), 0, 1e-12);
    EXPECT_GE((camera.position - camera.focus).norm(), 699.9);
  }
  EXPECT_EQ(between(a, top, 1).up, top.up);
  EXPECT_LT((between(a, top, 1 - 1e-9).up - top.up).norm(), 1e-6);
  EXPECT_LT((between(a, top, 1e-9).position - a.position).norm(), 1e-3);
}

TEST(Navigation, EasingStartsAndEndsAtRest) {
  EXPECT_EQ(eased(0), 0);
  EXPECT_EQ(eased(1), 1);
  EXPECT_EQ(eased(-3), 0);
  EXPECT_NEAR(eased(0.5), 0.5, 1e-12);
  EXPECT_LT(eased(1e-3), 1e-5);
  EXPECT_GT(eased(1 - 1e-3), 1 - 1e-5);
}

TEST(Navigation, ProjectionsKeepTheSizeAtTheFocus) {
  const Camera camera = sampleCamera();
  const Camera parallel = withProjection(camera, true);
  EXPECT_TRUE(parallel.parallel);
  EXPECT_NEAR(pixelSize(parallel, 700), pixelSize(camera, 700), 1e-12);
  EXPECT_LT((withProjection(parallel, false).position - camera.position).norm(), 1e-9);
}

}  // namespace
