// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a row says of the blade that is really there: its weight, its crossings and the foam that it leaves.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/motion/motion.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/station_times.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kHalf = 250;

using test::flatBlade;

struct Row {
  Result<Sweep> sweep = fail(ErrorCode::internal, "not made");
  SweepCheck check;
  Findings findings;
};

/// A row over z = height(x), cut towards −Y.
template <class Height>
Row rowOf(const test::RowSettings& settings, Height height, int stations = 9, double half = kHalf) {
  Row row;
  const Box block = test::blockUnder(half, 10.0 * (stations - 1), -2 * half, 2 * half);
  row.sweep = buildSweep(test::sectionsOf(stations, 10, [&](int) { return test::graphCurve(half, height); }),
                         settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, row.findings);
  if (!row.sweep) return row;
  row.check = *checkSweep(*row.sweep, settings, {});
  const Result<SweepAnalysis> analysis =
      test::analysisOf(*row.sweep, settings, test::GraphSampler(half, height), {});
  if (analysis) row.findings.insert(row.findings.end(), analysis->findings.begin(), analysis->findings.end());
  return row;
}

const auto kDome = [](double x) { return 60 * std::cos(kPi * x / (3 * kHalf)); };
const auto kBowl = [](double x) { return -kDome(x); };

/// The grips of a pose, written out once more.
HeavyProblem problemOf(const BladePose& pose, const Blade& blade, double weight) {
  HeavyProblem problem;
  problem.grips.start = pose.blade.start();
  problem.grips.end = pose.blade.at(blade.length).point;
  problem.grips.startAngle = pose.blade.startAngle();
  problem.grips.endAngle = pose.blade.at(blade.length).angle;
  problem.grips.length = blade.length;
  problem.stiffness = blade.flexuralRigidity();
  problem.weight = {0, -weight};
  return problem;
}

TEST(WeightOfBlades, IsThatOfTheirSection) {
  EXPECT_NEAR(flatBlade(800).weight(), 8300e-9 * 5 * 9.80665, 1e-12);
  Blade tube;
  EXPECT_NEAR(tube.weight(), 7850e-9 * kPi / 4 * (9 - 6.25) * 9.80665, 1e-12);
}

TEST(WeightOfBlades, LieOnTheirSectionsAsTheClampedBladeTells) {
  test::RowSettings settings;
  settings.blade = flatBlade(700);
  const Row light = rowOf(settings, kBowl);
  const double weight = 8 * settings.blade.weight();
  settings.weight = -weight * Vector3d::UnitZ();
  const Row heavy = rowOf(settings, kBowl);
  ASSERT_TRUE(light.sweep && heavy.sweep);
  for (std::size_t i = 0; i < heavy.sweep->poses.size(); ++i) {
    const BladePose &a = light.sweep->poses[i], &b = heavy.sweep->poses[i];
    ASSERT_FALSE(a.heavy);
    ASSERT_TRUE(b.heavy);
    EXPECT_GT((a.blade.start() - b.blade.start()).norm(), 0.01) << "the grips are those for the heavy blade";
    EXPECT_GT(heavy.check.stations[i].movedByWeight, 0.2);
    EXPECT_LT(heavy.sweep->fits[i].fit.hausdorff, 0.05) << "and still it lies on its section";
    EXPECT_FALSE(heavy.sweep->fits[i].snapsAt);
    EXPECT_EQ(light.check.stations[i].movedByWeight, 0);
    // The same by the boundary value problem.
    const HeavyProblem problem = problemOf(b, settings.blade, weight);
    ClampedOptions options;
    options.initial = b.blade;
    const Result<HeavyAnswer> answer = solveHeavy(problem, options);
    ASSERT_TRUE(answer) << answer.error().message;
    const std::vector<Vector3d> places = b.bladePoints(21);
    for (int k = 0; k <= 20; ++k)
      EXPECT_LT(
          (places[std::size_t(k)] - b.frame.toWorld(answer->solutions[0].blade.at(700.0 * k / 20).point))
              .norm(),
          1e-5);
    EXPECT_NEAR(heavy.check.stations[i].stabilityMargin, answer->solutions[0].stabilityMargin, 1e-6);
  }
}

