// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/biarc/biarc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include "bw/core/base/units.h"

namespace bw {

namespace {

using Eigen::Vector2d;

double angleBetween(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

Vector2d turned(const Vector2d& p, double angle) {
  return {std::cos(angle) * p.x() - std::sin(angle) * p.y(),
          std::sin(angle) * p.x() + std::cos(angle) * p.y()};
}

/// Ends, tangents and the common tangent of a biarc hold to `tolerance`.
void expectJoins(const Biarc& b, const Vector2d& start, double startAngle, const Vector2d& end,
                 double endAngle, double tolerance) {
  EXPECT_GT(b.first.length, 0);
  EXPECT_GT(b.second.length, 0);
  EXPECT_LT((b.first.start - start).norm(), tolerance);
  EXPECT_LT((b.first.end() - b.second.start).norm(), tolerance);
  EXPECT_LT((b.second.end() - end).norm(), tolerance);
  EXPECT_LT(angleBetween(b.first.startAngle, startAngle), tolerance);
  EXPECT_LT(angleBetween(b.first.endAngle(), b.second.startAngle), tolerance);
  EXPECT_LT(angleBetween(b.second.endAngle(), endAngle), tolerance);
}

}  // namespace

TEST(CircularArc, IsAQuarterOfTheUnitCircle) {
  const CircularArc arc{{1, 0}, kPi / 2, kPi / 2, kPi / 2};
  EXPECT_NEAR(*arc.radius(), 1, 1e-15);
  EXPECT_LT((arc.end() - Vector2d(0, 1)).norm(), 1e-15);
  EXPECT_LT((arc.pointAt(kPi / 4) - Vector2d(1, 1) / std::sqrt(2.0)).norm(), 1e-15);
  const CircularArc line{{1, 2}, 0, 0, 5};
  EXPECT_FALSE(line.radius());
  EXPECT_EQ(line.end(), Vector2d(6, 2));
}

TEST(Biarc, JoinsAnyPointsAndTangentsForAnyShare) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10, 10), angle(-kPi, kPi), share(0.02, 0.98);
  for (int i = 0; i < 20000; ++i) {
    const Vector2d a(place(random), place(random)), b(place(random), place(random));
    const double s = angle(random), e = angle(random);
    const Result<Biarc> biarc = makeBiarc(a, s, b, e, share(random));
    if (!biarc) {  // only where both tangents point back to within what an arc of 1e7 chords needs
      EXPECT_EQ(biarc.error().code, ErrorCode::noSolution);
      continue;
    }
    const double size = std::max({(b - a).norm(), biarc->first.length, biarc->second.length});
    expectJoins(*biarc, a, s, b, e, 1e-13 * std::max(size, 10.0) * 10);
  }
}

TEST(Biarc, FollowsTheReportsFormulas) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> alphas(-2, 2), totals(-3, 3), shares(0.05, 0.95);
  for (int i = 0; i < 2000; ++i) {
    const double alpha = alphas(random), w = totals(random), l = 3, share = shares(random);
    if (std::abs(w) < 0.1 || std::abs(w - alpha) > 3) continue;
    const double theta = 2 * alpha - (1 - share) * w;
    if (std::abs(theta) < 0.05 || std::abs(w - theta) < 0.05) continue;
    const Result<Biarc> biarc =
        makeBiarc({0, 0}, 0, l * Vector2d(std::cos(alpha), std::sin(alpha)), w, share);
    ASSERT_TRUE(biarc) << biarc.error().message;
    const double rA = l * std::sin((w + theta) / 2 - alpha) / (2 * std::sin(theta / 2) * std::sin(w / 2));
    const double rB = l * std::sin(alpha - theta / 2) / (2 * std::sin((w - theta) / 2) * std::sin(w / 2));
    EXPECT_NEAR(*biarc->first.radius() / rA, 1, 1e-10);
    EXPECT_NEAR(*biarc->second.radius() / rB, 1, 1e-10);
    EXPECT_NEAR(biarc->first.turning, theta, 1e-12);
  }
}

TEST(Biarc, HalfShareHasTheSmallestJumpOfCurvature) {
  const Vector2d a(0, 0), b(4, 1);
  const auto jump = [&](double share) {
    const Biarc biarc = makeBiarc(a, 0.9, b, -0.4, share).value();
    return std::abs(biarc.second.curvature() - biarc.first.curvature());
  };
  for (const double share : {0.1, 0.3, 0.45, 0.499, 0.501, 0.55, 0.7, 0.9}) EXPECT_GT(jump(share), jump(0.5));
}

