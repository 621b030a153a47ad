// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/elastica/elastica_bvp.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

#include "blade_problems.h"
#include "bw/core/base/units.h"
#include "reference_elastica.h"

namespace bw {

using namespace test;

namespace {

using Eigen::Vector2d;

/// The problem that a blade solves.
ClampedProblem problemOf(const Elastica& blade) {
  const Elastica::State end = blade.at(blade.length());
  return {blade.start(), end.point,      blade.startAngle(),
          end.angle,     blade.length(), end.angle - blade.startAngle()};
}

/// An independent search: Newton's method from random start values.
std::vector<Elastica> shootAtRandom(const ClampedProblem& problem, double turning, int shots,
                                    std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Elastica> found;
  const double length = problem.length;
  for (int i = 0; i < shots; ++i) {
    const double root = 7 + 6 * unit(engine), angle = kPi * unit(engine);
    Eigen::Vector3d q(2 * root * unit(engine), root * root * std::cos(angle), root * root * std::sin(angle));
    for (int k = 0; k < 30; ++k) {
      const Result<Elastica> e = Elastica::make(problem.start, *problem.startAngle, q(0) / length,
                                                q.tail<2>() / length / length, length);
      if (!e || std::abs(q(0)) + q.tail<2>().norm() > 2000) break;
      Elastica::Jacobian jacobian;
      const Elastica::State end = e->at(length, jacobian);
      const Eigen::Vector3d miss((problem.end.x() - end.point.x()) / length,
                                 (problem.end.y() - end.point.y()) / length,
                                 *problem.startAngle + turning - end.angle);
      if (miss.norm() < 1e-11) {
        found.push_back(*e);
        break;
      }
      Eigen::Matrix3d m = jacobian.block<3, 3>(0, 3);
      m.topRows<2>() /= length;
      m.col(0) /= length;
      m.rightCols<2>() /= length * length;
      Eigen::Vector3d step = m.partialPivLu().solve(miss);
      const double size =
          std::max(std::abs(step(0)) / 3, step.tail<2>().norm() / (10 + q.tail<2>().norm() / 3));
      if (size > 1) step /= size;
      if (!step.allFinite()) break;
      q += step;
    }
  }
  return found;
}

}  // namespace

TEST(ClampedBlade, FindsACircleByItsEnds) {
  for (const double turning : {0.01, 0.7, -2.5, 4.0}) {
    const Elastica arc = *Elastica::make({10, -3}, 0.3, turning / 500, {0, 0}, 500);
    const Result<ClampedAnswer> answer = solveClamped(problemOf(arc));
    ASSERT_TRUE(answer) << answer.error().message;
    const ClampedSolution& best = answer->solutions.front();
    EXPECT_TRUE(same(best.elastica, arc, 1e-9)) << turning;
    EXPECT_NEAR(best.energy, 0.5 * turning * turning / 500, 1e-9 * (1 + turning * turning) / 500);
    EXPECT_TRUE(best.stable);
    EXPECT_TRUE(best.inflections.empty());
  }
}

TEST(ClampedBlade, WholePeriodsBetweenEqualAnglesHaveAKnownChord) {
  // chord / L = (2E − K) / K whatever the angle.
  for (const double k : {0.2, 0.5, 0.7}) {
    const double period = 4 * test::quarterPeriod(k);
    for (const double phase : {0.3, 1.1}) {
      const Elastica e = *Elastica::fromControlParameters({k, phase, period, 100, 0.4, 5, 6});
      const ClampedProblem problem = problemOf(e);
      EXPECT_NEAR(std::remainder(*problem.endAngle - *problem.startAngle, 2 * kPi), 0, 1e-9);
      const Result<ClampedAnswer> all = solveAllClamped(problem);
      ASSERT_TRUE(all);
      int hits = 0;
      for (const ClampedSolution& solution : all->solutions) hits += same(solution.elastica, e, 1e-7);
      EXPECT_EQ(hits, 1) << k << " " << phase;
    }
  }
}

TEST(ClampedBlade, EverySolutionMeetsItsGrips) {
  for (const auto& [share, a, b] :
       {std::tuple{0.95, 0.3, -0.2}, {0.7, 1.2, 0.8}, {0.4, -1.0, 2.5}, {0.9, 0.0, 0.5}}) {
    ClampedProblem problem = across(share, a, b);
    problem.start = {100, 50};
    problem.end += problem.start;
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(all);
    EXPECT_GE(all->solutions.size(), 2u);
    double last = 0;
    for (const ClampedSolution& solution : all->solutions) {
      EXPECT_GE(solution.energy, last);
      last = solution.energy;
      EXPECT_LE(solution.inflections.size(), 4u);
      expectSolves(solution, problem);
      EXPECT_NEAR(solution.energy, solution.elastica.energy(), 1e-8 * solution.energy);
    }
  }
}

TEST(ClampedBlade, FindsWhatRandomShootingFinds) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    const ClampedProblem problem = across(0.7 + 0.25 * unit(engine), 1.7 * unit(engine), 1.7 * unit(engine));
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(all);
    for (const Elastica& shot : shootAtRandom(problem, *problem.endAngle - *problem.startAngle, 60, engine)) {
      if (shot.inflections().size() > 4) continue;
      ++compared;
      bool found = false;
      for (const ClampedSolution& solution : all->solutions)
        found = found || same(solution.elastica, shot, 1e-6);
      EXPECT_TRUE(found) << i << ": " << *problem.startAngle << " " << *problem.endAngle << " "
                         << problem.end.x();
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(ClampedBlade, RestsInTheStableShapeOfLowestEnergy) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i) {
    const double range = i % 2 ? fromDegrees(45) : fromDegrees(100);
    const double share = i % 2 ? 0.9225 + 0.0725 * unit(engine) : 0.74 + 0.24 * unit(engine);
    const ClampedProblem problem = across(share, range * unit(engine), range * unit(engine));
    const Result<ClampedAnswer> rest = solveClamped(problem);
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(rest && all);
    ASSERT_EQ(rest->solutions.size(), 1u);
    EXPECT_TRUE(rest->solutions[0].stable);
    for (const ClampedSolution& solution : all->solutions)
      if (solution.stable) {
        EXPECT_LE(rest->solutions[0].energy, solution.energy * (1 + 1e-6)) << i;
        break;
      }
  }
}

