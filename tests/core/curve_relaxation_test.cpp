// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/relax/curve_relaxation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bw/core/base/units.h"
#include "test_curves.h"

namespace bw {
namespace {

using Eigen::Vector2d;

PlanarCurve arch() { return *PlanarCurve::bezier({{0, 0}, {200, 150}, {400, 150}, {600, 0}}); }

RelaxResult relaxed(const PlanarCurve& curve, const RelaxOptions& options) {
  const Result<RelaxResult> result = relaxCurve(curve, options);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : RelaxResult(curve);
}

/// A chain of points on an elastica, and what is needed to find it again.
Elastica shape() { return *Elastica::make({10, 20}, 0.9, -0.004, Vector2d(3e-5, 4e-6), 500); }

double distance(const PlanarCurve& a, const PlanarCurve& b) {
  double worst = 0;
  for (const Vector2d& p : a.sample(60)) worst = std::max(worst, (b.value(b.nearestParameter(p)) - p).norm());
  return worst;
}

}  // namespace

TEST(CurveRelaxation, FindsTheElasticaOfItsEndsAndLength) {
  // Clamped ends and the length leave one elastica; the tube is wide enough not to matter. The target is bent
  // away from it.
  const Elastica e = shape();
  std::vector<Vector2d> points = e.sample(2001);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double s = double(i) / 2000, bump = std::pow(std::sin(kPi * s), 2) * std::sin(2 * kPi * s);
    points[i] += 3 * bump * Vector2d(1, 1).normalized();
  }
  for (const int degree : {3, 5}) {
    std::vector<double> errors, residuals;
    for (const int spans : {8, 16, 32}) {
      RelaxOptions options;
      options.tolerance = 40;
      options.degree = degree;
      options.spans = spans;
      options.length = e.length();
      const RelaxResult result = relaxed(*PlanarCurve::points(points), options);
      EXPECT_EQ(result.status, RelaxStatus::converged) << result.message;
      EXPECT_NEAR(result.curve.length(), 500, 1e-5);
      double worst = 0;
      for (const Vector2d& p : e.sample(101))
        worst = std::max(worst, (result.curve.value(result.curve.nearestParameter(p)) - p).norm());
      errors.push_back(worst);
      residuals.push_back(result.residual);
      EXPECT_NEAR(result.energy, e.energy(), 1e-2 * e.energy());
    }
    // The check (11) sees the spline come nearer to the elastica.
    EXPECT_LT(residuals[1], 0.5 * residuals[0]);
    EXPECT_LT(residuals[2], 0.5 * residuals[1]);
    EXPECT_LT(residuals[2], 0.01);
    EXPECT_LT(errors[2], 0.05);
  }
}

TEST(CurveRelaxation, LowersTheEnergyWithinTheTube) {
  const PlanarCurve curve = arch();
  double before = 1e300;
  for (const double epsilon : {0.5, 2.0, 8.0}) {
    RelaxOptions options;
    options.tolerance = epsilon;
    const RelaxResult result = relaxed(curve, options);
    EXPECT_NE(result.status, RelaxStatus::iterationLimit) << result.message;
    EXPECT_EQ(result.targetError, 0);
    EXPECT_LT(result.energy, result.targetEnergy);
    EXPECT_LT(result.energy, before);
    before = result.energy;
    EXPECT_LE(result.deviation, epsilon * std::sqrt(2.0) + 1e-9);
    EXPECT_EQ(result.status == RelaxStatus::boundActive, result.activeBounds > 0);
  }
}

TEST(CurveRelaxation, TheEnergyOfTheTargetIsItsOwn) {
  RelaxOptions options;
  options.degree = 5;
  options.spans = 40;
  const PlanarCurve curve = arch();
  double energy = 0;
  const PlanarCurve::Quadrature& q = curve.quadrature();
  for (std::size_t i = 0; i < q.weight.size(); ++i)
    energy += 0.5 * q.weight[i] * q.curvature[i] * q.curvature[i];
  EXPECT_NEAR(relaxed(curve, options).targetEnergy, energy, 1e-9 * energy);
}

TEST(CurveRelaxation, KeepsEndsAndTangentsAsAsked) {
  const PlanarCurve curve = arch();
  for (const bool endpoints : {false, true})
    for (const bool tangents : {false, true}) {
      RelaxOptions options;
      options.tolerance = 5;
      options.endpoints = endpoints;
      options.tangents = tangents;
      const RelaxResult result = relaxed(curve, options);
      EXPECT_NE(result.status, RelaxStatus::iterationLimit) << result.message;
      const PlanarCurve& r = result.curve;
      const double moved =
          (r.value(r.start()) - Vector2d(0, 0)).norm() + (r.value(r.end()) - Vector2d(600, 0)).norm();
      const Vector2d t0 = r.tangent(r.start()), t1 = r.tangent(r.end());
      const double turned =
          std::abs(t0.x() * 150 - t0.y() * 200) / 250 + std::abs(t1.x() * 150 + t1.y() * 200) / 250;
      EXPECT_EQ(moved < 1e-9, endpoints);
      EXPECT_EQ(turned < 1e-9, tangents);
      EXPECT_LE(result.deviation, 5 * std::sqrt(2.0) + 1e-9);
    }
}

