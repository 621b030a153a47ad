// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What no blade can be of what key blades tell: stretches whose ends are known, the narrow ones too.

#include "bw/core/shape/told_stretches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>

#include "bw/core/base/frame.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"

namespace bw {

namespace {

using Fault = ToldBlades::Fault;
constexpr double kLength = 600;

/// Arcs, each told by how much it turns.
BladesSurface arcs(const std::vector<std::pair<double, double>>& turns) {
  BladesSurface surface;
  for (const auto& [y, bend] : turns) surface.blades.push_back({y, {300, 250}, 0, kLength, bend, {0, 0}});
  return surface;
}

/// Arcs whose turn is `most` at `peak` and falls from there with the square of the way, told by three keys
/// none of which is there.
BladesSurface peaked(double most, double peak, double fall) {
  const auto at = [&](double y) { return std::pair(y, most - fall * (y - peak) * (y - peak)); };
  return arcs({at(0), at(97), at(200)});
}

std::vector<ToldStretch> of(Fault fault, const std::vector<ToldStretch>& all) {
  std::vector<ToldStretch> those;
  for (const ToldStretch& stretch : all)
    if (stretch.fault == fault) those.push_back(stretch);
  return those;
}

std::vector<ToldStretch> found(const BladesSurface& surface, double minRadius) {
  const Result<std::vector<ToldStretch>> stretches = toldStretches(surface, minRadius);
  EXPECT_TRUE(stretches) << stretches.error().message;
  return stretches.value_or(std::vector<ToldStretch>());
}

}  // namespace

TEST(ToldStretches, TheTightOneBeginsWhereTheRadiusIsThatOfTheBlade) {
  // The turn grows by 1 over 400 mm: the radius is below 400 mm from a turn of 1.5 on.
  const std::vector<ToldStretch> all = found(arcs({{0, 0}, {800, 2}}), 400);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].fault, Fault::tight);
  EXPECT_NEAR(all[0].from, 600, kStretchEnd);
  EXPECT_EQ(all[0].to, 800);
  EXPECT_EQ(all[0].worst, 800);
  EXPECT_NEAR(all[0].radius, 300, 1e-6);
  EXPECT_TRUE(found(arcs({{0, 0}, {800, 2}}), 299).empty());
  // What has just that radius may still be.
  EXPECT_TRUE(found(arcs({{0, 1.5}, {800, 1.5}}), 400).empty());
  EXPECT_TRUE(found(arcs({{0, 0}, {800, 0}}), 400).empty()) << "straight blades";
}

TEST(ToldStretches, OneFarNarrowerThanTheStepsIsFound) {
  // Beyond a turn of 1.5 by 1e-7 alone: over 0.06 mm, while 4 mm lie between the places looked at first.
  const double half = std::sqrt(1e-7 / 1e-4);
  const std::vector<ToldStretch> tight = found(peaked(1.5 + 1e-7, 51.3, 1e-4), 400);
  ASSERT_EQ(tight.size(), 1u);
  EXPECT_EQ(tight[0].fault, Fault::tight);
  EXPECT_NEAR(tight[0].from, 51.3 - half, 2 * kStretchEnd);
  EXPECT_NEAR(tight[0].to, 51.3 + half, 2 * kStretchEnd);
  EXPECT_NEAR(tight[0].worst, 51.3, half);
  EXPECT_TRUE(found(peaked(1.5 - 1e-6, 51.3, 1e-4), 400).empty());
  // A loop that closes over a millimetre.
  const std::vector<ToldStretch> loop = of(Fault::crossing, found(peaked(2 * kPi + 2.5e-5, 51.3, 1e-4), 10));
  ASSERT_EQ(loop.size(), 1u);
  EXPECT_NEAR(loop[0].from, 50.8, 0.01);
  EXPECT_NEAR(loop[0].to, 51.8, 0.01);
  EXPECT_TRUE(of(Fault::crossing, found(peaked(2 * kPi - 1e-4, 51.3, 1e-4), 10)).empty());
}

TEST(ToldStretches, AnArcCrossesItselfFromAFullTurnOn) {
  const std::vector<ToldStretch> loops = of(Fault::crossing, found(arcs({{0, 5}, {100, 7}}), 10));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(loops[0].from, 50 * (2 * kPi - 5), 0.01);
  EXPECT_EQ(loops[0].to, 100);
}