TEST(ClampedBlade, AllShapesHoldTheOneAtRestAtTheEdgesOfTheSheets) {
  // Inflections close to both grips, and a blade too taut for the cells.
  for (const auto& [share, a, b] :
       {std::tuple{0.7199, 1.0921, -0.8787}, {0.6239, -1.1221, 1.2256}, {0.974, 1.7024, -0.0629}}) {
    const Result<ClampedAnswer> rest = solveClamped(across(share, a, b));
    const Result<ClampedAnswer> all = solveAllClamped(across(share, a, b));
    ASSERT_TRUE(rest && all) << share;
    EXPECT_NEAR(all->solutions[0].energy, rest->solutions[0].energy, 1e-9 * rest->solutions[0].energy);
  }
}

TEST(ClampedBlade, BothRoutesAgreeOnStability) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  int stable = 0, unstable = 0;
  for (int i = 0; i < 25; ++i) {
    const ClampedProblem problem = across(0.75 + 0.2 * unit(engine), 1.5 * unit(engine), 1.5 * unit(engine));
    const Result<ClampedAnswer> all = solveAllClamped(problem);
    ASSERT_TRUE(all);
    for (const ClampedSolution& solution : all->solutions) {
      if (std::sqrt(solution.elastica.force().norm()) * problem.length > 16)
        continue;  // beyond the determinant's digits
      if (std::abs(solution.stabilityMargin) < 0.02) continue;
      EXPECT_EQ(isClampedStable(solution.elastica), solution.stable) << i << " " << solution.stabilityMargin;
      EXPECT_NEAR(stabilityMargin(solution.elastica), solution.stabilityMargin,
                  1e-6 * (1 + std::abs(solution.stabilityMargin)));
      (solution.stable ? stable : unstable)++;
    }
  }
  EXPECT_GT(stable, 25);
  EXPECT_GT(unstable, 25);
}

