// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Key blades whose planes turn.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/shape/turned_blades.h"
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

/// A sweep as curves at so many places from y to y, each by the points of its blade.
TurnedRow rowOf(const BladeSweep& sweep, double from, double to, int count) {
  TurnedRow row;
  row.block = {Frame{}, {600, 800, 500}};
  for (int i = 0; i < count; ++i) {
    const KeyBlade blade = sweep.at(from + (to - from) * i / (count - 1));
    std::vector<Eigen::Vector2d> points = elasticaOf(blade).value().sample(129);
    // Counted from another place of the plane.
    for (Eigen::Vector2d& point : points) point.x() += 40 - blade.middle.x();
    const Eigen::Vector2d along(std::cos(blade.turn), std::sin(blade.turn));
    row.curves.push_back({Eigen::Vector2d(blade.middle.x(), blade.y) - 40 * along, blade.turn,
                          cubicSplineThrough(points).value()});
  }
  return row;
}

std::vector<Eigen::Vector3d> placesOf(const KeyBlade& blade, int count) {
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector2d& point : elasticaOf(blade).value().sample(count))
    places.push_back(blade.placed(point));
  return places;
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

TEST(FewestTurnedBlades, ComeBackFromTheSweepThatTheyTell) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  const FewestTurnedBlades found = fewestTurnedBlades(rowOf(sweep, -150, 950, 45), 0.01).value();
  EXPECT_LE(found.blades.size(), 4u);
  EXPECT_LE(found.deviation, 0.01);
  EXPECT_LT(toDegrees(found.turnedOff), 1e-3);
  const BladeSweep back = BladeSweep::through(found.blades).value();
  for (const double y : {-140.0, 111.0, 500.0, 900.0}) {
    const KeyBlade one = sweep.at(y), other = back.at(y);
    EXPECT_NEAR(toDegrees(other.turn), toDegrees(one.turn), 1e-3);
    EXPECT_LT((other.middle - one.middle).norm(), 0.02);
    EXPECT_NEAR(other.length, one.length, 0.02);
  }
}

TEST(FewestTurnedBlades, AreHeldAgainstPlacesInTheirOwnPlanes) {
  std::vector<KeyBlade> wagging;
  for (int k = 0; k < 8; ++k) {
    wagging.push_back({150.0 * k - 125, {300, 250 + 2.0 * k}, 0.02 * k, 640, -0.6 + 0.02 * k, {0, 0}});
    wagging.back().turn = 0.06 * std::sin(1.3 * k);
  }
  const BladeSweep sweep = BladeSweep::through(wagging).value();
  const FewestTurnedBlades found = fewestTurnedBlades(rowOf(sweep, 0, 800, 33), 0.5).value();
  EXPECT_LT(found.blades.size(), 8u);
  EXPECT_LE(found.deviation, 0.5);
  EXPECT_GT(toDegrees(found.turnedOff), 0.01);
  // No place of the one surface lies farther from the other: by places that were not looked at.
  const BladeSweep back = BladeSweep::through(found.blades).value();
  double most = 0;
  for (const double y : {30.0, 130.0, 333.0, 512.0, 700.0}) {
    const std::vector<Eigen::Vector3d> places = placesOf(sweep.at(y), 12);
    std::vector<double> nearest(places.size(), 1e9);
    for (double near = y - 2; near <= y + 2; near += 0.1)
      for (const Eigen::Vector3d& other : placesOf(back.at(near), 3201))
        for (std::size_t i = 0; i < places.size(); ++i)
          nearest[i] = std::min(nearest[i], (other - places[i]).norm());
    most = std::max(most, *std::ranges::max_element(nearest));
  }
  EXPECT_LT(most, found.deviation + 0.15) << "and what lies between the places compared";
  EXPECT_GT(most, 0.2 * found.deviation);
}

TEST(FewestTurnedBlades, SeeWhatLiesBetweenTheCurves) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  TurnedRow row = rowOf(sweep, 0, 800, 9);
  row.between.push_back(placesOf(sweep.at(350), 33));
  EXPECT_LT(fewestTurnedBlades(row, 0.05).value().deviation, 0.05);
  for (Eigen::Vector3d& place : row.between[0]) place.z() += 3;  // a ridge that no curve has
  const FewestTurnedBlades found = fewestTurnedBlades(row, 0.05).value();
  EXPECT_NEAR(found.deviation, 3, 0.3);
  EXPECT_NEAR(found.worst, 350, 10);
}

TEST(FewestTurnedBlades, GoOnBeyondTheOuterCurves) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  TurnedRow row = rowOf(sweep, 0, 800, 33);
  row.before = 0.5;
  row.after = 0.25;
  const FewestTurnedBlades found = fewestTurnedBlades(row, 0.05).value();
  EXPECT_NEAR(found.blades.front().y, -0.5, 1e-5);
  EXPECT_NEAR(found.blades.back().y, 800.25, 1e-5);
  EXPECT_NEAR(found.blades.front().turn, sweep.at(-0.5).turn, 1e-5);
  EXPECT_LE(found.deviation, 0.05);
}

TEST(FewestTurnedBlades, SayWhatIsInTheirWay) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  TurnedRow row = rowOf(sweep, 0, 800, 9);
  TurnedRow one = row;
  one.curves = {row.curves.front()};
  EXPECT_EQ(fewestTurnedBlades(one, 1).error().code, ErrorCode::badInput);
  TurnedRow turnedBack = row;
  std::swap(turnedBack.curves[3], turnedBack.curves[4]);
  EXPECT_NE(fewestTurnedBlades(turnedBack, 1).error().message.find("do not go on along the travel"),
            std::string::npos);
  TurnedRow meeting = row;
  meeting.block.frame.origin.x() = -6000;
  meeting.block.size.x() = 6600;
  EXPECT_NE(fewestTurnedBlades(meeting, 1).error().message.find("meet in the block"), std::string::npos);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(fewestTurnedBlades(row, 1, {.stop = stop.get_token()}).error().code, ErrorCode::cancelled);
}

}  // namespace bw
