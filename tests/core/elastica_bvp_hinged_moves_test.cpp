// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Blades with hinged ends from blades that are there already, and what moved ends do to them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "blade_problems.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

namespace bw {

using namespace test;

using Eigen::Vector2d;

TEST(HingedBlade, OwnAnswersLeadToThemselves) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> angle(-kPi, kPi), share(0.05, 0.99);
  int answered = 0;
  for (int i = 0; i < 24; ++i) {
    ClampedProblem problem =
        across(i % 4 == 0 ? 1 - 0.01 * share(engine) : share(engine), angle(engine), kHinged);
    if (i % 3 == 1) std::swap(problem.startAngle, problem.endAngle);
    if (i % 3 == 2) problem.startAngle = kHinged;
    ClampedOptions options;
    options.maxInflections = 1;
    const Result<ClampedAnswer> all = solveAllClamped(problem, options);
    ASSERT_TRUE(all);
    for (const ClampedSolution& solution : all->solutions) {
      const Result<ClampedAnswer> again = solveClamped(problem, from(solution.elastica));
      ASSERT_TRUE(again) << i << " " << again.error().message;
      const ClampedSolution& rest = again->solutions[0];
      EXPECT_TRUE(rest.stable);
      EXPECT_EQ(again->snapsAt, solution.stable ? std::nullopt : std::optional<double>(0));
      if (!solution.stable) {
        EXPECT_NE(again->message.find("not stable here"), std::string::npos) << again->message;
        continue;
      }
      ++answered;
      EXPECT_NEAR(rest.energy, solution.energy, 1e-9 * solution.energy) << i;
      EXPECT_NEAR(rest.turning, solution.turning, 1e-9) << i;
      EXPECT_NEAR((rest.elastica.point(333) - solution.elastica.point(333)).norm(), 0, 1e-6) << i;
    }
  }
  EXPECT_GT(answered, 30);
}

TEST(HingedBlade, StaysOnItsSideWhileTheHingesMove) {
  const Result<ClampedAnswer> all = solveAllClamped(across(0.9, kHinged, kHinged));
  ASSERT_TRUE(all);
  for (const int image : {0, 1}) {
    const Elastica& blade = all->solutions[std::size_t(image)].elastica;
    const double side = blade.point(kBlade / 2).y();
    const ClampedProblem next{{50, -20}, {350, 380}, kHinged, kHinged, kBlade, {}};
    const Result<ClampedAnswer> answer = solveClamped(next, from(blade));
    ASSERT_TRUE(answer);
    EXPECT_FALSE(answer->snapsAt);
    const Vector2d chord = next.end - next.start;
    const Vector2d middle = answer->solutions[0].elastica.point(kBlade / 2) - next.start;
    EXPECT_GT((chord.x() * middle.y() - chord.y() * middle.x()) * side, 0);
    EXPECT_NEAR(answer->solutions[0].energy, solveClamped(next)->solutions[0].energy, 1e-12);
  }
}

TEST(HingedBlade, AReleasedGripLetsTheBladeComeToRest) {
  for (const double share : {0.6, 0.8, 0.95}) {
    const Result<ClampedAnswer> held = solveClamped(across(share, 0.6, -0.4));
    ASSERT_TRUE(held);
    for (const ClampedProblem& released :
         {across(share, 0.6, kHinged), across(share, kHinged, -0.4), across(share, kHinged, kHinged)}) {
      const Result<ClampedAnswer> answer = solveClamped(released, from(held->solutions[0].elastica));
      const Result<ClampedAnswer> rest = solveClamped(released);
      ASSERT_TRUE(answer && rest);
      EXPECT_FALSE(answer->snapsAt);
      EXPECT_NEAR(answer->solutions[0].energy, rest->solutions[0].energy, 1e-12);
      EXPECT_LT(answer->solutions[0].energy, held->solutions[0].energy);
      EXPECT_GT(answer->solutions[0].elastica.point(400).y(), 0);
    }
  }
}

TEST(HingedBlade, SnapsAtOnceWhereOnlyTheGripsHeldIt) {
  // Clamped in an S, which no pair of hinges holds.
  const ClampedProblem grips = across(0.8, 1.2, 1.2);
  const Result<ClampedAnswer> held = solveClamped(grips);
  ASSERT_TRUE(held);
  ASSERT_EQ(held->solutions[0].inflections.size() % 2, 1u) << "an S";
  const Elastica& blade = held->solutions[0].elastica;
  const Result<ClampedAnswer> released = solveClamped(across(0.8, kHinged, kHinged), from(blade));
  ASSERT_TRUE(released);
  ASSERT_TRUE(released->snapsAt);
  EXPECT_EQ(*released->snapsAt, 0);
  EXPECT_NE(released->message.find("snaps at once"), std::string::npos) << released->message;
  EXPECT_TRUE(released->solutions[0].stable);
  EXPECT_FALSE(solveClamped(grips, from(blade))->snapsAt) << "held, it stays";
  // A shape that does not even rest between its own grips.
  const ClampedProblem flat = across(0.8, 0.1, 0.1);
  const Result<ClampedAnswer> all = solveAllClamped(flat);
  ASSERT_TRUE(all);
  int unstable = 0;
  for (const ClampedSolution& solution : all->solutions) {
    if (solution.stable || solution.sliding) continue;
    ++unstable;
    for (const ClampedProblem& next : {flat, across(0.79, 0.11, 0.09)}) {
      const Result<ClampedAnswer> answer = solveClamped(next, from(solution.elastica));
      ASSERT_TRUE(answer);
      EXPECT_EQ(answer->snapsAt, std::optional<double>(0));
    }
  }
  EXPECT_GT(unstable, 0);
}

