// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// What rests between hinges, by routes of their own: a rod of straight segments, and the blades held at every
// angle that a hinge may take.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

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

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// A rod of length 1 of straight segments with springs between them, and half as long ones to the tangents
/// that are held; nothing at a hinge.
struct Rod {
  VectorXd angles;
  Vector2d force;
  std::optional<double> startAngle, endAngle;

  Index count() const { return angles.size(); }
  double energy() const {
    const double n = double(count());
    double sum = 0.5 * n * (angles.tail(count() - 1) - angles.head(count() - 1)).squaredNorm();
    if (startAngle) sum += n * std::pow(angles(0) - *startAngle, 2);
    if (endAngle) sum += n * std::pow(angles(count() - 1) - *endAngle, 2);
    return sum;
  }
  Vector2d end() const { return Vector2d(angles.array().cos().sum(), angles.array().sin().sum()) / count(); }
  /// The derivatives of the end.
  MatrixXd slopes() const {
    MatrixXd result(2, count());
    result.row(0) = -angles.array().sin() / double(count());
    result.row(1) = angles.array().cos() / double(count());
    return result;
  }
  VectorXd gradient() const {
    const double n = double(count());
    VectorXd result = VectorXd::Zero(count());
    for (Index i = 1; i < count(); ++i) {
      const double bend = n * (angles(i) - angles(i - 1));
      result(i) += bend;
      result(i - 1) -= bend;
    }
    if (startAngle) result(0) += 2 * n * (angles(0) - *startAngle);
    if (endAngle) result(count() - 1) += 2 * n * (angles(count() - 1) - *endAngle);
    return result + slopes().transpose() * force;
  }
  MatrixXd hessian() const {
    const double n = double(count());
    MatrixXd result = MatrixXd::Zero(count(), count());
    for (Index i = 1; i < count(); ++i) {
      result(i, i) += n;
      result(i - 1, i - 1) += n;
      result(i, i - 1) = result(i - 1, i) = -n;
    }
    if (startAngle) result(0, 0) += 2 * n;
    if (endAngle) result(count() - 1, count() - 1) += 2 * n;
    for (Index i = 0; i < count(); ++i)
      result(i, i) -= (force.x() * std::cos(angles(i)) + force.y() * std::sin(angles(i))) / n;
    return result;
  }
  /// Newton's method to the equilibrium nearby; how far the last step went.
  double settle(const Vector2d& target) {
    double last = INFINITY;
    for (int i = 0; i < 12; ++i) {
      MatrixXd system = MatrixXd::Zero(count() + 2, count() + 2);
      system.topLeftCorner(count(), count()) = hessian();
      system.bottomLeftCorner(2, count()) = slopes();
      system.topRightCorner(count(), 2) = slopes().transpose();
      VectorXd right(count() + 2);
      right << -gradient(), target - end();
      const VectorXd step = system.partialPivLu().solve(right);
      angles += step.head(count());
      force += step.tail<2>();
      last = step.head(count()).cwiseAbs().maxCoeff();
    }
    return last;
  }
  /// The smallest eigenvalue of the second derivatives where the end stays.
  double smallest() const {
    const MatrixXd q = slopes().transpose().householderQr().householderQ();
    const MatrixXd free = q.rightCols(count() - 2);
    const MatrixXd projected = free.transpose() * hessian() * free;
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(projected, Eigen::EigenvaluesOnly).eigenvalues()(0) *
           double(count());
  }
};

/// The rod that resembles a blade, its ends held or hinged as the problem has them.
Rod rodOf(const Elastica& blade, const ClampedProblem& problem, Index count) {
  Rod rod;
  rod.angles.resize(count);
  for (Index i = 0; i < count; ++i)
    rod.angles(i) = blade.at(blade.length() * (double(i) + 0.5) / double(count)).angle;
  rod.force = blade.force() * blade.length() * blade.length();
  if (problem.startAngle) rod.startAngle = blade.startAngle();
  if (problem.endAngle) rod.endAngle = blade.at(blade.length()).angle;
  return rod;
}

double straightEigenvalue(const ClampedProblem& problem) {
  const int held = int(problem.startAngle.has_value()) + int(problem.endAngle.has_value());
  return held == 2 ? 4 * kPi * kPi : held == 1 ? std::pow(4.493409457909064, 2) : kPi * kPi;
}

/// The least of `energy` over an angle: everywhere, then nearer and nearer to the best.
double leastOverAngle(const auto& energy, double from, double to, int steps) {
  double best = INFINITY, at = from;
  for (int i = 0; i < steps; ++i) {
    const double angle = from + (to - from) * (i + 0.5) / steps;
    if (const double value = energy(angle); value < best) best = value, at = angle;
  }
  double low = at - (to - from) / steps, high = at + (to - from) / steps;
  for (int i = 0; i < 22; ++i) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    const double atA = energy(a), atB = energy(b);
    best = std::min({best, atA, atB});
    (atA < atB ? high : low) = atA < atB ? b : a;
  }
  return best;
}

