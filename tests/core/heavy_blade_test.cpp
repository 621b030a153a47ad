// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Blades with weight, against integration of their equation, a chain of stiff segments, the weightless
// elastica and differences.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"

namespace bw {
namespace {

using Eigen::Vector2d;

constexpr double kLength = 800;
constexpr double kFlatStiffness = 83300;  // N mm²: flat NiCr 5 × 1 mm
constexpr double kFlatWeight = 4.1e-4;    // N/mm

/// Grips of a blade of 800 mm, 0.5 to 0.97 of it apart, whose tangents are up to `turned` off the chord.
ClampedProblem randomGrips(std::mt19937& random, double turned = 1) {
  const auto within = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  ClampedProblem grips;
  const double direction = within(-3, 3);
  grips.length = kLength;
  grips.start = {within(-500, 500), within(-500, 500)};
  grips.end = grips.start + kLength * within(0.5, 0.97) * Vector2d(std::cos(direction), std::sin(direction));
  grips.startAngle = direction + within(-turned, turned);
  grips.endAngle = direction + within(-turned, turned);
  return grips;
}

HeavyProblem heavyOf(const ClampedProblem& grips, double weight = kFlatWeight) {
  return {grips, kFlatStiffness, {0, -weight}};
}

/// EI κ' = n1 sin θ − n2 cos θ, n' = −w by Runge and Kutta's method of order 4 from the start of the blade:
/// the largest distance from it, over the length.
double strayFrom(const HeavyBlade& blade) {
  const HeavyBlade::Numbers& n = blade.numbers();
  using State = std::array<double, 4>;  // x, y, θ, κ
  const auto slope = [&](double s, const State& at) -> State {
    const Vector2d force = n.endForce + n.load * (n.length - s);
    return {std::cos(at[2]), std::sin(at[2]), at[3],
            force.x() * std::sin(at[2]) - force.y() * std::cos(at[2])};
  };
  const HeavyBlade::State first = blade.at(0);
  State at{first.point.x(), first.point.y(), first.angle, first.curvature};
  constexpr int kSteps = 4000;
  const double h = n.length / kSteps;
  double worst = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = h * i;
    const auto moved = [&](const State& by, double f) {
      State result = at;
      for (std::size_t k = 0; k < 4; ++k) result[k] += f * by[k];
      return result;
    };
    const State a = slope(s, at), b = slope(s + h / 2, moved(a, h / 2)),
                c = slope(s + h / 2, moved(b, h / 2)), d = slope(s + h, moved(c, h));
    for (std::size_t k = 0; k < 4; ++k) at[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
    if ((i + 1) % 40 == 0)
      worst = std::max(worst, (blade.at(s + h).point - Vector2d(at[0], at[1])).norm() / n.length);
  }
  return worst;
}

/// The smallest eigenvalue of the second variation of a chain of stiff segments that lies along the blade,
/// between held ends, over that of the straight one.
double chainMargin(const HeavyBlade& blade, int segments) {
  const HeavyBlade::Numbers& n = blade.numbers();
  const double h = 1.0 / segments;
  const int free = segments - 1;
  // The angles at the inner joints are free; energy Σ (θ_{i+1} − θ_i)²/(2h) − Σ h n·t(θ_i).
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(free, free), constraints(free, 2);
  for (int i = 0; i < free; ++i) {
    const double s = (i + 1) * h;
    const double angle = blade.at(s * n.length).angle;
    const Vector2d tangent(std::cos(angle), std::sin(angle));
    const Vector2d force = (n.endForce + n.load * (n.length * (1 - s))) * n.length * n.length;
    hessian(i, i) = 2 / h + h * force.dot(tangent);
    if (i > 0) hessian(i, i - 1) = hessian(i - 1, i) = -1 / h;
    constraints.row(i) << -tangent.y(), tangent.x();
  }
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(constraints).householderQ();
  const Eigen::MatrixXd kept = q.rightCols(free - 2);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(kept.transpose() * hessian * kept / h,
                                                              Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) / (4 * kPi * kPi);
}

/// In how many ways such a chain falls to less energy: the negative pivots of its second variation bordered
/// by what holds its ends, but for the two of these borders (Sylvester's law of inertia).
int chainFalls(const HeavyBlade& blade, int segments) {
  const HeavyBlade::Numbers& n = blade.numbers();
  const double h = 1.0 / segments;
  int negative = 0;
  double before = 0;
  Vector2d borderBefore = Vector2d::Zero();
  Eigen::Matrix2d corner = Eigen::Matrix2d::Zero();
  for (int i = 1; i < segments; ++i) {
    const double s = i * h, angle = blade.at(s * n.length).angle;
    const Vector2d tangent(std::cos(angle), std::sin(angle));
    const Vector2d force = (n.endForce + n.load * (n.length * (1 - s))) * n.length * n.length;
    double pivot = 2 / h + h * force.dot(tangent);
    Vector2d border(-tangent.y(), tangent.x());
    if (i > 1) {
      const double share = -1 / h / before;
      pivot += share / h;
      border -= share * borderBefore;
    }
    if (pivot < 0) ++negative;
    corner -= border * border.transpose() / pivot;
    before = pivot;
    borderBefore = border;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> ends(corner, Eigen::EigenvaluesOnly);
  return negative + int((ends.eigenvalues().array() < 0).count()) - 2;
}

TEST(HeavyBlade, IsTheElasticaWithoutWeight) {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    const ClampedProblem grips = randomGrips(random);
    const Result<HeavyAnswer> heavy = solveHeavy(heavyOf(grips, 0));
    const Result<ClampedAnswer> light = solveClamped(grips);
    ASSERT_TRUE(heavy && light) << i;
    const HeavySolution& a = heavy->solutions[0];
    const ClampedSolution& b = light->solutions[0];
    for (int k = 0; k <= 100; ++k) {
      const double s = kLength * k / 100;
      EXPECT_LT((a.blade.at(s).point - b.elastica.at(s).point).norm(), 1e-9 * kLength) << i;
      EXPECT_NEAR(a.blade.at(s).curvature, b.elastica.at(s).curvature, 1e-8 / kLength * 10) << i;
    }
    EXPECT_NEAR(a.energy, b.energy * kFlatStiffness, 1e-9 * a.energy);
    EXPECT_NEAR(a.stabilityMargin, b.stabilityMargin, 1e-5);
    EXPECT_NEAR(a.outOfPlaneMargin, b.outOfPlaneMargin, 1e-5);
    EXPECT_NEAR(a.sensitivity.perMm, b.sensitivity.perMm, 1e-5 * b.sensitivity.perMm);
    EXPECT_NEAR(a.sensitivity.perDegree, b.sensitivity.perDegree, 1e-5 * b.sensitivity.perDegree);
    EXPECT_EQ(a.blade.inflections().size(), b.inflections.size());
    EXPECT_NEAR(a.blade.maxCurvature(), b.elastica.maxCurvature(), 1e-2 * a.blade.maxCurvature());
    EXPECT_FALSE(a.snapsAt);
  }
}

TEST(HeavyBlade, ObeysItsEquationAndItsGrips) {
  std::mt19937 random(11);
  for (int i = 0; i < 100; ++i) {
    const ClampedProblem grips = randomGrips(random);
    const Result<HeavyAnswer> answer = solveHeavy(heavyOf(grips, kFlatWeight * (1 + i % 8)));
    ASSERT_TRUE(answer) << i << answer.error().message;
    const HeavyBlade& blade = answer->solutions[0].blade;
    EXPECT_LT(strayFrom(blade), 1e-8) << i;
    EXPECT_LT((blade.at(kLength).point - grips.end).norm(), 1e-8 * kLength) << i;
    EXPECT_NEAR(std::remainder(blade.at(kLength).angle - *grips.endAngle, 2 * kPi), 0, 1e-9) << i;
    EXPECT_EQ(answer->solutions[0].stable, answer->solutions[0].stabilityMargin > 0);
    EXPECT_TRUE(answer->solutions[0].stable) << i;
  }
}

TEST(HeavyBlade, IsAsStableAsAChainOfSegments) {
  std::mt19937 random(13);
  int stable = 0, unstable = 0;
  for (int i = 0; i < 8; ++i) {
    const Result<HeavyAnswer> all = solveAllHeavy(heavyOf(randomGrips(random), 2 * kFlatWeight));
    ASSERT_TRUE(all) << all.error().message;
    for (const HeavySolution& solution : all->solutions) {
      // Its error falls with the square of the segments' length.
      const double coarse = chainMargin(solution.blade, 100), fine = chainMargin(solution.blade, 200);
      const double chain = fine + (fine - coarse) / 3;
      EXPECT_NEAR(solution.stabilityMargin, chain, 1e-3 + 0.05 * std::abs(fine - coarse)) << i;
      (solution.stable ? stable : unstable)++;
    }
  }
  EXPECT_GT(stable, 8);
  EXPECT_GT(unstable, 8);
}

TEST(HeavyBlade, ThousandShapesAreAsStableAsAChainOfSegments) {
  constexpr int kShapes = 1000;
  constexpr double kTooNear = 2e-3;  // of the margin to 0, where the chain's own error decides
  std::mt19937 random(17);
  int stable = 0, unstable = 0, near = 0;
  for (int i = 0; stable + unstable < kShapes; ++i) {
    ASSERT_LT(i, kShapes);
    const Result<HeavyAnswer> all = solveAllHeavy(heavyOf(randomGrips(random), (i % 4) * kFlatWeight));
    ASSERT_TRUE(all) << i << all.error().message;
    for (const HeavySolution& solution : all->solutions) {
      if (std::abs(solution.stabilityMargin) < kTooNear) {
        ++near;
        continue;
      }
      EXPECT_EQ(solution.stable, chainFalls(solution.blade, 400) == 0)
          << i << ": margin " << solution.stabilityMargin;
      // By factorisations and the sign of a determinant instead of eigenvalues.
      EXPECT_EQ(HeavyBranch::from(solution.blade, 1).has_value(), solution.stable)
          << i << ": margin " << solution.stabilityMargin;
      (solution.stable ? stable : unstable)++;
    }
  }
  EXPECT_GT(stable, 200);
  EXPECT_GT(unstable, 200);
  EXPECT_LT(near, 10);
}

/// The panel of mathematics.md: an arch that the weight pushes through.
HeavyProblem arch(double weight) {
  ClampedProblem grips;
  grips.length = kLength;
  grips.start = {-390, 0};
  grips.end = {390, 0};
  grips.startAngle = 0.2;
  grips.endAngle = -0.2;
  return heavyOf(grips, weight);
}

TEST(HeavyBlade, SnapsWhereItsWeightPushesItThrough) {
  const Result<HeavyAnswer> light = solveHeavy(arch(0));
  const Result<HeavyAnswer> heavy = solveHeavy(arch(40 * kFlatWeight));
  ASSERT_TRUE(light && heavy) << heavy.error().message;
  EXPECT_GT(light->solutions[0].blade.at(kLength / 2).point.y(), 50) << "an arch to begin with";
  ASSERT_TRUE(heavy->solutions[0].snapsAt);
  const double share = *heavy->solutions[0].snapsAt;
  EXPECT_GT(share, 0.01);
  EXPECT_LT(share, 0.99);
  EXPECT_LT(heavy->solutions[0].blade.at(kLength / 2).point.y(), 0) << "it hangs";
  EXPECT_TRUE(heavy->solutions[0].stable);
  // By the other route: with a little less of the weight it holds, barely; with a little more it does not.
  const Result<HeavyAnswer> before = solveHeavy(arch(40 * kFlatWeight * share * (1 - 1e-4)));
  const Result<HeavyAnswer> after = solveHeavy(arch(40 * kFlatWeight * share * (1 + 1e-4)));
  ASSERT_TRUE(before && after);
  EXPECT_FALSE(before->solutions[0].snapsAt);
  EXPECT_GT(before->solutions[0].stabilityMargin, 0);
  EXPECT_LT(before->solutions[0].stabilityMargin, 0.05);
  EXPECT_TRUE(after->solutions[0].snapsAt);
  EXPECT_LT(after->solutions[0].energy, before->solutions[0].energy);
}

TEST(HeavyBlade, WithNextToNoSlackHangsAsABeamInTension) {
  // Flat arches, as of nearly flat panels, that hang through under pulls of up to 30 kN.
  for (const double length : {800.0, 2000.0, 3000.0})
    for (const double angle : {2e-5, 1e-4, 4e-4, 2e-3}) {
      ClampedProblem grips;
      grips.length = length;
      grips.end = {length * (1 - angle * angle / 6), 0};  // an arc
      grips.startAngle = angle;
      grips.endAngle = -angle;
      const Result<HeavyAnswer> answer = solveHeavy(heavyOf(grips));
      ASSERT_TRUE(answer) << length << " mm, " << angle << ": " << answer.error().message;
      const HeavySolution& hangs = answer->solutions[0];
      EXPECT_TRUE(hangs.stable);
      ASSERT_TRUE(hangs.snapsAt);
      EXPECT_LT(*hangs.snapsAt, 1);
      // EI v'''' − T v'' = −w with v = 0 and v' = ±angle at the ends.
      const double pull = hangs.blade.numbers().endForce.x(), load = kFlatWeight / kFlatStiffness;
      const double k = std::sqrt(pull), half = 0.5 * length;
      EXPECT_GT(k * length, 20) << "taut";
      // cosh k(x − half) / sinh k half, without its large numbers.
      const auto fades = [&](double x) {
        const double off = std::abs(x - half);
        return std::exp(k * (off - half)) * (1 + std::exp(-2 * k * off)) / (1 - std::exp(-2 * k * half));
      };
      const auto beam = [&](double x) {
        return -load / (2 * pull) * x * (length - x) -
               (angle + load * half / pull) / k * (fades(x) - fades(0));
      };
      const double sag = -beam(half);
      EXPECT_GT(sag, 0.5 * largestSag(length, grips.end.x()));
      for (int i = 0; i <= 20; ++i) {
        const Vector2d place = hangs.blade.at(length * i / 20).point;
        EXPECT_NEAR(place.y(), beam(place.x()), 1e-4 * sag) << length << " mm, " << angle << " at " << i;
      }
    }
}

TEST(HeavyBlade, IsNotLostForWantOfSlack) {
  // 1e-9 to 1 % of its length, grips turned by as much as that allows for and more.
  std::mt19937 random(5);
  const auto within = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int solved = 0;
  for (int i = 0; i < 120; ++i) {
    ClampedProblem grips;
    grips.length = within(500, 2500);
    const double slack = std::pow(10, within(-9, -2)), direction = within(-0.3, 0.3),
                 most = 1.2 * std::sqrt(2 * slack);
    grips.end = grips.length * (1 - slack) * Vector2d(std::cos(direction), std::sin(direction));
    grips.startAngle = direction + most * within(-1, 1);
    grips.endAngle = direction + most * within(-1, 1);
    if (!solveClamped(grips)) continue;  // not even without weight
    const Result<HeavyAnswer> answer = solveHeavy(heavyOf(grips));
    ASSERT_TRUE(answer) << grips.length << " mm, " << slack << ": " << answer.error().message;
    EXPECT_TRUE(answer->solutions[0].stable);
    EXPECT_LT(answer->solutions[0].endError, 1e-8 * grips.length);
    ++solved;
  }
  EXPECT_GT(solved, 60);
}

TEST(HeavyBlade, BucklesToTheSideWhereItsWeightPulls) {
  for (const double tilt : {0.0, 0.8, -2.5})
    for (const double side : {1.0, -1.0}) {
      HeavyProblem problem = arch(0);
      const Eigen::Matrix2d turn = Eigen::Rotation2Dd(tilt).toRotationMatrix();
      problem.grips.start = turn * problem.grips.start;
      problem.grips.end = turn * problem.grips.end;
      problem.grips.startAngle = problem.grips.endAngle = tilt;
      problem.weight = turn * Vector2d(0.3 * kFlatWeight, side * kFlatWeight);
      const Result<HeavyAnswer> answer = solveHeavy(problem);
      ASSERT_TRUE(answer) << answer.error().message;
      EXPECT_EQ(answer->kind, ClampedKind::buckling);
      EXPECT_TRUE(answer->message.empty()) << answer->message;
      const Vector2d middle = turn.transpose() * answer->solutions[0].blade.at(kLength / 2).point;
      EXPECT_GT(side * middle.y(), 50) << tilt;
      EXPECT_FALSE(answer->solutions[0].snapsAt);
      EXPECT_LT(strayFrom(answer->solutions[0].blade), 1e-8);
      const Result<HeavyAnswer> all = solveAllHeavy(problem);
      ASSERT_TRUE(all);
      EXPECT_NEAR(all->solutions[0].energy, answer->solutions[0].energy, 1e-6) << "the lowest there is";
    }
  const HeavyProblem along = [] {
    HeavyProblem problem = arch(0);
    problem.grips.startAngle = problem.grips.endAngle = 0;
    problem.weight = {kFlatWeight, 0};
    return problem;
  }();
  EXPECT_FALSE(solveHeavy(along)->message.empty()) << "both sides are as good";
}

TEST(HeavyBlade, IsHeldByABarrierThatItsWeightTakesAway) {
  ClampedOptions options;
  options.others = true;
  double last = 1e9;
  for (const double weight : {0.0, 2 * kFlatWeight, 4 * kFlatWeight}) {
    const Result<HeavyAnswer> answer = solveHeavy(arch(weight), options);
    ASSERT_TRUE(answer);
    ASSERT_TRUE(answer->solutions[0].barrier) << weight;
    EXPECT_GT(*answer->solutions[0].barrier, 0);
    EXPECT_LT(*answer->solutions[0].barrier, last);
    last = *answer->solutions[0].barrier;
    EXPECT_GT(answer->otherStable, 0);
  }
}

TEST(HeavyBranch, StaysOnItsBranchUntilItEnds) {
  HeavyProblem problem = arch(4 * kFlatWeight);
  const Result<HeavyAnswer> answer = solveHeavy(problem);
  ASSERT_TRUE(answer);
  Result<HeavyBranch> branch = HeavyBranch::from(problem, answer->solutions[0]);
  ASSERT_TRUE(branch);
  // A stride and many small steps lead to the same blade.
  Result<HeavyBranch> steps = branch;
  HeavyProblem next = problem;
  next.grips.start += Vector2d(15, 40);
  *next.grips.startAngle += 0.3;
  const Result<ClampedBranch::Move> moved = branch->moveTo(next);
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_FALSE(moved->snapped);
  for (int i = 1; i <= 30; ++i) {
    HeavyProblem between = problem;
    between.grips.start += Vector2d(15, 40) * (i / 30.0);
    *between.grips.startAngle += 0.3 * i / 30;
    const Result<ClampedBranch::Move> step = steps->moveTo(between);
    ASSERT_TRUE(step && !step->snapped) << i;
  }
  EXPECT_LT((branch->blade().at(400).point - steps->blade().at(400).point).norm(), 1e-6);
  EXPECT_LT(strayFrom(branch->blade()), 1e-8);
  EXPECT_LT((branch->blade().at(kLength).point - next.grips.end).norm(), 1e-6);
  // Both grips turn down: the arch ends on the way, and nothing is said of what lies beyond.
  HeavyProblem down = problem;
  down.grips.startAngle = -0.6;
  down.grips.endAngle = 0.6;
  Result<HeavyBranch> falling = HeavyBranch::from(problem, answer->solutions[0]);
  const Result<ClampedBranch::Move> end = falling->moveTo(down);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_TRUE(end->snapped);
  EXPECT_GT(end->reached, 0.05);
  EXPECT_LT(end->reached, 0.95);
  EXPECT_GT(falling->blade().at(400).point.y(), 0) << "still the arch";
  EXPECT_LT(strayFrom(falling->blade()), 1e-7);
}

TEST(HeavyBranch, StridesEndWhereManySmallStepsDo) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> way(-1, 1);
  int whole = 0, ended = 0;
  for (int i = 0; i < 40; ++i) {
    const HeavyProblem problem = heavyOf(randomGrips(random, 0.4), 2 * kFlatWeight);
    const Result<HeavyAnswer> answer = solveHeavy(problem);
    ASSERT_TRUE(answer) << answer.error().message;
    Result<HeavyBranch> stride = HeavyBranch::from(problem, answer->solutions[0]);
    if (!stride) continue;
    HeavyBranch walk = *stride;
    const Vector2d shift(0.15 * kLength * way(random), 0.15 * kLength * way(random));
    const double turn = way(random);
    const auto after = [&](double share) {
      HeavyProblem next = problem;
      next.grips.start += share * shift;
      *next.grips.startAngle += share * turn;
      return next;
    };
    if ((after(1).grips.end - after(1).grips.start).norm() > 0.97 * kLength) continue;
    const Result<ClampedBranch::Move> moved = stride->moveTo(after(1));
    ASSERT_TRUE(moved) << moved.error().message;
    double reached = 1;
    for (int step = 1; step <= 200 && reached == 1; ++step) {
      const Result<ClampedBranch::Move> small = walk.moveTo(after(step / 200.0));
      ASSERT_TRUE(small) << small.error().message;
      if (small->snapped) reached = (step - 1 + small->reached) / 200;
    }
    EXPECT_EQ(moved->snapped, reached < 1) << i << ": " << reached;
    if (moved->snapped) {
      EXPECT_NEAR(moved->reached, reached, 1e-4) << i;
      ++ended;
      continue;
    }
    for (const double share : {0.25, 0.5, 0.8})
      EXPECT_LT((stride->blade().at(share * kLength).point - walk.blade().at(share * kLength).point).norm(),
                1e-6 * kLength)
          << i;
    ++whole;
  }
  EXPECT_GT(whole, 15);
  EXPECT_GT(ended, 0);
}

TEST(HeavyBranch, PassesBesideAnotherThatComesNear) {
  // A flat blade over a gentle wave that its grips push together: where it may nearly go either way (margin
  // 0.0063 at 0.62 of the way, by collocation in 400 steps) a stride went over to the shape between both, and
  // the blade was said to snap.
  HeavyProblem problem;
  problem.grips.start = {-52.97372841477727, 141.32318467191766};
  problem.grips.end = {800.4997084154635, 152.78468864421762};
  problem.grips.startAngle = 0.14246311669213382;
  problem.grips.endAngle = 0.06310822113523153;
  problem.grips.length = 855;
  problem.stiffness = 83333.33333333334;
  problem.weight = {0, -0.0004069759750000001};
  const Result<HeavyAnswer> answer = solveHeavy(problem);
  ASSERT_TRUE(answer);
  Result<HeavyBranch> branch = HeavyBranch::from(problem, answer->solutions[0]);
  ASSERT_TRUE(branch);
  HeavyProblem next = problem;
  next.grips.start += 0.5 * (problem.grips.end - problem.grips.start).normalized();
  *next.grips.startAngle -= fromDegrees(0.2);
  const Result<ClampedBranch::Move> move = branch->moveTo(next);
  ASSERT_TRUE(move) << move.error().message;
  EXPECT_FALSE(move->snapped) << move->reached;
  EXPECT_NEAR(branch->blade().at(427.5).point.y(), 156.775, 0.02);
  EXPECT_LT(strayFrom(branch->blade()), 1e-7);
}

TEST(HeavyBranch, StaysWhereItIsWhenItsWorkIsSpent) {
  std::mt19937 random(29);
  const HeavyProblem problem = heavyOf(randomGrips(random, 0.4), 2 * kFlatWeight);
  const Result<HeavyAnswer> answer = solveHeavy(problem);
  ASSERT_TRUE(answer);
  Result<HeavyBranch> branch = HeavyBranch::from(problem, answer->solutions[0]);
  ASSERT_TRUE(branch);
  HeavyProblem next = problem;
  next.grips.start.x() += 0.02 * kLength;
  const Result<ClampedBranch::Move> stopped = branch->moveTo(next, 1);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::noSolution);
  EXPECT_LT((branch->blade().at(0).point - problem.grips.start).norm(), 1e-9);
  EXPECT_TRUE(branch->moveTo(next));
  EXPECT_LT((branch->blade().at(0).point - next.grips.start).norm(), 1e-9);
}