TEST(HeldBlade, IsNotSaidToSnapWhereItIsPulledTaut) {
  // Symmetric bows have no fold on their way to any taut chord; followed by its start the walk loses them.
  for (const double angle : {0.6, 0.9, 1.2}) {
    const Result<ClampedAnswer> bow = solveClamped(across(0.8, angle, -angle));
    ASSERT_TRUE(bow);
    for (const double share : {0.9, 0.95, 0.976, 0.985, 0.999}) {
      const ClampedProblem taut = across(share, angle, -angle);
      const Result<ClampedAnswer> pulled = solveClamped(taut, from(bow->solutions[0].elastica));
      const Result<ClampedAnswer> rest = solveClamped(taut);
      ASSERT_TRUE(pulled && rest) << angle << " " << share;
      EXPECT_FALSE(pulled->snapsAt) << angle << " " << share << " " << pulled->message;
      EXPECT_NEAR(pulled->solutions[0].energy, rest->solutions[0].energy, 1e-9 * rest->solutions[0].energy);
    }
  }
}

TEST(HingedBlade, SnapsWhereItsMarginVanishes) {
  // Of the two blades that rest at a slanted grip, that which bows against the grip gives way as it turns.
  const Result<ClampedAnswer> all = solveAllClamped(across(0.7, 0.5, kHinged));
  ASSERT_TRUE(all);
  const ClampedSolution* against = nullptr;
  for (const ClampedSolution& solution : all->solutions)
    if (solution.stable && solution.turning > 0 && solution.turning < kPi) against = &solution;
  ASSERT_NE(against, nullptr);
  const Result<ClampedAnswer> gone = solveClamped(across(0.7, 2.5, kHinged), from(against->elastica));
  ASSERT_TRUE(gone);
  ASSERT_TRUE(gone->snapsAt);
  EXPECT_TRUE(gone->solutions[0].stable);
  const double angle = 0.5 + 2 * *gone->snapsAt;
  for (const double factor : {0.99, 1.01}) {
    const Result<ClampedAnswer> near =
        solveClamped(across(0.7, factor * angle, kHinged), from(against->elastica));
    ASSERT_TRUE(near);
    EXPECT_EQ(near->snapsAt.has_value(), factor > 1);
    if (factor > 1) {
      EXPECT_NEAR(0.5 + (factor * angle - 0.5) * *near->snapsAt, angle, 1e-3);
    } else {
      EXPECT_GT(near->solutions[0].stabilityMargin, 0);
      EXPECT_LT(near->solutions[0].stabilityMargin, 0.3 * against->stabilityMargin);
    }
  }
  // The same seen from the other end.
  const Result<ClampedAnswer> back = solveClamped({{0.7 * kBlade, 0}, {0, 0}, kHinged, 2.5 + kPi, kBlade, {}},
                                                  from(against->elastica.reversed()));
  ASSERT_TRUE(back && back->snapsAt);
  EXPECT_NEAR(*back->snapsAt, *gone->snapsAt, 1e-6);
  EXPECT_NEAR(back->solutions[0].energy, gone->solutions[0].energy, 1e-12);
}

TEST(HingedBlade, ABranchFollowsHingesAndGripsInTurn) {
  const Result<ClampedAnswer> start = solveClamped(across(0.9, 0.4, -0.3));
  ASSERT_TRUE(start);
  Result<ClampedBranch> branch = ClampedBranch::from(start->solutions[0].elastica);
  ASSERT_TRUE(branch);
  for (const ClampedProblem& next : {across(0.85, 0.5, kHinged), across(0.8, kHinged, kHinged),
                                     across(0.85, 0.5, kHinged), across(0.9, 0.4, -0.3)}) {
    const Result<ClampedBranch::Move> move = branch->moveTo(next);
    ASSERT_TRUE(move) << move.error().message;
    EXPECT_FALSE(move->snapped);
    EXPECT_NEAR((branch->blade().at(kBlade).point - next.end).norm(), 0, 1e-8);
    EXPECT_NEAR(branch->blade().energy(), solveClamped(next)->solutions[0].energy, 1e-11);
  }
  const Result<ClampedBranch::Move> refused = branch->moveTo(across(0.9, kHinged, -0.3));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::badInput);
}

TEST(HingedBlade, SensitivityIsWhatMovedEndsDo) {
  for (const ClampedProblem& problem :
       {across(0.92, 0.5, kHinged), across(0.8, kHinged, -0.7), across(0.9, kHinged, kHinged)})
    expectSensitivity(problem);
}

}  // namespace bw