TEST(WeightOfBlades, UpDecidesWhatItDoes) {
  test::RowSettings settings;
  settings.blade = flatBlade(700);
  const double weight = settings.blade.weight();
  settings.weight = -weight * Vector3d::UnitZ();
  const double down = rowOf(settings, kDome).check.stations[4].movedByWeight;
  settings.weight = weight * Vector3d::UnitZ();
  const double upside = rowOf(settings, kBowl).check.stations[4].movedByWeight;
  EXPECT_NEAR(down, upside, 1e-6) << "a dome as it is, a bowl upside down";
  settings.weight = -weight * Vector3d::UnitY();
  const Row across = rowOf(settings, kDome);
  EXPECT_LT(across.check.stations[4].movedByWeight, 1e-6) << "a flat blade carries it";
  EXPECT_EQ(across.check.stations[4].sideways, 0);
}

TEST(WeightOfBlades, BendsARoundOneSideways) {
  // Straight, it sags as a clamped beam does.
  test::RowSettings settings;
  settings.blade.length = 900;
  settings.weight = -settings.blade.weight() * Vector3d::UnitY();
  const Row row = rowOf(settings, [](double) { return 0.0; });
  ASSERT_TRUE(row.sweep);
  const double sag = settings.blade.weight() * std::pow(900.0, 4) / (384 * settings.blade.flexuralRigidity());
  EXPECT_GT(sag, 0.5);
  for (const StationCheck& station : row.check.stations) EXPECT_NEAR(station.sideways, sag, 1e-6 * sag);
  const Row bent = rowOf(settings, kDome);
  for (const StationCheck& station : bent.check.stations) EXPECT_GT(station.sideways, 0.1);
}

TEST(WeightOfBlades, TellsWhereTheBladeSnaps) {
  test::RowSettings settings;
  settings.blade = flatBlade(1000);
  settings.blade.yieldStress = 5000;
  // So heavy that no turn of its grips holds it up.
  settings.weight = -20 * settings.blade.weight() * Vector3d::UnitZ();
  const auto dome = [](double x) { return 20 * std::cos(kPi * x / (2.4 * kHalf)); };
  const Row row = rowOf(settings, dome);
  ASSERT_TRUE(row.sweep);
  const Finding* finding = test::findingOf<SnapsInWeight>(row.findings);
  ASSERT_TRUE(finding);
  const auto& cause = std::get<SnapsInWeight>(finding->cause);
  EXPECT_GT(cause.share, 0);
  EXPECT_LT(cause.share, 1);
  EXPECT_GT(cause.distance, 5);
  EXPECT_TRUE(exceedsLimit(row.findings));
  for (const StationCheck& station : row.check.stations) EXPECT_FALSE(station.stable);
  EXPECT_TRUE(test::findingOf<TooFar>(row.findings)) << "what is cut is the surface of the snapped blade";
}

TEST(Certainty, IsThatOfTheBoundaryValueProblem) {
  // What is followed along the row from five stations is what a search finds at each.
  test::RowSettings settings;
  settings.blade = flatBlade(700);
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  const Row row = rowOf(settings, kDome, 17);
  ASSERT_TRUE(row.sweep);
  const Result<RowCertainty> certainty = certaintyOf(*row.sweep, {});
  ASSERT_TRUE(certainty);
  ASSERT_EQ(certainty->stations.size(), 17u);
  for (const std::size_t i : {0u, 3u, 6u, 10u, 16u}) {
    const BladePose& pose = row.sweep->poses[i];
    const HeavyProblem problem = problemOf(pose, settings.blade, settings.blade.weight());
    const Result<HeavyAnswer> all = solveAllHeavy(problem);
    ASSERT_TRUE(all);
    std::optional<double> lowest;
    bool own = false;
    for (const HeavySolution& solution : all->solutions) {
      if (!solution.stable) continue;
      const bool same = (solution.blade.at(350).point - pose.heavy->at(350).point).norm() < 0.01;
      own |= same;
      if (same) {
        EXPECT_NEAR(solution.energy, certainty->stations[i].energy, 1e-6 * std::abs(solution.energy));
      } else if (!lowest) {
        lowest = solution.energy;
      }
    }
    EXPECT_TRUE(own) << i;
    ASSERT_EQ(lowest.has_value(), certainty->stations[i].other.has_value()) << i;
    if (lowest) {
      EXPECT_NEAR(*lowest, certainty->stations[i].other->energy, 1e-6 * std::abs(*lowest));
    }
  }
}

