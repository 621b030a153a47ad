// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/curve/planar_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bw/core/base/units.h"
#include "test_curves.h"

namespace bw {
namespace {

using Eigen::Vector2d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// The nearest point by brute force: a fine scan, then a golden-section search around the best sample.
double bruteDistance(const PlanarCurve& c, const Vector2d& p) {
  const int count = 4000;
  const double h = (c.end() - c.start()) / count;
  double best = std::numeric_limits<double>::infinity();
  double at = c.start();
  for (int i = 0; i <= count; ++i) {
    const double t = c.start() + i * h;
    const double d = (c.value(t) - p).norm();
    if (d < best) {
      best = d;
      at = t;
    }
  }
  double a = std::max(c.start(), at - h);
  double b = std::min(c.end(), at + h);
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (int i = 0; i < 60; ++i) {
    const double x = b - golden * (b - a);
    const double y = a + golden * (b - a);
    ((c.value(x) - p).norm() < (c.value(y) - p).norm() ? b : a) =
        (c.value(x) - p).norm() < (c.value(y) - p).norm() ? y : x;
  }
  return std::min(best, (c.value(0.5 * (a + b)) - p).norm());
}

TEST(PlanarCurve, RationalQuarterCircleIsACircle) {
  const double r = 250;
  const PlanarCurve c =
      PlanarCurve::bspline(2, {0, 0, 0, 1, 1, 1}, {{r, 0}, {r, r}, {0, r}}, {1, std::sqrt(0.5), 1}).value();
  EXPECT_NEAR(c.length(), r * kPi / 2, 1e-10 * r);
  for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    EXPECT_NEAR(c.value(t).norm(), r, 1e-12 * r);
    EXPECT_NEAR(c.curvature(t), 1 / r, 1e-12);
  }
  for (const double s : {0.1, 0.3, 0.9}) {
    const Vector2d p = c.value(c.parameterAt(s * c.length()));
    EXPECT_NEAR(std::atan2(p.y(), p.x()), s * kPi / 2, 1e-12);
  }
}

TEST(PlanarCurve, LengthOfAParabolaIsTheClosedForm) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {0.5, 0}, {1, 1}}).value();  // y = x²
  const double exact = 0.25 * (2 * std::sqrt(5.0) + std::asinh(2.0));
  EXPECT_NEAR(c.length(), exact, 1e-12);
}

TEST(PlanarCurve, DerivativesMatchCentralDifferences) {
  for (const auto& [name, c] : test::fitCurves()) {
    if (c.kind() == PlanarCurve::Kind::points) continue;
    SCOPED_TRACE(name);
    const double width = c.end() - c.start();
    for (const double x : {0.131, 0.377, 0.618, 0.913}) {
      const double t = c.start() + x * width;
      const double h = 1e-5 * width;
      const Vector2d first = (c.value(t + h) - c.value(t - h)) / (2 * h);
      const Vector2d second = (c.derivatives(t + h).first - c.derivatives(t - h).first) / (2 * h);
      const PlanarCurve::Derivatives d = c.derivatives(t);
      EXPECT_LT((d.value - c.value(t)).norm(), 1e-13 * (c.length() + d.value.norm()));
      EXPECT_LT((d.first - first).norm(), 1e-6 * c.length() / width);
      EXPECT_LT((d.second - second).norm(), 1e-4 * c.length() / (width * width));
    }
  }
}

TEST(PlanarCurve, ArcLengthIsTheIntegralOfTheSpeedAndParameterAtItsInverse) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    // An independent rule: the length of a fine polygon, improved twice by Richardson's extrapolation.
    // Corners and spans with uneven knots make it less exact there.
    if (c.kind() == PlanarCurve::Kind::bezier) {
      double polygon[3];
      for (int level = 0; level < 3; ++level) {
        const int count = 2000 << level;
        polygon[level] = 0;
        for (int i = 0; i < count; ++i) {
          polygon[level] += (c.value((i + 1.0) / count) - c.value(static_cast<double>(i) / count)).norm();
        }
      }
      const double a = (4 * polygon[1] - polygon[0]) / 3;
      const double b = (4 * polygon[2] - polygon[1]) / 3;
      EXPECT_NEAR(c.length(), (16 * b - a) / 15, 1e-9 * c.length());
    }
    double before = -1;
    for (int i = 0; i <= 50; ++i) {
      const double s = c.length() * i / 50;
      const double t = c.parameterAt(s);
      EXPECT_NEAR(c.arcLength(t), s, 1e-11 * c.length());
      EXPECT_GE(t, before);
      before = t;
    }
    EXPECT_EQ(c.arcLength(c.start()), 0);
    EXPECT_EQ(c.arcLength(c.end()), c.length());
  }
}

