// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How much of a target is cut: by the surface between the stations, and by what the whole blade leaves beside
// it.

#include <gtest/gtest.h>

#include <cmath>

#include "bw/core/sweep/coverage.h"
#include "plane_sections.h"

namespace bw {
namespace {

using Eigen::Vector3d;

/// The plane z = 0 over a rectangle as two large triangles.
TriangleMesh rectangle(double x0, double x1, double y0, double y1) {
  return {{{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}, {}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A flat cut over |x| ≤ 100, y from 0 to −80.
SurfaceGrid flatCut() {
  SurfaceGrid cut;
  cut.rows = 9;
  cut.columns = 11;
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 11; ++c) cut.points.emplace_back(20.0 * c - 100, -10.0 * r, 0);
  return cut;
}

TEST(Coverages, LookFromTheTargetToTheCut) {
  Findings findings;
  const Box block{Frame{{-300, -300, -50}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
                  {600, 600, 100}};
  const Result<Sweep> sweep = buildSweep(
      test::sectionsOf(9, 10, [](int) { return test::graphCurve(100, [](double) { return 0.0; }); }), {},
      block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  const auto look = [&](const TriangleMesh& target) { return coverageOf(flatCut(), *sweep, target, {2}); };

  const Coverage whole = look(rectangle(-100, 100, -80, 0));
  EXPECT_NEAR(whole.area, 16000, 1e-6);
  EXPECT_EQ(whole.uncovered, 0);
  EXPECT_LT(whole.distance, 1e-9);
  EXPECT_TRUE(whole.findings.empty());

  // Nothing of it in the block: no cut is asked for there, and none is said to be whole.
  const Coverage elsewhere = look(rectangle(400, 500, -80, 0));
  EXPECT_EQ(elsewhere.share(), 0);
  ASSERT_EQ(elsewhere.findings.size(), 1u);
  EXPECT_EQ(elsewhere.findings[0].severity, Severity::error);
  EXPECT_EQ(std::get<Uncovered>(elsewhere.findings[0].cause).where, Uncovered::Where::elsewhere);

  // A block that lies between all places that are looked at of a large target is met all the same.
  Sweep small = *sweep;
  small.block = Box{Frame{{1, -3, -1}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {1, 1, 2}};
  const Coverage inside = coverageOf(flatCut(), small, rectangle(-900, 900, -900, 900), {2});
  EXPECT_NEAR(inside.area, 1, 0.2);
  EXPECT_EQ(inside.share(), 1);
  EXPECT_TRUE(inside.findings.empty());

  // Under the surface, but off it: a part of a target that no blade followed.
  TriangleMesh lifted = rectangle(-100, 100, -80, 0);
  for (Vector3d& p : lifted.points) p.z() = 30;
  const Coverage off = look(lifted);
  EXPECT_NEAR(off.distance, 30, 1e-9);
  EXPECT_EQ(off.share(), 0);
  ASSERT_EQ(off.findings.size(), 1u);
  EXPECT_EQ(std::get<Uncovered>(off.findings[0].cause).where, Uncovered::Where::off);
  EXPECT_EQ(coverageOf(flatCut(), *sweep, lifted, {2, 30}).share(), 1) << "asked to stand back so far";
  for (Vector3d& p : lifted.points) p.z() = 1.9;
  EXPECT_EQ(look(lifted).share(), 1) << "within the tolerance";
  EXPECT_LT(look(lifted).distance, 1e-9);
  // A step of the target down to the surface: its upper part is off by what it stands above it.
  TriangleMesh wall;
  wall.points = {{-100, -40, 0}, {100, -40, 0}, {100, -40, 20}, {-100, -40, 20}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Coverage upright = look(wall);
  EXPECT_NEAR(upright.distance, 20, 1e-9);
  EXPECT_NEAR(upright.share(), 0.1, 0.05);

  // Steep along the travel the plane's own distance is longer than the true one.
  SurfaceGrid steep = flatCut();
  for (Vector3d& p : steep.points) p.z() = -4 * p.y() / 8;
  TriangleMesh beneath = rectangle(-100, 100, -80, 0);
  for (Vector3d& p : beneath.points) p.z() = -4 * p.y() / 8 - 2.1;
  EXPECT_EQ(coverageOf(steep, *sweep, beneath, {2}).share(), 1) << 2.1 / std::hypot(1, 0.5);

  const Coverage beside = look(rectangle(-100, 140, -80, 0));
  EXPECT_NEAR(beside.distance, 40, 1e-9);
  EXPECT_NEAR(beside.uncovered, 38 * 80, 0.02 * 240 * 80);
  ASSERT_EQ(beside.findings.size(), 1u);
  EXPECT_EQ(beside.findings[0].severity, Severity::error);
  EXPECT_EQ(std::get<Uncovered>(beside.findings[0].cause).where, Uncovered::Where::beside);
  EXPECT_NEAR(beside.point.x(), 140, 1e-9);
  // … unless the blade goes on over it: not where it rises from it, nor as far as it does not come.
  const auto goingOn = [&](double slope) {
    const auto blades = [slope] {
      SurfaceGrid grid = flatCut();
      for (int r = 0; r < grid.rows; ++r)
        grid.points[std::size_t(11 * r + 10)] += Vector3d(30, 0, 30 * slope);
      return grid;
    };
    return coverageOf(flatCut(), *sweep, rectangle(-100, 140, -80, 0), {2, 0, nullptr, blades});
  };
  EXPECT_NEAR(goingOn(0).uncovered, 8 * 80, 0.02 * 240 * 80);
  EXPECT_NEAR(goingOn(0).distance, 40, 1e-9);
  EXPECT_GT(goingOn(1).uncovered, 30 * 80);
  // A tongue that it passes over counts by how far it is from the blade.
  const auto tongue = [&](double height, double tolerance) {
    TriangleMesh mesh = rectangle(104, 120, -46, -33);
    for (Vector3d& p : mesh.points) p.z() = height;
    const auto blades = [] {
      SurfaceGrid grid = flatCut();
      for (int r = 0; r < grid.rows; ++r) grid.points[std::size_t(11 * r + 10)].x() += 30;
      return grid;
    };
    return coverageOf(flatCut(), *sweep, mesh, {tolerance, 0, nullptr, blades});
  };
  EXPECT_NEAR(tongue(1.5, 2).distance, 1.5, 1e-6);
  EXPECT_EQ(tongue(1.5, 2).share(), 1);
  EXPECT_NEAR(tongue(0.05, 0.1).distance, 0.05, 1e-6);
  EXPECT_EQ(tongue(0.45, 0.1).share(), 0);

  const Coverage after = look(rectangle(-100, 100, -188, 0));
  EXPECT_NEAR(after.distance, 108, 1e-9);
  EXPECT_NEAR(after.share(), 82.0 / 188, 0.02);
  EXPECT_EQ(std::get<Uncovered>(after.findings[0].cause).where, Uncovered::Where::after);
  const Coverage before = look(rectangle(-100, 100, -80, 50));
  EXPECT_NEAR(before.distance, 50, 1e-9);
  EXPECT_EQ(std::get<Uncovered>(before.findings[0].cause).where, Uncovered::Where::before);

  // What lies outside of the block is not asked for.
  const Coverage far = look(rectangle(-100, 100, -80, 2000));
  EXPECT_LE(far.distance, 300);
}

}  // namespace
}  // namespace bw
