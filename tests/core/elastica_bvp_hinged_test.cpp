// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "blade_problems.h"
#include "bw/core/base/units.h"
#include "bw/core/calibration/blade_length.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

using namespace test;

using Eigen::Vector2d;

TEST(HingedBlade, BetweenHingesAreEqualHalfWavesAlongTheChord) {
  for (const double k : {0.05, 0.4, 0.8, 0.9, 0.93, 0.97}) {
    const double first = std::comp_ellint_1(k), second = std::comp_ellint_2(k);
    const double along = (2 * second - first) / first;  // of the force
    const ClampedProblem problem = across(std::abs(along), kHinged, kHinged);
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(all) << all.error().message;
    EXPECT_EQ(all->kind, ClampedKind::buckling);
    for (int count = 1; count <= 5; ++count) {
      const double energy = 8 * count * count * first * (second - (1 - k * k) * first) / kBlade;
      int images = 0;
      double turnings = 0;
      for (const ClampedSolution& solution : all->solutions) {
        if (std::abs(solution.energy - energy) > 1e-9 * energy) continue;
        ++images;
        turnings += solution.elastica.startAngle();
        expectSolves(solution, problem);
        EXPECT_EQ(int(solution.inflections.size()), count - 1);
        EXPECT_NEAR(std::sqrt(solution.elastica.force().norm()) * kBlade, 2 * count * first, 1e-8 * count);
        EXPECT_NEAR(solution.elastica.force().y(), 0, 1e-9 * solution.elastica.force().norm());
        const double swing = 2 * std::asin(k), angle = along > 0 ? swing : kPi - swing;
        EXPECT_NEAR(std::abs(solution.elastica.startAngle()), angle, 1e-9);
        EXPECT_NEAR(std::abs(solution.turning), count % 2 == 1 ? 2 * swing : 0, 1e-9);
      }
      EXPECT_EQ(images, 2) << k << " " << count;
      EXPECT_NEAR(turnings, 0, 1e-9);
    }
    // To either side of the chord, by the number of half waves, along the force or against it.
    EXPECT_LE(all->solutions.size(), 20u);
    EXPECT_GE(all->solutions.size(), 10u);
  }
}

TEST(HingedBlade, TheEndsMeetWhereTheMountedBladeMeetsItself) {
  constexpr double kMeet = 0.908908557548541;
  const Result<ClampedAnswer> near = solveClamped(across(2e-6, kHinged, kHinged));
  ASSERT_TRUE(near);
  EXPECT_NEAR(std::sin(near->solutions[0].elastica.startAngle() / 2), kMeet, 2e-6);
  const Result<ClampedAnswer> one = solveClamped({{3, 4}, {3, 4}, kHinged, kHinged, kBlade, {}});
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().code, ErrorCode::noSolution);
  EXPECT_NE(one.error().message.find("hinged in one place"), std::string::npos) << one.error().message;
}

TEST(HingedBlade, AgreesWithTheMountedBladeOfHingedEnds) {
  for (const double share : {0.02, 0.3, 0.7, 0.95, 0.9999}) {
    const Result<BladeHeight> mounted = bladeHeight(kBlade, {share * kBlade, 0, std::nullopt});
    ASSERT_TRUE(mounted) << mounted.error().message;
    const Result<ClampedAnswer> answer = solveClamped(across(share, kHinged, kHinged));
    ASSERT_TRUE(answer);
    const ClampedSolution& rest = answer->solutions[0];
    EXPECT_TRUE(rest.stable);
    EXPECT_NEAR(rest.elastica.point(kBlade / 2).y(), mounted->height, 1e-7);
    EXPECT_NEAR(rest.elastica.startAngle(), mounted->blade.angle, 1e-9);
    EXPECT_TRUE(same(rest.elastica.mirrored(), mounted->blade.elastica, 1e-9)) << share;
  }
}