/// One of x, y and angle of the start, then of the end, moved.
HeavyProblem withGrip(HeavyProblem problem, int column, double by) {
  if (column == 2) *problem.grips.startAngle += by;
  if (column == 5) *problem.grips.endAngle += by;
  if (column < 2) problem.grips.start(column) += by;
  if (column > 2 && column < 5) problem.grips.end(column - 3) += by;
  return problem;
}

TEST(HeavyBlade, MarginChangesWithItsGripsAsDifferencesSay) {
  std::mt19937 random(23);
  for (int i = 0; i < 20; ++i) {
    const HeavyProblem problem = heavyOf(randomGrips(random, 0.6), 2 * kFlatWeight);
    const Result<HeavyAnswer> answer = solveHeavy(problem);
    ASSERT_TRUE(answer);
    const HeavySolution& rest = answer->solutions[0];
    const HeavyMarginSlope told = marginByGrips(rest.blade), across = outOfPlaneByGrips(rest.blade);
    EXPECT_NEAR(told.margin, rest.stabilityMargin, 1e-9);
    EXPECT_NEAR(across.margin, rest.outOfPlaneMargin, 1e-9);
    for (int column = 0; column < 6; ++column) {
      const double step = column % 3 == 2 ? 1e-6 : 1e-4;
      const auto at = [&](double by) { return solveHeavy(withGrip(problem, column, by))->solutions[0]; };
      const HeavySolution more = at(step), less = at(-step);
      const double scale = column % 3 == 2 ? kLength : 1;
      const auto same = [&](double a, double b, double slope) {
        EXPECT_NEAR((a - b) / (2 * step) / scale, slope / scale, 1e-6) << i << " " << column;
      };
      same(more.stabilityMargin, less.stabilityMargin, told.byGrips(column));
      same(more.outOfPlaneMargin, less.outOfPlaneMargin, across.byGrips(column));
    }
  }
}

