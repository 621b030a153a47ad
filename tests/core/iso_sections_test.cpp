// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Where two splines differ, and the curves of one that are sections of a block.
#include "bw/core/shape/iso_sections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bw/core/base/units.h"
#include "bw/core/curve/same_curve.h"
#include "bw/core/shape/designed_surface.h"
#include "bw/core/surface/spline_change.h"
#include "bw/core/sweep/plane_family.h"

namespace bw {
namespace {

PolesSurface net(int columns, int rows, int degreeX, int degreeY) {
  PolesSurface surface;
  surface.over = {{0, 0}, {1800, 1600}};
  surface.columns = columns;
  surface.rows = rows;
  surface.degreeX = degreeX;
  surface.degreeY = degreeY;
  surface.poles.assign(std::size_t(rows * columns), {});
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      surface.at(row, column).height = 250 + 40 * std::sin(1.3 * column + 0.7 * row);
  return surface;
}

SplineSurface splineOf(const PolesSurface& surface) { return bw::splineOf(DesignedSurface{surface}).value(); }

TEST(ChangedPart, HoldsAllThatDiffersAndNoMore) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 40; ++trial) {
    const int degreeX = 1 + trial % 3, degreeY = 1 + trial / 3 % 3;
    PolesSurface surface = net(5 + int(random() % 8), 5 + int(random() % 8), degreeX, degreeY);
    const SplineSurface before = splineOf(surface);
    EXPECT_TRUE(changedPart(before, before).isEmpty());
    surface.at(int(random() % unsigned(surface.rows)), int(random() % unsigned(surface.columns))).height += 1;
    const SplineSurface after = splineOf(surface);
    const Eigen::AlignedBox2d changed = changedPart(before, after);
    ASSERT_FALSE(changed.isEmpty());
    bool differs = false;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60; ++j) {
        const double u = i / 60.0, v = j / 60.0;
        const bool same = before.value(u, v) == after.value(u, v);
        if (!changed.contains(Eigen::Vector2d(u, v))) {
          EXPECT_TRUE(same) << trial << " " << u << " " << v;
        }
        differs = differs || !same;
      }
    EXPECT_TRUE(differs);
    // Just inside its corners it does differ, if by little.
    const Eigen::Vector2d inset = 0.2 * changed.sizes();
    for (const Eigen::Vector2d& at :
         {Eigen::Vector2d(changed.min() + inset), Eigen::Vector2d(changed.max() - inset)})
      EXPECT_NE(before.value(at.x(), at.y()), after.value(at.x(), at.y())) << trial;
  }
  EXPECT_EQ(changedPart(splineOf(net(5, 5, 3, 3)), splineOf(net(6, 5, 3, 3))).sizes(), Eigen::Vector2d(1, 1));
}

Box blockAt(double x, double y, double width) {
  Box box;
  box.frame.origin = {x, y, 0};
  box.size = {width, 800, 500};
  return box;
}

/// Planes across the travel, each with a curve that stands for a section.
std::vector<Section> planesIn(const Box& block, const Eigen::Vector3d& direction, int count) {
  const PlaneFamily planes = PlaneFamily::across(block, direction);
  std::vector<Section> sections;
  for (int i = 0; i < count; ++i) {
    const double level = std::lerp(planes.entry + 0.01, planes.exit - 0.01, double(i) / (count - 1));
    sections.push_back(
        {i, planes.travel(level), planes.at(level), {PlanarCurve::bezier({{0, 0}, {1, 0}}).value()}, 0});
  }
  return sections;
}