TEST(PlanarCurve, QuadratureIntegratesAlongTheArcLength) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    const PlanarCurve::Quadrature& q = c.quadrature();
    double sum = 0;
    Vector2d first = Vector2d::Zero();
    for (std::size_t i = 0; i < q.arc.size(); ++i) {
      sum += q.weight[i];
      first += q.weight[i] * (q.point[i] - c.value(c.start()));
      EXPECT_LT((c.value(q.parameter[i]) - q.point[i]).norm(), 1e-11 * (c.length() + q.point[i].norm()));
      EXPECT_NEAR(c.arcLength(q.parameter[i]), q.arc[i], 1e-11 * c.length());
      EXPECT_NEAR(q.tangent[i].norm(), 1, 1e-12);
      EXPECT_GT(q.arc[i], i > 0 ? q.arc[i - 1] : 0.0);
    }
    EXPECT_NEAR(sum, c.length(), 1e-13 * c.length());
    // ∫ r ds by the midpoint rule over 20000 pieces of equal arc length.
    Vector2d reference = Vector2d::Zero();
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      reference += (c.value(c.parameterAt(c.length() * (i + 0.5) / count)) - c.value(c.start())) *
                   (c.length() / count);
    }
    EXPECT_LT((first - reference).norm(), 3e-8 * c.length() * c.length());
  }
}

TEST(PlanarCurve, ALongSideAmongManyShortOnesHasItsOwnNodes) {
  constexpr int kShort = 30000;
  for (const bool atEnd : {true, false}) {
    // 10 mm in short sides of two lengths, and one side of 1000 mm.
    std::vector<Vector2d> points;
    for (int i = 0; i <= kShort; ++i) points.emplace_back(10.0 * (i + 0.3 * (i % 2)) / kShort, 0);
    points.emplace_back(1010, 0);
    if (!atEnd)
      for (Vector2d& p : points) p.x() = 1010 - p.x();
    const PlanarCurve c = PlanarCurve::points(points).value();
    const PlanarCurve::Quadrature& q = c.quadrature();
    double length = 0, second = 0, largest = 0;
    for (std::size_t i = 0; i < q.arc.size(); ++i) {
      length += q.weight[i];
      second += q.weight[i] * q.point[i].x() * q.point[i].x();
      largest = std::max(largest, q.weight[i]);
    }
    EXPECT_NEAR(length, 1010, 1e-9);
    EXPECT_NEAR(second, std::pow(1010, 3) / 3, 1e-8 * std::pow(1010, 3));
    EXPECT_LT(largest, 0.2 * 1010);
    EXPECT_LT(q.arc.size(), 1000u);
  }
}

TEST(PlanarCurve, SmoothBezierNeedsFewNodes) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {200, 150}, {420, 110}, {600, 0}}).value();
  EXPECT_GE(c.quadrature().arc.size(), 20U);
  EXPECT_LE(c.quadrature().arc.size(), 32U);
}

TEST(PlanarCurve, UnclampedUniformQuadraticPassesTheMidpointsOfItsPolygon) {
  const std::vector<Vector2d> poles = {{0, 0}, {1, 2}, {3, 1}, {4, 4}};
  const PlanarCurve c = PlanarCurve::bspline(2, {0, 1, 2, 3, 4, 5, 6}, poles).value();
  EXPECT_EQ(c.start(), 2);
  EXPECT_EQ(c.end(), 4);
  EXPECT_LT((c.value(2) - Vector2d(0.5, 1)).norm(), 1e-15);
  EXPECT_LT((c.value(3) - Vector2d(2, 1.5)).norm(), 1e-15);
  EXPECT_LT((c.value(4) - Vector2d(3.5, 2.5)).norm(), 1e-15);
  EXPECT_LT((c.derivatives(3).first - Vector2d(2, -1)).norm(), 1e-14);
}

