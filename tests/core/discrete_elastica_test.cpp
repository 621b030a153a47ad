// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/discrete/discrete_elastica.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "bw/core/base/units.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Ends = DiscreteOptions::Ends;

Elastica shape(double angle, double curvature, double along, double across) {
  return *Elastica::make({12, -7}, angle, curvature / 400, Vector2d(along, across) / (400. * 400.), 400);
}

/// Shapes of all kinds: inflections, none, nearly a circle, taut.
std::vector<Elastica> shapes() {
  return {shape(0.3, 1.5, 4, 2), shape(-1, 4, 10, -3), shape(2, 2.5, 0.01, 0.02), shape(0.5, -3, -12, 6),
          shape(0, 0.5, 25, 10)};
}

ClampedEnds endsOf(const Elastica& e) {
  const Elastica::State end = e.at(e.length());
  return {e.start(), end.point, e.startAngle(), end.angle, e.length()};
}

DiscreteElastica near(const Elastica& e, int segments, Ends held) {
  DiscreteOptions options;
  options.segments = segments;
  options.ends = held;
  options.shape = e;
  const Result<DiscreteElastica> chain = discreteElastica(endsOf(e), options);
  EXPECT_TRUE(chain) << chain.error().message;
  return chain ? *chain : DiscreteElastica{};
}

double distance(const DiscreteElastica& chain, const Elastica& e) {
  double worst = 0;
  const double n = double(chain.vertices.size() - 1);
  for (std::size_t i = 0; i < chain.vertices.size(); ++i)
    worst = std::max(worst, (chain.vertices[i] - e.point(double(i) / n * e.length())).norm());
  return worst;
}

void expectMeetsEnds(const DiscreteElastica& chain, const ClampedEnds& ends) {
  EXPECT_LT(chain.closure, 1e-10 * ends.length);
  EXPECT_LT((chain.vertices.front() - ends.start).norm(), 1e-12 * ends.length);
  EXPECT_LT((chain.vertices.back() - ends.end).norm(), 1e-10 * ends.length);
  const double turning = std::accumulate(chain.turningAngles.begin(), chain.turningAngles.end(), 0.0);
  EXPECT_NEAR(std::remainder(turning - (ends.endAngle - ends.startAngle), 2 * kPi), 0, 1e-11);
}

}  // namespace

TEST(DiscreteElastica, IsARegularPolygonOnACircle) {
  // Equal turning angles need no force: exact for any number of segments.
  for (const int n : {4, 5, 17, 400}) {
    const double turn = 1.9 / (n - 1), h = 250.0 / n;
    Vector2d end(3, 4);
    for (int i = 0; i < n; ++i) end += h * Vector2d(std::cos(0.4 + i * turn), std::sin(0.4 + i * turn));
    DiscreteOptions options;
    options.segments = n;
    const Result<DiscreteElastica> chain = discreteElastica({{3, 4}, end, 0.4, 2.3, 250}, options);
    ASSERT_TRUE(chain) << chain.error().message;
    ASSERT_EQ(chain->turningAngles.size(), std::size_t(n - 1));
    for (const double theta : chain->turningAngles) EXPECT_NEAR(theta, turn, 1e-9);
    EXPECT_NEAR(chain->squaredTurning, (n - 1) * turn * turn, 1e-10);
    EXPECT_NEAR(chain->energy, 0.5 * chain->squaredTurning / h, 1e-10);
    EXPECT_TRUE(chain->stable);
  }
}

TEST(DiscreteElastica, ConvergesToTheElasticaAtItsOrder) {
  for (const auto& [held, order] : {std::pair{Ends::tangent, 1.0}, std::pair{Ends::half, 2.0}})
    for (const Elastica& e : shapes()) {
      std::vector<double> errors, energies;
      for (const int n : {125, 250, 500, 1000}) {
        const DiscreteElastica chain = near(e, n, held);
        expectMeetsEnds(chain, endsOf(e));
        errors.push_back(distance(chain, e));
        energies.push_back(std::abs(chain.energy - e.energy()));
      }
      for (std::size_t i = 2; i < errors.size(); ++i) {
        EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), order, 0.1) << e.startAngle() << " " << errors[i];
        EXPECT_NEAR(std::log2(energies[i - 1] / energies[i]), order, 0.15) << e.startAngle();
      }
      EXPECT_LT(errors.back(), (held == Ends::half ? 1e-4 : 2e-2) * e.length());
    }
}

