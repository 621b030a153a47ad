// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/active_set_step.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using bw::optimise::activeSetStep;
using bw::optimise::ActiveSetStep;
using bw::optimise::Constraints;
using bw::optimise::LeastSquaresModel;
using bw::optimise::stationarityOf;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Bounds of a box around the point 0: −low ≤ d ≤ high.
Constraints box(const VectorXd& low, const VectorXd& high) {
  Constraints out;
  out.clear(low.size());
  for (Index i = 0; i < low.size(); ++i) {
    out.add(-high[i], static_cast<int>(2 * i))[i] = 1;
    out.add(-low[i], static_cast<int>(2 * i + 1))[i] = -1;
  }
  return out;
}

double valueOf(const MatrixXd& hessian, const VectorXd& gradient, const VectorXd& d) {
  return gradient.dot(d) + 0.5 * d.dot(hessian * d);
}

// The least value over all sets of active bounds whose step breaks no bound.
double leastValue(const MatrixXd& hessian, const VectorXd& gradient, const Constraints& constraints) {
  const Index n = gradient.size();
  double least = std::numeric_limits<double>::infinity();
  for (unsigned set = 0; set < 1U << (constraints.size() - constraints.equalities); ++set) {
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      if (i < constraints.equalities || (set >> (i - constraints.equalities) & 1U) != 0) active.push_back(i);
    }
    const auto m = static_cast<Index>(active.size());
    if (m > n) continue;
    MatrixXd kkt = MatrixXd::Zero(n + m, n + m);
    VectorXd right = VectorXd::Zero(n + m);
    kkt.topLeftCorner(n, n) = hessian;
    right.head(n) = -gradient;
    for (Index k = 0; k < m; ++k) {
      const std::size_t i = active[static_cast<std::size_t>(k)];
      kkt.col(n + k).head(n) = constraints.gradient(i);
      kkt.row(n + k).head(n) = constraints.gradient(i).transpose();
      right[n + k] = -constraints.values[i];
    }
    const VectorXd d = kkt.fullPivHouseholderQr().solve(right).head(n);
    bool feasible = true;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      feasible = feasible && constraints.values[i] + constraints.gradient(i).dot(d) <= 1e-9;
    if (feasible) least = std::min(least, valueOf(hessian, gradient, d));
  }
  return least;
}

TEST(ActiveSetStep, IsNewtonsStepWithoutConstraints) {
  const MatrixXd hessian = Vector2d(2, 4).asDiagonal();
  Constraints none;
  none.clear(2);
  const auto step = activeSetStep(hessian, Vector2d(2, -4), none, {});
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->d.isApprox(Vector2d(-1, 1)));
}

TEST(ActiveSetStep, StopsAtTheWallsOfABox) {
  const auto step = activeSetStep(MatrixXd::Identity(3, 3), Eigen::Vector3d(-5, 0.5, 7),
                                  box(Eigen::Vector3d(1, 1, 2), Eigen::Vector3d(3, 1, 1)), {});
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->d.isApprox(Eigen::Vector3d(3, -0.5, -2)));
  EXPECT_EQ(step->active, (std::vector<char>{1, 0, 0, 0, 0, 1}));
  // The multipliers are what the gradient of the function keeps there.
  EXPECT_NEAR(step->multipliers[0], 2, 1e-14);
  EXPECT_NEAR(step->multipliers[5], 5, 1e-14);
}

TEST(ActiveSetStep, LetsGoOfBoundsThatAreWronglyGuessedActive) {
  const Constraints walls = box(Vector2d(1, 1), Vector2d(1, 1));
  const auto step = activeSetStep(MatrixXd::Identity(2, 2), Vector2d(0.5, -3), walls, {1, 0, 0, 1});
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->d.isApprox(Vector2d(-0.5, 1)));
}

