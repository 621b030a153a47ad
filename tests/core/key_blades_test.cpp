// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/key_blades.h"
#include "bw/core/shape/designed_surface.h"
#include "bw/core/shape/surface_blades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bw/core/base/units.h"
#include "sweep/station_velocity.h"

namespace bw {

namespace {

/// Four blades that grow, lean and bend ever more.
std::vector<KeyBlade> fan() {
  return {{0, {300, 250}, 0.05, 600, 0.4, {-3, 1}},
          {200, {305, 260}, 0.02, 620, 0.9, {-5, 2}},
          {500, {310, 255}, -0.04, 640, 1.3, {-8, -1}},
          {800, {300, 240}, -0.1, 650, -0.2, {2, -3}}};
}

/// Places of a blade by small steps of the equations from its middle, a route of its own.
Eigen::Vector2d steppedTo(const KeyBlade& blade, double share) {
  const double length = blade.length, s = (share - 0.5) * length;
  const double fx =
      (blade.force.x() * std::cos(blade.angle) - blade.force.y() * std::sin(blade.angle)) / (length * length);
  const double fy =
      (blade.force.x() * std::sin(blade.angle) + blade.force.y() * std::cos(blade.angle)) / (length * length);
  using State = Eigen::Vector4d;  // x, z, angle, curvature
  const auto change = [&](const State& at) {
    return State(std::cos(at(2)), std::sin(at(2)), at(3), -fx * std::sin(at(2)) + fy * std::cos(at(2)));
  };
  State at(blade.middle.x(), blade.middle.y(), blade.angle, blade.bend / length);
  constexpr int kSteps = 2000;
  const double h = s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const State a = change(at), b = change(at + h / 2 * a), c = change(at + h / 2 * b),
                d = change(at + h * c);
    at += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return at.head<2>();
}

std::string errorOf(const std::vector<KeyBlade>& blades) {
  const Result<SplineSurface> spline = splineOf(DesignedSurface{BladesSurface{blades}});
  return spline ? "accepted" : spline.error().message;
}

}  // namespace

TEST(KeyBlades, ABladeIsTheElasticaOfItsMiddle) {
  for (const KeyBlade& blade : fan()) {
    const Elastica elastica = elasticaOf(blade).value();
    EXPECT_DOUBLE_EQ(elastica.length(), blade.length);
    for (const double share : {0.0, 0.2, 0.5, 0.83, 1.0})
      EXPECT_LT((elastica.point(share * blade.length) - steppedTo(blade, share)).norm(), 1e-7) << share;
    const KeyBlade back = keyBladeOf(elastica, blade.y);
    EXPECT_LT((back.middle - blade.middle).norm(), 1e-9);
    EXPECT_NEAR(back.angle, blade.angle, 1e-12);
    EXPECT_NEAR(back.bend, blade.bend, 1e-10);
    EXPECT_LT((back.force - blade.force).norm(), 1e-9);
  }
}

TEST(KeyBlades, EveryNumberIsACubicOfTheTravelWithTwoContinuousDerivatives) {
  const std::vector<KeyBlade> keys = fan();
  const BladeSweep sweep = BladeSweep::through(keys).value();
  EXPECT_EQ(sweep.from(), 0);
  EXPECT_EQ(sweep.to(), 800);
  for (const KeyBlade& key : keys) {
    const KeyBlade at = sweep.at(key.y);
    EXPECT_LT((at.middle - key.middle).norm(), 1e-9);
    EXPECT_NEAR(at.bend, key.bend, 1e-12);
    EXPECT_NEAR(at.length, key.length, 1e-9);
    EXPECT_LT((at.force - key.force).norm(), 1e-12);
  }
  // Four of them lie on one cubic: its fourth difference vanishes over the whole travel.
  const auto bend = [&](double y) { return sweep.at(y).bend; };
  EXPECT_NEAR(bend(0) - 4 * bend(150) + 6 * bend(300) - 4 * bend(450) + bend(600), 0, 1e-12);
  for (const double y : {0.0, 130.0, 200.0, 480.0, 799.0, 800.0}) {
    const KeyBlade change = sweep.changeAt(y);
    const double h = 1e-3, low = std::max(0.0, y - h), high = std::min(800.0, y + h);
    const KeyBlade a = sweep.at(low), b = sweep.at(high);
    EXPECT_NEAR(change.angle, (b.angle - a.angle) / (high - low), 1e-8);
    EXPECT_NEAR(change.length, (b.length - a.length) / (high - low), 2e-6);
    EXPECT_NEAR(change.force.y(), (b.force.y() - a.force.y()) / (high - low), 1e-6);
  }
  const BladeSweep line = BladeSweep::through({keys[0], keys[3]}).value();
  EXPECT_NEAR(line.at(200).bend, 0.4 - 0.25 * 0.6, 1e-12);
  EXPECT_NEAR(line.changeAt(200).bend, -0.6 / 800, 1e-15);
  const BladeSweep parabola = BladeSweep::through({keys[0], keys[2], keys[3]}).value();
  EXPECT_NEAR(parabola.at(500).angle, keys[2].angle, 1e-13);
}

TEST(KeyBlades, TheVelocityIsAnalytic) {
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  const std::vector<double> shares = {0, 0.17, 0.5, 0.9, 1};
  for (const double y : {50.0, 333.0, 700.0}) {
    const std::vector<Eigen::Vector2d> velocities =
        bladeVelocities(sweep.at(y), sweep.changeAt(y), shares).value();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const double h = 0.01;
      const auto at = [&](double where) {
        const KeyBlade blade = sweep.at(where);
        return elasticaOf(blade).value().point(shares[i] * blade.length);
      };
      const Eigen::Vector2d numeric = (at(y + h) - at(y - h)) / (2 * h);
      EXPECT_LT((velocities[i] - numeric).norm(), 1e-7) << y << " " << shares[i];
    }
  }
}