TEST(ClampedBlade, DoesNotChangeWithPlaceScaleMirrorOrDirection) {
  const ClampedProblem problem = across(0.9, 0.5, -0.3);
  const ClampedSolution reference = solveClamped(problem)->solutions[0];
  const auto expectSame = [&](const ClampedProblem& other, double scale) {
    const Result<ClampedAnswer> answer = solveClamped(other);
    ASSERT_TRUE(answer);
    const ClampedSolution& solution = answer->solutions[0];
    EXPECT_NEAR(solution.energy * scale, reference.energy, 1e-9 * reference.energy);
    EXPECT_NEAR(solution.stabilityMargin, reference.stabilityMargin, 1e-7);
    EXPECT_NEAR(solution.outOfPlaneMargin, reference.outOfPlaneMargin, 1e-7);
    EXPECT_NEAR(solution.sensitivity.perMm, reference.sensitivity.perMm, 1e-7);
    EXPECT_NEAR(solution.sensitivity.perDegree / scale, reference.sensitivity.perDegree, 1e-6);
  };
  const double turn = 2.3, c = 800 * 0.9 * std::cos(turn), s = 800 * 0.9 * std::sin(turn);
  expectSame({{50, 60}, {50 + c, 60 + s}, 0.5 + turn, -0.3 + turn, 800, {}}, 1);
  expectSame({{0, 0}, {0.009 * 800, 0}, 0.5, -0.3, 8, {}}, 0.01);
  expectSame(across(0.9, -0.5, 0.3), 1);
  expectSame(across(0.9, 0.3, -0.5), 1);  // turned half round and run backwards
  expectSame(across(0.9, 0.5 - 2 * kPi, -0.3 + 4 * kPi), 1);
}

TEST(ClampedBlade, PureBucklingHasTwoMirrorShapes) {
  const ClampedProblem problem = across(0.9, 0, 0);
  const Result<ClampedAnswer> rest = solveClamped(problem);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->kind, ClampedKind::buckling);
  const Result<ClampedAnswer> all = solveAllClamped(problem);
  ASSERT_TRUE(all);
  int stable = 0;
  for (const ClampedSolution& solution : all->solutions) {
    if (!solution.stable || std::abs(solution.turning) > 1) continue;
    ++stable;
    EXPECT_TRUE(same(solution.elastica, rest->solutions[0].elastica, 1e-8) ||
                same(solution.elastica.mirrored(), rest->solutions[0].elastica, 1e-8));
  }
  EXPECT_EQ(stable, 2);
  // Whole period of modulus k from an inflection-free middle: chord / L = (2E − K)/K = 0.9.
  EXPECT_EQ(rest->solutions[0].inflections.size(), 2u);
  // Just after buckling the force is Euler's 4π²/L².
  const ClampedSolution slight = solveClamped(across(1 - 1e-7, 0, 0))->solutions[0];
  EXPECT_NEAR(slight.elastica.force().norm() * 800 * 800, 4 * kPi * kPi, 1e-4);
  EXPECT_TRUE(slight.stable);
}

TEST(ClampedBlade, StraightBladesAreStraight) {
  const Result<ClampedAnswer> answer =
      solveClamped({{1, 2}, {4, 6}, std::atan2(4, 3), std::atan2(4, 3) + 2 * kPi, 5, {}});
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->kind, ClampedKind::straight);
  EXPECT_EQ(answer->solutions[0].energy, 0);
  EXPECT_EQ(answer->solutions[0].stabilityMargin, 1);
  EXPECT_LT(answer->solutions[0].endError, 1e-12);
}