TEST(Certainty, IsNotClaimedWhereNothingIsKnown) {
  test::RowSettings settings;
  settings.blade = flatBlade(700);
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  Row row = rowOf(settings, kDome, 17);
  ASSERT_TRUE(row.sweep);
  row.sweep->fits[0].unknown = "not found";
  row.sweep->fits[6].unknown = "not found";
  const Result<RowCertainty> certainty = certaintyOf(*row.sweep, {});
  ASSERT_TRUE(certainty);
  for (const std::size_t i : {0u, 6u}) {
    EXPECT_FALSE(certainty->stations[i].certain()) << i;
    EXPECT_FALSE(std::isfinite(certainty->stations[i].energy)) << i;
  }
  // Station 0 is one of the five: what it cannot tell of those up to the next is sought again at the first.
  for (const std::size_t i : {1u, 3u, 4u, 7u, 16u})
    EXPECT_TRUE(std::isfinite(certainty->stations[i].energy)) << i;
}

TEST(Crossings, AreErrors) {
  // An Ω: more than half a turn, so that its blade crosses itself beyond it.
  test::RowSettings settings;
  settings.blade.yieldStress = 20000;
  const auto omega = [&](double length) {
    settings.blade.length = length;
    Row row;
    const Box block = test::blockUnder(120, 80, -120, 120);
    row.sweep = buildSweep(test::sectionsOf(9, 10,
                                            [](int) {
                                              return test::arc({0, 0}, 100, kPi / 2 + 2.6, kPi / 2);
                                            }),
                           settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, row.findings);
    if (row.sweep) row.check = *checkSweep(*row.sweep, settings, {});
    return row;
  };
  const Row crossed = omega(700);
  ASSERT_TRUE(crossed.sweep) << crossed.sweep.error().message;
  EXPECT_TRUE(crossed.check.stations[4].crossesItself);
  const Row open = omega(300);
  ASSERT_TRUE(open.sweep);
  EXPECT_FALSE(open.check.stations[4].crossesItself || open.check.stations[4].gripsSwapped);
}

TEST(Leads, GrowUntilTheWholeBladeIsOutsideOfTheBlock) {
  test::RowSettings settings;
  settings.lead = 20;
  Findings findings;
  const Box block{Frame{{-kHalf, -300, -100}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
                  {2 * kHalf, 310, 300}};
  const Result<Sweep> sweep =
      buildSweep(test::sectionsOf(9, 10, [](int) { return test::graphCurve(kHalf - 10, kDome); }), settings,
                 block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  findings.clear();
  const Result<Motion> motion = buildMotion(*sweep, {}, sweep->poses, settings, findings);
  ASSERT_TRUE(motion);
  // 10 mm of foam before the first station, which 20 mm leave; 220 mm after the last one.
  ASSERT_EQ(findings.size(), 1u);
  const auto* grown = std::get_if<LeadGrown>(&findings[0].cause);
  ASSERT_TRUE(grown);
  EXPECT_FALSE(grown->atStart);
  EXPECT_NEAR(grown->grown, 221, 1e-9);
  const auto ends = [&](std::size_t i) {
    return block.frame.toWorld(motion->instants[i].poses[0].position.head<2>(),
                               motion->instants[i].poses[0].position.z());
  };
  EXPECT_NEAR((ends(motion->instants.size() - 1) - ends(motion->instants.size() - 2)).norm(), 221, 1e-9);
  EXPECT_NEAR((ends(1) - ends(0)).norm(), 20, 1e-9);
}

/// How far outside of the block the grips are at the nearest place of their straight ways, mm.
double nearestGrip(const Motion& motion, std::size_t first, std::size_t last) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = first + 1; i <= last; ++i)
    for (std::size_t grip = 0; grip < 2; ++grip)
      for (int k = 0; k <= 400; ++k) {
        const Eigen::Vector3d &from = motion.instants[i - 1].poses[grip].position,
                              &to = motion.instants[i].poses[grip].position;
        const Eigen::Vector3d place = from + k / 400.0 * (to - from);
        nearest = std::min(
            nearest, test::outside(motion.block, motion.block.frame.toWorld(place.head<2>(), place.z())));
      }
  return nearest;
}