TEST(PlanarCurve, SubCurveIsTheSameCurve) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    const double width = c.end() - c.start();
    for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.0, 0.4}, {0.21, 0.83}, {0.5, 1.0}, {0.6, 0.61}}) {
      const double t0 = c.start() + a * width;
      const double t1 = c.start() + b * width;
      const PlanarCurve part = c.subCurve(t0, t1).value();
      EXPECT_NEAR(part.length(), c.arcLength(t1) - c.arcLength(t0), 1e-10 * c.length());
      for (int i = 0; i <= 10; ++i) {
        const double x = i / 10.0;
        const Vector2d p = part.value(part.start() + x * (part.end() - part.start()));
        EXPECT_LT((p - c.value(t0 + x * (t1 - t0))).norm(), 1e-11 * (c.length() + p.norm()));
      }
      if (c.kind() == PlanarCurve::Kind::bspline) {
        EXPECT_NEAR(part.start(), t0, 0);
        EXPECT_NEAR(part.end(), t1, 0);
      }
    }
  }
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {1, 0}}).value();
  EXPECT_FALSE(c.subCurve(0.5, 0.5).has_value());
  EXPECT_FALSE(c.subCurve(0.7, 0.2).has_value());
  EXPECT_FALSE(c.subCurve(kNan, 1).has_value());
}

TEST(PlanarCurve, ReversalAndMotionMapPointByPoint) {
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    const PlanarCurve back = c.reversed();
    const PlanarCurve moved = c.transformed(0.7, 2.5, {-30, 12});
    Eigen::Matrix2d rotation;
    rotation << std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7);
    EXPECT_NEAR(back.length(), c.length(), 1e-11 * c.length());
    EXPECT_NEAR(moved.length(), 2.5 * c.length(), 1e-10 * c.length());
    for (int i = 0; i <= 8; ++i) {
      const double s = c.length() * i / 8;
      const Vector2d p = c.value(c.parameterAt(s));
      const double size = c.length() + p.norm();
      EXPECT_LT((back.value(back.parameterAt(c.length() - s)) - p).norm(), 1e-10 * size);
      EXPECT_LT((moved.value(moved.parameterAt(2.5 * s)) - (2.5 * (rotation * p) + Vector2d(-30, 12))).norm(),
                1e-9 * size);
    }
  }
}

TEST(PlanarCurve, NearestParameterIsGlobal) {
  std::mt19937 engine(7);
  for (const auto& [name, c] : test::fitCurves()) {
    SCOPED_TRACE(name);
    Vector2d low = c.poles().front();
    Vector2d high = low;
    for (const Vector2d& p : c.poles()) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vector2d middle = 0.5 * (low + high);
    for (int i = 0; i < 12; ++i) {
      std::uniform_real_distribution<double> unit(-1, 1);
      const double reach = i < 8 ? 0.7 : 5;
      const Vector2d p = middle + reach * c.length() * Vector2d(unit(engine), unit(engine));
      const double t = c.nearestParameter(p);
      EXPECT_LE((c.value(t) - p).norm(), bruteDistance(c, p) + 1e-9 * c.length());
      // The local search, seeded near the answer, finds the same point; corners have local answers of their
      // own.
      const bool corners = c.kind() == PlanarCurve::Kind::points || name == "with a kink";
      const double near = c.nearestParameter(p, c.parameterAt(c.arcLength(t) + 1e-3 * c.length()));
      EXPECT_NEAR((c.value(near) - p).norm(), (c.value(t) - p).norm(), (corners ? 1e-3 : 1e-9) * c.length());
    }
    // A point of the curve finds itself.
    const double t = c.parameterAt(0.371 * c.length());
    EXPECT_LT((c.value(c.nearestParameter(c.value(t))) - c.value(t)).norm(), 1e-9 * c.length());
  }
}

TEST(PlanarCurve, EveryPointOfACircleIsNearestToItsCentre) {
  const PlanarCurve c =
      PlanarCurve::bspline(2, {0, 0, 0, 1, 1, 1}, {{5, 0}, {5, 5}, {0, 5}}, {1, std::sqrt(0.5), 1}).value();
  EXPECT_NEAR((c.value(c.nearestParameter({0, 0}))).norm(), 5, 1e-12);
}