TEST(DiscreteElastica, BalancesBendingAndForceAtEverySegment) {
  for (const Elastica& e : shapes()) {
    const DiscreteElastica chain = near(e, 300, Ends::tangent);
    const double h = e.length() / 300;
    for (std::size_t i = 1; i + 1 < chain.angles.size(); ++i) {
      const double bend = (chain.turningAngles[i] - chain.turningAngles[i - 1]) / (h * h);
      const double a = chain.angles[i];
      EXPECT_NEAR(bend + chain.force.x() * std::sin(a) - chain.force.y() * std::cos(a), 0,
                  1e-6 / (h * e.length()));
    }
  }
}

TEST(DiscreteElastica, LeadsToTheElasticaItCameFrom) {
  for (const Ends held : {Ends::tangent, Ends::half})
    for (const Elastica& e : shapes()) {
      const DiscreteElastica chain = near(e, 200, held);
      const Result<AnalyticElastica> analytic = analyticElastica(chain);
      ASSERT_TRUE(analytic) << analytic.error().message;
      for (int i = 0; i <= 10; ++i)
        EXPECT_LT((analytic->elastica.point(40. * i) - e.point(40. * i)).norm(), 1e-8) << i;
      EXPECT_NEAR(analytic->deviation, distance(chain, e), 1e-6);
      EXPECT_EQ(analytic->elastica.length(), e.length());
    }
}

TEST(DiscreteElastica, BucklesToTheLeftFromTheStraightState) {
  // The example of the thesis, with which it cannot begin: all turning angles zero.
  DiscreteOptions options;
  options.segments = 61;
  options.turningAngles = std::vector<double>(60, 0.0);
  const Result<DiscreteElastica> chain = discreteElastica({{0, 0}, {1, 0}, 0, 0, 1.5}, options);
  ASSERT_TRUE(chain) << chain.error().message;
  EXPECT_TRUE(chain->stable);
  EXPECT_GT(chain->vertices[30].y(), 0.3);
  const Result<AnalyticElastica> analytic = analyticElastica(*chain);
  ASSERT_TRUE(analytic) << analytic.error().message;
  const double k = analytic->elastica.controlParameters()->k;
  const double K = boost::math::ellint_1(k), E = boost::math::ellint_2(k);
  EXPECT_NEAR((2 * E - K) / K, 1 / 1.5, 1e-10);
  for (const int n : {5, 10, 15, 30, 60, 2000}) {
    DiscreteOptions plain;
    plain.segments = n + 1 > 2000 ? 2000 : n + 1;
    EXPECT_TRUE(discreteElastica({{0, 0}, {1, 0}, 0, 0, 1.5}, plain)) << n;
  }
}

TEST(DiscreteElastica, FollowsTheSketchToItsBranch) {
  // One set of ends, three sketches: plain, with a whole turn more and one less.
  const ClampedEnds ends{{0, 0}, {300, 0}, 0.9, -0.9, 700};
  const auto sketch = [](std::vector<Vector2d> points) { return *PlanarCurve::points(std::move(points)); };
  std::vector<Vector2d> plain, left, right;
  for (int i = 0; i <= 60; ++i) {
    const double s = i / 60.0, x = 300 * s;
    plain.emplace_back(x, 200 * std::sin(kPi * s));
    left.emplace_back(x + 120 * std::sin(2 * kPi * s), 130 * (1 - std::cos(2 * kPi * s)) * (1 - 0.3 * s));
    right.emplace_back(x + 120 * std::sin(2 * kPi * s), -130 * (1 - std::cos(2 * kPi * s)));
  }
  std::vector<double> turnings;
  for (const std::vector<Vector2d>& points : {plain, left, right}) {
    DiscreteOptions options;
    options.sketch = sketch(points);
    const Result<DiscreteElastica> chain = discreteElastica(ends, options);
    ASSERT_TRUE(chain) << chain.error().message;
    expectMeetsEnds(*chain, ends);
    turnings.push_back(chain->ends.endAngle - chain->ends.startAngle);
    const Result<AnalyticElastica> analytic = analyticElastica(*chain);
    ASSERT_TRUE(analytic) << analytic.error().message;
    EXPECT_NEAR(analytic->elastica.at(700).angle - 0.9, turnings.back(), 1e-9);
  }
  EXPECT_NEAR(turnings[0], -1.8, 1e-12);
  EXPECT_NEAR(turnings[1], 2 * kPi - 1.8, 1e-12);
  EXPECT_NEAR(std::abs(turnings[2] + 1.8), 2 * kPi, 1e-12);
}