TEST(Leads, TellOfGripsThatComeIntoTheBlock) {
  test::RowSettings settings;
  settings.lead = 20;
  settings.clearance = 20;
  settings.blade.length = 560;
  for (const double turned : {0.0, 6.0, 20.0, -20.0}) {
    SCOPED_TRACE(turned);
    const Eigen::AngleAxisd by(fromDegrees(turned), Eigen::Vector3d::UnitZ());
    // The sections end 220 mm before the block, which is turned, so that it comes across the way out.
    const Box block{Frame{by * Eigen::Vector3d(-kHalf, -300, -100), by * Eigen::Vector3d::UnitX(),
                          by * Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
                    {2 * kHalf, 310, 300}};
    Findings findings;
    const Result<Sweep> sweep =
        buildSweep(test::sectionsOf(9, 10, [](int) { return test::graphCurve(kHalf - 10, kDome); }), settings,
                   block, PlaneFamily::across(block, -Eigen::Vector3d::UnitY()), {}, findings);
    ASSERT_TRUE(sweep);
    findings.clear();
    const Result<Motion> motion = buildMotion(*sweep, {}, sweep->poses, settings, findings);
    ASSERT_TRUE(motion);
    const std::size_t last = motion->instants.size() - 1;
    const double nearest = nearestGrip(*motion, last - 1, last);
    const auto told = std::ranges::find_if(findings, [](const Finding& finding) {
      return std::holds_alternative<GripTooNear>(finding.cause) && finding.where.stations->last < 0;
    });
    const bool found = told != findings.end();
    EXPECT_EQ(nearest < settings.clearance - 0.1, found);
    EXPECT_EQ(found, turned != 0);
    if (!found) continue;
    EXPECT_EQ(told->severity, nearest < 0 ? Severity::error : Severity::warning);
    EXPECT_NEAR(std::get<GripTooNear>(told->cause).distance, nearest, 0.2);
    EXPECT_NEAR(test::outside(block, *told->where.point), nearest, 0.2);
    EXPECT_EQ(told->where.stations->first, 8);
    EXPECT_EQ(told->where.stations->count, 0);
    EXPECT_EQ(nearest < 0, std::abs(turned) == 20);
  }
}

TEST(Leads, TellOfAGripInTheBlockInTheAirToo) {
  // Where the stations keep the clearance, and where none does, which is told of them.
  for (const double clearance : {20.0, 60.0}) {
    test::RowSettings settings;
    settings.clearance = clearance;
    settings.blade.length = 560;
    Findings findings;
    const Box block{Frame{{-kHalf, -81, -100},
                          Eigen::Vector3d::UnitX(),
                          Eigen::Vector3d::UnitY(),
                          Eigen::Vector3d::UnitZ()},
                    {2 * kHalf, 82, 300}};
    const Result<Sweep> sweep =
        buildSweep(test::sectionsOf(9, 10, [](int) { return test::graphCurve(kHalf - 10, kDome); }), settings,
                   block, PlaneFamily::across(block, -Eigen::Vector3d::UnitY()), {}, findings);
    ASSERT_TRUE(sweep);
    const auto toldWith = [&](double aside) {
      // The blade comes from beside: past the block, into it, or straight.
      EntryExit ends;
      ends.entry.poses = {sweep->poses.front()};
      ends.entry.poses[0].frame.origin += Eigen::Vector3d(aside, 0, 0);
      Findings told;
      EXPECT_TRUE(buildMotion(*sweep, ends, sweep->poses, settings, told));
      const Finding* found = test::findingOf<GripTooNear>(told);
      return found ? std::optional(*found) : std::nullopt;
    };
    EXPECT_FALSE(toldWith(0));
    const std::optional<Finding> in = toldWith(150);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->severity, Severity::error);
    EXPECT_LT(std::get<GripTooNear>(in->cause).distance, 0);
    EXPECT_EQ(in->where.stations->first, -1);
  }
}