TEST(PlanarCurve, VanishingDerivativeAtAnEndHasTheLimitTangent) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {0, 0}, {3, 4}, {3, 4}}).value();
  EXPECT_LT((c.tangent(0) - Vector2d(0.6, 0.8)).norm(), 1e-15);
  EXPECT_LT((c.tangent(1) - Vector2d(0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(c.curvature(0), 0);
  EXPECT_NEAR(c.length(), 5, 1e-10);
  EXPECT_NEAR(c.value(c.parameterAt(2.5)).norm(), 2.5, 1e-10);
}

TEST(PlanarCurve, InnerCuspKeepsItsLength) {
  // x = u², y = u³ with u = 2 t − 1: length 2 (13^{3/2} − 8) / 27, cusp at t = ½.
  const PlanarCurve c = PlanarCurve::bezier({{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}).value();
  EXPECT_NEAR(c.length(), 2 * (std::pow(13.0, 1.5) - 8) / 27, 1e-10);
  EXPECT_LT((c.tangent(0.5) - Vector2d(1, 0)).norm(), 1e-5);
  EXPECT_TRUE(std::isfinite(c.curvature(0.5)));
}

TEST(PlanarCurve, ChainRunsByItsOwnArcLength) {
  const PlanarCurve c = PlanarCurve::points({{0, 0}, {0, 0}, {3, 0}, {3, 4}, {3, 4}}).value();
  EXPECT_EQ(c.poles().size(), 3U);
  EXPECT_EQ(c.length(), 7);
  EXPECT_LT((c.value(5) - Vector2d(3, 2)).norm(), 1e-15);
  EXPECT_LT((c.tangent(1) - Vector2d(1, 0)).norm(), 1e-15);
  EXPECT_NEAR(c.curvature(3), (kPi / 2) / 3.5, 1e-14);
  EXPECT_NEAR(c.nearestParameter({4, 3}), 6, 1e-14);
  EXPECT_NEAR(c.nearestParameter({4, 3}, 0.1), 6, 1e-14);
}

TEST(PlanarCurve, ChainOfACircleHasItsCurvature) {
  std::vector<Vector2d> points;
  for (int i = 0; i <= 100; ++i) points.push_back(40 * Vector2d(std::cos(0.02 * i), -std::sin(0.02 * i)));
  const PlanarCurve c = PlanarCurve::points(points).value();
  for (const double t : {0.0, 0.3, 0.5, 1.0}) EXPECT_NEAR(c.curvature(t * c.length()), -1.0 / 40, 1e-5);
}

TEST(PlanarCurve, SampleIsEvenInArcLength) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {0.02, 0.01}, {0.05, 0.03}, {3, 1.4}}).value();
  const std::vector<Vector2d> points = c.sample(2001);
  ASSERT_EQ(points.size(), 2001U);
  EXPECT_LT((points.front() - c.value(0)).norm(), 1e-15);
  EXPECT_LT((points.back() - c.value(1)).norm(), 1e-15);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_NEAR((points[i] - points[i - 1]).norm(), c.length() / 2000, 1e-5 * c.length());
  }
}

TEST(PlanarCurve, ParametersOutsideTheDomainAreClamped) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {1, 1}, {2, 0}}).value();
  EXPECT_EQ(c.value(-3), c.value(0));
  EXPECT_EQ(c.value(7), c.value(1));
  EXPECT_EQ(c.value(kNan), c.value(0));
  EXPECT_EQ(c.parameterAt(-1), 0);
  EXPECT_EQ(c.parameterAt(1e9), 1);
}