TEST(HingedBlade, EverySolutionMeetsItsEndsAndIsAmongTheClamped) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> angle(-kPi, kPi), share(0.05, 0.97);
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    ClampedProblem problem = across(share(engine), angle(engine), kHinged);
    if (i % 3 == 1) std::swap(problem.startAngle, problem.endAngle);
    if (i % 3 == 2) problem.startAngle = kHinged;
    ClampedOptions options;
    options.maxInflections = 2;
    const Result<ClampedAnswer> all = solveAllClamped(problem, options);
    ASSERT_TRUE(all) << i;
    ASSERT_GE(all->solutions.size(), 3u);
    for (std::size_t j = 0; j < all->solutions.size(); ++j) {
      const ClampedSolution& solution = all->solutions[j];
      SCOPED_TRACE(std::to_string(i) + " " + std::to_string(j));
      expectSolves(solution, problem);
      EXPECT_LE(solution.inflections.size(), 2u);
      for (std::size_t k = 0; k < j; ++k)
        EXPECT_FALSE(same(solution.elastica, all->solutions[k].elastica, 1e-6)) << k;
      if (solution.elastica.anchor()) continue;
      // Held at the angles that it takes, the same blade is in equilibrium. Whole waves are on a fold there:
      // their ends cannot be turned further.
      const bool fold = !problem.startAngle && !problem.endAngle && solution.inflections.size() % 2 == 1;
      const double tolerance = fold ? 1e-5 : 1e-8;
      ClampedProblem held = problem;
      held.startAngle = solution.elastica.startAngle();
      held.endAngle = *held.startAngle + solution.turning;
      held.turning = solution.turning;
      const Result<ClampedAnswer> clamped = solveAllClamped(held);
      ASSERT_TRUE(clamped);
      EXPECT_TRUE(
          std::any_of(clamped->solutions.begin(), clamped->solutions.end(), [&](const ClampedSolution& s) {
            return same(s.elastica, solution.elastica, tolerance) && (s.stable || !solution.stable);
          }));
      ++compared;
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(HingedBlade, DoesNotChangeWithPlaceScaleMirrorOrDirection) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> angle(-2, 2), share(0.2, 0.98);
  for (int i = 0; i < 8; ++i) {
    const double a = angle(engine), d = share(engine), turn = 3 * angle(engine), scale = 0.37;
    ClampedOptions options;
    options.maxInflections = 2;
    const Result<ClampedAnswer> all = solveAllClamped(across(d, a, kHinged), options);
    ASSERT_TRUE(all);
    const Vector2d place(17, -4), chord = scale * d * kBlade * Vector2d(std::cos(turn), std::sin(turn));
    const double length = scale * kBlade;
    const Vector2d mirrored = scale * d * kBlade * Vector2d(std::cos(turn), -std::sin(turn));
    const ClampedProblem others[] = {{place, place + chord, a + turn, kHinged, length, {}},
                                     {place, place + mirrored, -a - turn, kHinged, length, {}},
                                     {place + chord, place, kHinged, a + turn + kPi, length, {}}};
    for (const ClampedProblem& other : others) {
      const Result<ClampedAnswer> moved = solveAllClamped(other, options);
      ASSERT_TRUE(moved);
      ASSERT_EQ(moved->solutions.size(), all->solutions.size()) << i;
      for (std::size_t j = 0; j < all->solutions.size(); ++j) {
        const ClampedSolution &x = all->solutions[j], &y = moved->solutions[j];
        expectSolves(y, other);
        EXPECT_NEAR(y.energy * scale, x.energy, 1e-8 * x.energy);
        EXPECT_NEAR(std::abs(y.turning), std::abs(x.turning), 1e-8);
        EXPECT_EQ(y.stable, x.stable);
        EXPECT_EQ(y.inflections.size(), x.inflections.size());
      }
      const Result<ClampedAnswer> rest = solveClamped(other);
      ASSERT_TRUE(rest);
      expectSolves(rest->solutions[0], other);
    }
  }
}

TEST(HingedBlade, TautBladesBendAtTheGripAlone) {
  // The bend alone: √f = 2 (1 − cos ½α)/(1 − d cos τ), E = 2 √f (1 − cos ½α), the hinge at the stretch's end.
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i) {
    const double missing = std::pow(10, -3 + unit(engine));
    const double a = kPi * unit(engine);
    const ClampedProblem problem = across(1 - missing, a, kHinged);
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_TRUE(answer) << missing << " " << a << " " << answer.error().message;
    const ClampedSolution& rest = answer->solutions[0];
    expectSolves(rest, problem);
    EXPECT_TRUE(rest.stable);
    const double root = std::sqrt(rest.elastica.force().norm()) * kBlade;
    if (root < 25) continue;
    const double bend = a - rest.elastica.at(kBlade).angle;
    EXPECT_NEAR(rest.energy * kBlade, 2 * root * (1 - std::cos(bend / 2)), 1e-6 * root) << i;
    EXPECT_NEAR((1 - missing) * std::cos(a - bend), 1 - 2 / root * (1 - std::cos(bend / 2)), 1e-8) << i;
    EXPECT_GT(rest.stabilityMargin, 0.5 * root * root / 20.19 * (1 - std::pow(std::cos(bend / 2), 2)));
  }
}

