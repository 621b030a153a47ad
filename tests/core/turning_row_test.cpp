// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A row whose planes turn as the blade travels, on a sphere, which all planes cut in circles: from its
// sections to the run of its motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/parts/whole_cut.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/coverage.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/joints.h"
#include "bw/core/sweep/kerf_field.h"
#include "bw/core/sweep/live_row.h"
#include "bw/core/sweep/row_motion.h"
#include "row_settings.h"
#include "turning_planes.h"

namespace bw::turning_row {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 700, kHalf = 240, kReach = 100, kTurn = fromDegrees(24);
constexpr int kStations = 17;

/// From the line about which the planes turn, mm.
double awayFrom(double x) { return 2 * kReach / kTurn + x; }

Box block() { return {Frame{{-260, -240, 0}}, {520, 480, 2 * kRadius}}; }

std::vector<Section> sectionsIn(const PlaneFamily& planes) {
  std::vector<Section> sections;
  for (int i = 0; i < kStations; ++i) {
    const double level = -kReach + 2 * kReach * i / (kStations - 1);
    Section section{i, planes.travel(level), planes.at(level), {}, 0};
    const Frame& frame = section.frame;
    const double off = frame.normal.dot(frame.origin);
    const Vector3d foot = frame.toLocal(off * frame.normal);  // of the sphere's middle
    const double rho = std::sqrt(kRadius * kRadius - off * off);
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k <= 480; ++k) {
      const double x = kHalf * (k / 240.0 - 1);
      points.emplace_back(x, foot.y() + std::sqrt(rho * rho - std::pow(x - foot.x(), 2)));
    }
    section.branches = {*PlanarCurve::points(points)};
    sections.push_back(std::move(section));
  }
  return sections;
}

/// A row with all that a program is made of.
struct Made {
  test::RowSettings settings;
  PlaneFamily planes = PlaneFamily::turning(block(), test::fanAlongY(kReach, kTurn)).value();
  Sweep sweep;
  SweepCheck check;
  RowMotion way;
  SweepAnalysis analysis;
  explicit Made(bool hangs = true) {
    settings.blade.yieldStress = 2000;
    if (hangs) settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
    Findings findings;
    sweep = buildSweep(sectionsIn(planes), settings, block(), planes, {}, findings).value();
    check = checkSweep(sweep, settings, {}).value();
    way = followRow(sweep, settings, {}).value();
    analysis =
        analyzeSweep(sweep, way.course, check, settings, test::SphereSampler(kRadius), test::interpolated, {})
            .value();
  }
};

TEST(TurningRow, LiesOnItsSectionsInPlanesOfItsOwn) {
  const Made made;
  ASSERT_EQ(made.sweep.poses.size(), std::size_t(kStations));
  for (const BladePose& pose : made.sweep.poses) {
    EXPECT_NEAR((pose.frame.normal - made.planes.at(made.planes.entry + pose.travel).normal).norm(), 0,
                1e-12);
    for (const Vector3d& p : pose.cutPoints(33)) {
      EXPECT_NEAR(p.norm(), kRadius, 0.2);
      EXPECT_NEAR(made.planes.travel(made.planes.level(p)), pose.travel, 1e-7);
    }
  }
}

TEST(TurningRow, IsAsFastAsItIsFarFromTheLineItTurnsAbout) {
  const Made made;
  const StationVelocity& velocity = made.check.velocities[kStations / 2];
  // x of the planes looks to −x: a section begins where it is fast.
  EXPECT_NEAR(velocity.relative.back() / velocity.relative.front(), awayFrom(-kHalf) / awayFrom(kHalf), 0.03);
  // Its fastest point is the outer end of the blade, whose leads go on beyond the surface.
  const double outer = -made.sweep.poses[kStations / 2].blade.start().x();
  EXPECT_NEAR(velocity.speed.front(), made.settings.cuttingSpeed * awayFrom(kHalf) / awayFrom(outer), 0.5);
}

TEST(TurningRow, IsFollowedBetweenItsStations) {
  const Made made;
  EXPECT_EQ(made.way.snaps, 0);
  EXPECT_TRUE(made.way.findings.empty());
  EXPECT_EQ(std::ranges::count(made.way.reached, 1), kStations - 1);
  const WayDeviation way =
      deviationOf(made.way, made.sweep, made.analysis, made.settings, test::SphereSampler(kRadius), {})
          .value();
  EXPECT_LT(way.deviationMax, 0.3);
  EXPECT_LT(way.fromShown, 0.1);
  for (const RowMotion::Instant& instant : made.way.instants) {
    // All of a blade is in one plane of the family, but for what robots cannot do otherwise.
    const double level = made.planes.level(instant.places.front());
    for (const Vector3d& p : instant.places) EXPECT_NEAR(made.planes.at(level).toLocal(p).z(), 0, 0.05);
  }
}