TEST(Leads, CornersAtStationsAreCutByLittle) {
  // Both ends come flat and rise at 60°, which a zone of 1 mm cuts by a quarter of a millimetre.
  const auto motion = [](double rise, double seconds) {
    std::vector<MotionInstant> instants;
    for (const auto& [time, y, z] : {std::array{0.0, -20.0, 0.0},
                                     {1.0, 0.0, 0.0},
                                     {1.0 + seconds, 20 * std::cos(rise), 20 * std::sin(rise)}}) {
      MotionInstant& at = instants.emplace_back();
      at.time = time;
      at.station = time > 0 ? int(instants.size()) - 2 : -1;
      at.poses.resize(2);
      for (std::size_t end = 0; end < 2; ++end) at.poses[end].position = {600.0 * double(end), y, z};
    }
    return instants;
  };
  EXPECT_EQ(plannedZone(motion(0, 1), 1), 1);
  EXPECT_EQ(plannedZone(motion(0, 3), 1), 1) << "it slows down on its way";
  EXPECT_EQ(plannedZone(motion(fromDegrees(10), 1), 1), 1);
  EXPECT_EQ(plannedZone(motion(fromDegrees(30), 1), 1), 0.3);
  EXPECT_EQ(plannedZone(motion(fromDegrees(60), 1), 1), 0.05);
  EXPECT_EQ(plannedZone(motion(fromDegrees(10), 1), 1, 0.02), 0.3) << "the less, the less it may be cut";
  EXPECT_EQ(plannedZone(motion(fromDegrees(30), 1), 1, 0.02), 0.05);
  std::vector<MotionInstant> air = motion(fromDegrees(60), 1);
  air[1].station = -1;
  EXPECT_EQ(plannedZone(air, 1), 1);
}

struct OnSphere {
  Sweep sweep;
  RowMotion motion;
  SweepAnalysis analysis;
  WayDeviation way;
};

