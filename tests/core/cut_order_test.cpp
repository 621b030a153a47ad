// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// In which order the cuts of a block are made, and what they meet of it.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/parts/cut_order.h"
#include "bw/core/surface/refine.h"

namespace bw {
namespace {

using Eigen::Vector3d;
using test::PatchSampler;

Box standing() { return BlockPlacement{{0, 0, 0}, {600, 800, 500}, {0, 0, 0}}.box(); }

/// z = `height` + `slope` x over the block and beyond it.
PatchSampler slope(double height, double slope) {
  const Vector3d x = Vector3d(1, 0, slope).normalized();
  return {{300, 400, height + 300 * slope}, x, Vector3d::UnitY(), {2000, 2000}};
}

TEST(CutOrder, AreaAndHeightAreOfWhatLiesInTheBlock) {
  const AreaInBox in = areaInBox(slope(100, 0.5).mesh(), standing());
  EXPECT_NEAR(in.area, 600 * std::sqrt(1.25) * 800, 1e-6);
  EXPECT_NEAR(in.height, 250, 1e-9);
  // Half of it comes out at the top.
  const AreaInBox part = areaInBox(slope(350, 0.5).mesh(), standing());
  EXPECT_NEAR(part.area, 300 * std::sqrt(1.25) * 800, 1e-6);
  EXPECT_NEAR(part.height, 425, 1e-9);
  EXPECT_EQ(areaInBox(slope(600, 0).mesh(), standing()).area, 0);
}

TEST(CutOrder, WhatLiesInNoBlockIsTold) {
  // A level sheet of 4000 × 4000 mm around the middle of the block of 600 × 800.
  const AreaOutside around = areaOutside(slope(100, 0).mesh(), {standing()});
  EXPECT_NEAR(around.all, 16e6, 1e-6);
  EXPECT_NEAR(around.area, 16e6 - 600 * 800, 1e-6);
  EXPECT_NEAR(around.distance, std::hypot(1700, 1600), 1e-9) << "a corner";
  EXPECT_NEAR(std::abs(around.point.x() - 300), 2000, 1e-9);
  // A second block beside it holds as much again; in a large one lies all of it.
  const Box beside = BlockPlacement{{600, 0, 0}, {600, 800, 500}, {0, 0, 0}}.box();
  EXPECT_NEAR(areaOutside(slope(100, 0).mesh(), {standing(), beside}).area, 16e6 - 2 * 600 * 800, 1e-6);
  const Box large = BlockPlacement{{-2000, -2000, 0}, {5000, 5000, 500}, {0, 0, 0}}.box();
  const AreaOutside none = areaOutside(slope(100, 0).mesh(), {large});
  EXPECT_NEAR(none.area, 0, 1e-6);
  EXPECT_EQ(none.distance, 0);
  // Over and under it lies only what the slope leads out of it there: at x > 300 half of its width.
  const AreaOutside over = areaOutside(slope(350, 0.5).mesh(), {standing()}, Outside::overOrUnder);
  EXPECT_NEAR(over.area, 300 * std::sqrt(1.25) * 800, 1e-6);
  EXPECT_NEAR(over.distance, 150, 1e-9);
  EXPECT_EQ(areaOutside(slope(100, 0).mesh(), {standing()}, Outside::overOrUnder).area, 0);
}

TEST(CutOrder, TheLowestComesFirstUnlessTold) {
  EXPECT_EQ(orderOf({{{}, 300}, {{}, 100}, {{}, 200}}), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_EQ(orderOf({{{}, 300}, {{}, 100}, {2, 200}, {1, 250}}), (std::vector<std::size_t>{3, 2, 1, 0}));
  EXPECT_EQ(orderOf({{{}, 100}, {{}, 100}}), (std::vector<std::size_t>{0, 1})) << "equal ones as they come";
  EXPECT_TRUE(orderOf({}).empty());
}

TEST(CutOrder, TheSideIsThatOfTheNormal) {
  PatchSampler up = slope(100, 0.2);
  PatchSampler down(Vector3d(300, 400, 100), Vector3d::UnitY(), Vector3d::UnitX(), {2000, 2000});
  EXPECT_EQ(sideKept(up.mesh(), up, -Vector3d::UnitZ()).value(), -1);
  EXPECT_EQ(sideKept(up.mesh(), up, Vector3d::UnitZ()).value(), 1);
  EXPECT_EQ(sideKept(down.mesh(), down, -Vector3d::UnitZ()).value(), 1);
  // However its triangles are turned.
  TriangleMesh turned = up.mesh();
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(sideKept(turned, up, -Vector3d::UnitZ()).value(), -1);
}

TEST(CutOrder, AnUprightSurfaceHasNoSideBelow) {
  PatchSampler wall(Vector3d(300, 400, 250), Vector3d::UnitY(), Vector3d::UnitZ(), {2000, 2000});
  const Result<int> side = sideKept(wall.mesh(), wall, -Vector3d::UnitZ());
  ASSERT_FALSE(side);
  EXPECT_EQ(side.error().code, ErrorCode::badInput);
  EXPECT_NE(side.error().message.find("keep"), std::string::npos) << side.error().message;
  EXPECT_EQ(sideKept(wall.mesh(), wall, -Vector3d::UnitX()).value(), -1);
}

TEST(CutOrder, DepthIsThatInAllThatStays) {
  PatchSampler low = slope(100, 0), steep = slope(50, 0.5);
  const std::vector<PartedBy> both = {{&low, -1}, {&steep, -1}};
  EXPECT_NEAR(depthIn(both, {500, 400, 90}).value(), 10, 1e-9);
  EXPECT_NEAR(depthIn(both, {0, 400, 80}).value(), -30 / std::sqrt(1.25), 1e-9);
  EXPECT_TRUE(std::isinf(depthIn({}, {0, 0, 0}).value()));
}

TEST(CutOrder, ACutAboveWhatIsLeftMeetsNothing) {
  PatchSampler low = slope(100, 0), high = slope(200, 0.1), across = slope(-50, 0.5);
  const std::vector<PartedBy> before = {{&low, -1}};
  EXPECT_EQ(meets(high.mesh(), standing(), before, {}).value(), 0);
  // z = x / 2 − 50 goes under z = 100 up to x = 300, and enters the block at x = 100.
  EXPECT_NEAR(meets(across.mesh(), standing(), before, {}).value(), 100, 5);
  EXPECT_TRUE(std::isinf(meets(high.mesh(), standing(), {}, {}).value())) << "a whole block";
}

TEST(CutOrder, ACutTakesWhatLiesOnItsOtherSide) {
  PatchSampler top = slope(100, 0), below = slope(99, 0), far = slope(130, 0), steep = slope(60, 0.1);
  const std::vector<PartedBy> before = {{&top, -1}};
  const auto taken = [&](PatchSampler& of, double kept) {
    const TriangleMesh mesh = of.mesh();
    return takes({&mesh, {&of, kept > 0 ? 1 : -1}, kept * Vector3d::UnitZ()}, standing(), before, 2, {})
        .value();
  };
  // A millimetre under what was left: a film, or all but a sheet of that.
  EXPECT_NEAR(taken(below, -1), 1, 1e-9);
  EXPECT_GE(taken(below, 1), 2);
  // Above it: nothing, or all.
  EXPECT_EQ(taken(far, -1), 0);
  EXPECT_GE(taken(far, 1), 2);
  EXPECT_GE(taken(steep, -1), 2);
}

TEST(Refined, EdgesAreHalvedAndStayShared) {
  const TriangleMesh mesh = slope(0, 0).mesh();
  const Box all = BlockPlacement{{-1700, -1600, -100}, {4000, 4000, 200}, {0, 0, 0}}.box();
  const TriangleMesh fine = refined(mesh, all, 300);
  double area = 0, longest = 0;
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : fine.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      longest = std::max(longest, (fine.points[std::size_t(a)] - fine.points[std::size_t(b)]).norm());
      ++edges[std::minmax(a, b)];
    }
    area += 0.5 * Vector3d(fine.points[std::size_t(t[1])] - fine.points[std::size_t(t[0])])
                      .cross(fine.points[std::size_t(t[2])] - fine.points[std::size_t(t[0])])
                      .z();
  }
  EXPECT_LE(longest, 300);
  EXPECT_NEAR(area, 4000.0 * 4000, 1e-3) << "nothing overlaps, nothing is turned";
  double border = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_LE(count, 2);
    if (count == 1)
      border += (fine.points[std::size_t(edge.first)] - fine.points[std::size_t(edge.second)]).norm();
  }
  EXPECT_NEAR(border, 16000, 1e-6) << "only the edges of the rectangle are those of one triangle";
}

