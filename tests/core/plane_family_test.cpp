// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/plane_family.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "bw/core/base/units.h"
#include "turning_planes.h"

namespace bw {

namespace {

const Box kBlock{Frame{{10, 20, 30}}, {400, 300, 200}};

}  // namespace

TEST(PlaneFamily, LiesAcrossItsDirectionWithYUpwards) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d(3, 4, 0) / 5);
  EXPECT_NEAR((planes.direction() - Eigen::Vector3d(0.6, 0.8, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((planes.frame.y - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((planes.frame.x.cross(planes.frame.y) - planes.direction()).norm(), 0, 1e-15);
  EXPECT_NEAR(planes.entry, 0.6 * 10 + 0.8 * 20, 1e-12);
  EXPECT_NEAR(planes.exit, 0.6 * 410 + 0.8 * 320, 1e-12);
}

TEST(PlaneFamily, TakesTheBlocksOwnYWhereTheBladeTravelsUpwards) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR((planes.frame.y - Eigen::Vector3d::UnitY()).norm(), 0, 1e-15);
}

TEST(PlaneFamily, CountsTravelFromTheBlock) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d::UnitY());
  EXPECT_NEAR(planes.travel(25), 5, 1e-12);
  const Frame plane = planes.at(25);
  EXPECT_NEAR(plane.origin.dot(planes.direction()), 25, 1e-12);
  EXPECT_EQ(plane.x, planes.frame.x);
}

TEST(PlaneFamily, HasOneLevelInAllOfAPlane) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d(3, 4, 0) / 5);
  for (const double level : {planes.entry, 100.0, planes.exit})
    for (const Eigen::Vector2d& place : {Eigen::Vector2d(0, 0), Eigen::Vector2d(-250, 40)})
      EXPECT_NEAR(planes.level(planes.at(level).toWorld(place)), level, 1e-12);
  EXPECT_NEAR(planes.level(planes.at(100).toWorld({30, 40}, 7)), 107, 1e-12);
}

namespace {

const Box kWide{Frame{{-250, -200, 0}}, {500, 400, 300}};

/// Planes that turn and move aside in two spans that meet twice continuously differentiable.
TurningPlanes winding() {
  TurningPlanes planes = test::fanAlongY(150, fromDegrees(20));
  planes.turn.spans = {{-150, {10, 0.1, 2e-4, 0}, {-0.2, 1e-3, 2e-6, -1e-8}}};
  const PlaneTurn::State middle = planes.turn.at(0);
  planes.turn.spans.push_back({0,
                               {middle.aside[0], middle.aside[1], 0.5 * middle.aside[2], -1e-6},
                               {middle.angle[0], middle.angle[1], 0.5 * middle.angle[2], 1e-8}});
  planes.turn.to = 150;
  return planes;
}

}  // namespace

TEST(TurningPlanes, HaveOneLevelInAllOfAPlane) {
  const PlaneFamily planes = PlaneFamily::turning(kWide, winding()).value();
  EXPECT_TRUE(planes.turns());
  for (const double level : {-180.0, -150.0, -70.0, 0.0, 33.0, 150.0, 190.0}) {
    const Frame plane = planes.at(level);
    EXPECT_NEAR((plane.x.cross(plane.y) - plane.normal).norm(), 0, 1e-14);
    EXPECT_EQ(plane.y, planes.frame.y);
    for (const double x : {-240.0, 0.0, 240.0})
      EXPECT_NEAR(planes.level(plane.toWorld({x, 40})), level, 1e-8) << x;
  }
  for (const Eigen::Vector3d& corner : kWide.corners()) {
    EXPECT_GE(planes.level(corner), planes.entry);
    EXPECT_LE(planes.level(corner), planes.exit);
  }
}

TEST(TurningPlanes, CarryTheirPlacesWithTheVelocityThatIsTold) {
  const PlaneFamily planes = PlaneFamily::turning(kWide, winding()).value();
  constexpr double kStep = 1e-3;
  for (const double level : {-170.0, -100.0, 0.0, 60.0, 170.0})
    for (const double x : {-200.0, 0.0, 220.0}) {
      const Eigen::Vector2d place(x, 50);
      const auto at = [&](double where) { return planes.at(where).toWorld(place); };
      const Eigen::Vector3d moved = (at(level + kStep) - at(level - kStep)) / (2 * kStep);
      EXPECT_NEAR((planes.velocity(level, at(level)) - moved).norm(), 0, 1e-8) << level << ' ' << x;
      // A place that stays is passed by the planes at their speed across it.
      const Eigen::Vector3d n = planes.at(level).normal;
      const double passed = planes.level(at(level) + kStep * n) - planes.level(at(level) - kStep * n);
      EXPECT_NEAR(planes.speed(level, at(level)) * passed, 2 * kStep, 1e-6) << level << ' ' << x;
    }
}

TEST(TurningPlanes, AreAsFastAsTheyAreFarFromTheLineTheyTurnAbout) {
  const double turn = fromDegrees(30), reach = 100, away = 2 * reach / turn;
  const PlaneFamily planes = PlaneFamily::turning(kWide, test::fanAlongY(reach, turn)).value();
  for (const double x : {-200.0, 0.0, 200.0}) EXPECT_NEAR(planes.speed(0, {x, 0, 100}), 1 + x / away, 1e-12);
  EXPECT_NEAR(planes.speed(-150, planes.at(-150).toWorld({200, 0})), 1, 1e-12) << "before, they are parallel";
}

TEST(TurningPlanes, AreTheSameInABlockThatLiesUpsideDown) {
  Box turned = kWide;
  turned.frame = {
      {-250, 200, 300}, Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ()};
  const PlaneFamily one = PlaneFamily::turning(kWide, winding()).value(),
                    other = PlaneFamily::turning(turned, winding()).value();
  EXPECT_EQ(other.frame.y, -one.frame.y);
  for (const double level : {-170.0, -30.0, 120.0}) {
    EXPECT_NEAR((one.at(level).normal - other.at(level).normal).norm(), 0, 1e-14);
    EXPECT_NEAR((one.at(level).origin - other.at(level).origin).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(one.entry, other.entry, 1e-9);
  EXPECT_NEAR(one.exit, other.exit, 1e-9);
}

TEST(TurningPlanes, ThatMeetInTheBlockAreRefusedWithThePlace) {
  const Result<PlaneFamily> planes = PlaneFamily::turning(kWide, test::fanAlongY(100, fromDegrees(60)));
  ASSERT_FALSE(planes);
  EXPECT_EQ(planes.error().code, ErrorCode::badInput);
  // Against the clock, they meet where x is least.
  EXPECT_NE(planes.error().message.find("x = -2"), std::string::npos) << planes.error().message;
  EXPECT_TRUE(PlaneFamily::turning(kWide, test::fanAlongY(100, fromDegrees(30))));
}

}  // namespace bw