TEST(IsoSections, AreCutAtTheSidesOfABlock) {
  const SplineSurface surface = splineOf(net(10, 9, 3, 3));
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 0, 0)}) {
    // Across x it is the rows of poles that go on beyond the block.
    const bool alongY = direction.x() == 0;
    SplineSurface turned = surface;
    if (!alongY) {
      std::swap(turned.polesU, turned.polesV);
      std::swap(turned.knotsU, turned.knotsV);
      for (int j = 0; j < turned.polesV; ++j)
        for (int i = 0; i < turned.polesU; ++i)
          turned.poles[std::size_t(j * turned.polesU + i)] =
              surface.poles[std::size_t(i * surface.polesU + j)];
    }
    for (const double x : {0.0, 450.0, 600.0, 1200.0}) {
      const Box block = blockAt(x, 800, 600);
      const std::vector<Section> like = planesIn(block, direction, 7);
      const auto sections = isoSections(turned, turned, like, block);
      ASSERT_TRUE(sections) << x;
      for (std::size_t i = 0; i < sections->size(); ++i) {
        const Section& section = (*sections)[i];
        const PlanarCurve& curve = section.curve();
        EXPECT_GT(curve.value(curve.end()).x(), curve.value(curve.start()).x());
        for (const Eigen::Vector2d& at : curve.sample(20)) {
          const Eigen::Vector3d p = section.frame.toWorld(at), local = block.frame.toLocal(p);
          EXPECT_GT(local.minCoeff(), -1e-9);
          EXPECT_GT((block.size - local).minCoeff(), -1e-9);
          // The surface there, by halving in u and v of its even net.
          const auto over = [](const auto& value, double wanted) {
            double low = 0, high = 1;
            for (int k = 0; k < 60; ++k) {
              const double middle = 0.5 * (low + high);
              (value(middle) < wanted ? low : high) = middle;
            }
            return low;
          };
          const double u = over([&](double t) { return surface.value(t, 0.5).x(); }, p.x()),
                       v = over([&](double t) { return surface.value(0.5, t).y(); }, p.y());
          EXPECT_LT((surface.value(u, v) - p).norm(), 1e-8) << x << " " << i;
        }
        for (const double end : {curve.start(), curve.end()}) {
          const Eigen::Vector3d local = block.frame.toLocal(section.frame.toWorld(curve.value(end)));
          const double across = alongY ? local.x() : local.y(), width = alongY ? 600 : 800;
          EXPECT_LT(std::min(std::abs(across), std::abs(width - across)), 1e-9);
        }
      }
    }
  }
}

TEST(IsoSections, HangOnThePolesOfTheirSpansAlone) {
  PolesSurface poles = net(13, 9, 3, 3);
  const SplineSurface before = splineOf(poles);
  const Box block = blockAt(600, 0, 600);
  const std::vector<Section> like = isoSections(before, before, planesIn(block, {0, 1, 0}, 9), block).value();
  // Far to the left: nothing of it. In the next block: what is near to the side.
  poles.at(2, 1).height += 100;
  const auto far = isoSections(splineOf(poles), before, like, block);
  ASSERT_TRUE(far);
  for (std::size_t i = 0; i < like.size(); ++i)
    EXPECT_EQ(&(*far)[i].curve().poles(), &like[i].curve().poles()) << "the curve itself";
  poles.at(2, 6).height += 5;
  const auto near = isoSections(splineOf(poles), before, like, block);
  ASSERT_TRUE(near);
  int changed = 0;
  for (std::size_t i = 0; i < like.size(); ++i)
    changed += sameCurve((*near)[i].curve(), like[i].curve()) ? 0 : 1;
  EXPECT_GE(changed, 8);
}

TEST(IsoSections, AreNoneWhereThePlanesAreThoseOfAPart) {
  const SplineSurface surface = splineOf(net(10, 9, 3, 3));
  const Box block = blockAt(0, 0, 600);
  std::vector<Section> like = planesIn(block, {0, 1, 0}, 9);
  EXPECT_TRUE(isoSections(surface, surface, like, block));
  like.pop_back();
  EXPECT_FALSE(isoSections(surface, surface, like, block)) << "tracing would spread them to the end";
  like = planesIn(block, {0, 1, 0}, 9);
  Box shallow = block;
  shallow.size.z() = 260;
  EXPECT_FALSE(isoSections(surface, surface, like, shallow)) << "it leaves the block by its top";
  Box beside = block;
  beside.frame.origin.x() = 2000;
  EXPECT_FALSE(isoSections(surface, surface, planesIn(beside, {0, 1, 0}, 9), beside));
  Box leaning = block;
  leaning.frame.x = Eigen::Vector3d(1, 0.1, 0).normalized();
  leaning.frame.y = Eigen::Vector3d(-0.1, 1, 0).normalized();
  EXPECT_FALSE(isoSections(surface, surface, like, leaning));
}

}  // namespace
}  // namespace bw