/// A row on a sphere and what its blade does between the stations; a large motion tolerance leaves the robots
/// no targets but these.
OnSphere onSphere(double radius, const std::vector<double>& travel, const test::RowSettings& settings) {
  Findings findings;
  const Box block{
      Frame{{-kHalf, -travel.back() - 1, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
      {2 * kHalf, travel.back() + 2, 2 * radius}};
  const Result<Sweep> sweep = buildSweep(test::sphereSections(radius, kHalf, travel), settings, block,
                                         PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  const test::SphereSampler sphere(radius);
  const RowMotion motion = followRow(sweep.value(), settings, {}).value();
  const SweepCheck check = checkSweep(*sweep, settings, {}).value();
  const SweepAnalysis analysis =
      analyzeSweep(*sweep, motion.course, check, settings, sphere, test::interpolated, {}).value();
  return {*sweep, motion, analysis, deviationOf(motion, *sweep, analysis, settings, sphere, {}).value()};
}

/// The farthest from the sphere that elastica lie whose grips are a quarter, half and three quarters of the
/// way between stations: each by the boundary value problem.
double byBoundaryValues(const Sweep& sweep, double radius) {
  double farthest = 0;
  for (std::size_t i = 0; i + 1 < sweep.poses.size(); ++i)
    for (const double f : {0.25, 0.5, 0.75}) {
      const BladePose &a = sweep.poses[i], &b = sweep.poses[i + 1];
      const auto mix = [f](const auto& x, const auto& y) { return (x + f * (y - x)).eval(); };
      const Elastica::State endA = a.blade.at(a.blade.length()), endB = b.blade.at(b.blade.length());
      ClampedProblem grips;
      grips.start = mix(a.blade.start(), b.blade.start());
      grips.end = mix(endA.point, endB.point);
      grips.startAngle = a.blade.startAngle() + f * (b.blade.startAngle() - a.blade.startAngle());
      grips.endAngle = endA.angle + f * (endB.angle - endA.angle);
      grips.length = a.blade.length();
      ClampedOptions options;
      options.initial = a.blade;
      const Result<ClampedAnswer> answer = solveClamped(grips, options);
      if (!answer) return -1;
      const double from = a.before + f * (b.before - a.before),
                   length = a.cut.length() + f * (b.cut.length() - a.cut.length());
      for (int k = 0; k <= 40; ++k) {
        const Vector3d place =
            a.frame.toWorld(answer->solutions[0].elastica.at(from + length * k / 40).point) +
            f * (b.frame.origin - a.frame.origin);
        farthest = std::max(farthest, std::abs(place.norm() - radius));
      }
    }
  return farthest;
}

TEST(OnTheWay, GripsCutChordsBetweenTargets) {
  test::RowSettings settings;
  settings.tolerance = 0.5;
  settings.blade.yieldStress = 2000;
  settings.motionTolerance = 100;
  // Over 80 mm of travel an arc of 700 mm rises by 1.1 mm above its chord; the skin follows it.
  const OnSphere coarse = onSphere(700, {0, 80, 160, 240}, settings);
  EXPECT_EQ(coarse.motion.targets.size(), 4u);
  EXPECT_GT(coarse.way.deviationMax, 1);
  EXPECT_NEAR(coarse.way.deviationMax, byBoundaryValues(coarse.sweep, 700), 1e-4);
  EXPECT_LT(coarse.analysis.summary.deviationMax, 0.3 * coarse.way.deviationMax);
  EXPECT_TRUE(test::findingOf<TooFarOnTheWay>(coarse.way.findings));
  EXPECT_TRUE(exceedsLimit(coarse.way.findings));
  // A quarter of the distance, a sixteenth of the deviation.
  std::vector<double> travel;
  for (int i = 0; i <= 12; ++i) travel.push_back(20 * i);
  const OnSphere fine = onSphere(700, travel, settings);
  EXPECT_NEAR(fine.way.deviationMax, byBoundaryValues(fine.sweep, 700), 1e-4);
  EXPECT_NEAR(fine.way.deviationMax, coarse.way.deviationMax / 16, 0.03);
  EXPECT_NEAR(fine.way.fromShown, fine.way.deviationMax, 0.03);
  EXPECT_TRUE(fine.way.findings.empty());
  EXPECT_EQ(fine.motion.snaps, 0);
  // With weight the same, of a blade that hangs.
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  EXPECT_NEAR(onSphere(700, travel, settings).way.fromShown, fine.way.fromShown, 0.02);
}

TEST(OnTheWay, TargetsAreAddedUntilTheMotionToleranceHolds) {
  test::RowSettings settings;
  settings.tolerance = 0.5;
  settings.blade.yieldStress = 2000;
  for (const bool hangs : {false, true})
    for (const double tolerance : {0.3, 0.1, 0.03}) {
      SCOPED_TRACE(tolerance);
      settings.motionTolerance = tolerance;
      if (hangs) settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
      const OnSphere row = onSphere(700, {0, 80, 160, 240}, settings);
      EXPECT_LE(row.way.fromShown, tolerance);
      // Not more than the chord needs: s²/8r of it is the tolerance.
      const double moves = 240 / std::sqrt(8 * 700 * tolerance);
      EXPECT_LE(double(row.motion.targets.size()), 1.5 * moves + 4);
      EXPECT_TRUE(row.way.findings.empty());
      // The surface shown is that of the targets: what the blade makes, by another route.
      Sweep targets = row.sweep;
      targets.poses = row.motion.targets;
      EXPECT_NEAR(byBoundaryValues(targets, 700), row.way.deviationMax, 0.01);
      int stations = 0;
      for (std::size_t i = 0; i < row.motion.targets.size(); ++i) {
        const BladePose& pose = row.motion.targets[i];
        stations += pose.index >= 0;
        EXPECT_EQ(pose.heavy.has_value(), hangs);
        if (i > 0) {
          EXPECT_GT(pose.travel, row.motion.targets[i - 1].travel);
        }
      }
      EXPECT_EQ(stations, 4);
    }
}

/// s from target to target of the program of a row, without entry and exit.
std::vector<double> pauses(const OnSphere& row, const test::RowSettings& settings, Findings& findings) {
  const Motion motion = buildMotion(row.sweep, {}, row.motion.targets, settings, findings).value();
  std::vector<double> result;
  for (std::size_t i = 2; i + 1 < motion.instants.size(); ++i)  // between the leads
    result.push_back(motion.instants[i].time - motion.instants[i - 1].time);
  return result;
}

TEST(OnTheWay, StationsThatFollowTooSoonArePassedBy) {
  test::RowSettings settings;
  settings.tolerance = 0.5;
  settings.blade.yieldStress = 2000;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  std::vector<double> travel;  // 0.02 s apart
  for (int i = 0; i <= 200; ++i) travel.push_back(0.4 * i);
  const OnSphere row = onSphere(700, travel, settings);
  EXPECT_EQ(row.motion.course.size(), travel.size()) << "the surface goes through all stations";
  EXPECT_LT(row.motion.targets.size(), 45u);
  Findings findings;
  const std::vector<double> times = pauses(row, settings, findings);
  EXPECT_GE(std::ranges::min(times), kTargetSeconds);
  EXPECT_TRUE(findings.empty());
  EXPECT_EQ(row.motion.targets.front().index, 0);
  EXPECT_EQ(row.motion.targets.back().index, 200);
  // Nothing is lost by it: the blade lies on the surface that goes through all of them.
  EXPECT_LE(row.way.fromShown, settings.motionTolerance);
  EXPECT_TRUE(row.way.findings.empty());
  EXPECT_EQ(std::ranges::count(row.motion.reached, 1), 200);
  // The instants say after which station they are, in order.
  EXPECT_TRUE(std::ranges::is_sorted(row.motion.instants, {}, &RowMotion::Instant::station));
}

TEST(OnTheWay, StationsWithoutWhichNothingIsLostAreNoTargets) {
  test::RowSettings settings;
  settings.tolerance = 0.5;
  settings.blade.yieldStress = 2000;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  std::vector<double> travel;  // 0.12 s apart: none follows too soon
  for (int i = 0; i < 400; ++i) travel.push_back(2.4 * i);
  const OnSphere row = onSphere(2000, travel, settings);
  EXPECT_EQ(row.motion.course.size(), travel.size());
  EXPECT_LT(row.motion.targets.size(), 120u);
  EXPECT_LE(row.way.fromShown, settings.motionTolerance);
  EXPECT_TRUE(row.way.findings.empty());
  EXPECT_EQ(row.motion.targets.front().index, 0);
  EXPECT_EQ(row.motion.targets.back().index, 399);
  Findings findings;
  const std::vector<double> times = pauses(row, settings, findings);
  EXPECT_GE(std::ranges::min(times), kTargetSeconds);
  EXPECT_LE(std::ranges::max(times), 1 + kTargetSeconds);
  EXPECT_TRUE(findings.empty());
  // Every station has its time, target or not.
  const Motion motion = buildMotion(row.sweep, {}, row.motion.targets, settings, findings).value();
  const std::vector<double> at = stationTimes(motion, row.sweep.poses);
  ASSERT_EQ(at.size(), travel.size());
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GT(at[i], at[i - 1]) << i;
  for (const MotionInstant& instant : motion.instants)
    if (instant.station >= 0) {
      EXPECT_EQ(at[std::size_t(instant.station)], instant.time);
    }
  EXPECT_TRUE(stationTimes(Motion(), row.sweep.poses).empty());
  // A finer tolerance asks for more of them.
  settings.motionTolerance = 0.01;
  const OnSphere finer = onSphere(2000, travel, settings);
  EXPECT_GT(double(finer.motion.targets.size()), 1.5 * double(row.motion.targets.size()));
  EXPECT_LE(finer.way.fromShown, settings.motionTolerance);
}

TEST(OnTheWay, TargetsThatTheToleranceCrowdsAreTold) {
  test::RowSettings settings;
  settings.tolerance = 0.5;
  settings.blade.yieldStress = 2000;
  settings.motionTolerance = 2e-4;
  std::vector<double> travel;
  for (int i = 0; i <= 40; ++i) travel.push_back(2.0 * i);
  const OnSphere row = onSphere(700, travel, settings);
  EXPECT_GE(row.motion.targets.size(), travel.size());
  Findings findings;
  const std::vector<double> times = pauses(row, settings, findings);
  const TargetsCrowd* crowd = test::findingOf<TargetsCrowd>(findings)
                                  ? &std::get<TargetsCrowd>(test::findingOf<TargetsCrowd>(findings)->cause)
                                  : nullptr;
  ASSERT_TRUE(crowd);
  EXPECT_NEAR(crowd->seconds, std::ranges::min(times), kTimeUnit)
      << "times are rounded as programs state them";
  EXPECT_EQ(crowd->count, std::ranges::count_if(times, [](double t) { return t < kTargetSeconds; }));
}

TEST(OnTheWay, EqualStationsAreLeftByNothing) {
  test::RowSettings settings;
  Findings findings;
  const Box block = test::blockUnder(kHalf, 80, -200, 200);
  const Result<Sweep> sweep =
      buildSweep(test::sectionsOf(5, 20, [](int) { return test::graphCurve(kHalf, kDome); }), settings, block,
                 PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  const test::GraphSampler target(kHalf, kDome);
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, target, {});
  ASSERT_TRUE(analysis);
  const Result<RowMotion> motion = followRow(*sweep, settings, {});
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->targets.size(), 5u);
  const Result<WayDeviation> way = deviationOf(*motion, *sweep, *analysis, settings, target, {});
  ASSERT_TRUE(way);
  EXPECT_LT(way->fromShown, 1e-3);
  EXPECT_TRUE(way->findings.empty());
}

TEST(OnTheWay, StraightBladesCutChordsToo) {
  // Level lines at heights y²/200, 20 mm apart: chords lie 0.5 mm above the middle between two of them.
  test::RowSettings settings;
  Findings findings;
  const Box block = test::blockUnder(kHalf, 160, -10, 200);
  const Result<Sweep> sweep = buildSweep(
      test::sectionsOf(9, 20,
                       [](int i) { return test::graphCurve(kHalf, [i](double) { return 2.0 * i * i; }); }),
      settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  const test::PlaneSampler target(Vector3d::UnitZ());
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, target, {});
  ASSERT_TRUE(analysis);
  const Result<RowMotion> motion = followRow(*sweep, {100, 20}, {});
  ASSERT_TRUE(motion);
  const Result<WayDeviation> way = deviationOf(*motion, *sweep, *analysis, settings, target, {});
  ASSERT_TRUE(way);
  // From the plane z = 0, three quarters of the way from 98 to 128 mm; the parabola is at 120.125 mm there.
  EXPECT_NEAR(way->deviationMax, 120.5, 1e-9);
  EXPECT_NEAR(way->fromShown, 0.5, 0.02) << "the skin leaves the parabola by 0.01";
}

TEST(OnTheWay, BeyondTheEndsOfTheSurfaceShownThereIsNoneToLeave) {
  // A flat target that gets narrower at once, as where its border steps back.
  test::RowSettings settings;
  Findings findings;
  const Box block = test::blockUnder(kHalf, 120, -10, 200);
  const Result<Sweep> sweep = buildSweep(
      test::sectionsOf(
          7, 20,
          [](int i) { return test::graphCurve(i < 3 ? kHalf : 0.5 * kHalf, [](double) { return 0; }); }),
      settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  const test::PlaneSampler target(Vector3d::UnitZ());
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, target, {});
  ASSERT_TRUE(analysis);
  const Result<RowMotion> motion = followRow(*sweep, settings, {});
  ASSERT_TRUE(motion);
  const Result<WayDeviation> way = deviationOf(*motion, *sweep, *analysis, settings, target, {});
  ASSERT_TRUE(way);
  EXPECT_LT(way->fromShown, 0.01);
  EXPECT_FALSE(test::findingOf<OffTheSurfaceShown>(way->findings));
}

TEST(OnTheWay, AnyExcessOverTheToleranceIsTold) {
  // Just above the tolerance, which the surface shown just keeps.
  test::RowSettings settings;
  settings.blade.yieldStress = 2000;
  settings.motionTolerance = 100;
  OnSphere row = onSphere(700, {0, 80, 160, 240}, settings);
  const test::SphereSampler sphere(700);
  WayRequest request = settings;
  request.tolerance = 0.99 * row.way.deviationMax;
  row.analysis.summary.deviationMax = 0.98 * row.way.deviationMax;
  EXPECT_TRUE(exceedsLimit(deviationOf(row.motion, row.sweep, row.analysis, request, sphere, {})->findings));
  request.tolerance = 1.01 * row.way.deviationMax;
  EXPECT_FALSE(exceedsLimit(deviationOf(row.motion, row.sweep, row.analysis, request, sphere, {})->findings));
  EXPECT_TRUE(exceedsLimit({{Severity::warning, LostOnTheWay{"why"}, {}, {}}})) << "what is not known";
}

TEST(OnTheWay, ASnapIsTold) {
  // A dome, a flat blade with little to spare, then a dip: the arch ends on the way.
  test::RowSettings settings;
  settings.blade.yieldStress = 20000;
  Findings findings;
  const Box block = test::blockUnder(kHalf, 80, -300, 300);
  const auto height = [](int i) {
    const double rise = i < 2 ? 60 : -60;
    return [rise](double x) { return rise * std::cos(kPi * x / (2 * kHalf)); };
  };
  const Result<Sweep> sweep =
      buildSweep(test::sectionsOf(4, 20, [&](int i) { return test::graphCurve(kHalf, height(i)); }), settings,
                 block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep);
  const Result<RowMotion> way = followRow(*sweep, settings, {});
  ASSERT_TRUE(way);
  EXPECT_TRUE(test::findingOf<SnapsOnTheWay>(way->findings) ||
              test::findingOf<ArrivesOtherwise>(way->findings));
  EXPECT_TRUE(exceedsLimit(way->findings));
}

}  // namespace
}  // namespace bw