TEST(TurningRow, IsRunAsItIsShown) {
  const Made made;
  Findings findings;
  const EntryExit ends = planEntryExit(made.sweep, {}, {}).value();
  ASSERT_FALSE(ends.entry.poses.empty());
  ASSERT_FALSE(ends.exit.poses.empty());
  // The blade bends outside of the block.
  for (const BladeWay* way : {&ends.entry, &ends.exit})
    for (const BladePose& pose : way->poses)
      for (const Vector3d& p : pose.bladePoints(41)) {
        const Vector3d local = made.sweep.block.frame.toLocal(p);
        EXPECT_FALSE((local.array() > 0).all() && (local.array() < made.sweep.block.size.array()).all());
      }
  const Motion motion = buildMotion(made.sweep, ends, made.way.targets, made.settings, findings).value();
  const Simulation run = simulate(motion, made.settings.blade, made.settings.weight, {}).value();
  EXPECT_FALSE(run.halt);
  EXPECT_TRUE(run.snaps.empty());
  const SimulatedSurface cut =
      compare(run, made.analysis.cut, made.sweep.block, made.planes, test::SphereSampler(kRadius), {})
          .value();
  EXPECT_GT(cut.covered, 0.99);
  EXPECT_LT(cut.toDesignMax, 0.15);
  EXPECT_LT(cut.toTargetMax, 0.3);
  ASSERT_TRUE(run.speeds);
  EXPECT_LT(run.speeds->max, 1.02 * made.settings.cuttingSpeed);
}

TEST(TurningRow, CoversWhatItsBladesPass) {
  const Made made(false);
  // Two triangles on the sphere over its middle, and one before its first plane.
  const auto at = [](double x, double y) -> Vector3d {
    return {x, y, std::sqrt(kRadius * kRadius - x * x - y * y)};
  };
  TriangleMesh inside{{at(-100, -20), at(100, -20), at(0, 40)}, {}, {{0, 1, 2}}};
  test::SphereSampler sphere(kRadius), larger(kRadius + 10);
  EXPECT_TRUE(coverageOf(made.analysis.cut, made.sweep, inside, {1, 0, &sphere}).findings.empty());
  // The same 10 mm farther out is off the cut by these, in whatever plane the nearest of it lies.
  const Coverage off = coverageOf(made.analysis.cut, made.sweep, inside, {1, 0, &larger});
  ASSERT_EQ(off.findings.size(), 1u);
  EXPECT_EQ(std::get<Uncovered>(off.findings[0].cause).where, Uncovered::Where::off);
  EXPECT_NEAR(off.distance, 10, 0.2);
  TriangleMesh before{{at(200, -190), at(220, -190), at(210, -170)}, {}, {{0, 1, 2}}};
  const Coverage missed = coverageOf(made.analysis.cut, made.sweep, before, {1});
  EXPECT_FALSE(missed.findings.empty());
  const Frame& first = made.sweep.poses.front().frame;
  EXPECT_NEAR(missed.distance, -first.toLocal(at(200, -190)).z(), 2) << "mm, across the first plane";
}

TEST(TurningRow, MeltsByTheSpeedOfEachPlace) {
  const Made made(false);
  const KerfField field = KerfField::of(made.sweep, made.check, {{5, 5}, {20, 2}});
  for (std::size_t i = 0; i < made.sweep.poses.size(); ++i) {
    const std::vector<double>& speeds = made.check.velocities[i].speed;
    const std::vector<Vector3d> places = made.sweep.poses[i].cutPoints(int(speeds.size()));
    for (std::size_t k = 0; k < places.size(); k += 16) EXPECT_NEAR(field.speed(places[k]), speeds[k], 1e-3);
  }
}