TEST(ClampedBlade, SaysWhyThereIsNoSolution) {
  const Result<ClampedAnswer> tooFar = solveClamped(across(1.01, 0, 0));
  ASSERT_FALSE(tooFar);
  EXPECT_EQ(tooFar.error().code, ErrorCode::noSolution);
  EXPECT_NE(tooFar.error().message.find("nearer"), std::string::npos);
  EXPECT_EQ(tooFar.error().value, 800);
  const Result<ClampedAnswer> crooked = solveClamped(across(1, 0.2, 0));
  ASSERT_FALSE(crooked);
  EXPECT_EQ(crooked.error().code, ErrorCode::noSolution);
  EXPECT_NE(crooked.error().message.find("straight"), std::string::npos);
  ClampedProblem problem = across(0.9, 0.1, 0.1);
  problem.turning = 1;
  EXPECT_EQ(solveClamped(problem).error().code, ErrorCode::badInput);
  problem = across(0.9, 0.1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(solveClamped(problem).error().code, ErrorCode::badInput);
  problem = across(0.9, 0.1, 0.2, -1);
  EXPECT_EQ(solveClamped(problem).error().code, ErrorCode::badInput);
}

TEST(ClampedBlade, ClosedCurvesThatSlideThroughTheirGripsAreOneEachAndNotStable) {
  // Both grips in one place: the circle either way, and figures of eight that may start anywhere.
  for (const double angle : {0.0, 1.3}) {
    const ClampedProblem problem{{3, 4}, {3, 4}, angle, angle + 2 * kPi, 800, {}};
    const Result<ClampedAnswer> answer = solveAllClamped(problem);
    ASSERT_TRUE(answer) << answer.error().message;
    ASSERT_EQ(answer->solutions.size(), 4u);
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(answer->solutions[i].stable);
      EXPECT_NEAR(answer->solutions[i].energy, 2 * kPi * kPi / 800, 1e-9);
    }
    for (int i = 2; i < 4; ++i) {
      const ClampedSolution& eight = answer->solutions[i];
      EXPECT_EQ(eight.inflections.size(), i == 2 ? 2u : 4u);
      EXPECT_FALSE(eight.stable) << eight.stabilityMargin;
      EXPECT_NEAR(eight.turning, 0, 1e-9);
    }
    EXPECT_NEAR(answer->solutions[3].energy, 4 * answer->solutions[2].energy, 1e-9) << "half as large, twice";
    EXPECT_NE(answer->message.find("slide"), std::string::npos);
    EXPECT_TRUE(solveClamped(problem)->solutions[0].inflections.empty());
  }
}

TEST(ClampedBlade, TurnsAsAsked) {
  for (const double turns : {-1.0, 0.0, 1.0}) {
    ClampedProblem problem = across(0.6, 0.4, -0.2);
    problem.turning = -0.6 + 2 * kPi * turns;
    const Result<ClampedAnswer> answer = solveClamped(problem);
    ASSERT_TRUE(answer) << turns;
    const Elastica& e = answer->solutions[0].elastica;
    EXPECT_NEAR(e.at(e.length()).angle - e.startAngle(), *problem.turning, 1e-9);
    EXPECT_EQ(answer->solutions[0].selfIntersects, turns != 0);
  }
}

TEST(ClampedBlade, SensitivityIsWhatMovedGripsDo) { expectSensitivity(across(0.92, 0.5, -0.2)); }

TEST(ClampedBranch, FollowsTheGripsThereAndBack) {
  const ClampedSolution start = solveClamped(across(0.95, 0.4, -0.3))->solutions[0];
  Result<ClampedBranch> branch = ClampedBranch::from(start.elastica);
  ASSERT_TRUE(branch);
  const ClampedProblem far = across(0.85, 0.9, -0.5);
  Result<ClampedBranch::Move> move = branch->moveTo(far);
  ASSERT_TRUE(move);
  EXPECT_FALSE(move->snapped);
  EXPECT_NEAR((branch->blade().at(800).point - far.end).norm(), 0, 1e-8);
  EXPECT_GT(stabilityMargin(branch->blade()), 0);
  move = branch->moveTo(across(0.95, 0.4, -0.3));
  ASSERT_TRUE(move);
  EXPECT_FALSE(move->snapped);
  EXPECT_TRUE(same(branch->blade(), start.elastica, 1e-9));
}