TEST(HingedBlade, TautBladesTakeTheBendOfLeastEnergy) {
  // √f L just below and above 400, from where on the bends alone tell all.
  for (const auto& [missing, a] :
       {std::pair{0.0025, 2.0}, {0.00117, 1.338}, {0.00326, 2.387}, {0.0022, 2.0}}) {
    const Result<ClampedAnswer> answer = solveClamped(across(1 - missing, a, kHinged));
    ASSERT_TRUE(answer);
    const double share = 1 - std::cos(a / 2);
    EXPECT_NEAR(answer->solutions[0].energy * kBlade, 4 * share * share / missing,
                0.04 * share * share / missing);
    EXPECT_LT(std::abs(answer->solutions[0].turning), kPi);
  }
}

TEST(HingedBlade, IsStraightWhereItIsAsLongAsItsChord) {
  const double turn = 0.4;
  const Vector2d end = kBlade * Vector2d(std::cos(turn), std::sin(turn));
  for (const ClampedProblem& problem : {ClampedProblem{{0, 0}, end, kHinged, kHinged, kBlade, {}},
                                        ClampedProblem{{0, 0}, end, turn, kHinged, kBlade, {}},
                                        ClampedProblem{{0, 0}, end, kHinged, turn, kBlade, {}}}) {
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_EQ(answer->kind, ClampedKind::straight);
    expectSolves(answer->solutions[0], problem);
    EXPECT_EQ(answer->solutions[0].energy, 0);
  }
}

TEST(HingedBlade, SaysWhyThereIsNoSolution) {
  const auto refused = [](const ClampedProblem& problem, ErrorCode code, const char* where,
                          const char* words) {
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, code);
    EXPECT_EQ(answer.error().where, where);
    EXPECT_NE(answer.error().message.find(words), std::string::npos) << answer.error().message;
    EXPECT_FALSE(solveAllClamped(problem));
  };
  refused(across(1.01, kHinged, kHinged), ErrorCode::noSolution, "length", "take a blade of at least");
  refused(across(1.01, kHinged, 1), ErrorCode::noSolution, "length", "take a blade of at least");
  refused(across(1, 0.1, kHinged), ErrorCode::noSolution, "start_angle", "off the line");
  refused(across(1, kHinged, 0.1), ErrorCode::noSolution, "end_angle", "off the line");
  refused(across(0, kHinged, kHinged), ErrorCode::noSolution, "end", "hinged in one place");
  refused(across(0.5, kHinged, 2e9), ErrorCode::badInput, "end_angle", "1e9");
  ClampedProblem turned = across(0.5, 0.3, kHinged);
  turned.turning = 1;
  refused(turned, ErrorCode::badInput, "turning", "leave the turning out");
  // One grip where the hinge is.
  const ClampedProblem loop = across(0, 0.3, kHinged);
  const Result<ClampedAnswer> answer = solveClamped(loop);
  ASSERT_TRUE(answer) << answer.error().message;
  expectSolves(answer->solutions[0], loop);
}

TEST(HingedBlade, SurvivesWildProblems) {
  std::mt19937 engine(77);
  std::uniform_real_distribution<double> unit(-1, 1);
  int solved = 0, refused = 0;
  for (int i = 0; i < 150; ++i) {
    ClampedProblem problem;
    problem.length = std::pow(10, 3 * unit(engine));
    const double direction = 9 * unit(engine);
    problem.end =
        problem.length * 1.02 * std::abs(unit(engine)) * Vector2d(std::cos(direction), std::sin(direction));
    problem.startAngle = 10 * unit(engine);
    problem.endAngle = kHinged;
    if (i % 13 == 0) problem.end = {0, 0};
    if (i % 11 == 0) problem.startAngle = direction;
    if (i % 2 == 0) std::swap(problem.startAngle, problem.endAngle);
    if (i % 5 == 0) problem.startAngle = problem.endAngle = kHinged;
    const Result<ClampedAnswer> answer = solveClamped(problem);
    if (!answer) {
      ASSERT_EQ(answer.error().code, ErrorCode::noSolution);
      ++refused;
      continue;
    }
    ++solved;
    expectSolves(answer->solutions[0], problem);
    ASSERT_TRUE(answer->solutions[0].stable) << i;
  }
  EXPECT_GT(solved, 130);
  EXPECT_GT(refused, 0);
}

}  // namespace bw