TEST(HeavyBlade, MarginAsFarAsItIsBelowABoundIsTheMargin) {
  std::mt19937 random(31);
  int below = 0, above = 0;
  for (int i = 0; i < 60; ++i) {
    const Result<HeavyAnswer> answer =
        solveHeavy(heavyOf(randomGrips(random, i % 2 == 0 ? 0.1 : 0.6), kFlatWeight));
    ASSERT_TRUE(answer);
    const HeavySolution& rest = answer->solutions[0];
    for (const double share : {0.1, 0.5, 0.9, 0.99, 1.01, 1.2}) {
      const double bound = share * std::min(rest.stabilityMargin, rest.outOfPlaneMargin);
      EXPECT_NEAR(marginByGrips(rest.blade, bound).margin, std::min(bound, rest.stabilityMargin), 1e-9) << i;
      EXPECT_NEAR(outOfPlaneByGrips(rest.blade, bound).margin, std::min(bound, rest.outOfPlaneMargin), 1e-9)
          << i;
      ++(std::min(rest.stabilityMargin, rest.outOfPlaneMargin) < bound ? below : above);
    }
  }
  EXPECT_GT(below, 20);
  EXPECT_GT(above, 20);
}

TEST(HeavyBlade, APassIsFollowedAndItsHeightChangesAsDifferencesSay) {
  std::mt19937 random(29);
  int seen = 0, returned = 0;
  for (int i = 0; i < 30; ++i) {
    const HeavyProblem problem = heavyOf(randomGrips(random, 0.6), 2 * kFlatWeight);
    const HeavyBlade blade = solveHeavy(problem)->solutions[0].blade;
    const Result<HeavyRivals> rivals = rivalsOf(blade, problem.stiffness);
    ASSERT_TRUE(rivals);
    ASSERT_EQ(!rivals->passes.empty(), rivals->barrier.has_value());
    if (rivals->passes.empty()) continue;
    ++seen;
    const HeavyPassHeight told = heightOf(rivals->passes[0], blade, problem.stiffness);
    EXPECT_NEAR(told.energy, *rivals->barrier, 1e-6 * std::abs(rivals->energy));
    for (int column = 0; column < 6; ++column) {
      const double step = column % 3 == 2 ? 1e-4 : 1e-2;
      // Both move by Newton's method, and the pass does not become the blade at rest.
      const auto at = [&](double by) {
        const HeavyProblem there = withGrip(problem, column, by);
        Result<HeavyBranch> branch = HeavyBranch::from(blade, problem.stiffness);
        EXPECT_TRUE(branch->moveTo(there));
        const std::optional<HeavyBlade> pass = passAt(rivals->passes[0], there);
        EXPECT_TRUE(pass) << i;
        return pass ? heightOf(*pass, branch->blade(), problem.stiffness).energy : std::nan("");
      };
      const double scale = column % 3 == 2 ? kLength : 1;
      EXPECT_NEAR((at(step) - at(-step)) / (2 * step) / scale, told.byGrips(column) / scale, 1e-5)
          << i << " " << column;
    }
    EXPECT_FALSE(passAt(blade, problem)) << "a blade at rest is no pass";
    // Far away and back it is the same one, or lost; never another.
    const HeavyProblem far = withGrip(withGrip(problem, 3, 60), 5, 0.3);
    const std::optional<HeavyBlade> there = passAt(rivals->passes[0], far);
    const std::optional<HeavyBlade> back = there ? passAt(*there, problem) : std::nullopt;
    if (!back) continue;
    ++returned;
    EXPECT_NEAR(heightOf(*back, blade, problem.stiffness).energy, told.energy,
                1e-6 * std::abs(rivals->energy))
        << i;
  }
  EXPECT_GT(seen, 10);
  EXPECT_GT(returned, 5);
}