TEST(PlanarCurve, BadInputNamesThePlaceAndTheNumber) {
  const auto message = [](const Result<PlanarCurve>& r) {
    return r.has_value() ? std::string("none") : r.error().message;
  };
  EXPECT_FALSE(PlanarCurve::bezier({}).has_value());
  EXPECT_FALSE(PlanarCurve::bezier({{0, 0}}).has_value());
  EXPECT_FALSE(PlanarCurve::bezier({{2, 3}, {2, 3}, {2, 3}}).has_value());
  EXPECT_NE(message(PlanarCurve::bezier({{0, 0}, {1, kNan}})).find("pole 1"), std::string::npos);
  EXPECT_FALSE(PlanarCurve::bezier(std::vector<Vector2d>(200, Vector2d(1, 2))).has_value());
  EXPECT_FALSE(PlanarCurve::bezier({{0, 0}, {1e308, 1e308}, {-1e308, 1e308}}).has_value());
  EXPECT_NE(message(PlanarCurve::bspline(2, {0, 0, 0, 1, 1}, {{0, 0}, {1, 0}, {2, 1}})).find("6 knots"),
            std::string::npos);
  EXPECT_NE(message(PlanarCurve::bspline(1, {0, 0, 2, 1, 3}, {{0, 0}, {1, 0}, {2, 1}})).find("Knot 3"),
            std::string::npos);
  EXPECT_NE(
      message(PlanarCurve::bspline(1, {0, 0, 1, 1, 2, 2}, {{0, 0}, {1, 0}, {2, 1}, {3, 1}})).find("repeated"),
      std::string::npos);
  EXPECT_FALSE(PlanarCurve::bspline(1, {0, 0, 0, 0}, {{0, 0}, {1, 0}}).has_value());
  EXPECT_NE(message(PlanarCurve::bspline(1, {0, 0, 1, 1}, {{0, 0}, {1, 0}}, {1, -2})).find("Weight 1"),
            std::string::npos);
  EXPECT_FALSE(PlanarCurve::bspline(1, {0, 0, 1, 1}, {{0, 0}, {1, 0}}, {1}).has_value());
  EXPECT_FALSE(PlanarCurve::bspline(0, {0, 1}, {{0, 0}}).has_value());
  EXPECT_FALSE(PlanarCurve::points({{1, 1}, {1, 1}}).has_value());
  EXPECT_NE(message(PlanarCurve::points({{1, 1}, {2, kNan}})).find("point 1"), std::string::npos);
}

TEST(PlanarCurve, KnotsThatAreNeitherOneNorTwoAreRefused) {
  const std::vector<Vector2d> poles{{0, 0}, {1, 1}, {2, 0}, {3, 1}};
  for (const double knot : {1e-300, 1e-150, 1e-13, 1 - 1e-13})
    EXPECT_FALSE(PlanarCurve::bspline(2, {0, 0, 0, knot, 1, 1, 1}, poles)) << knot;
  for (const double knot : {1e-11, 1e-6, 1 - 1e-6})
    EXPECT_TRUE(PlanarCurve::bspline(2, {0, 0, 0, knot, 1, 1, 1}, poles)) << knot;
  // The same in another unit.
  EXPECT_TRUE(PlanarCurve::bspline(2, {0, 0, 0, 1e-26, 1e-20, 1e-20, 1e-20}, poles));
  EXPECT_FALSE(PlanarCurve::bspline(2, {5, 5, 5, 5 + 1e-13, 5 + 1e-12, 5 + 1e-12, 5 + 1e-12}, poles));
}

TEST(PlanarCurve, RationalCurvesFarFromTheOriginEndAndKeepTheirLength) {
  const double half = std::sqrt(0.5);
  for (const double away : {0.0, 1e6, 1e9}) {
    const auto quarter = PlanarCurve::bspline(
        2, {0, 0, 0, 1, 1, 1}, {{away + 1, away}, {away + 1, away + 1}, {away, away + 1}}, {1, half, 1});
    ASSERT_TRUE(quarter);
    EXPECT_NEAR(quarter->length(), kPi / 2, 1e-10 + 1e-15 * away);
  }
}

TEST(PlanarCurve, CurvatureIsPositiveCounterClockwise) {
  const PlanarCurve c = PlanarCurve::bezier({{0, 0}, {1, 0}, {1, 1}}).value();
  EXPECT_GT(c.curvature(0.5), 0);
  const PlanarCurve::Derivatives d = c.derivatives(0.3);
  EXPECT_NEAR(c.curvature(0.3), cross(d.first, d.second) / std::pow(d.first.norm(), 3), 1e-14);
}

}  // namespace
}  // namespace bw
