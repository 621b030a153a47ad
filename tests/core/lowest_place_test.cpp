// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/sweep/lowest_place.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "bw/core/base/units.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLength = 800, kTightest = 92;  // mm; the smallest of all presets

double lowestOf(const Box& block, const std::vector<Vector3d>& points) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : points)
    lowest = std::min(lowest, (point - block.frame.origin).dot(block.frame.normal));
  return lowest;
}

/// A block that lies with another face down.
Box lying(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(kPi * number(random), Vector3d(number(random), number(random), 2).normalized())
          .toRotationMatrix();
  return {Frame{{100 * number(random), 0, -300}, turned.col(0), turned.col(1), turned.col(2)},
          {600, 100, 600}};
}

TEST(LowestPlace, IsThatOfAFinelySampledBlade) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  int tried = 0;
  double worst = 0, asPoints = 0;
  while (tried < 300) {
    const Vector2d force(60 * number(random), 60 * number(random));
    const Result<Elastica> blade = Elastica::make({0, 0}, kPi * number(random), 8 * number(random) / kLength,
                                                  force / (kLength * kLength), kLength);
    if (!blade || blade->maxCurvature() > 1 / kTightest) continue;
    ++tried;
    const Box block = lying(random);
    BladePose pose;
    pose.frame = Frame{{0, 50, 0}, Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY()};
    pose.cut = pose.blade = *blade;
    const LowestPlace told = lowestPlace(block, pose);
    const std::vector<Vector3d> coarse = pose.bladePoints(kLowestPlaces);
    const double truth = lowestOf(block, pose.bladePoints(20001));
    EXPECT_NEAR(told.height, truth, 0.05) << tried;
    EXPECT_NEAR((told.point - block.frame.origin).dot(block.frame.normal), truth, 2);
    worst = std::max(worst, std::abs(told.height - truth));
    asPoints = std::max(asPoints, lowestOf(block, coarse) - truth);
  }
  EXPECT_GT(asPoints, 5 * worst) << "the places alone would do as well";
}

TEST(LowestPlace, LiesBetweenTheGripAndThePlaceNextToIt) {
  // A circle that leaves the grip downwards and is lowest a little farther on.
  constexpr double kBend = 240, kDown = 0.04;
  const Box block{Frame{{0, 0, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {600, 100, 600}};
  BladePose pose;
  pose.frame = Frame{{0, 50, 100}, Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY()};
  for (const bool backwards : {false, true}) {
    pose.blade = *Elastica::make({0, 0}, -kDown, 1 / kBend, Vector2d::Zero(), kLength);
    if (backwards) pose.blade = pose.blade.reversed();
    pose.cut = pose.blade;
    EXPECT_NEAR(lowestPlace(block, pose).height, 100 - kBend * (1 - std::cos(kDown)), 0.005) << backwards;
  }
}

TEST(LowestPlace, OfAParabolaIsExactWhereverItsVertexLies) {
  const Box block{Frame{{0, 0, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {1, 1, 1}};
  for (double vertex = -0.5; vertex <= 4.5; vertex += 0.09) {
    std::vector<Vector3d> points;
    for (int k = 0; k < 5; ++k) points.emplace_back(k, 0, 7 + (k - vertex) * (k - vertex));
    const double beyond = std::max({0.0, -vertex, vertex - 4});
    EXPECT_NEAR(lowestPlace(block, points).height, 7 + beyond * beyond, 1e-12) << vertex;
  }
}

TEST(LowestPlace, OfFewPointsIsTheLowestOfThem) {
  const Box block{Frame{{0, 0, 5}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {1, 1, 1}};
  EXPECT_EQ(lowestPlace(block, std::vector<Vector3d>{}).height, std::numeric_limits<double>::infinity());
  EXPECT_EQ(lowestPlace(block, std::vector{Vector3d(0, 0, 8)}).height, 3);
  EXPECT_EQ(lowestPlace(block, std::vector{Vector3d(0, 0, 8), Vector3d(1, 0, 6)}).height, 1);
}

}  // namespace
}  // namespace bw
