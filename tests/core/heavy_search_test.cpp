// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// All shapes that a blade with weight could rest in, and what is between them, against Newton's method from
// random shapes.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "bw/core/heavy/heavy_bvp.h"
#include "heavy/heavy_equations.h"

namespace bw {
namespace {

using Eigen::Vector2d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A flat blade of 700 mm between grips that leave it 5 to 30 mm to sag, its tangents up to `steep` off the
/// chord, with 0.1 to 3 times the weight of flat NiCr of 5 × 1 mm.
HeavyProblem slackBlade(std::mt19937& random, double steep) {
  const auto within = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  HeavyProblem problem;
  ClampedProblem& grips = problem.grips;
  grips.length = 700;
  const double sag = within(5, 30), tilt = within(-0.2, 0.2);
  const double chord = grips.length - sag * sag / (0.375 * grips.length);
  grips.end = chord * Vector2d(std::cos(tilt), std::sin(tilt));
  grips.startAngle = tilt + within(-steep, steep);
  grips.endAngle = tilt + within(-steep, steep);
  problem.stiffness = 83333;
  problem.weight = {0, -0.000407 * within(0.1, 3)};
  return problem;
}

/// Stable shapes, and the energy of the lowest that gives way in one direction alone.
struct LowShapes {
  int stable = 0;
  double pass = kInfinite;  ///< N mm
};

/// From 200 shapes whose curvatures are random.
LowShapes byNewton(const HeavyProblem& problem, std::mt19937& random) {
  const ClampedProblem& grips = problem.grips;
  const heavy::Modes& modes = heavy::modesOf(1);
  const double length = grips.length;
  const heavy::Hold hold{(grips.end - grips.start) / length, *grips.startAngle,
                         *grips.endAngle - *grips.startAngle,
                         problem.weight * (length * length * length / problem.stiffness)};
  const double slack = 1 - hold.chord.norm();
  std::uniform_real_distribution<double> any(-1, 1);
  LowShapes low;
  std::vector<double> seen;
  for (int k = 0; k < 200; ++k) {
    heavy::Shape shape{Eigen::VectorXd(modes.count()), Vector2d::Zero()};
    for (Eigen::Index i = 0; i < modes.count(); ++i)
      shape.coefficients(i) = any(random) * (i < 6 ? 75 * std::sqrt(slack) : 0.05);
    const heavy::Equations start(modes, hold, shape);
    shape.force = -start.closure().colPivHouseholderQr().solve(start.residual().head(modes.count()));
    const std::optional<heavy::Shape> found = heavy::settle(hold, shape, 40);
    if (!found) continue;
    const heavy::Equations there(heavy::modesOf(found->count()), hold, *found);
    const double energy = there.energy() * problem.stiffness / length;
    if (std::ranges::any_of(seen, [&](double other) { return std::abs(other - energy) < 1e-6; })) continue;
    seen.push_back(energy);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> stiff(heavy::reducedHessian(there));
    const auto soft = (stiff.eigenvalues().array() < 0).count();
    if (soft == 0) ++low.stable;
    if (soft == 1) low.pass = std::min(low.pass, energy);
  }
  return low;
}

TEST(HeavySearch, FindsTheShapesAndPassesThatNewtonsMethodFindsFromAnywhere) {
  std::mt19937 random(20261128);
  int several = 0, reached = 0;
  for (int k = 0; k < 160; ++k) {
    const HeavyProblem problem = slackBlade(random, 0.05 + 0.1 * (k % 3));
    const Result<HeavyAnswer> answer = solveAllHeavy(problem);
    ASSERT_TRUE(answer) << k << ": " << answer.error().message;
    const double turning = *problem.grips.endAngle - *problem.grips.startAngle;
    LowShapes told;
    for (const HeavySolution& solution : answer->solutions) {
      if (std::abs(solution.turning - turning) > 1e-9) continue;
      if (solution.stable)
        ++told.stable;
      else
        told.pass = std::min(told.pass, solution.energy);
    }
    const LowShapes low = byNewton(problem, random);
    EXPECT_LE(low.stable, told.stable) << k;
    if (told.stable < 2) continue;
    EXPECT_LE(told.pass, low.pass + 1e-6) << k;
    ++several;
    if (low.pass < told.pass + 1e-6) ++reached;
  }
  EXPECT_GE(several, 40);
  EXPECT_GE(reached, several * 9 / 10) << "or the other route finds too little to tell";
}

TEST(HeavySearch, FindsShapesThatOnlyWeightBringsAbout) {
  // Without weight these grips leave a blade one shape. With it another hangs below, and the lower of the two
  // passes between them is on the branch of that one alone.
  HeavyProblem problem;
  problem.grips.length = 700;
  problem.grips.end = {699.7714114411458, 0};
  problem.grips.startAngle = 0.035372242986425814;
  problem.grips.endAngle = -0.00946302918122307;
  problem.stiffness = 83333.33333333334;
  problem.weight = {-3.4443271388782772e-06, -0.0004069613996901439};
  const Result<HeavyAnswer> answer = solveAllHeavy(problem);
  ASSERT_TRUE(answer);
  EXPECT_NEAR(answer->solutions.front().barrier.value(), 0.66, 0.01) << "of a discrete rod";
}

TEST(HeavySearch, FindsWhatTheWeightMakesOfAFork) {
  // Grips between which the branches of the weightless blade fork: none can be followed as the weight comes
  // on. Close beside them all are the same.
  HeavyProblem problem;
  problem.grips.length = 600;
  problem.grips.startAngle = problem.grips.endAngle = 0.02;
  problem.stiffness = 83333;
  problem.weight = {0, -0.000407};
  const auto energies = [&](double chord) {
    problem.grips.end = {chord, 0};
    std::vector<double> all;
    const Result<HeavyAnswer> answer = solveAllHeavy(problem);
    EXPECT_TRUE(answer) << chord;
    if (answer)
      for (const HeavySolution& solution : answer->solutions) all.push_back(solution.energy);
    return all;
  };
  const std::vector<double> there = energies(599.94);
  for (const double beside : {599.9401, 599.9399}) {
    const std::vector<double> near = energies(beside);
    ASSERT_EQ(near.size(), there.size());
    for (std::size_t i = 0; i < near.size(); ++i) EXPECT_NEAR(near[i], there[i], 0.01);
  }
}

TEST(HeavySearch, WhatTurnsByFarMoreIsLeftOutWhereItMayBe) {
  std::mt19937 random(7);
  const auto within = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int fewer = 0;
  for (int i = 0; i < 30; ++i) {
    HeavyProblem problem = slackBlade(random, 1.2);
    problem.grips.end *= within(0.6, 1);
    const Result<HeavyAnswer> answer = solveHeavy(problem);
    if (!answer) continue;
    const HeavyBlade& own = answer->solutions[0].blade;
    const Result<HeavyRests> some = restsOf(problem, &own), all = restsOf(problem, nullptr);
    ASSERT_TRUE(some && all);
    fewer += some->stable.size() < all->stable.size();
    for (const HeavyBlade& blade : all->stable) {
      if (blade.energy() > own.energy() + own.clearGap()) continue;
      const auto same = [&](const HeavyBlade& other) {
        return (other.at(350).point - blade.at(350).point).norm() < 0.5;
      };
      EXPECT_TRUE(std::ranges::any_of(some->stable, same)) << i;
    }
  }
  EXPECT_GT(fewer, 10);
}

TEST(HeavySearch, BarriersAreThoseOfARodInSines) {
  // Shallow shapes beside their pass, and grips that are mirror images of each other, whose lowest passes are
  // not. Another route's numbers: Newton's method from anywhere on angles in sine modes. For the first and
  // the third case a chain of 400 segments was led over, too.
  struct Case {
    double length, chord, startAngle, endAngle;
    double lower, upper;  ///< N mm
  };
  const Case cases[] = {
      {814.8192108744767, 814.6091524278738, 0.0003292466890595855, -0.001506715477706382, 2.797, 0.126},
      {900, 899.55, 0.05, -0.05, 1.321, 0.905},
      {1000, 999.5, 0.05, -0.05, 1.591, 0.665},
      {900, 899.37, -0.02, 0.02, 7.668, 0.069},
  };
  for (const Case& told : cases) {
    HeavyProblem problem;
    problem.grips.length = told.length;
    problem.grips.end = {told.chord, 0};
    problem.grips.startAngle = told.startAngle;
    problem.grips.endAngle = told.endAngle;
    problem.stiffness = 83333;
    problem.weight = {0, -0.000407};
    const Result<HeavyAnswer> answer = solveAllHeavy(problem);
    ASSERT_TRUE(answer);
    std::vector<double> barriers;
    for (const HeavySolution& solution : answer->solutions)
      if (solution.stable) barriers.push_back(solution.barrier.value_or(kInfinite));
    ASSERT_EQ(barriers.size(), 2u) << told.length;
    EXPECT_NEAR(barriers[0], told.lower, 0.001) << told.length;
    EXPECT_NEAR(barriers[1], told.upper, 0.001) << told.length;
  }
}

TEST(HeavySearch, EnergiesAndWhatIsClearlyHigherAreThoseOfMirrorImages) {
  std::mt19937 random(5);
  const auto level = [](const Vector2d& point) { return Vector2d(-point.x(), point.y()); };
  for (int k = 0; k < 20; ++k) {
    const HeavyProblem problem = slackBlade(random, 0.2);
    HeavyProblem other = problem;
    other.grips.start = level(problem.grips.end);
    other.grips.end = level(problem.grips.start);
    other.grips.startAngle = -*problem.grips.endAngle;
    other.grips.endAngle = -*problem.grips.startAngle;
    const Result<HeavyAnswer> one = solveAllHeavy(problem), image = solveAllHeavy(other);
    ASSERT_TRUE(one && image) << k;
    ASSERT_EQ(one->solutions.size(), image->solutions.size()) << k;
    for (std::size_t i = 0; i < one->solutions.size(); ++i) {
      const HeavyBlade& blade = one->solutions[i].blade;
      EXPECT_NEAR(image->solutions[i].blade.clearGap(), blade.clearGap(), 1e-9 * blade.clearGap()) << k;
      // Simpson's rule: bending, and lifting from the chord.
      constexpr int kParts = 2000;
      const std::vector<Elastica::State> states = blade.sample(kParts + 1);
      double bend = 0, lift = 0;
      for (int j = 0; j <= kParts; ++j) {
        const double part = double(j) / kParts;
        const double step = blade.length() / kParts / 3 * (j == 0 || j == kParts ? 1 : 2 + 2 * (j % 2));
        const Vector2d chord = states.front().point + part * (states.back().point - states.front().point);
        bend += step * 0.5 * states[std::size_t(j)].curvature * states[std::size_t(j)].curvature;
        lift += step * blade.numbers().load.dot(states[std::size_t(j)].point - chord);
      }
      EXPECT_NEAR(blade.clearGap(), 0.05 * (bend + std::abs(lift)), 1e-5 * blade.clearGap()) << k;
      EXPECT_NEAR(blade.energy(), bend - lift, 2e-4 * blade.clearGap()) << k;
      EXPECT_NEAR(image->solutions[i].blade.energy(), blade.energy(), 1e-9 * blade.clearGap()) << k;
    }
  }
}

/// A tube of 800 mm whose grips are turned up, and so near to its length apart that they would pull it far
/// too taut if it had no weight. `scale`: of heights and slopes; with small ones energies go by its square.
HeavyProblem tautTube(double scale, double slack) {
  HeavyProblem problem;
  ClampedProblem& grips = problem.grips;
  grips.length = 800;
  grips.end = {grips.length * (1 - scale * scale * slack), 0};
  grips.startAngle = 2.78e-3 * scale;
  grips.endAngle = -2.78e-3 * scale;
  grips.turning = -5.56e-3 * scale;
  problem.stiffness = 411700;
  problem.weight = {0, -1.66e-4 * scale};
  return problem;
}

TEST(HeavySearch, FindsTheOtherShapeOfBladesThatAreTooTautWithoutTheirWeight) {
  constexpr double kSlack = 6.5e-7, kScale = 12;
  const HeavyProblem slacker = tautTube(1, 3e-6), small = tautTube(1, kSlack),
                     large = tautTube(kScale, kSlack);
  EXPECT_FALSE(solveAllClamped(small.grips, {}));
  const Result<HeavyAnswer> all = solveAllHeavy(large, {});
  ASSERT_TRUE(all) << all.error().message;
  std::vector<double> stable;
  for (const HeavySolution& solution : all->solutions)
    if (solution.stable) stable.push_back(large.stiffness * solution.blade.energy());
  std::ranges::sort(stable);
  ASSERT_EQ(stable.size(), 2u);
  const Result<HeavyAnswer> begun = solveHeavy(slacker, {});
  ASSERT_TRUE(begun) << begun.error().message;
  Result<HeavyBranch> branch = HeavyBranch::from(slacker, begun->solutions.front());
  ASSERT_TRUE(branch);
  const auto moved = branch->moveTo(small);
  ASSERT_TRUE(moved) << moved.error().message;
  const Result<HeavyRivals> rivals = rivalsOf(branch->blade(), small.stiffness);
  ASSERT_TRUE(rivals) << rivals.error().message;
  EXPECT_NEAR(kScale * kScale * rivals->energy, stable[0], 1e-3 * stable[0]);
  ASSERT_TRUE(rivals->next);
  EXPECT_NEAR(kScale * kScale * rivals->nextEnergy, stable[1], 1e-3 * stable[1]);
  ASSERT_TRUE(rivals->barrier);
  EXPECT_GT(*rivals->barrier, rivals->nextEnergy - rivals->energy);
}

}  // namespace
}  // namespace bw