TEST(ToldStretches, TheUnstableOneEndsWhereTheBladeRests) {
  // The force along the blade grows beyond what one that is clamped bears.
  BladesSurface surface;
  for (const auto& [y, force] : {std::pair(0.0, 10.0), std::pair(300.0, 130.0), std::pair(500.0, 20.0)})
    surface.blades.push_back({y, {300, 250}, 0.1, kLength, 0.4, {force, 1}});
  const std::vector<ToldStretch> all = of(Fault::unstable, found(surface, 10));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_GT(all[0].from, 50);
  EXPECT_LT(all[0].to, 499);
  const BladeSweep sweep = BladeSweep::through(surface.blades).value();
  const auto rests = [&](double y) { return isClampedStable(elasticaOf(sweep.at(y)).value()); };
  EXPECT_TRUE(rests(all[0].from - 0.1));
  EXPECT_FALSE(rests(all[0].from + 0.1));
  EXPECT_FALSE(rests(all[0].to - 0.1));
  EXPECT_TRUE(rests(all[0].to + 0.1));
  const auto margin = [&](double y) { return stabilityMargin(elasticaOf(sweep.at(y)).value()); };
  for (double y = all[0].from; y <= all[0].to; y += 1) EXPECT_GE(margin(y), margin(all[0].worst) - 1e-6) << y;
}

TEST(ToldStretches, AreTheSameOfBladesThatLieOtherwise) {
  const BladesSurface surface = peaked(2 * kPi + 0.4, 51.3, 4e-4);
  const std::vector<ToldStretch> own = found(surface, 120);
  ASSERT_EQ(own.size(), 2u) << "too tight, and crossing";
  BladesSurface moved = surface, mirrored = surface;
  for (KeyBlade& blade : moved.blades) {
    blade.middle += Eigen::Vector2d(70, -30);
    blade.angle += 0.7;
  }
  for (KeyBlade& blade : mirrored.blades) {
    blade.bend = -blade.bend;
    blade.force.y() = -blade.force.y();
  }
  for (const BladesSurface* other : {&moved, &mirrored}) {
    const std::vector<ToldStretch> theirs = found(*other, 120);
    ASSERT_EQ(theirs.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(theirs[i].fault, own[i].fault);
      EXPECT_NEAR(theirs[i].from, own[i].from, 2 * kStretchEnd);
      EXPECT_NEAR(theirs[i].to, own[i].to, 2 * kStretchEnd);
    }
  }
}

TEST(ToldStretches, AreMarkedInThePlanesOfBladesThatTurn) {
  BladesSurface turned = arcs({{0, 0}, {800, 2}});
  turned.blades[0].turn = turned.blades[1].turn = 0.3;
  const std::vector<ToldStretch> stretches = found(turned, 400);
  ASSERT_EQ(stretches.size(), 1u);
  for (const auto& line : markedBlades({turned}, stretches[0], 10)) {
    EXPECT_GT((line.back() - line.front()).norm(), 100);
    for (const Eigen::Vector3d& p : line)
      EXPECT_NEAR((p - line.front()).dot(Eigen::Vector3d(-std::sin(0.3), std::cos(0.3), 0)), 0, 1e-9);
    EXPECT_GT((line.back() - line.front()).y(), 30);
  }
}

TEST(ToldStretches, AreToldAndMarkedWhereTheyLie) {
  DesignedSurface surface{arcs({{0, 0}, {800, 2}})};
  surface.origin = {100, 200, 300};
  surface.rotation = {0, 0, kPi / 2};
  const std::vector<ToldStretch> stretches = found(std::get<BladesSurface>(surface.shape), 400);
  const Findings told = toldFindings(surface, stretches, 400);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].severity, Severity::warning);
  EXPECT_EQ(told[0].kind(), FindingKind::keyBlades);
  EXPECT_FALSE(exceedsLimit(told)) << "the blades that cut decide";
  const auto& cause = std::get<ToldBlades>(told[0].cause);
  EXPECT_NEAR(cause.from, 600, kStretchEnd);
  EXPECT_EQ(cause.limit, 400);
  ASSERT_TRUE(remedyOf<BendingBlade>(told[0].remedies));
  EXPECT_NEAR(remedyOf<BendingBlade>(told[0].remedies)->radius, 297, 0.5);
  // The middle of the last blade, (300, 800, 250), turned by a right angle.
  ASSERT_TRUE(told[0].where.point);
  EXPECT_LT((*told[0].where.point - Eigen::Vector3d(-700, 500, 550)).norm(), 1e-9);
  const auto lines = markedBlades(surface, stretches[0], 10);
  EXPECT_GE(lines.size(), 21u);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const Eigen::Vector3d& p : lines[i]) {
      EXPECT_LE(p.x(), 100 - 600 + 0.01) << "y of the surface runs against x";
      EXPECT_GE(p.x(), 100 - 800 - 0.01);
      EXPECT_NEAR(p.x(), lines[i].front().x(), 1e-9);
      if (i > 0) {
        EXPECT_LE(lines[i - 1].front().x() - p.x(), 10 + 1e-9);
      }
    }
}

TEST(ToldStretches, SayWhatTheyCannotLookAt) {
  const BladesSurface good = arcs({{0, 0}, {800, 2}});
  EXPECT_EQ(toldStretches(good, 0).error().code, ErrorCode::badInput);
  EXPECT_EQ(toldStretches(arcs({{0, 0}}), 400).error().code, ErrorCode::badInput);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(toldStretches(good, 400, {.stop = stop.get_token()}).error().code, ErrorCode::cancelled);
}

}  // namespace bw