TEST(KeyBlades, TheSpeedsOfACutAreThoseOfTheAnalyticVelocity) {
  // The blades that cut are those told, and their material points go on as the arc from the middle says: at a
  // share of the length that is the velocity without what the length grows by along the tangent.
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  constexpr int kPoints = 21;
  constexpr double kFast = 20;
  std::vector<double> shares;
  for (int k = 0; k < kPoints; ++k) shares.push_back(double(k) / (kPoints - 1));
  struct Off {
    double angle = 0, relative = 0, speed = 0;
  };
  const auto errorsOf = [&](int stations) {
    std::vector<BladePose> poses;
    std::vector<double> travel;
    for (int i = 0; i < stations; ++i) {
      BladePose pose;
      pose.index = i;
      pose.travel = 800.0 * i / (stations - 1);
      // The plane (x, z) of the blades; its normal looks back along the travel.
      pose.frame = {
          {0, pose.travel, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()};
      pose.cut = pose.blade = elasticaOf(sweep.at(pose.travel)).value();
      poses.push_back(pose);
      travel.push_back(pose.travel);
    }
    Off worst;
    for (int i = 0; i < stations; ++i) {
      const StationVelocity seen = sweep::stationVelocity(poses, travel, std::size_t(i), kPoints, kFast);
      const KeyBlade blade = sweep.at(travel[std::size_t(i)]), change = sweep.changeAt(blade.y);
      const std::vector<Eigen::Vector2d> moved = bladeVelocities(blade, change, shares).value();
      const Elastica curve = elasticaOf(blade).value();
      std::vector<double> speeds;
      double fastest = 0;
      for (int k = 0; k < kPoints; ++k) {
        const double share = shares[std::size_t(k)], tangent = curve.at(share * blade.length).angle;
        const Eigen::Vector2d inPlane =
            moved[std::size_t(k)] -
            (share - 0.5) * change.length * Eigen::Vector2d(std::cos(tangent), std::sin(tangent));
        speeds.push_back(std::hypot(1, inPlane.norm()));
        fastest = std::max(fastest, speeds.back());
        worst.angle =
            std::max(worst.angle, std::abs(kPi - seen.angle[std::size_t(k)] - std::atan(inPlane.norm())));
      }
      for (int k = 0; k < kPoints; ++k) {
        const auto at = std::size_t(k);
        worst.relative = std::max(worst.relative, std::abs(seen.relative[at] - speeds[at] / fastest));
        worst.speed = std::max(worst.speed, std::abs(seen.speed[at] - kFast * speeds[at] / fastest));
      }
    }
    return worst;
  };
  const Off coarse = errorsOf(17), usual = errorsOf(33), fine = errorsOf(65);
  // With the stations that designs begin with: 0.2°, and a quarter of a per cent of the speed.
  EXPECT_LT(usual.angle, fromDegrees(0.2));
  EXPECT_LT(usual.relative, 2.5e-3);
  EXPECT_LT(usual.speed, 2.5e-3 * kFast);
  // Parabolas through three stations: the error falls with the square of their distance.
  for (const auto& [wide, narrow] : {std::pair(coarse, usual), std::pair(usual, fine)}) {
    EXPECT_NEAR(std::log2(wide.angle / narrow.angle), 2, 0.3);
    EXPECT_NEAR(std::log2(wide.relative / narrow.relative), 2, 0.4);
  }
}

TEST(KeyBlades, TheSplineHoldsEveryBladeBetween) {
  const SplineSurface spline = splineOf(DesignedSurface{BladesSurface{fan()}}).value();
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  double worst = 0;
  for (double y = 0; y <= 800; y += 7.3) {
    const KeyBlade blade = sweep.at(y);
    const Elastica elastica = elasticaOf(blade).value();
    for (double u = 0; u <= 1; u += 0.037) {
      const Eigen::Vector3d own = spline.value(u, y);
      EXPECT_NEAR(own.y(), y, 1e-9);
      worst = std::max(worst, (Eigen::Vector2d(own.x(), own.z()) - elastica.point(u * blade.length)).norm());
    }
  }
  EXPECT_LT(worst, BladesSurface::kTolerance);
  EXPECT_LT(spline.polesU * spline.polesV, 4000);
}

TEST(KeyBlades, WhatMakesNoSurfaceIsNamed) {
  const std::vector<KeyBlade> good = fan();
  EXPECT_EQ(errorOf(good), "accepted");
  EXPECT_NE(errorOf({good[0]}).find("takes 2 to 200 key blades, not 1"), std::string::npos);
  const auto with = [&](const auto& change) {
    std::vector<KeyBlade> blades = good;
    change(blades[2]);
    return errorOf(blades);
  };
  EXPECT_NE(with([](KeyBlade& b) { b.y = 200; }).find("y = 200 must lie beyond"), std::string::npos);
  EXPECT_NE(with([](KeyBlade& b) { b.length = 0; }).find("is 0 mm long"), std::string::npos);
  EXPECT_NE(with([](KeyBlade& b) { b.bend = 51; }).find("it may by 50"), std::string::npos);
  EXPECT_NE(with([](KeyBlade& b) { b.force = {1200, 1200}; }).find("1600 is the most"), std::string::npos);
  EXPECT_NE(with([](KeyBlade& b) { b.angle = std::numeric_limits<double>::quiet_NaN(); }).find("not finite"),
            std::string::npos);
  // Each key is a blade, but what lies between them is none.
  const std::string shrunk = errorOf({{0, {0, 0}, 0, 600, 0, {0, 0}},
                                      {100, {0, 0}, 0, 5, 0, {0, 0}},
                                      {200, {0, 0}, 0, 5, 0, {0, 0}},
                                      {300, {0, 0}, 0, 600, 0, {0, 0}}});
  EXPECT_NE(shrunk.find("add a key blade near there"), std::string::npos) << shrunk;
}

TEST(KeyBlades, TheFewestThatServeAreFound) {
  // Curves of a sweep of four blades come back as four, to far below the tolerance.
  const BladeSweep sweep = BladeSweep::through(fan()).value();
  std::vector<PlacedCurve> curves;
  for (int i = 0; i <= 32; ++i) {
    const double y = 25.0 * i;
    curves.push_back({y, PlanarCurve::points(elasticaOf(sweep.at(y)).value().sample(400)).value()});
  }
  const FewestBlades found = fewestBlades(curves, 0.05).value();
  EXPECT_LE(found.blades.size(), 4u);
  EXPECT_LE(found.deviation, 0.05);
  EXPECT_EQ(found.blades.front().y, 0);
  EXPECT_EQ(found.blades.back().y, 800);
  // What it says is what one finds: all places of the sweep of the blades found against the curves.
  const BladeSweep made = BladeSweep::through(found.blades).value();
  for (const PlacedCurve& curve : curves) {
    const Elastica blade = elasticaOf(made.at(curve.y)).value();
    for (const Eigen::Vector2d& p : blade.sample(100))
      EXPECT_LT((curve.curve.value(curve.curve.nearestParameter(p)) - p).norm(), 0.052);
  }
  // A coarse tolerance takes no more of them, a fine one no fewer.
  const FewestBlades coarse = fewestBlades(curves, 5).value();
  EXPECT_LE(coarse.blades.size(), found.blades.size());
  EXPECT_LE(coarse.deviation, 5);
}

TEST(KeyBlades, OfASurfaceTheyComeNearBetweenTheirCurvesToo) {
  const auto surfaceOf = [](double amplitude) {
    FormulaSurface formula;
    formula.over = {{0, 0}, {600, 800}};
    formula.formula = "300 - 60*((x - 300)/300)^2 + a*sin(3*pi*y/800)*(1 - 0.3*((x - 300)/300)^2)";
    formula.numbers = {{"a", amplitude}};
    DesignedSurface designed;
    designed.shape = formula;
    return splineOf(designed).value();
  };
  const auto farthest = [](const SplineSurface& surface, const SurfaceBlades& found) {
    const BladeSweep sweep = BladeSweep::through(found.shape.blades).value();
    double largest = 0;
    for (int i = 0; i <= 800; ++i) {
      std::vector<Eigen::Vector2d> points;
      for (int k = 0; k <= 200; ++k) {
        const Eigen::Vector3d p = surface.value(
            surface.knotsU.front() + (surface.knotsU.back() - surface.knotsU.front()) * k / 200.0,
            surface.knotsV.front() + (surface.knotsV.back() - surface.knotsV.front()) * i / 800.0);
        points.emplace_back(p.x(), p.z());
      }
      const PlanarCurve curve = PlanarCurve::points(points).value();
      for (const Eigen::Vector2d& p : elasticaOf(sweep.at(double(i))).value().sample(21))
        largest = std::max(largest, (curve.value(curve.nearestParameter(p)) - p).norm());
    }
    return largest;
  };
  const SplineSurface ripple = surfaceOf(25);
  const SurfaceBlades found = fewestBladesOf(ripple, 0.5).value();
  EXPECT_LE(found.deviation, 0.5);
  EXPECT_LE(farthest(ripple, found), found.deviation + 0.02);
  EXPECT_LT(found.shape.blades.size(), 20u);
  EXPECT_NEAR(found.from, 0, 1e-9);
  EXPECT_NEAR(found.to, 800, 1e-9);
  // Nearer than an elastica comes: it is told.
  const SurfaceBlades fine = fewestBladesOf(ripple, 1e-6).value();
  EXPECT_GT(fine.deviation, 1e-6);
}

TEST(KeyBlades, AreNoMoreWhereNoElasticaComesNearerThanTheToleranceAsksFor) {
  // One curve that a blade does not follow, shifted up and down along the travel.
  FormulaSurface formula;
  formula.over = {{0, 0}, {600, 800}};
  formula.formula = "300 + 0.6*sin(5*pi*x/600) - 60*((x - 300)/300)^2 + 16*cos(2*pi*y/800)";
  DesignedSurface designed;
  designed.shape = formula;
  const SplineSurface surface = splineOf(designed).value();
  const SurfaceBlades near = fewestBladesOf(surface, 0.9).value();
  EXPECT_LE(near.deviation, 0.9);
  for (const double tolerance : {0.5, 0.1}) {
    const SurfaceBlades found = fewestBladesOf(surface, tolerance).value();
    EXPECT_GT(found.deviation, tolerance);
    EXPECT_LE(found.deviation, near.deviation);
    EXPECT_LE(found.shape.blades.size(), near.shape.blades.size() + 2) << tolerance;
  }
}

TEST(KeyBlades, OfASurfaceWhoseLinesDoNotLieAcrossTheyFollowItInThePlanes) {
  // Poles moved along the travel: what lies at one v lies at many y.
  PolesSurface poles;
  poles.over = {{0, 0}, {600, 800}};
  for (int r = 0; r < poles.rows; ++r)
    for (int c = 0; c < poles.columns; ++c) {
      poles.at(r, c).height = 250 + 12 * r - 4 * c;
      if (r > 0 && r + 1 < poles.rows && c == 1) poles.at(r, c).moved.y() = 40;
    }
  DesignedSurface designed;
  designed.shape = poles;
  const SplineSurface surface = splineOf(designed).value();
  const SurfaceBlades found = fewestBladesOf(surface, 0.2).value();
  const BladeSweep sweep = BladeSweep::through(found.shape.blades).value();
  double largest = 0;
  for (int i = 1; i < 20; ++i)
    for (int k = 1; k < 20; ++k) {
      const Eigen::Vector3d p =
          surface.value(surface.knotsU.front() + (surface.knotsU.back() - surface.knotsU.front()) * k / 20.0,
                        surface.knotsV.front() + (surface.knotsV.back() - surface.knotsV.front()) * i / 20.0);
      const std::vector<Eigen::Vector2d> blade = elasticaOf(sweep.at(p.y())).value().sample(2001);
      double nearest = 1e9;
      for (const Eigen::Vector2d& q : blade)
        nearest = std::min(nearest, (q - Eigen::Vector2d(p.x(), p.z())).norm());
      largest = std::max(largest, nearest);
    }
  EXPECT_LE(largest, found.deviation + 0.2) << "half of the spacing of the points comes to it";
  EXPECT_LE(found.deviation, 0.2);
}

TEST(KeyBlades, CurvesThatNoElasticaComesNearToSayHowFarTheyAreOff) {
  std::vector<PlacedCurve> curves;
  for (int i = 0; i <= 8; ++i) {
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k <= 200; ++k) points.emplace_back(3.0 * k, 200 + 15 * std::sin(k / 200.0 * 8 * kPi) + i);
    curves.push_back({100.0 * i, PlanarCurve::points(points).value()});
  }
  const FewestBlades found = fewestBlades(curves, 0.1).value();
  EXPECT_GT(found.deviation, 0.1);
  const std::vector<PlacedCurve> one(1, curves.front());
  EXPECT_EQ(fewestBlades(one, 0.1).error().code, ErrorCode::badInput);
  std::swap(curves[2], curves[5]);
  EXPECT_NE(fewestBlades(curves, 0.1).error().message.find("in order"), std::string::npos);
  std::swap(curves[2], curves[5]);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(fewestBlades(curves, 0.1, {.stop = stop.get_token()}).error().code, ErrorCode::cancelled);
}

}  // namespace bw