double restEnergy(const ClampedProblem& problem) {
  const Result<ClampedAnswer> answer = solveClamped(problem);
  return answer ? answer->solutions[0].energy : INFINITY;
}

}  // namespace

TEST(HingedBlade, ARodOfSegmentsIsAsStable) {
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> angle(-kPi, kPi), share(0.1, 0.97);
  constexpr Index kSegments = 160;
  int compared = 0, stable = 0;
  for (int i = 0; i < 12; ++i) {
    ClampedProblem problem = across(share(engine), angle(engine), kHinged);
    if (i % 3 == 1) std::swap(problem.startAngle, problem.endAngle);
    if (i % 3 == 2) problem.startAngle = kHinged;
    ClampedOptions options;
    options.maxInflections = 2;
    const Result<ClampedAnswer> all = solveAllClamped(problem, options);
    ASSERT_TRUE(all);
    for (const ClampedSolution& solution : all->solutions) {
      const double root = std::sqrt(solution.elastica.force().norm()) * kBlade;
      if (root > 12) continue;
      SCOPED_TRACE(std::to_string(i) + " energy " + std::to_string(solution.energy * kBlade));
      Rod rod = rodOf(solution.elastica, problem, kSegments);
      ASSERT_LT(rod.settle((problem.end - problem.start) / kBlade), 1e-9);
      // Both errors are of second order in the segments' length.
      const double error = std::pow(root / kSegments, 2);
      EXPECT_NEAR(rod.energy(), solution.energy * kBlade, 2 * error * rod.energy());
      const double margin = rod.smallest() / straightEigenvalue(problem);
      EXPECT_NEAR(margin, solution.stabilityMargin, error * (1 + root * root / 10));
      if (std::abs(margin) > 0.02) {
        EXPECT_EQ(solution.stable, margin > 0);
      }
      ++compared;
      stable += solution.stable ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(stable, 12);
}

TEST(HingedBlade, OnlyTheFirstHalfWaveRestsBetweenHinges) {
  for (const double share : {1e-4, 0.1, 0.5, 0.8, 0.9, 0.95, 0.97, 0.98, 0.999}) {
    const Result<ClampedAnswer> all = solveAllClamped(across(share, kHinged, kHinged));
    ASSERT_TRUE(all);
    EXPECT_EQ(all->others.stable, 1);
    for (std::size_t j = 0; j < all->solutions.size(); ++j) {
      const ClampedSolution& solution = all->solutions[j];
      EXPECT_EQ(solution.stable, j < 2) << share << " " << j << " " << solution.stabilityMargin;
      EXPECT_FALSE(solution.stable && solution.sliding);
      // Loops along a taut blade.
      if (std::abs(std::cos(solution.elastica.startAngle())) > 1 - 1e-8 && j >= 2) {
        EXPECT_TRUE(solution.sliding) << share << " " << j;
      }
    }
    EXPECT_NEAR(all->solutions[0].elastica.startAngle(), -all->solutions[1].elastica.startAngle(), 1e-12);
  }
  // The straight limit: φ = cos 2πs is the next one, 4π² − π² over π².
  const Result<ClampedAnswer> flat = solveClamped(across(1 - 1e-7, kHinged, kHinged));
  ASSERT_TRUE(flat);
  EXPECT_NEAR(flat->solutions[0].stabilityMargin, 3, 1e-5);
}

TEST(HingedBlade, ALoopBetweenAGripAndAHingeIsNeverStable) {
  int loops = 0;
  for (const double share : {0.8, 0.9, 0.95, 0.97}) {
    for (const double a : {0.0, 0.5, -1.2, 2.5}) {
      const Result<ClampedAnswer> all = solveAllClamped(across(share, a, kHinged));
      ASSERT_TRUE(all);
      for (const ClampedSolution& s : all->solutions) {
        EXPECT_FALSE(s.stable && s.sliding);
        const double root = std::sqrt(s.elastica.force().norm()) * kBlade;
        // A bend at the grip has the energy 2 √f (1 − cos ½α) < 4 √f, a loop 4 √f more.
        if (root > 20 && s.energy * kBlade > 4.01 * root) {
          EXPECT_FALSE(s.stable) << share << " " << a << " " << s.energy * kBlade;
          ++loops;
        }
      }
    }
  }
  EXPECT_GT(loops, 20);
}

TEST(HingedBlade, NearlyAWholeTurnAtTheGripRests) {
  // Strongest away from the grip, but held by it: f (1 − cos² ½α) is about the least eigenvalue.
  for (const auto& [share, a] : {std::pair{0.98, 0.15}, {0.966, 0.05}, {0.97, 0.1}, {0.93, 0.3}}) {
    const Result<ClampedAnswer> all = solveAllClamped(across(share, a, kHinged));
    ASSERT_TRUE(all);
    int found = 0;
    for (const ClampedSolution& s : all->solutions) {
      if (s.turning < kPi || !s.inflections.empty()) continue;
      ++found;
      const double root = std::sqrt(s.elastica.force().norm()) * kBlade;
      const double least =
          root * root * std::pow(std::sin(s.turning / 2), 2) / straightEigenvalue(across(share, a, kHinged));
      EXPECT_TRUE(s.stable) << share << " " << s.stabilityMargin;
      EXPECT_NEAR(s.stabilityMargin, least, 0.3 * least) << share;
    }
    EXPECT_EQ(found, 1) << share;
  }
}

TEST(HingedBlade, RestsInTheLowestOfAllBladesHeldAtAnyAngle) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> angle(-kPi, kPi), share(0.05, 0.99);
  for (int i = 0; i < 25; ++i) {
    ClampedProblem problem = across(share(engine), angle(engine), kHinged);
    const double hinged = restEnergy(problem);
    const double least = leastOverAngle(
        [&](double free) {
          ClampedProblem held = problem;
          held.endAngle = free;
          const double energy = restEnergy(held);
          EXPECT_GE(energy, hinged * (1 - 1e-9)) << i << " " << free;
          return energy;
        },
        -kPi, kPi, 90);
    EXPECT_NEAR(hinged, least, 1e-6 * least) << i << " " << problem.end.x() << " " << *problem.startAngle;
  }
  for (const double distance : {0.15, 0.6, 0.93}) {
    const double hinged = restEnergy(across(distance, kHinged, kHinged));
    const double least =
        leastOverAngle([&](double free) { return restEnergy(across(distance, free, kHinged)); }, 0, kPi, 12);
    EXPECT_NEAR(hinged, least, 1e-6 * least) << distance;
  }
}

TEST(HingedBlade, FindsWhatRandomShootingFinds) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> angle(-kPi, kPi), share(0.1, 0.95), unit(-1, 1);
  int shots = 0;
  for (int i = 0; i < 12; ++i) {
    const ClampedProblem problem = across(share(engine), angle(engine), kHinged);
    ClampedOptions options;
    options.maxInflections = 8;
    const Result<ClampedAnswer> all = solveAllClamped(problem, options);
    ASSERT_TRUE(all);
    for (int j = 0; j < 60; ++j) {
      // Newton's method on curvature and force at the start, by differences.
      const double root = 7 + 6 * unit(engine), direction = kPi * unit(engine);
      Eigen::Vector3d q(2 * root * unit(engine), root * root * std::cos(direction),
                        root * root * std::sin(direction));
      const auto blade = [&](const Eigen::Vector3d& x) {
        return Elastica::make({0, 0}, *problem.startAngle, x(0), x.tail<2>(), 1);
      };
      for (int k = 0; k < 30 && q.norm() < 2000; ++k) {
        Elastica::Jacobian jacobian;
        const Elastica::State end = blade(q)->at(1, jacobian);
        const Eigen::Vector3d miss(problem.end.x() / kBlade - end.point.x(), -end.point.y(), -end.curvature);
        if (miss.norm() < 1e-10) {
          const Elastica found = blade(q)->transformed(0, kBlade, {0, 0});
          if (std::abs(end.angle - *problem.startAngle) > 9.5 || found.inflections().size() > 7) break;
          ++shots;
          EXPECT_TRUE(std::any_of(all->solutions.begin(), all->solutions.end(),
                                  [&](const ClampedSolution& s) {
                                    return (s.elastica.point(300) - found.point(300)).norm() < 1e-4 &&
                                           (s.elastica.point(500) - found.point(500)).norm() < 1e-4;
                                  }))
              << i << " " << found.energy() * kBlade;
          break;
        }
        Eigen::Matrix3d slope;
        slope << jacobian.block<2, 3>(0, 3), jacobian.block<1, 3>(3, 3);
        Eigen::Vector3d step = slope.partialPivLu().solve(miss);
        const double size =
            std::max(std::abs(step(0)) / 3, step.tail<2>().norm() / (10 + q.tail<2>().norm() / 3));
        if (size > 1) step /= size;
        if (!step.allFinite()) break;
        q += step;
      }
    }
  }
  EXPECT_GT(shots, 200);
}

}  // namespace bw