TEST(HeavyBlade, MovesWithItsGripsAsDifferencesSay) {
  std::mt19937 random(17);
  for (int i = 0; i < 10; ++i) {
    const HeavyProblem problem = heavyOf(randomGrips(random, 0.6), 2 * kFlatWeight);
    const Result<HeavyAnswer> answer = solveHeavy(problem);
    ASSERT_TRUE(answer);
    const std::vector<double> arcs{0.1 * kLength, 0.5 * kLength, 0.83 * kLength};
    const Result<HeavyDerivatives> moved = derivativesByGrips(answer->solutions[0].blade, arcs);
    ASSERT_TRUE(moved);
    for (int column = 0; column < 6; ++column) {
      const double step = column % 3 == 2 ? 1e-6 : 1e-4;
      const auto changed = [&](double by) {
        return solveHeavy(withGrip(problem, column, by))->solutions[0].blade;
      };
      const HeavyBlade more = changed(step), less = changed(-step);
      for (std::size_t k = 0; k < arcs.size(); ++k) {
        const HeavyBlade::State a = more.at(arcs[k]), b = less.at(arcs[k]);
        const Eigen::Vector3d difference =
            Eigen::Vector3d(a.point.x() - b.point.x(), a.point.y() - b.point.y(), a.angle - b.angle) /
            (2 * step);
        const Eigen::Vector3d told = moved->byGrips[k].col(column);
        const double scale = column % 3 == 2 ? kLength : 1;
        EXPECT_LT((difference - told).head<2>().norm(), 2e-5 * scale) << i << " " << column;
        EXPECT_NEAR(difference.z(), told.z(), 2e-5 * scale / kLength * 10) << i << " " << column;
      }
    }
  }
}