TEST(CurveRelaxation, LeavesALineAndACircleAlone) {
  const RelaxResult line = relaxed(*PlanarCurve::bezier({{0, 0}, {100, 50}, {300, 150}}), {});
  EXPECT_NEAR(line.energy, 0, 1e-15);
  EXPECT_TRUE(line.isElastica);
  // A circle is the least energy of its length among curves with its ends and tangents.
  const Elastica circle = *Elastica::make({0, 0}, 0, 0.004, Vector2d::Zero(), 400);
  RelaxOptions options;
  options.tolerance = 1;
  options.length = 400;
  const RelaxResult result = relaxed(*PlanarCurve::points(circle.sample(4001)), options);
  EXPECT_EQ(result.status, RelaxStatus::converged) << result.message;
  EXPECT_TRUE(result.isElastica);
  EXPECT_NEAR(result.energy, circle.energy(), 1e-5 * circle.energy());
  ASSERT_TRUE(result.elastica);
  EXPECT_LT((result.elastica->point(200) - circle.point(200)).norm(), 1e-2);
}

TEST(CurveRelaxation, SaysThatACurveHeldByTheTubeIsNoElastica) {
  // An S with a kink-like bend, held within a narrow tube.
  const PlanarCurve curve =
      *PlanarCurve::bspline(3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4},
                            {{0, 0}, {80, 0}, {160, 120}, {200, -60}, {320, 90}, {400, 0}, {480, 10}});
  RelaxOptions options;
  options.tolerance = 0.5;
  const RelaxResult result = relaxed(curve, options);
  EXPECT_EQ(result.status, RelaxStatus::boundActive);
  EXPECT_FALSE(result.isElastica);
  EXPECT_FALSE(result.elastica);
  EXPECT_GT(result.residual, 0.1);
}

TEST(CurveRelaxation, MovesTurnsScalesAndMirrorsWithItsTarget) {
  RelaxOptions options;
  options.tolerance = 4;
  const RelaxResult plain = relaxed(arch(), options);
  RelaxOptions wide = options;
  wide.tolerance = 12;
  const RelaxResult moved = relaxed(arch().transformed(1.1, 3, {70, -30}), wide);
  EXPECT_NEAR(moved.energy, plain.energy / 3, 1e-7 * plain.energy);
  EXPECT_LT(distance(moved.curve, plain.curve.transformed(1.1, 3, {70, -30})), 1e-3);
  const RelaxResult mirrored =
      relaxed(*PlanarCurve::bezier({{0, 0}, {200, -150}, {400, -150}, {600, 0}}), options);
  EXPECT_NEAR(mirrored.energy, plain.energy, 1e-7 * plain.energy);
  const RelaxResult reversed = relaxed(arch().reversed(), options);
  EXPECT_NEAR(reversed.energy, plain.energy, 1e-7 * plain.energy);
}

TEST(CurveRelaxation, ReachesALengthOrSaysThatItCannot) {
  const PlanarCurve curve = arch();
  RelaxOptions options;
  options.tolerance = 10;
  options.length = curve.length() + 4;
  EXPECT_NEAR(relaxed(curve, options).curve.length(), curve.length() + 4, 1e-5);
  options.length = curve.length() + 400;
  const Result<RelaxResult> far = relaxCurve(curve, options);
  EXPECT_TRUE(!far || far->status == RelaxStatus::iterationLimit);
  options.length = 590;
  EXPECT_FALSE(relaxCurve(curve, options) &&
               relaxCurve(curve, options)->status != RelaxStatus::iterationLimit);
}

TEST(CurveRelaxation, ComesToRestInWideTubes) {
  for (const auto& [name, c] : test::fitCurves()) {
    for (const double share : {0.01, 0.05, 0.2, 0.5}) {
      SCOPED_TRACE(testing::Message() << name << " " << share);
      RelaxOptions options;
      options.tolerance = share * c.length();
      const Result<RelaxResult> result = relaxCurve(c, options);
      if (!result) {
        EXPECT_EQ(result.error().code, ErrorCode::badInput);
        continue;
      }
      EXPECT_NE(result->status, RelaxStatus::iterationLimit) << result->message;
      EXPECT_LE(result->energy, result->targetEnergy * (1 + 1e-9));
    }
  }
  // Into this one a first long step falls into a fold.
  RelaxOptions options;
  options.tolerance = 0.01;
  options.endpoints = options.tangents = false;
  const RelaxResult straight =
      relaxed(*PlanarCurve::bezier({{0, 0}, {0.33, 0.02}, {0.66, 0.025}, {1, 0}}), options);
  EXPECT_NE(straight.status, RelaxStatus::iterationLimit) << straight.message;
}

TEST(CurveRelaxation, RefusesWhatItCannotDo) {
  RelaxOptions options;
  options.tolerance = 0;
  EXPECT_EQ(relaxCurve(arch(), options).error().code, ErrorCode::badInput);
  options = {};
  options.degree = 4;
  EXPECT_EQ(relaxCurve(arch(), options).error().code, ErrorCode::badInput);
  options = {};
  options.spans = 3;
  EXPECT_EQ(relaxCurve(arch(), options).error().code, ErrorCode::badInput);
  // A corner is not in the spline space: the error names how far it is.
  options = {};
  options.tolerance = 0.01;
  const Result<RelaxResult> corner =
      relaxCurve(*PlanarCurve::points({{0, 0}, {100, 100}, {200, 0}}), options);
  ASSERT_FALSE(corner);
  EXPECT_GT(*corner.error().limit, 0.01);
}

}  // namespace bw