TEST(TurningRow, GoesOnLiveAndThroughTheWholeBlock) {
  const Made made;
  std::optional<LiveRow> live = LiveRow::of(made.sweep, {});
  ASSERT_TRUE(live);
  std::vector<Section> sections = sectionsIn(made.planes);
  for (Section& section : sections) section.curve() = section.curve().transformed(0, 1, {0, 1});
  ASSERT_TRUE(live->follow(sections, block(), made.planes, {}));
  const std::size_t middle = kStations / 2;
  const auto height = [&](const Sweep& row) { return row.poses[middle].cutPoints(3)[1].z(); };
  EXPECT_NEAR(height(live->sweep()), height(made.sweep) + 1, 0.05);

  const WholeCut whole = wholeCut(made.way.course, made.planes).value();
  // Before its first blade and behind its last one it goes on across their planes.
  const Vector3d begins = whole.grid.at(1, 20) - whole.grid.at(0, 20);
  EXPECT_GT(begins.normalized().dot(made.sweep.poses.front().frame.normal), 0.99);
}

/// The row of a part of the block on a sphere: of each plane that comes into the part, and of the next ones
/// before and behind, the section over all of its width, or until an x.
Sweep partOf(const Vector3d& low, const Vector3d& high, double radius, double until = 1e9) {
  const Box box{Frame{low}, high - low};
  const PlaneFamily planes = PlaneFamily::turning(box, test::fanAlongY(kReach, kTurn)).value();
  std::vector<Section> sections;
  for (int i = 0; i < kStations; ++i) {
    const double level = -kReach + 2 * kReach * i / (kStations - 1);
    Section section{i, planes.travel(level), planes.at(level), {}, -1};
    const Frame& frame = section.frame;
    std::vector<Eigen::Vector2d> points;
    bool comesIn = false;
    constexpr int kFine = 4000;
    constexpr double kApart = 2 * kReach / (kStations - 1);
    for (int k = 0; k <= kFine; ++k) {
      const double x = 400 * (2.0 * k / kFine - 1);
      const Vector3d flat = frame.toWorld(Eigen::Vector2d(x, 0));
      if (flat.x() < low.x() || flat.x() > std::min(high.x(), until)) continue;
      comesIn = comesIn || (flat.y() >= low.y() - kApart && flat.y() <= high.y() + kApart);
      points.emplace_back(x, std::sqrt(radius * radius - flat.head<2>().squaredNorm()) - flat.z());
    }
    if (comesIn) {
      section.branches = {*PlanarCurve::points(points)};
      section.chosen = 0;
    }
    sections.push_back(std::move(section));
  }
  test::RowSettings settings;
  settings.blade.yieldStress = 2000;
  Findings findings;
  return buildSweep(sections, settings, box, planes, {}, findings).value();
}

Joints jointsOf(const Sweep& one, const Sweep& other) {
  return measureJoints({{"one", "cut", &one}, {"other", "cut", &other}}, {}, {}).value();
}

/// What is told of rows that meet, and of one beside it that lies a millimetre higher.
void expectMeets(const Sweep& one, const Sweep& other, const Sweep& raised) {
  const Joints joints = jointsOf(one, other), off = jointsOf(one, raised);
  EXPECT_TRUE(joints.findings.empty());
  ASSERT_EQ(joints.joints.size(), 1u);
  EXPECT_GT(joints.joints[0].places, 40);
  EXPECT_EQ(joints.joints[0].open, 0);
  EXPECT_LT(joints.gapMax(), 0.05);
  EXPECT_LT(joints.kinkMax(), fromDegrees(0.3));
  ASSERT_EQ(off.joints.size(), 1u);
  EXPECT_NEAR(off.gapMax(), 1, 0.1);
}

TEST(TurningRow, MeetsThatOfTheBlockBesideIt) {
  const Vector3d begin(0, -240, 0), end(260, 240, 2 * kRadius);
  expectMeets(partOf({-260, -240, 0}, {0, 240, 2 * kRadius}, kRadius), partOf(begin, end, kRadius),
              partOf(begin, end, kRadius + 1));
}

TEST(TurningRow, MeetsThatOfTheBlockBehindIt) {
  const Vector3d low(-260, -240, 0), high(260, 240, 2 * kRadius);
  for (const double at : {30.0, -20.0}) {
    const Vector3d end(high.x(), at, high.z()), begin(low.x(), at, low.z());
    const Sweep one = partOf(low, end, kRadius);
    expectMeets(one, partOf(begin, high, kRadius), partOf(begin, high, kRadius + 1));
    // One that ends 60 mm before the side of its block.
    const Joints open = jointsOf(one, partOf(begin, high, kRadius, 200));
    ASSERT_EQ(open.joints.size(), 1u);
    EXPECT_GT(open.joints[0].open, 2);
    EXPECT_GT(open.joints[0].openAt.x(), 200);
  }
}

}  // namespace
}  // namespace bw::turning_row