TEST(HeavyBlade, TurnsScalesAndMirrorsWithItsProblem) {
  std::mt19937 random(19);
  for (int i = 0; i < 20; ++i) {
    const HeavyProblem problem = heavyOf(randomGrips(random), 3 * kFlatWeight);
    const Result<HeavyAnswer> answer = solveHeavy(problem);
    ASSERT_TRUE(answer);
    const HeavySolution& here = answer->solutions[0];

    HeavyProblem turned = problem;
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    turned.grips.start = turn * problem.grips.start;
    turned.grips.end = turn * problem.grips.end;
    *turned.grips.startAngle += 0.7;
    *turned.grips.endAngle += 0.7;
    turned.weight = turn * problem.weight;

    HeavyProblem mirrored = problem;
    for (Vector2d* v : {&mirrored.grips.start, &mirrored.grips.end, &mirrored.weight}) v->y() *= -1;
    *mirrored.grips.startAngle *= -1;
    *mirrored.grips.endAngle *= -1;

    HeavyProblem scaled = problem;  // twice as large, an eighth of the weight
    for (Vector2d* v : {&scaled.grips.start, &scaled.grips.end}) *v *= 2;
    scaled.grips.length *= 2;
    scaled.weight /= 8;

    const auto there = [](const HeavyProblem& other) { return solveHeavy(other)->solutions[0]; };
    const HeavySolution a = there(turned), b = there(mirrored), c = there(scaled);
    for (int k = 0; k <= 10; ++k) {
      const double s = kLength * k / 10;
      const Vector2d p = here.blade.at(s).point;
      EXPECT_LT((a.blade.at(s).point - turn * p).norm(), 1e-8 * kLength);
      EXPECT_LT((b.blade.at(s).point - Vector2d(p.x(), -p.y())).norm(), 1e-8 * kLength);
      EXPECT_LT((c.blade.at(2 * s).point - 2 * p).norm(), 1e-8 * kLength);
    }
    EXPECT_NEAR(here.energy, a.energy, 1e-8 * std::abs(here.energy));
    EXPECT_NEAR(here.stabilityMargin, c.stabilityMargin, 1e-7);
  }
}

