// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/bounded_newton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/work_meter.h"

namespace {

using bw::optimise::BoundedMinimum;
using bw::optimise::boundedNewton;
using bw::optimise::Indefinite;
using bw::optimise::NewtonLimits;
using bw::optimise::SmoothFunction;
using bw::optimise::SmoothValue;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const VectorXd kFree = VectorXd::Constant(2, kInfinity);

SmoothValue rosenbrock(const VectorXd& v, bool) {
  const double x = v[0], y = v[1], off = y - x * x;
  SmoothValue result;
  result.value = 100 * off * off + (1 - x) * (1 - x);
  result.gradient = Vector2d(-400 * x * off - 2 * (1 - x), 200 * off);
  result.hessian.resize(2, 2);
  result.hessian << 1200 * x * x - 400 * y + 2, -400 * x, -400 * x, 200;
  return result;
}

// Minima of −1/4 at (±1, 0), a saddle at the origin.
SmoothValue twoValleys(const VectorXd& v, bool) {
  const double x = v[0], y = v[1];
  SmoothValue result;
  result.value = 0.25 * std::pow(x, 4) - 0.5 * x * x + 0.5 * y * y;
  result.gradient = Vector2d(x * x * x - x, y);
  result.hessian = Vector2d(3 * x * x - 1, 1).asDiagonal();
  return result;
}

TEST(BoundedNewton, FindsTheMinimumOfRosenbrocksValley) {
  for (const Indefinite way : {Indefinite::shift, Indefinite::reflect}) {
    const BoundedMinimum found = boundedNewton(rosenbrock, Vector2d(-1.2, 1), -kFree, kFree,
                                               {.gradient = 1e-10, .iterations = 100, .indefinite = way});
    EXPECT_TRUE(found.converged);
    EXPECT_LE(found.gradient, 1e-10);
    EXPECT_LT((found.at - Vector2d(1, 1)).norm(), 1e-9);
    EXPECT_EQ(found.active, 0);
    EXPECT_LT(found.iterations, 30);
  }
}

TEST(BoundedNewton, HoldsWhatPressesAgainstItsBound) {
  const BoundedMinimum found = boundedNewton(rosenbrock, Vector2d(-1.2, 1), Vector2d(-2, -2),
                                             Vector2d(0.5, 2), {.gradient = 1e-10, .iterations = 100});
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.at[0], 0.5);
  EXPECT_NEAR(found.at[1], 0.25, 1e-12);
  EXPECT_EQ(found.active, 1);
}

TEST(BoundedNewton, LeavesABoundThatTheGradientPullsAwayFrom) {
  const BoundedMinimum found = boundedNewton(rosenbrock, Vector2d(2, 2), Vector2d(-2, -2), Vector2d(2, 2),
                                             {.gradient = 1e-10, .iterations = 100});
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.at - Vector2d(1, 1)).norm(), 1e-9);
  EXPECT_EQ(found.active, 0);
}

TEST(BoundedNewton, DescendsFromAnIndefiniteHessian) {
  for (const Indefinite way : {Indefinite::shift, Indefinite::reflect})
    for (const double side : {1.0, -1.0}) {
      const BoundedMinimum found = boundedNewton(twoValleys, Vector2d(1e-3 * side, 1), -kFree, kFree,
                                                 {.gradient = 1e-10, .iterations = 100, .indefinite = way});
      EXPECT_TRUE(found.converged);
      EXPECT_LT((found.at.cwiseAbs() - Vector2d(1, 0)).norm(), 1e-9);
      if (way == Indefinite::reflect) {
        EXPECT_GT(side * found.at[0], 0) << "a reflected step stays on its side";
      }
    }
}

TEST(BoundedNewton, TakesNoLongerStepsThanAllowed) {
  Vector2d before(100, 0);
  const SmoothFunction bowl = [&](const VectorXd& v, bool derivatives) {
    if (derivatives) {
      EXPECT_LE((v - before).lpNorm<Eigen::Infinity>(), 1 + 1e-12);
      before = v;
    }
    return SmoothValue{0.5 * v.squaredNorm(), v, Eigen::Matrix2d::Identity()};
  };
  const BoundedMinimum found = boundedNewton(bowl, Vector2d(100, 0), -kFree, kFree,
                                             {.gradient = 1e-10, .iterations = 200, .longestStep = 1});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.iterations, 100, 1);
}

TEST(BoundedNewton, StepsShortOfPlacesWithoutAValue) {
  // x − log x: the whole step from 10 leads to −80.
  const SmoothFunction barrier = [](const VectorXd& v, bool) {
    const double x = v[0];
    return SmoothValue{x > 0 ? x - std::log(x) : kInfinity, VectorXd::Constant(1, 1 - 1 / x),
                       Eigen::MatrixXd::Constant(1, 1, 1 / (x * x))};
  };
  const VectorXd bound = VectorXd::Constant(1, kInfinity);
  const BoundedMinimum found =
      boundedNewton(barrier, VectorXd::Constant(1, 10), -bound, bound, {.gradient = 1e-10, .iterations = 50});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.at[0], 1, 1e-9);
}

TEST(BoundedNewton, HasNotConvergedWhereDerivativesAreNotFinite) {
  const SmoothFunction broken = [](const VectorXd& v, bool) {
    return SmoothValue{v.squaredNorm(), Vector2d::Constant(std::nan("")), Eigen::Matrix2d::Identity()};
  };
  const BoundedMinimum found =
      boundedNewton(broken, Vector2d(1, 2), -kFree, kFree, {.gradient = 1e-10, .iterations = 50});
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_EQ(found.at, Vector2d(1, 2));
}

TEST(BoundedNewton, EndsWithTheBestSoFarWhereTheWorkIsSpent) {
  const NewtonLimits limits{.gradient = 1e-10, .iterations = 100};
  const bw::WorkMeter meter(700);
  const BoundedMinimum found = boundedNewton(rosenbrock, Vector2d(-1.2, 1), -kFree, kFree, limits);
  EXPECT_TRUE(meter.stopped());
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.iterations, 3);
  EXPECT_LT(rosenbrock(found.at, false).value, rosenbrock(Vector2d(-1.2, 1), false).value);
}

}  // namespace
