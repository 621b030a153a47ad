// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/surface_jet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analytic_surfaces.h"

namespace bw {

namespace {

/// The torus of these radii about z, u around it and v around the tube; the outer side is that of the air.
SurfaceJet torus(double major, double minor, double u, double v) {
  const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
  const double r = major + minor * cv;
  return {{r * cu, r * su, minor * sv},
          {-r * su, r * cu, 0},
          {-minor * sv * cu, -minor * sv * su, minor * cv},
          {-r * cu, -r * su, 0},
          {minor * sv * su, -minor * sv * cu, 0},
          {-minor * cv * cu, -minor * cv * su, -minor * sv},
          {cv * cu, cv * su, sv}};
}

/// z = x²/2a − y²/2b, seen from above.
SurfaceJet saddle(double a, double b, double x, double y) {
  SurfaceJet jet{{x, y, x * x / (2 * a) - y * y / (2 * b)},
                 {1, 0, x / a},
                 {0, 1, -y / b},
                 {0, 0, 1 / a},
                 Eigen::Vector3d::Zero(),
                 {0, 0, -1 / b}};
  jet.normal = normalOf(jet);
  return jet;
}

}  // namespace

TEST(SurfaceCurvature, OfASphereIsTheSameEveryWay) {
  const test::SphereSampler sphere(250);
  for (const double v : {-1.2, 0.0, 0.7, 1.5}) {
    const auto jet = sphere.at(0, {0.4, v});
    ASSERT_TRUE(jet);
    const auto k = curvatureOf(*jet);
    ASSERT_TRUE(k);
    EXPECT_NEAR(k->min, -1 / 250.0, 1e-14);
    EXPECT_NEAR(k->max, -1 / 250.0, 1e-14);
    EXPECT_NEAR(k->along({1, 2, 3}), -1 / 250.0, 1e-14);
  }
}

TEST(SurfaceCurvature, OfATorusIsThatOfItsTubeAndItsDistance) {
  for (const double v : {0.0, 0.9, 2.5}) {
    const SurfaceJet jet = torus(1000, 450, 0.3, v);
    const auto k = curvatureOf(jet);
    ASSERT_TRUE(k);
    const double tube = -1 / 450.0, around = -std::cos(v) / (1000 + 450 * std::cos(v));
    EXPECT_NEAR(k->min, tube, 1e-15);
    EXPECT_NEAR(k->max, around, 1e-15);
    EXPECT_NEAR(std::abs(k->alongMin.dot(jet.dv.normalized())), 1, 1e-12);
    EXPECT_NEAR(k->along(7 * jet.du), around, 1e-15);
    EXPECT_NEAR(k->gauss(), tube * around, 1e-17);
    EXPECT_NEAR(k->alongMin.cross(k->alongMax).dot(jet.normal), 1, 1e-12);
  }
}

TEST(SurfaceCurvature, OfASaddleHasBothSigns) {
  const auto middle = curvatureOf(saddle(800, 500, 0, 0));
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->max, 1 / 800.0, 1e-15);
  EXPECT_NEAR(middle->min, -1 / 500.0, 1e-15);
  EXPECT_NEAR(middle->along({1, 1, 0}), middle->mean(), 1e-15);
  EXPECT_NEAR(middle->along({0, 0, 1}), middle->mean(), 1e-15);
  // Elsewhere by the formula for graphs.
  const double x = 120, y = -70, p = x / 800, q = -y / 500, w = 1 + p * p + q * q;
  const auto k = curvatureOf(saddle(800, 500, x, y));
  ASSERT_TRUE(k);
  EXPECT_NEAR(k->gauss(), -1 / (800.0 * 500.0) / (w * w), 1e-17);
  EXPECT_NEAR(k->mean(), ((1 + q * q) / 800 - (1 + p * p) / 500) / (2 * std::pow(w, 1.5)), 1e-15);
}

TEST(SurfaceCurvature, DoesNotHangOnTheParameters) {
  // u = 2s + t, v = s − 3t of the same torus.
  const SurfaceJet a = torus(1000, 450, 0.3, 0.9);
  SurfaceJet b = a;
  b.du = 2 * a.du + a.dv;
  b.dv = a.du - 3 * a.dv;
  b.duu = 4 * a.duu + 4 * a.duv + a.dvv;
  b.duv = 2 * a.duu - 5 * a.duv - 3 * a.dvv;
  b.dvv = a.duu - 6 * a.duv + 9 * a.dvv;
  const auto ka = curvatureOf(a), kb = curvatureOf(b);
  ASSERT_TRUE(ka && kb);
  EXPECT_NEAR(ka->min, kb->min, 1e-15);
  EXPECT_NEAR(ka->max, kb->max, 1e-15);
  const Eigen::Vector3d way(3, -1, 2);
  EXPECT_NEAR(ka->along(way), kb->along(way), 1e-15);
}

TEST(SurfaceCurvature, TurnsItsSignWithTheSide) {
  SurfaceJet jet = saddle(800, 500, 30, 40);
  const auto above = curvatureOf(jet);
  jet.normal = -jet.normal;
  const auto below = curvatureOf(jet);
  ASSERT_TRUE(above && below);
  EXPECT_NEAR(above->min, -below->max, 1e-16);
  EXPECT_NEAR(above->max, -below->min, 1e-16);
}

TEST(SurfaceCurvature, IsRefusedWhereThereIsNone) {
  SurfaceJet line = saddle(800, 500, 0, 0);
  line.dv = 3 * line.du;
  EXPECT_EQ(curvatureOf(line).error().code, ErrorCode::noSolution);
  SurfaceJet side = saddle(800, 500, 0, 0);
  side.normal.setZero();
  EXPECT_EQ(curvatureOf(side).error().code, ErrorCode::badInput);
  SurfaceJet broken = saddle(800, 500, 0, 0);
  broken.duv.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(curvatureOf(broken).error().code, ErrorCode::badInput);
}

}  // namespace bw