TEST(Biarc, ParallelTangentsGiveOppositeRadii) {
  const double l = 5, alpha = 0.4;
  const Biarc biarc = makeBiarc({0, 0}, 0, l * Vector2d(std::cos(alpha), std::sin(alpha)), 0).value();
  EXPECT_NEAR(*biarc.first.radius(), l / (4 * std::sin(alpha)), 1e-14);
  EXPECT_NEAR(*biarc.second.radius(), -l / (4 * std::sin(alpha)), 1e-14);
  // The limit W → 0 is smooth.
  for (const double w : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Biarc near = makeBiarc({0, 0}, 0, l * Vector2d(std::cos(alpha), std::sin(alpha)), w).value();
    EXPECT_NEAR(*near.first.radius(), *biarc.first.radius(), 20 * w);
  }
}

TEST(Biarc, KnowsCirclesAndLines) {
  const Biarc circle = makeBiarc({1, 0}, kPi / 2, {0, 1}, kPi).value();
  EXPECT_NEAR(*circle.first.radius(), 1, 1e-15);
  EXPECT_NEAR(*circle.second.radius(), 1, 1e-15);
  const Biarc line = makeBiarc({1, 1}, kPi / 4, {3, 3}, kPi / 4).value();
  EXPECT_TRUE(line.first.straight());
  EXPECT_TRUE(line.second.straight());
  EXPECT_NEAR(line.first.length, std::sqrt(2.0), 1e-15);
  // A straight piece and an arc: 2α = (1 − λ) W.
  const Biarc half = makeBiarc({0, 0}, 0, {3, 1}, 1.2, 1 - 2 * std::atan2(1, 3) / 1.2).value();
  EXPECT_TRUE(half.first.straight());
  expectJoins(half, {0, 0}, 0, {3, 1}, 1.2, 1e-14);
}

TEST(Biarc, RefusesWhatHasNoSolution) {
  EXPECT_EQ(makeBiarc({1, 2}, 0, {1, 2}, 1).error().code, ErrorCode::badInput);
  EXPECT_EQ(makeBiarc({0, 0}, NAN, {1, 2}, 1).error().code, ErrorCode::badInput);
  EXPECT_EQ(makeBiarc({0, 0}, 0, {1, 2}, 1, 1).error().where, "share");
  EXPECT_EQ(makeBiarc({0, 0}, kPi, {1, 0}, kPi).error().code, ErrorCode::noSolution);
  // One tangent straight back is no obstacle.
  const Result<Biarc> back = makeBiarc({0, 0}, kPi, {1, 0}, 0.3);
  ASSERT_TRUE(back);
  expectJoins(*back, {0, 0}, kPi, {1, 0}, 0.3, 1e-13);
}

TEST(Biarc, MovesTurnsScalesMirrorsAndReverses) {
  const Vector2d a(0.3, -0.2), b(4, 1.5);
  const double s = 0.8, e = -0.6, share = 0.35;
  const Biarc biarc = makeBiarc(a, s, b, e, share).value();
  const double angle = 1.1, scale = 25;
  const Vector2d move(100, -70);
  const Biarc moved =
      makeBiarc(scale * turned(a, angle) + move, s + angle, scale * turned(b, angle) + move, e + angle, share)
          .value();
  EXPECT_NEAR(*moved.first.radius(), scale * *biarc.first.radius(), 1e-11);
  EXPECT_NEAR(*moved.second.radius(), scale * *biarc.second.radius(), 1e-11);
  EXPECT_LT((moved.second.start - (scale * turned(biarc.second.start, angle) + move)).norm(), 1e-11);
  const Biarc mirrored = makeBiarc({a.x(), -a.y()}, -s, {b.x(), -b.y()}, -e, share).value();
  EXPECT_NEAR(mirrored.first.turning, -biarc.first.turning, 1e-14);
  const Biarc reversed = makeBiarc(b, e + kPi, a, s + kPi, 1 - share).value();
  EXPECT_NEAR(reversed.first.turning, -biarc.second.turning, 1e-13);
  EXPECT_NEAR(reversed.second.length, biarc.first.length, 1e-13);
}

TEST(BiarcTangents, FollowTheNeighbours) {
  const std::vector<double> open = biarcTangents({{1, 0}, {2, 6}, {5.5, 3}}).value();
  EXPECT_NEAR(open[0], std::atan2(6, 1), 1e-15);
  EXPECT_NEAR(open[1], std::atan2(3, 4.5), 1e-15);
  EXPECT_NEAR(open[2], std::atan2(-3, 3.5), 1e-15);
  const std::vector<double> square = biarcTangents({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true).value();
  EXPECT_NEAR(square[0], -kPi / 4, 1e-15);
  // A chain that turns straight back crosses its turning point at a right angle.
  const std::vector<double> back = biarcTangents({{0, 0}, {3, 0}, {1, 0}}).value();
  EXPECT_NEAR(std::abs(back[1]), kPi / 2, 1e-15);
  EXPECT_FALSE(biarcTangents({{0, 0}}));
  EXPECT_EQ(biarcTangents({{0, 0}, {1, 1}, {1, 1}, {2, 0}}).error().where, "points[1]");
}

}  // namespace bw