TEST(ClampedBranch, SaysThatTheBladeSnapsAndWhere) {
  // A buckled blade whose grips turn against its bow gives way at some angle, the same for either half of the
  // way there.
  const Result<ClampedAnswer> all = solveAllClamped(across(0.9, 0.0, 0.0));
  const ClampedSolution* up = nullptr;
  for (const ClampedSolution& solution : all->solutions)
    if (solution.stable && std::abs(solution.turning) < 1 && solution.elastica.point(400).y() > 0)
      up = &solution;
  ASSERT_NE(up, nullptr);
  Result<ClampedBranch> branch = ClampedBranch::from(up->elastica);
  ASSERT_TRUE(branch);
  const Result<ClampedBranch::Move> move = branch->moveTo(across(0.9, -1.5, 1.5));
  ASSERT_TRUE(move);
  ASSERT_TRUE(move->snapped);
  EXPECT_GT(move->reached, 0.05);
  EXPECT_LT(move->reached, 0.95);
  // At the fold the margin vanishes.
  const double angle = 1.5 * move->reached;
  const ClampedProblem before = across(0.9, -angle * 0.98, angle * 0.98);
  ClampedOptions options;
  options.initial = up->elastica;
  const Result<ClampedAnswer> still = solveClamped(before, options);
  ASSERT_TRUE(still);
  EXPECT_FALSE(still->snapsAt);
  EXPECT_GT(still->solutions[0].elastica.point(400).y(), 0);
  EXPECT_GT(still->solutions[0].stabilityMargin, 0);
  EXPECT_LT(still->solutions[0].stabilityMargin, 0.3 * up->stabilityMargin);
  const Result<ClampedAnswer> after = solveClamped(across(0.9, -angle * 1.02, angle * 1.02), options);
  ASSERT_TRUE(after);
  ASSERT_TRUE(after->snapsAt);
  EXPECT_NEAR(*after->snapsAt, 1 / 1.02, 1e-3);
  EXPECT_LT(after->solutions[0].elastica.point(400).y(), 0);
  EXPECT_TRUE(after->solutions[0].stable);
}

TEST(ClampedBlade, TautBladesKeepTheirEnergyAndRest) {
  // The longer the blade is against its energy, the less: lengthening by a little must lower the energy and
  // keep the shape.
  double last = std::numeric_limits<double>::infinity();
  for (const double share : {0.995, 0.993, 0.99, 0.985, 0.98}) {
    const Result<ClampedAnswer> answer = solveClamped(across(share, 0.6, -0.6));
    ASSERT_TRUE(answer) << share;
    EXPECT_TRUE(answer->solutions[0].stable);
    EXPECT_LT(answer->solutions[0].energy, last);
    last = answer->solutions[0].energy;
  }
}