TEST(DiscreteElastica, TakesTheTurningThatIsAskedFor) {
  const ClampedEnds ends{{0, 0}, {300, 0}, 0.9, -0.9, 900};
  for (const double turns : {-1.0, 0.0, 1.0}) {
    DiscreteOptions options;
    options.turning = -1.8 + 2 * kPi * turns;
    const Result<DiscreteElastica> chain = discreteElastica(ends, options);
    ASSERT_TRUE(chain) << turns << chain.error().message;
    EXPECT_NEAR(std::accumulate(chain->turningAngles.begin(), chain->turningAngles.end(), 0.0),
                *options.turning, 1e-11);
  }
  DiscreteOptions options;
  options.turning = 1.0;
  EXPECT_EQ(discreteElastica(ends, options).error().code, ErrorCode::badInput);
}

TEST(DiscreteElastica, MovesTurnsScalesMirrorsAndReversesWithItsEnds) {
  const ClampedEnds ends{{10, 20}, {310, 90}, 1.1, -0.2, 420};
  const DiscreteElastica plain = *discreteElastica(ends);
  const double a = 2.2, c = 3.5;
  const Eigen::Rotation2Dd turn(a);
  const DiscreteElastica moved =
      *discreteElastica({c * (turn * ends.start) + Vector2d(5, 6), c * (turn * ends.end) + Vector2d(5, 6),
                         1.1 + a, -0.2 + a, 420 * c});
  const DiscreteElastica mirrored = *discreteElastica({{10, -20}, {310, -90}, -1.1, 0.2, 420});
  const DiscreteElastica reversed = *discreteElastica({{310, 90}, {10, 20}, -0.2 + kPi, 1.1 + kPi, 420});
  for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
    const Vector2d& p = plain.vertices[i];
    EXPECT_LT((moved.vertices[i] - (c * (turn * p) + Vector2d(5, 6))).norm(), 1e-7);
    EXPECT_LT((mirrored.vertices[i] - Vector2d(p.x(), -p.y())).norm(), 1e-7);
    EXPECT_LT((reversed.vertices[plain.vertices.size() - 1 - i] - p).norm(), 1e-7);
  }
  EXPECT_NEAR(moved.energy, plain.energy / c, 1e-10 * plain.energy);
  EXPECT_LT((moved.force - turn * plain.force / (c * c)).norm(), 1e-9 * plain.force.norm());
}

TEST(DiscreteElastica, FindsBladeLikeShapesWithoutAGuide) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> angle(-kPi / 4, kPi / 4), chord(0.85, 0.99);
  for (int i = 0; i < 200; ++i) {
    const ClampedEnds ends{{0, 0}, {800 * chord(engine), 0}, angle(engine), angle(engine), 800};
    const Result<DiscreteElastica> chain = discreteElastica(ends);
    ASSERT_TRUE(chain) << i << " " << chain.error().message;
    EXPECT_TRUE(chain->stable);
    expectMeetsEnds(*chain, ends);
    const Result<AnalyticElastica> analytic = analyticElastica(*chain);
    ASSERT_TRUE(analytic) << i << " " << analytic.error().message;
    EXPECT_LT(analytic->deviation, 0.02 * 800);
  }
}

TEST(DiscreteElastica, SaysWhatIsWrong) {
  const ClampedEnds good{{0, 0}, {300, 0}, 0.4, -0.4, 400};
  const auto code = [](const ClampedEnds& ends, const DiscreteOptions& options = {}) {
    const Result<DiscreteElastica> chain = discreteElastica(ends, options);
    return chain ? std::optional<ErrorCode>() : chain.error().code;
  };
  EXPECT_EQ(code(good), std::nullopt);
  ClampedEnds bad = good;
  bad.length = 299;
  EXPECT_EQ(code(bad), ErrorCode::noSolution);
  bad.length = 300;
  EXPECT_EQ(code(bad), ErrorCode::noSolution);
  bad.startAngle = bad.endAngle = 0;
  EXPECT_EQ(code(bad), std::nullopt);  // straight
  bad = good;
  bad.endAngle = std::nan("");
  EXPECT_EQ(code(bad), ErrorCode::badInput);
  DiscreteOptions options;
  options.segments = 3;
  EXPECT_EQ(code(good, options), ErrorCode::badInput);
  options.segments = 2001;
  EXPECT_EQ(code(good, options), ErrorCode::badInput);
  options.segments = 10;
  options.turningAngles = std::vector<double>(10, 0.1);
  EXPECT_EQ(code(good, options), ErrorCode::badInput);
  options.turningAngles = std::vector<double>(9, 0.1);
  EXPECT_EQ(code(good, options), std::nullopt);
  options.shape = shapes()[0];
  EXPECT_EQ(code(good, options), ErrorCode::badInput);
  // Steep tangents, long segments: the inner ones cannot reach.
  EXPECT_EQ(code({{0, 0}, {390, 0}, 1.5, -1.5, 400}, {4}), ErrorCode::noSolution);
}

}  // namespace bw
