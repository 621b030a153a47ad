// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The lines of a solid as they are seen, and the mark.
#include <gtest/gtest.h>

#include <cmath>

#include "mark.h"
#include "seen_lines.h"

namespace bw::drawings {
namespace {

/// A box with a corner at 0, its faces with points of their own.
TriangleMesh box(const Eigen::Vector3d& size) {
  TriangleMesh out;
  for (int k = 0; k < 3; ++k)
    for (const int side : {0, 1}) {
      const int u = (k + 1) % 3, v = (k + 2) % 3, base = int(out.points.size());
      for (int i = 0; i < 4; ++i) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[k] = side ? size[k] : 0;
        p[u] = i == 1 || i == 2 ? size[u] : 0;
        p[v] = i >= 2 ? size[v] : 0;
        out.points.push_back(p);
        out.normals.push_back((side ? 1 : -1) * Eigen::Vector3d::Unit(k));
      }
      out.triangles.push_back({base, base + (side ? 1 : 2), base + (side ? 2 : 1)});
      out.triangles.push_back({base, base + (side ? 2 : 3), base + (side ? 3 : 2)});
    }
  return out;
}

/// A cylinder along z of radius 100 and height 200, without its ends.
TriangleMesh cylinder(int parts) {
  TriangleMesh out;
  for (int i = 0; i < parts; ++i)
    for (const double z : {0.0, 200.0}) {
      const Eigen::Vector3d n(std::cos(2 * M_PI * i / parts), std::sin(2 * M_PI * i / parts), 0);
      out.points.push_back(100 * n + z * Eigen::Vector3d::UnitZ());
      out.normals.push_back(n);
    }
  for (int i = 0; i < parts; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % parts);
    out.triangles.push_back({a, b, b + 1});
    out.triangles.push_back({a, b + 1, a + 1});
  }
  return out;
}

double lengthOf(const std::vector<std::vector<Point>>& lines) {
  double length = 0;
  for (const std::vector<Point>& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

TEST(SeenLines, ABoxHasTwelveEdgesOfWhichNineAreSeen) {
  const Solid solid(box({300, 200, 100}));
  double edges = 0;
  for (const Polyline& line : solid.edges())
    for (std::size_t i = 1; i < line.size(); ++i) edges += (line[i] - line[i - 1]).norm();
  EXPECT_NEAR(edges, 4 * 600, 1e-6) << "no diagonal of a face";
  const View view = View::from({0.5, -0.8, 0.5});
  const SeenLines lines = DepthBuffer(solid.mesh(), view).lines(solid.edges());
  const auto projected = [&](const Eigen::Vector3d& v) { return view.flat(v).norm(); };
  const double each = projected({300, 0, 0}) + projected({0, 200, 0}) + projected({0, 0, 100});
  EXPECT_NEAR(lengthOf(lines.hidden), each, 0.03 * each);
  EXPECT_NEAR(lengthOf(lines.seen), 3 * each, 0.03 * each);
  EXPECT_TRUE(solid.outlines(view).empty()) << "flat faces";
}

TEST(SeenLines, ACylinderHasItsOutline) {
  const Solid solid(cylinder(72));
  const View view = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()};
  const std::vector<Polyline> outlines = solid.outlines(view);
  ASSERT_EQ(outlines.size(), 2u);
  for (const Polyline& line : outlines)
    for (const Eigen::Vector3d& p : line) EXPECT_NEAR(std::abs(p.x()), 100, 0.2);
  EXPECT_EQ(solid.edges().size(), 2u) << "the rims";
}

TEST(SeenLines, WhatLiesOnTheSurfaceIsKept) {
  const Solid solid(box({300, 200, 100}));
  const View view = View::from({0.5, -0.8, 0.5});
  const DepthBuffer buffer(solid.mesh(), view);
  const Polyline on = {{20, 100, 100}, {280, 100, 100}}, above = {{20, 100, 130}, {280, 100, 130}},
                 below = {{20, 100, 60}, {280, 100, 60}};
  EXPECT_NEAR(lengthOf(buffer.onSurface({on})), (view.flat(on[1]) - view.flat(on[0])).norm(), 2);
  EXPECT_EQ(lengthOf(buffer.onSurface({above, below})), 0);
  // What comes out of the box is seen from there on.
  const Polyline through = {{150, 100, 50}, {150, 100, 200}};
  const SeenLines lines = buffer.lines({through});
  const double whole = (view.flat(through[1]) - view.flat(through[0])).norm();
  EXPECT_NEAR(lengthOf(lines.seen), whole * 100 / 150, 4);
}

TEST(SeenLines, SimplifiedKeepsWithinItsBound) {
  std::vector<Point> circle;
  for (int i = 0; i <= 360; ++i)
    circle.emplace_back(50 * std::cos(M_PI * i / 180), 50 * std::sin(M_PI * i / 180));
  const std::vector<Point> fewer = simplified(circle, 0.1);
  EXPECT_LT(fewer.size(), 70u) << "a sag of 0.1 mm asks for 50";
  for (std::size_t i = 1; i < fewer.size(); ++i) EXPECT_GT((fewer[i] + fewer[i - 1]).norm() / 2, 49.9 - 1e-9);
  EXPECT_EQ(fewer.front(), circle.front());
  EXPECT_EQ(fewer.back(), circle.back());
  EXPECT_EQ(simplified({{0, 0}, {1, 1e-3}, {2, 0}}, 0.01).size(), 2u);
}

TEST(Mark, StandsWhereFoamIsLeft) {
  const Eigen::Vector3d size(600, 400, 300);
  EXPECT_EQ(Mark::on(size, nullptr).place(), "front, right, top");
  const Solid lower(box({600, 400, 150}));
  EXPECT_EQ(Mark::on(size, &lower).place(), "front, right, bottom");
  const Solid left(box({300, 400, 300}));
  EXPECT_EQ(Mark::on(size, &left).place(), "front, left, top");
  EXPECT_TRUE(Mark::on(size, &left).stays);
  TriangleMesh inner = box({300, 200, 100});
  for (Eigen::Vector3d& p : inner.points) p += Eigen::Vector3d(150, 100, 100);
  const Solid middle(inner);
  EXPECT_FALSE(Mark::on(size, &middle).stays);
}

TEST(Mark, TellsAllWaysToLieApart) {
  const std::array<Mark::Triangle, 3> triangles = Mark().triangles({600, 400, 300}, 50);
  int filled = 0;
  for (const Mark::Triangle& triangle : triangles) {
    filled += triangle.filled ? 1 : 0;
    EXPECT_EQ(triangle.corners[0], Eigen::Vector3d(600, 0, 300));
    for (const Eigen::Vector3d& p : triangle.corners)
      EXPECT_NEAR((p - triangle.corners[0]).dot(triangle.out), 0, 1e-12) << "on its face";
    EXPECT_NEAR((triangle.corners[1] - triangle.corners[2]).norm(), 50 * std::sqrt(2), 1e-9);
  }
  EXPECT_EQ(filled, 1) << "three alike would leave turns about the corner open";
}

}  // namespace
}  // namespace bw::drawings