TEST(ActiveSetStep, AgreesWithAllActiveSetsOfRandomProblems) {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  const auto number = [&] { return normal(engine); };
  for (int n = 0; n < 300; ++n) {
    const Index unknowns = 2 + n % 3;
    const MatrixXd root = MatrixXd::NullaryExpr(unknowns, unknowns, number);
    const MatrixXd hessian = root * root.transpose() + 0.1 * MatrixXd::Identity(unknowns, unknowns);
    const VectorXd gradient = 3 * VectorXd::NullaryExpr(unknowns, number);
    Constraints constraints;
    constraints.clear(unknowns);
    // As many constraints as unknowns can hold together, whichever are active.
    for (int i = 0; i < unknowns; ++i) {
      if (i == n % 2) constraints.equalities = constraints.size();
      constraints.add(number() - 0.5, i) = VectorXd::NullaryExpr(unknowns, number);
    }
    const auto step = activeSetStep(hessian, gradient, constraints, {});
    ASSERT_TRUE(step) << n;
    const double least = leastValue(hessian, gradient, constraints);
    EXPECT_NEAR(valueOf(hessian, gradient, step->d), least, 1e-7 * (1 + std::abs(least))) << n;
  }
}

TEST(ActiveSetStep, TakesAHessianThatIsConvexOnTheConstraintsAlone) {
  const MatrixXd saddle = Vector2d(1, -1).asDiagonal();
  Constraints held;
  held.clear(2);
  held.add(-1, 0)[1] = 1;
  held.equalities = 1;
  const auto step = activeSetStep(saddle, Vector2d(2, 0), held, {});
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->d.isApprox(Vector2d(-2, 1)));
  held.equalities = 0;
  EXPECT_FALSE(activeSetStep(-MatrixXd::Identity(2, 2), Vector2d(2, 0), held, {}));
}

TEST(ActiveSetStep, TakesARepeatedConstraint) {
  Constraints twice;
  twice.clear(2);
  for (const int name : {0, 1}) twice.add(-1, name)[0] = 1;
  twice.equalities = 2;
  const auto step = activeSetStep(MatrixXd::Identity(2, 2), Vector2d(0, 1), twice, {});
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->d.isApprox(Vector2d(1, -1)));
}

TEST(Stationarity, CountsOnlyActiveConstraintsWhoseMultipliersHaveTheRightSign) {
  LeastSquaresModel model{2, Vector2d(3, -4), MatrixXd::Identity(2, 2)};
  Constraints bounds;
  bounds.clear(2);
  EXPECT_NEAR(stationarityOf(model, bounds, 1e-7).gradient, 10, 1e-13);
  EXPECT_NEAR(stationarityOf(model, bounds, 1e-7).movement, 5, 1e-13);
  bounds.add(0, 0)[1] = 1;  // keeps the second unknown from growing
  EXPECT_NEAR(stationarityOf(model, bounds, 1e-7).gradient, 6, 1e-13);
  bounds.add(0, 1)[0] = 1;  // the first one falls anyway
  EXPECT_NEAR(stationarityOf(model, bounds, 1e-7).gradient, 6, 1e-13);
  bounds.add(0, 2)[0] = -1;
  EXPECT_EQ(stationarityOf(model, bounds, 1e-7).gradient, 0);
  bounds.values[2] = -1e-3;
  EXPECT_NEAR(stationarityOf(model, bounds, 1e-7).gradient, 6, 1e-13);
}

TEST(LeastNormSolution, IsTheShortestOfManyAndTheNearestToNone) {
  const MatrixXd row = Eigen::RowVector2d(3, 4);
  EXPECT_TRUE(bw::optimise::leastNormSolution(row, VectorXd::Constant(1, 25)).isApprox(Vector2d(3, 4)));
  const MatrixXd twice = Vector2d(1, 1);
  EXPECT_NEAR(bw::optimise::leastNormSolution(twice, Vector2d(1, 2))[0], 1.5, 1e-14);
}

}  // namespace