TEST(HeavyBlade, RefusesWhatIsNoProblem) {
  HeavyProblem problem = arch(kFlatWeight);
  problem.stiffness = 0;
  EXPECT_EQ(solveHeavy(problem).error().where, "stiffness");
  problem = arch(1e3);
  EXPECT_EQ(solveHeavy(problem).error().where, "weight");
  problem = arch(std::nan(""));
  EXPECT_EQ(solveAllHeavy(problem).error().where, "weight");
  problem = arch(kFlatWeight);
  problem.grips.endAngle.reset();
  EXPECT_EQ(solveHeavy(problem).error().where, "end_angle");
  problem = arch(kFlatWeight);
  problem.grips.length = 100;
  EXPECT_EQ(solveHeavy(problem).error().code, ErrorCode::noSolution);
}

TEST(HeavyBlade, AsLongAsItsGripsAreApartIsStraight) {
  HeavyProblem problem = arch(kFlatWeight);
  problem.grips.length = 780;
  problem.grips.startAngle = problem.grips.endAngle = 0;
  const Result<HeavyAnswer> answer = solveHeavy(problem);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->kind, ClampedKind::straight);
  EXPECT_NEAR(answer->solutions[0].blade.at(390).point.y(), 0, 1e-9);
  EXPECT_TRUE(answer->solutions[0].stable);
}

}  // namespace
}  // namespace bw
