// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How many stations a tolerance asks for.

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

/// A sheet of 400 by 600 mm that rises by `height` as a wave along the travel (y) of so many periods.
std::string waves(double height, double periods) {
  return stepOf(
      [=](double u, double v) {
        return Eigen::Vector3d(400 * u, 600 * v,
                               0.5 * height * (1 - std::cos(2 * kPi * periods * v)) + 30 * u * (1 - u));
      },
      241, 9);
}

geometry::Setup usualSetup(const Target& target) {
  Findings findings;
  const auto setup = resolveSetup(target, {{}, Eigen::Vector3d::UnitY()}, findings);
  EXPECT_TRUE(setup) << setup.error().message;
  return *setup;
}

StationCount countOf(const Target& target, double tolerance, int threads = 0) {
  RunContext context;
  context.threads = threads;
  const auto count = stationsFor(target, usualSetup(target), tolerance, context);
  EXPECT_TRUE(count) << count.error().message;
  return *count;
}

/// The farthest, mm, that sections of many other planes lie from the skin through those of `stations` planes,
/// by OpenCASCADE's sections and closest points over the whole of them: another way than the count's own.
double farthestBetween(const Target& target, int stations) {
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.route = SectionRoute::kernel;
  settings.stations = stations;
  const Cut row = cutOf(target, settings);
  settings.stations = 71;  // none of which is one of the row
  const Cut finer = cutOf(target, settings);
  SurfaceGrid grid;
  grid.columns = 41;
  grid.rows = int(row.sections.size());
  std::vector<double> v;
  const double first = row.sections.front().travel, way = row.sections.back().travel - first;
  for (const Section& section : row.sections) {
    v.push_back((section.travel - first) / way);
    for (const Eigen::Vector2d& p : section.curve().sample(grid.columns))
      grid.points.push_back(section.frame.toWorld(p));
  }
  const auto skin = loft(grid, v);
  EXPECT_TRUE(skin);
  double farthest = 0;
  for (const Section& section : finer.sections)
    for (int c = 2; c < 39; ++c) {
      const Eigen::Vector2d p =
          section.frame.toLocal(skin->value(c / 40.0, (section.travel - first) / way)).head<2>();
      const PlanarCurve& curve = section.curve();
      farthest = std::max(farthest, (curve.value(curve.nearestParameter(p)) - p).norm());
    }
  return farthest;
}

TEST(StationCount, APlaneTakesTheFewest) {
  const Target plane =
      targetOf(stepOf([](double u, double v) { return Eigen::Vector3d(400 * u, 600 * v, 90 * u); }));
  const StationCount count = countOf(plane, 0.5);
  EXPECT_EQ(count.stations, StationCount::kLeast);
  ASSERT_TRUE(count.between);
  EXPECT_LT(*count.between, 1e-3);
}

TEST(StationCount, WhatLiesBetweenKeepsWithinItsShare) {
  int before = 0;
  for (const double periods : {1.0, 4.0, 9.0, 16.0}) {
    const Target target = targetOf(waves(60, periods));
    const StationCount count = countOf(target, 2);
    EXPECT_GE(count.stations, before) << periods;
    before = count.stations;
    ASSERT_TRUE(count.between);
    EXPECT_LE(*count.between, 0.05 * 2);
    EXPECT_LE(farthestBetween(target, count.stations), 1.3 * 0.05 * 2) << periods << ", " << count.stations;
  }
  EXPECT_GT(before, StationCount::kLeast) << "sixteen waves ask for more";
}

TEST(StationCount, NoFewerStationsForANarrowerTolerance) {
  const Target target = targetOf(waves(60, 6));
  int before = 0;
  for (const double tolerance : {50.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02}) {
    const StationCount count = countOf(target, tolerance);
    EXPECT_GE(count.stations, before) << tolerance;
    before = count.stations;
    EXPECT_EQ(countOf(target, tolerance, 1), count) << "whatever the number of threads";
  }
  EXPECT_GT(before, 60);
}

TEST(StationCount, BordersThatBendAskForMore) {
  // A plane sheet whose left side runs in and out in two waves: only its border tells.
  const Target target = targetOf(stepOf(
      [](double u, double v) {
        const double left = 60 * std::sin(4 * kPi * 4 * v);
        return Eigen::Vector3d(left + (400 - left) * u, 600 * v, 0);
      },
      241, 9));
  EXPECT_GT(countOf(target, 0.5).stations, StationCount::kLeast);
}

TEST(StationCount, ACreaseTakesTheMost) {
  const Target ridge = targetOf(
      stepOf([](double u, double v) { return Eigen::Vector3d(400 * u, 600 * v, 600 * std::abs(v - 0.41)); },
             401, 5));
  const StationCount count = countOf(ridge, 0.05);
  EXPECT_EQ(count.stations, StationCount::kMost);
  ASSERT_TRUE(count.between);
  EXPECT_GT(*count.between, 0.05 * 0.05) << "which is told as it is";
}

TEST(StationCount, ErrorsAreThoseOfTheRow) {
  const Target target = targetOf(waves(60, 1));
  geometry::Setup away = usualSetup(target);
  away.block.frame.origin.z() += 5000;
  away.planes = PlaneFamily::across(away.block, Eigen::Vector3d::UnitY());
  expectError(stationsFor(target, away, 2, {}), ErrorCode::badInput, "no plane across the cutting direction");
  Findings findings;
  expectError(cutSections(target, usualSetup(target), {}, {}, findings), ErrorCode::internal, "stations");
}

}  // namespace
}  // namespace bw::geometry::test
