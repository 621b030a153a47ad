// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "blade_problems.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

using namespace test;

TEST(ClampedBlade, OtherStableShapesAreThoseAmongAll) {
  std::mt19937 engine(31);
  std::uniform_real_distribution<double> angle(-1.8, 1.8), share(0.3, 0.99);
  ClampedOptions options;
  options.others = true;
  int several = 0;
  for (int i = 0; i < 60; ++i) {
    const ClampedProblem problem = across(share(engine), angle(engine), angle(engine));
    const Result<ClampedAnswer> rest = solveClamped(problem, options);
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(rest && all) << i;
    EXPECT_EQ(rest->others.stable, all->others.stable) << i;
    const auto stable = std::count_if(all->solutions.begin(), all->solutions.end(),
                                      [](const ClampedSolution& s) { return s.stable; });
    EXPECT_EQ(all->others.stable, stable - 1) << i;
    if (all->others.stable == 0) continue;
    ++several;
    EXPECT_NEAR(rest->others.energy, all->others.energy, 1e-9 * all->others.energy) << i;
    EXPECT_NEAR(rest->others.turning, all->others.turning, 1e-9) << i;
    EXPECT_GE(rest->others.energy, rest->solutions[0].energy * (1 - 1e-9)) << i;
  }
  EXPECT_GT(several, 30);
}

TEST(ClampedBlade, ABuckledBladeMayRestInItsMirrorImage) {
  ClampedOptions options;
  options.others = true;
  const Result<ClampedAnswer> rest = solveClamped(across(0.9, 0, 0), options);
  ASSERT_TRUE(rest);
  ASSERT_GE(rest->others.stable, 1);
  EXPECT_NEAR(rest->others.energy, rest->solutions[0].energy, 1e-9 * rest->others.energy);
  EXPECT_EQ(rest->others.turning, 0);
  // Held in the other image, the first one is the other.
  options.initial = rest->solutions[0].elastica.mirrored();
  const Result<ClampedAnswer> mirror = solveClamped(across(0.9, 0, 0), options);
  ASSERT_TRUE(mirror) << mirror.error().message;
  EXPECT_NEAR(mirror->solutions[0].elastica.startCurvature(), -rest->solutions[0].elastica.startCurvature(),
              1e-9);
  EXPECT_EQ(mirror->others.stable, rest->others.stable);
}

TEST(ClampedBlade, WhatSlidesIsNeverStable) {
  // The figure of eight through grips in one place slides; half as large and run twice it is unstable
  // besides, and the circle has nothing to slide into.
  const Result<ClampedAnswer> closed = solveAllClamped({{3, 4}, {3, 4}, 0.7, 0.7, 800, {}});
  ASSERT_TRUE(closed);
  for (const ClampedSolution& s : closed->solutions) {
    EXPECT_FALSE(s.stable && s.sliding);
    EXPECT_EQ(s.sliding, s.inflections.size() == 2) << s.stabilityMargin;
  }
  // Taut blades with a loop somewhere between their bends.
  for (const double share : {0.75, 0.8, 0.85, 0.9}) {
    const Result<ClampedAnswer> loops = solveAllClamped(across(share, 0.4, -0.4));
    ASSERT_TRUE(loops);
    for (const ClampedSolution& s : loops->solutions) {
      EXPECT_FALSE(s.stable && s.sliding);
      if (s.sliding) {
        EXPECT_TRUE(s.selfIntersects);
      }
    }
  }
}

TEST(ClampedBlade, AdviceOnGripsTooFarApartHelps) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> angle(-kPi, kPi), beyond(1, 1.3);
  for (int i = 0; i < 100; ++i) {
    ClampedProblem problem = across(beyond(engine), angle(engine), angle(engine));
    if (i % 5 == 0) problem.length = problem.end.x();
    const Result<ClampedAnswer> refused = solveClamped(problem);
    ASSERT_FALSE(refused);
    const std::string& message = refused.error().message;
    const auto numberBefore = [&](const std::string& words) {
      const std::size_t at = message.find(words);
      if (at == std::string::npos) return 0.0;
      const std::size_t from = message.rfind(' ', at - 1);
      return std::stod(message.substr(from + 1, at - from - 1));
    };
    ClampedProblem closer = problem;
    closer.end.x() = numberBefore(" mm apart or");
    ASSERT_GT(closer.end.x(), 0) << message;
    EXPECT_TRUE(solveClamped(closer)) << i << " " << message;
    ClampedProblem longer = problem;
    longer.length = numberBefore(" mm.");
    EXPECT_TRUE(solveClamped(longer)) << i << " " << message;
  }
}

}  // namespace bw