namespace {

bool allFinite(const Elastica& e) {
  if (const Elastica::Anchor* a = e.anchor())
    if (!std::isfinite(a->at + a->angle + a->curvature + a->straight) || !a->point.allFinite() ||
        !a->force.allFinite())
      return false;
  return e.start().allFinite() && e.force().allFinite() &&
         std::isfinite(e.startAngle() + e.startCurvature() + e.length());
}

/// Sensitivities alone may be infinite, for a straight blade.
bool allFinite(const ClampedSolution& s) {
  return allFinite(s.elastica) && std::isfinite(s.energy) && std::isfinite(s.turning) &&
         std::isfinite(s.stabilityMargin) && std::isfinite(s.outOfPlaneMargin) && std::isfinite(s.endError) &&
         !std::isnan(s.sensitivity.perMm) && !std::isnan(s.sensitivity.perDegree) &&
         std::all_of(s.inflections.begin(), s.inflections.end(),
                     [&](double at) { return at >= 0 && at <= s.elastica.length(); });
}

constexpr int kWildBlock = 1000;

/// Random problems of every kind, some closed, aligned or impossible: no crash, every number finite, and what
/// comes back rests and ends where it should. A block has its own seed.
void surviveWildProblems(int block, int count) {
  std::mt19937 engine(unsigned(12 + block));
  std::uniform_real_distribution<double> unit(-1, 1);
  int solved = 0, refused = 0;
  for (int i = 0; i < count; ++i) {
    ClampedProblem problem;
    problem.length = std::pow(10, 3 * unit(engine));
    const double direction = 9 * unit(engine);
    problem.end =
        problem.length * 1.02 * std::abs(unit(engine)) * Vector2d(std::cos(direction), std::sin(direction));
    problem.startAngle = 10 * unit(engine);
    problem.endAngle = 10 * unit(engine);
    if (i % 10 == 0) problem.endAngle = *problem.startAngle;
    if (i % 17 == 0) problem.end = {0, 0};
    if (i % 31 == 0) problem.startAngle = problem.endAngle = direction;
    const Result<ClampedAnswer> answer = solveClamped(problem);
    if (!answer) {
      ASSERT_EQ(answer.error().code, ErrorCode::noSolution);
      ++refused;
      continue;
    }
    ++solved;
    const ClampedSolution& solution = answer->solutions[0];
    ASSERT_TRUE(allFinite(solution)) << block << " " << i;
    ASSERT_TRUE(solution.stable) << block << " " << i;
    ASSERT_LE(solution.endError, 1e-6 * problem.length) << block << " " << i;
  }
  EXPECT_GT(solved, count * 9 / 10);
  EXPECT_GT(refused, 0);
}

}  // namespace

TEST(ClampedBlade, SurvivesWildProblems) { surviveWildProblems(0, 300); }

/// About an hour: run by --gtest_also_run_disabled_tests. BW_WILD_BLOCKS="FIRST COUNT" runs a part of its
/// 1000 blocks.
TEST(ClampedBlade, DISABLED_SurvivesAMillionWildProblems) {
  int first = 0, count = 1000;
  if (const char* blocks = std::getenv("BW_WILD_BLOCKS")) std::istringstream(blocks) >> first >> count;
  for (int block = first; block < first + count && !HasFatalFailure(); ++block) {
    surviveWildProblems(block, kWildBlock);
    std::cout << "block " << block << " done" << std::endl;
  }
}

TEST(ClampedBlade, TautBladesAreStraightBetweenTheirBends) {
  // Each bend is longer than its chord by 2 (1 − cos ½α)/√λ and has the energy 2 √λ (1 − cos ½α); bent the
  // same way, they need no tilt of the stretch between them.
  for (const auto& [share, a] : {std::tuple{0.995, 0.6}, {0.998, -0.3}, {0.99, 0.7}, {0.999, 0.8}}) {
    const Result<ClampedAnswer> answer = solveClamped(across(share, a, -a));
    ASSERT_TRUE(answer) << share;
    const ClampedSolution& solution = answer->solutions[0];
    const double root = 4 * (1 - std::cos(a / 2)) / (1 - share);
    EXPECT_NEAR(std::sqrt(solution.elastica.force().norm()) * 800, root, 1e-5 * root) << share;
    EXPECT_NEAR(solution.energy * 800, 4 * root * (1 - std::cos(a / 2)), 1e-4 * solution.energy * 800)
        << share;
    EXPECT_GT(solution.stabilityMargin, 1);
    EXPECT_TRUE(solution.inflections.empty());
  }
  for (const auto& [share, a, b] : {std::tuple{0.995, 0.6, 0.5}, {0.99, 0.7, 0.7}, {0.998, 0.3, 0.5}}) {
    const Result<ClampedAnswer> answer = solveClamped(across(share, a, b));
    ASSERT_TRUE(answer) << share;
    ASSERT_EQ(answer->solutions[0].inflections.size(), 1u) << share;
    EXPECT_NEAR(answer->solutions[0].inflections[0], 400, 50);
  }
}

}  // namespace bw