TEST(Refined, WhatIsFarFromTheBoxIsLeftOut) {
  const TriangleMesh fine = refined(slope(100, 0).mesh(), standing(), 20);
  EXPECT_LT(fine.triangles.size(), 9000u) << "of 128,000 of the whole";
  EXPECT_NEAR(areaInBox(fine, standing()).area, 600 * 800, 1e-6) << "all of it in the box is there";
}

TEST(Refined, TrianglesWithOneOrTwoLongEdges) {
  // A needle, and a triangle with two long edges beside it.
  const TriangleMesh mesh = {{{0, 0, 0}, {10, 0, 0}, {10, 1, 0}, {0, 1, 0}}, {}, {{0, 1, 2}, {0, 2, 3}}};
  for (const double longest : {9.9, 6.0, 2.0, 0.7}) {
    const TriangleMesh fine = refined(mesh, standing(), longest);
    double area = 0;
    for (const auto& t : fine.triangles)
      area += 0.5 * Vector3d(fine.points[std::size_t(t[1])] - fine.points[std::size_t(t[0])])
                        .cross(fine.points[std::size_t(t[2])] - fine.points[std::size_t(t[0])])
                        .z();
    EXPECT_NEAR(area, 10, 1e-9) << longest;
  }
}

}  // namespace
}  // namespace bw
