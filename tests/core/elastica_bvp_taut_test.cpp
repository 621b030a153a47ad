// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "blade_problems.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

using namespace test;

namespace {

using Eigen::Vector2d;

/// E L and √f L of the lower of the ways in which two bends alone may meet their grips, by fixed points.
std::pair<double, double> bendsAlone(double share, double start, double end) {
  std::pair<double, double> best{INFINITY, 0};
  for (const double turns : {-1.0, 0.0, 1.0}) {
    const double far = end + 2 * kPi * turns;
    if (std::abs(far) > 2 * kPi - 0.1) continue;
    double root = 0, tilt = 0, shares = 0;
    for (int i = 0; i < 200; ++i) {
      shares = 2 - std::cos((start + tilt) / 2) - std::cos((far + tilt) / 2);
      root = 2 * shares / (1 - share * std::cos(tilt));
      const double aside = 2 / root * (std::sin((start + tilt) / 2) + std::sin((far + tilt) / 2)) / share;
      tilt += 0.5 * (std::asin(std::clamp(aside, -1.0, 1.0)) - tilt);
    }
    if (2 * root * shares < best.first) best = {2 * root * shares, root};
  }
  return best;
}

}  // namespace

TEST(ClampedBlade, TautBladesWithAGripAlongTheChordRest) {
  // (share, grips, E L of discrete chains, extrapolated to endless segments): a level grip is no
  // special place.
  for (const auto& [share, a, b, energy] :
       {std::tuple{0.999, 0.0, 1.5, 288.897}, {0.999, 1.5, 0.0, 288.897}, {0.9999, 0.0, 0.5, 38.780}}) {
    const ClampedProblem problem = across(share, a, b);
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_TRUE(answer) << share << " " << a << " " << b << ": " << answer.error().message;
    expectSolves(answer->solutions[0], problem);
    EXPECT_TRUE(answer->solutions[0].stable);
    EXPECT_NEAR(answer->solutions[0].energy * 800, energy, 1e-4 * energy);
    for (const double turn : {kPi / 2, 1.1, -2.0}) {
      const Vector2d end = problem.end.x() * Vector2d(std::cos(turn), std::sin(turn));
      const Result<ClampedAnswer> turned = solveClamped({{0, 0}, end, a + turn, b + turn, 800, {}});
      ASSERT_TRUE(turned) << turn << ": " << turned.error().message;
      EXPECT_NEAR(turned->solutions[0].energy, answer->solutions[0].energy, 1e-9 * energy / 800);
    }
  }
}

TEST(ClampedBlade, TautBladesChangeEvenlyAsAGripTurnsThroughTheStretch) {
  // Where the stretch between the bends meets a grip without a bend, its inflection leaves the blade.
  for (const double share : {0.98, 0.99, 0.995}) {
    for (const double b : {1.0, 2.0}) {
      std::optional<double> last, slope;
      for (int i = -50; i <= 50; ++i) {
        const ClampedProblem problem = across(share, 1e-3 * i, b);
        const Result<ClampedAnswer> answer = solveClamped(problem);
        ASSERT_TRUE(answer) << share << " " << b << " " << *problem.startAngle;
        expectSolves(answer->solutions[0], problem);
        const double energy = answer->solutions[0].energy * 800;
        if (last && slope) {
          EXPECT_NEAR(energy - *last, *slope, 4e-5 * energy) << share << " " << b << " " << i;
        }
        if (last) slope = energy - *last;
        last = energy;
      }
    }
  }
}

TEST(ClampedBlade, TautBladesBendEitherWayPastAHalfTurn) {
  // E L of discrete chains and of the bends alone, for either sense of the last grip.
  for (const auto& [share, a, b, energy] :
       {std::tuple{0.99, -0.02, 3.1, 385.52}, {0.9907, -0.02, 3.0, 373.37}, {0.9907, -0.02, 3.1, 414.37}}) {
    const Result<ClampedAnswer> answer = solveClamped(across(share, a, b));
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_NEAR(answer->solutions[0].energy * 800, energy, 0.1) << share << " " << b;
    EXPECT_NEAR(answer->solutions[0].turning, b - a, 1e-12);
    EXPECT_TRUE(answer->solutions[0].stable);
    // The other way round it costs more, and rests as well.
    ClampedProblem other = across(share, a, b);
    other.turning = b - a - 2 * kPi;
    const Result<ClampedAnswer> past = solveClamped(other);
    ASSERT_TRUE(past) << past.error().message;
    expectSolves(past->solutions[0], other);
    EXPECT_GT(past->solutions[0].energy, answer->solutions[0].energy);
    EXPECT_TRUE(past->solutions[0].stable);
  }
}

TEST(ClampedBlade, TautBladesWithAnyGripsRest) {
  std::mt19937 engine(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 400; ++i) {
    const double missing = std::pow(10, -2.6 + 0.9 * unit(engine));
    ClampedProblem problem = across(1 - missing, kPi * unit(engine), kPi * unit(engine));
    if (i % 4 == 0) problem.startAngle = 0.05 * unit(engine);
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_TRUE(answer) << i << " " << missing << " " << *problem.startAngle << " " << *problem.endAngle;
    const ClampedSolution& solution = answer->solutions[0];
    expectSolves(solution, problem);
    EXPECT_TRUE(solution.stable);
    const auto [energy, root] = bendsAlone(1 - missing, *problem.startAngle, *problem.endAngle);
    if (root > 30) {
      EXPECT_NEAR(solution.energy * 800, energy, 1e-5 * energy) << i;
    }
  }
}

}  // namespace bw
