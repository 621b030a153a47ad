// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Key blades whose planes turn.

#include <gtest/gtest.h>

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/shape/turning_planes.h"

namespace bw {

namespace {

std::vector<KeyBlade> fan() {
  std::vector<KeyBlade> blades = {{-150, {300, 250}, 0.05, 640, -0.9, {-3, 1}},
                                  {200, {305, 260}, 0.02, 650, -0.7, {-5, 2}},
                                  {600, {310, 255}, -0.04, 645, -0.6, {-4, -1}},
                                  {950, {300, 240}, -0.1, 650, -0.5, {-2, -1}}};
  const double turns[] = {-0.3, -0.12, 0.1, 0.32};
  for (std::size_t i = 0; i < blades.size(); ++i) blades[i].turn = turns[i];
  return blades;
}

DesignedSurface surfaceOf(std::vector<KeyBlade> blades) { return {BladesSurface{std::move(blades)}}; }

}  // namespace

TEST(TurningBlades, MakeASurfaceWhoseRowsAreThemInTheirPlanes) {
  const DesignedSurface surface = surfaceOf(fan());
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  const SplineSurface spline = splineOf(surface).value();
  const TurningPlanes told = planesOf(surface).value();
  const PlaneFamily planes = PlaneFamily::turning({Frame{}, {600, 800, 500}}, told).value();
  for (const double y : {-150.0, -20.0, 200.0, 444.0, 800.0, 950.0}) {
    const KeyBlade blade = sweep.at(y);
    const Frame plane = planes.at(y);
    for (const double share : {0.0, 0.3, 0.5, 1.0}) {
      const Eigen::Vector3d place = blade.placed(elasticaOf(blade).value().point(share * blade.length));
      EXPECT_LT((spline.value(share, y) - place).norm(), BladesSurface::kTolerance) << y << ' ' << share;
      EXPECT_NEAR(plane.toLocal(place).z(), 0, 1e-9);
    }
  }
}

TEST(TurningBlades, MoveWithTheVelocityThatIsTold) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  const std::vector<double> shares = {0, 0.17, 0.5, 0.9, 1};
  for (const double y : {50.0, 333.0, 700.0}) {
    const std::vector<Eigen::Vector3d> velocities =
        spaceVelocities(sweep.at(y), sweep.changeAt(y), shares).value();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      constexpr double kStep = 0.01;
      const auto at = [&](double where) {
        const KeyBlade blade = sweep.at(where);
        return blade.placed(elasticaOf(blade).value().point(shares[i] * blade.length));
      };
      const Eigen::Vector3d numeric = (at(y + kStep) - at(y - kStep)) / (2 * kStep);
      EXPECT_LT((velocities[i] - numeric).norm(), 1e-7) << y << ' ' << shares[i];
    }
  }
}

TEST(TurningBlades, TurnWithTheFrameOfTheirSurface) {
  DesignedSurface surface = surfaceOf(fan());
  surface.origin = {10, -20, 30};
  surface.rotation = {0, 0, 0.4};
  const Eigen::Matrix3d axes = rotationFromAngles(surface.rotation);
  const TurningPlanes own = planesOf(surfaceOf(fan())).value(), turned = planesOf(surface).value();
  EXPECT_EQ(turned.turn, own.turn);
  EXPECT_NEAR((turned.frame.normal - axes * own.frame.normal).norm(), 0, 1e-15);
  EXPECT_NEAR((turned.frame.origin - surface.origin).norm(), 0, 1e-15);
}

TEST(TurningBlades, AreNoneWhereNoneIsTurned) {
  std::vector<KeyBlade> blades = fan();
  for (KeyBlade& blade : blades) blade.turn = 0;
  EXPECT_FALSE(planesOf(surfaceOf(blades)));
  EXPECT_FALSE(planesOf({PolesSurface{}}));
  blades[1].turn = 2;
  EXPECT_NE(splineOf(surfaceOf(blades)).error().message.find("turned by"), std::string::npos);
}

}  // namespace bw
