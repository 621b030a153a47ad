// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A motion that is run: the blade is found from the poses of its ends alone.

#include "bw/core/simulation/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/simulation/barriers.h"
#include "bw/core/simulation/run_findings.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/row_motion.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 700, kHalfWide = 250;

/// A row on a sphere with all that a program is made of.
struct Made {
  Sweep sweep;
  RowMotion way;
  SweepAnalysis analysis;
  WayDeviation deviation;
  Motion motion;
  Made(const test::RowSettings& settings, bool led = true)
      : sweep(rowOf(settings)),
        way(followRow(sweep, settings, {}).value()),
        analysis(analyzeSweep(sweep, way.course, checkSweep(sweep, settings, {}).value(), settings,
                              test::SphereSampler(kRadius), test::interpolated, {})
                     .value()),
        deviation(deviationOf(way, sweep, analysis, settings, test::SphereSampler(kRadius), {}).value()) {
    Findings findings;
    const EntryExit ends = led ? planEntryExit(sweep, {}, {}).value() : EntryExit();
    motion = buildMotion(sweep, ends, way.targets, settings, findings).value();
  }
  static Sweep rowOf(const test::RowSettings& settings) {
    const std::vector<double> travel = {0, 40, 80, 120, 160};
    Findings findings;
    const Box block{Frame{{-kHalfWide, -161, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
                    {2 * kHalfWide, 162, 2 * kRadius}};
    return buildSweep(test::sphereSections(kRadius, kHalfWide, travel), settings, block,
                      PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings)
        .value();
  }
  Result<SimulatedSurface> compared(const Simulation& simulation) const {
    return compare(simulation, analysis.cut, sweep.block, sweep.planes, test::SphereSampler(kRadius), {});
  }
};

test::RowSettings heavySettings() {
  test::RowSettings settings;
  settings.blade.yieldStress = 2000;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  return settings;
}

/// One blade in planes that turn by so much from each to the next, about an upright line 700 mm beside its
/// middle.
Sweep fanOf(const test::RowSettings& settings, double turn, int count) {
  const double length = settings.blade.length;
  Sweep sweep;
  // Aside, so that no lead is needed.
  sweep.block = {Frame{{-500, -500, -900}}, {1000, 1000, 100}};
  sweep.planes = PlaneFamily::across(sweep.block, -Vector3d::UnitY());
  sweep.request = settings;
  const Elastica half = Elastica::make({0, 0}, 0, -1.2 / length, {0, 0}, 0.5 * length).value();
  const Elastica blade = half.segment(-0.5 * length, 0.5 * length).value();
  const Vector3d centre(-700, 0, 0);
  for (int k = 0; k < count; ++k) {
    const Eigen::AngleAxisd turned(-turn * k, Vector3d::UnitZ());
    BladePose pose;
    pose.index = k;
    pose.travel = 700 * turn * k;
    pose.frame = sweep.planes.frame;
    pose.frame.origin = centre - turned * centre;
    for (Vector3d* axis : {&pose.frame.x, &pose.frame.y, &pose.frame.normal}) *axis = turned * *axis;
    pose.cut = pose.blade = blade;
    pose.heavy = hang(blade, settings.blade.flexuralRigidity(),
                      {settings.weight.dot(pose.frame.x), settings.weight.dot(pose.frame.y)})
                     .value()
                     .blade;
    sweep.poses.push_back(pose);
    sweep.fits.push_back({*PlanarCurve::points({{-250, 0}, {0, 1}, {250, 0}})});
  }
  return sweep;
}

TEST(Simulation, PlanesThatTurnAreTimedByTheOuterEnd) {
  test::RowSettings settings = heavySettings();
  settings.lead = 0;
  const double turn = fromDegrees(4);
  const Sweep sweep = fanOf(settings, turn, 5);
  Findings findings;
  const Motion motion = buildMotion(sweep, {}, sweep.poses, settings, findings).value();
  ASSERT_EQ(motion.instants.size(), 5u);
  const double outer = 700 + sweep.poses.front().blade.at(settings.blade.length).point.x();
  ASSERT_GT(outer, 1000);
  const double seconds = 2 * outer * std::sin(0.5 * turn) / settings.cuttingSpeed;
  for (std::size_t i = 1; i < motion.instants.size(); ++i)
    EXPECT_NEAR(motion.instants[i].time - motion.instants[i - 1].time, seconds, 1e-3 * seconds) << i;
  const Simulation simulation = simulate(motion, settings.blade, settings.weight, {}).value();
  EXPECT_FALSE(simulation.halt);
  EXPECT_TRUE(simulation.snaps.empty());
  ASSERT_FALSE(simulation.blades.empty());
  EXPECT_NEAR(std::acos(simulation.blades.back().frame.normal.dot(simulation.blades.front().frame.normal)),
              4 * turn, 1e-6);
}

TEST(Simulation, CutsWhatIsShown) {
  for (const bool hangs : {true, false}) {
    test::RowSettings settings = heavySettings();
    if (!hangs) settings.weight.setZero();
    const Made made(settings);
    const Result<Simulation> run = simulate(made.motion, settings.blade, settings.weight, {});
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_TRUE(run->decided);
    EXPECT_TRUE(run->snaps.empty());
    EXPECT_EQ(run->blades.size(), 4 * (made.motion.instants.size() - 1) + 1);
    EXPECT_NEAR(run->speeds->max, settings.cuttingSpeed, 0.01 * settings.cuttingSpeed);
    const Result<SimulatedSurface> cut = made.compared(*run);
    ASSERT_TRUE(cut);
    EXPECT_LE(cut->toDesignMax, settings.motionTolerance);
    EXPECT_GT(cut->toDesignMax, 0);
    EXPECT_NEAR(cut->covered, 1, 1e-6);
    // With no corners cut, what was found on the way from target to target; at each station the blade of the
    // row, by another route.
    Motion sharp = made.motion;
    for (MotionInstant& instant : sharp.instants) instant.zone = 0;
    const Result<Simulation> exact = simulate(sharp, settings.blade, settings.weight, {});
    ASSERT_TRUE(exact);
    const Result<SimulatedSurface> straight = made.compared(*exact);
    ASSERT_TRUE(straight);
    EXPECT_NEAR(straight->toDesignMax, made.deviation.fromShown, 0.01);
    EXPECT_NEAR(straight->toTargetMax, made.deviation.deviationMax, 0.01);
    EXPECT_NEAR(cut->toDesignMax, straight->toDesignMax, 0.03);
    int met = 0;
    for (const SimulatedBlade& now : exact->blades)
      for (const BladePose& pose : made.sweep.poses) {
        if (std::abs(now.frame.normal.dot(now.frame.origin - pose.frame.origin)) > 1e-6) continue;
        ++met;
        const Vector3d here = now.frame.toWorld(now.blade.at(400).point);
        EXPECT_LT((here - pose.bladePoints(3)[1]).norm(), 5 * kPlaceUnit) << "grips are told in such units";
      }
    EXPECT_EQ(met, 5);
  }
}

TEST(Simulation, StraightBladesStaySoAsTheyTurn) {
  // Lines that turn by up to 2.8° from one to the next: of targets that are a blade's length apart the grips
  // come nearer to each other on the way, and a micrometre of slack is half a millimetre of sag.
  test::RowSettings settings = heavySettings();
  const auto slope = [](double travel) { return 0.35 * std::sin(2 * kPi * travel / 400); };
  const auto sections = test::sectionsOf(
      21, 20, [&](int i) { return test::graphCurve(250, [&](double x) { return slope(20.0 * i) * x; }); });
  const Box block = test::blockUnder(250, 400, -120, 200);
  Findings findings;
  const Result<Sweep> sweep =
      buildSweep(sections, settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  const RowMotion way = followRow(*sweep, settings, {}).value();
  EXPECT_LT(way.targets.size(), 10 * sections.size());
  const Motion motion = buildMotion(*sweep, {}, way.targets, settings, findings).value();
  EXPECT_FALSE(test::findingOf<TargetsCrowd>(findings)) << "they need not follow at once";
  const double length = settings.blade.length;
  double most = 0;
  for (std::size_t i = 1; i < motion.instants.size(); ++i)
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      Vector3d chord = Vector3d::Zero();
      for (const auto& [at, part] : {std::pair(i - 1, 1 - share), {i, share}})
        chord += part * (motion.instants[at].poses[1].position - motion.instants[at].poses[0].position);
      EXPECT_GE(chord.norm(), length) << i << ' ' << share;
      most = std::max(most, chord.norm() - length);
    }
  EXPECT_LE(most, mostPull(length) + 2 * kPlaceUnit);
  EXPECT_GT(most, 0.1 * mostPull(length));
  const Simulation run = simulate(motion, settings.blade, settings.weight, {}).value();
  EXPECT_FALSE(run.halt);
  EXPECT_EQ(run.straightWithin, 0);
  for (const SimulatedBlade& now : run.blades) EXPECT_LT(now.blade.maxCurvature(), 1e-12);
  EXPECT_NEAR(run.speeds->max, settings.cuttingSpeed, 0.01 * settings.cuttingSpeed);
}

TEST(Simulation, RunsAtTheCuttingSpeedBetweenTargetsToo) {
  // A blade that is let go slack bulges fastest at once: twice the slack is only 1.4 times the bulge.
  test::RowSettings settings = heavySettings();
  settings.blade.length = 620;
  const auto sections = test::sectionsOf(
      5, 2, [](int i) { return test::graphCurve(250, [&](double x) { return -1e-4 * i * x * x; }); });
  const Box block = test::blockUnder(250, 8, -50, 50);
  Findings findings;
  const Result<Sweep> sweep =
      buildSweep(sections, settings, block, PlaneFamily::across(block, -Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  // At once from the straight blade to the slackest one.
  Motion motion =
      buildMotion(*sweep, {}, {sweep->poses.front(), sweep->poses.back()}, settings, findings).value();
  for (MotionInstant& instant : motion.instants) instant.zone = 0;
  const Result<Simulation> run = simulate(motion, settings.blade, settings.weight, {});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_LT(run->speeds->max, 1.01 * settings.cuttingSpeed);
  EXPECT_GT(run->speeds->max, 0.95 * settings.cuttingSpeed);
}

TEST(Simulation, CornersAreParabolasWithinTheirZones) {
  // Three targets of a blade held straight, in an angle: in the middle the corner is missed by a quarter of
  // what both moves go in the time of the zone; one that is larger than half of them is that long.
  Motion motion;
  motion.block = test::blockUnder(kHalfWide, 80, -200, 200);
  motion.bladeLength = 500;
  const auto at = [](double time, double travel, double height, double zone) {
    const Eigen::Quaterniond right(Eigen::AngleAxisd(kPi, Vector3d::UnitY()));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX()));
    return MotionInstant{
        time, 0, {{Vector3d(0, travel, height), turn}, {Vector3d(500, travel, height), right * turn}}, zone};
  };
  for (const auto& [zone, missed] : {std::pair(0.0, 0.0), {1.0, 0.25}, {50.0, 1.25}}) {
    motion.instants = {at(0, 0, 0, 0), at(1, 10, 0, zone), at(2, 10, 10, 0)};
    const Result<Simulation> run = simulate(motion, Blade(), Vector3d::Zero(), {});
    ASSERT_TRUE(run) << run.error().message;
    const SimulatedBlade& middle = run->blades[4];
    EXPECT_NEAR(middle.time, 1, 1e-12);
    const Vector3d place = motion.block.frame.toLocal(middle.frame.toWorld(middle.blade.at(250).point));
    EXPECT_NEAR(place.y(), 10 - missed, 1e-9);
    EXPECT_NEAR(place.z(), missed, 1e-9);
    // It leaves the straight line at the edge of its zone, and no sooner.
    const SimulatedBlade& before = run->blades[3];
    const Vector3d onTheLine = motion.block.frame.toLocal(before.frame.toWorld(before.blade.at(250).point));
    if (zone <= 2.5) {
      EXPECT_NEAR(onTheLine.y(), 7.5, 1e-9);
    } else {
      EXPECT_GT(onTheLine.z(), 0.1);
    }
  }
}

TEST(Simulation, AMovedTargetIsSeen) {
  const test::RowSettings settings = heavySettings();
  Made made(settings);
  const std::size_t middle = made.motion.instants.size() / 2;
  made.motion.instants[middle].poses[0].position.z() += 3;
  const Result<Simulation> run = simulate(made.motion, settings.blade, settings.weight, {});
  ASSERT_TRUE(run);
  EXPECT_GT(made.compared(*run)->toDesignMax, 1);
  // Another weight is another surface.
  Made own(settings);
  const Result<Simulation> heavier = simulate(own.motion, settings.blade, 30 * settings.weight, {});
  ASSERT_TRUE(heavier);
  EXPECT_GT(own.compared(*heavier)->toDesignMax, 2 * own.deviation.fromShown);
}

TEST(Simulation, CoversTheTravelWhicheverWayItGoes) {
  const test::RowSettings settings = heavySettings();
  const Made made(settings);
  const auto covered = [&](const Motion& motion) {
    const Simulation run = simulate(motion, settings.blade, settings.weight, {}).value();
    return made.compared(run).value().covered;
  };
  Motion back = made.motion;
  std::ranges::reverse(back.instants);
  for (MotionInstant& instant : back.instants) instant.time = made.motion.duration() - instant.time;
  EXPECT_NEAR(covered(back), 1, 1e-6);
  // Up to the middle, back and up to there again it is half of it as well.
  Motion half = made.motion;
  half.instants.resize(half.instants.size() / 2);
  const double once = covered(half);
  EXPECT_GT(once, 0.2);
  EXPECT_LT(once, 0.8);
  Motion thrice = half;
  const double pause = half.instants[1].time - half.instants[0].time;
  for (const bool again : {false, true}) {
    std::vector<MotionInstant> more = half.instants;
    if (!again) std::ranges::reverse(more);
    const double from = thrice.duration() + pause;
    for (MotionInstant& instant : more) {
      instant.time = from + (again ? instant.time : half.duration() - instant.time);
      thrice.instants.push_back(instant);
    }
  }
  EXPECT_NEAR(covered(thrice), once, 0.02);
}

TEST(Simulation, HaltsWhereNoBladeCanFollow) {
  const test::RowSettings settings = heavySettings();
  const Made made(settings);
  const std::size_t changed = made.motion.instants.size() / 2;
  const Result<Simulation> whole = simulate(made.motion, settings.blade, settings.weight, {});
  ASSERT_TRUE(whole);
  EXPECT_FALSE(whole->halt);
  const auto halted = [&](auto change) {
    Motion motion = made.motion;
    for (MotionInstant& instant : motion.instants) instant.zone = 0;
    change(motion.instants[changed]);
    Result<Simulation> run = simulate(motion, settings.blade, settings.weight, {});
    EXPECT_TRUE(run && run->halt);
    return run.value();
  };
  const Simulation torn = halted(
      [](MotionInstant& at) { at.poses[0].position += 0.5 * (at.poses[0].position - at.poses[1].position); });
  EXPECT_EQ(torn.halt->why, Halt::Why::tears);
  EXPECT_GT(torn.halt->apart, settings.blade.length);
  EXPECT_EQ(torn.halt->instant, changed - 1) << "on the way there";
  EXPECT_GT(torn.halt->time, made.motion.instants[changed - 1].time);
  EXPECT_LT(torn.halt->time, made.motion.instants[changed].time);
  // What comes before is as it is without the change, and it is told where it ends.
  ASSERT_GE(torn.blades.size(), 4 * (changed - 1) + 1);
  ASSERT_LT(torn.blades.size(), 4 * changed + 1);
  EXPECT_LT(torn.blades.back().time, torn.halt->time);
  EXPECT_LT(
      (torn.blades.back().frame.toWorld(torn.blades.back().blade.at(400).point) - torn.halt->place).norm(),
      400);
  const Result<SimulatedSurface> part = made.compared(torn);
  ASSERT_TRUE(part);
  EXPECT_GT(part->covered, 0);
  EXPECT_LT(part->covered, 0.9);
  const Findings told = runFindings(torn, *part, made.motion, made.analysis, {}, {});
  const Finding* lost = test::findingOf<LostOnTheWay>(told);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->severity, Severity::error);
  EXPECT_NE(std::get<LostOnTheWay>(lost->cause).why.find("farther apart"), std::string::npos);

  const Simulation tilted = halted([](MotionInstant& at) { at.poses[0].position.y() += 2; });
  EXPECT_EQ(tilted.halt->why, Halt::Why::offPlane);
  EXPECT_GT(tilted.halt->off, 0.5);
  const Simulation twisted = halted([](MotionInstant& at) {
    at.poses[0].rotation =
        Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Vector3d::UnitX())) * at.poses[0].rotation;
  });
  EXPECT_EQ(twisted.halt->why, Halt::Why::offPlane);
  EXPECT_GT(twisted.halt->twist, fromDegrees(0.5));
  const Result<Simulation> heavy = simulate(made.motion, settings.blade, 1e5 * settings.weight, {});
  ASSERT_TRUE(heavy && heavy->halt);
  EXPECT_EQ(heavy->halt->why, Halt::Why::lost);
  EXPECT_NE(heavy->halt->reason, "");
  EXPECT_TRUE(heavy->blades.empty());
  const Result<SimulatedSurface> none = made.compared(*heavy);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->covered, 0);
}

TEST(Simulation, RefusesWhatIsNoMotionOfABlade) {
  const test::RowSettings settings = heavySettings();
  const Made made(settings);
  const auto refused = [&](auto change) {
    Motion motion = made.motion;
    change(motion);
    const Result<Simulation> run = simulate(motion, settings.blade, settings.weight, {});
    return run ? std::string("ran") : run.error().message;
  };
  EXPECT_NE(refused([](Motion& m) { m.instants.resize(1); }).find("two instants"), std::string::npos);
  EXPECT_NE(refused([](Motion& m) {
              for (MotionInstant& instant : m.instants) instant.poses.resize(1);
            }).find("two ends"),
            std::string::npos);
}

/// The pose of an end whose blade goes on inward, in a plane across y.
Pose endAt(const Vector3d& place, const Vector3d& inward) {
  Eigen::Matrix3d axes;
  axes << inward, Vector3d::UnitY().cross(inward), Vector3d::UnitY();
  return {place, Eigen::Quaterniond(axes)};
}

/// A blade of 800 mm with grips 780 mm apart, tilted by an angle towards one side at each of some times.
Motion tilting(const std::vector<std::pair<double, double>>& angles) {
  Motion motion;
  motion.block = {Frame{}, {100, 100, 100}};
  motion.bladeLength = 800;
  motion.cuttingSpeed = 20;
  for (const auto& [time, angle] : angles) {
    MotionInstant instant{time, -1, {}};
    instant.poses = {endAt({0, 10 * time, 0}, {std::cos(angle), 0, std::sin(angle)}),
                     endAt({780, 10 * time, 0}, {-std::cos(angle), 0, std::sin(angle)})};
    motion.instants.push_back(instant);
  }
  return motion;
}

std::vector<std::pair<double, double>> fromSideToSide() {
  std::vector<std::pair<double, double>> angles;
  for (int i = 0; i <= 10; ++i) angles.emplace_back(i, 0.5 - 0.1 * i);
  return angles;
}

TEST(Barriers, AreThoseOfTheBoundaryValueProblem) {
  // On the wrong side of its grips a blade needs less and less to be brought over, until it snaps.
  const Blade blade;
  const double stiffness = blade.flexuralRigidity();
  Simulation run = simulate(tilting(fromSideToSide()), blade, Vector3d::Zero(), {}).value();
  ASSERT_EQ(run.snaps.size(), 1u);
  const double snap = run.snaps[0].time;
  const std::vector<BarrierLook> looks = barriersAlong(run, stiffness, {}).value();
  ASSERT_GE(looks.size(), 12u);
  int unsure = 0;
  double before = 1e300;
  for (const BarrierLook& look : looks) {
    if (look.time < 4 || look.time >= snap) {
      EXPECT_FALSE(look.unsure) << look.time;
      EXPECT_FALSE(look.barrier) << look.time;
      continue;
    }
    if (!look.unsure) continue;
    ++unsure;
    ASSERT_TRUE(look.barrier) << look.time;
    EXPECT_LT(*look.barrier, before) << look.time;
    before = *look.barrier;
    // Without weight the way over is the lowest shape that does not rest.
    const auto at = std::ranges::find(run.blades, look.time, &SimulatedBlade::time);
    const HeavyProblem problem = holdOf(at->blade, stiffness);
    const ClampedAnswer all = solveAllClamped(problem.grips).value();
    std::optional<double> pass;
    for (const ClampedSolution& solution : all.solutions)
      if (!solution.stable && (!pass || solution.energy < *pass)) pass = solution.energy;
    ASSERT_TRUE(pass);
    EXPECT_NEAR(*look.barrier, stiffness * (*pass - at->blade.energy()), 1e-6 * stiffness * *pass)
        << look.time;
  }
  EXPECT_GE(unsure, 4);
  const BarrierLook* least = leastBarrier(looks);
  ASSERT_TRUE(least);
  EXPECT_EQ(*least->barrier, before);
  RunContext alone;
  alone.threads = 1;
  const std::vector<BarrierLook> again = barriersAlong(run, stiffness, alone).value();
  ASSERT_EQ(again.size(), looks.size());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    EXPECT_EQ(again[i].time, looks[i].time);
    EXPECT_EQ(again[i].barrier, looks[i].barrier);
  }
  // The place is told once, unless its stations are known to be lost.
  const Motion motion = tilting(fromSideToSide());
  CheckRequest request;
  const auto told = [&](const std::vector<BarrierLook>& some, double margin, const Findings& known,
                        const std::vector<char>& snaps = {}) {
    request.margin = margin;
    return restFindings(some, snaps, run, motion, request, known);
  };
  EXPECT_EQ(told(looks, 0, {}).empty(), *least->barrier >= kLeastBarrier);
  BarrierLook weakest = *least;
  weakest.barrier = 0.5 * kLeastBarrier;
  const Findings low = told({looks.front(), weakest}, 0, {});
  ASSERT_EQ(low.size(), 1u);
  const auto& cause = std::get<OtherShape>(low[0].cause);
  EXPECT_EQ(low[0].severity, Severity::error);
  EXPECT_EQ(cause.lost, OtherShape::Lost::lowBarrier);
  EXPECT_EQ(cause.barrier, weakest.barrier);
  EXPECT_GT(cause.distance, 10);
  EXPECT_GT(cause.energy, cause.other) << "it is on the wrong side";
  EXPECT_EQ(low[0].where.stations->count, 0);
  EXPECT_TRUE(told({weakest}, 0, low).empty());
  std::vector<BarrierLook> others = {looks.front()};
  EXPECT_TRUE(told(others, 0, {}).empty()) << "it has one shape there";
  others.front().unsure = true;
  const Findings unknown = told(others, 0, {});
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_EQ(std::get<OtherShape>(unknown[0].cause).lost, OtherShape::Lost::unsought) << "none is known";
  others.front().distance = 3;
  EXPECT_EQ(std::get<OtherShape>(told(others, 0, {})[0].cause).lost, OtherShape::Lost::unknownBarrier);
  // So is a margin that falls short, unless that of a station beside is known to.
  const double asked = 0.3;
  const Findings loose = told({}, asked, {});
  ASSERT_EQ(loose.size(), 1u);
  EXPECT_EQ(loose[0].severity, Severity::warning);
  EXPECT_EQ(std::get<LowMargin>(loose[0].cause).margin, run.marginMin);
  EXPECT_EQ(loose[0].where.stations->count, 0);
  EXPECT_TRUE(told({}, asked, loose).empty());
  EXPECT_TRUE(told({}, run.marginMin + 0.5 * kMarginRounded, {}).empty());
  // So is where it snaps once a grip is off: as many moments in a row as one.
  std::vector<char> snaps(run.blades.size(), 0);
  std::fill_n(snaps.begin() + std::ptrdiff_t(snaps.size() / 2), 3, char(1));
  const Findings snapping = told({}, 0, {}, snaps);
  ASSERT_EQ(snapping.size(), 1u);
  EXPECT_EQ(snapping[0].severity, Severity::error);
  EXPECT_TRUE(std::get<GripErrors>(snapping[0].cause).snaps);
  EXPECT_EQ(snapping[0].where.stations->count, 0);
  EXPECT_TRUE(told({}, 0, snapping, snaps).empty());
  run.blades.clear();
  EXPECT_TRUE(barriersAlong(run, stiffness, {}).value().empty());
  EXPECT_EQ(leastBarrier({}), nullptr);
}

TEST(Barriers, AreThoseOfTheBladeWithItsWeight) {
  const Blade blade;
  const double stiffness = blade.flexuralRigidity();
  const Simulation run =
      simulate(tilting(fromSideToSide()), blade, -4 * blade.weight() * Vector3d::UnitZ(), {}).value();
  const std::vector<BarrierLook> looks = barriersAlong(run, stiffness, {}).value();
  int known = 0;
  for (const BarrierLook& look : looks) {
    if (!look.barrier) continue;
    ++known;
    const auto at = std::ranges::find(run.blades, look.time, &SimulatedBlade::time);
    const HeavyAnswer all = solveAllHeavy(holdOf(at->blade, stiffness)).value();
    std::optional<double> own;
    for (const HeavySolution& solution : all.solutions)
      if ((solution.blade.at(400).point - at->blade.at(400).point).norm() < 1e-4) own = solution.barrier;
    ASSERT_TRUE(own) << look.time;
    EXPECT_NEAR(*look.barrier, *own, 1e-6 * (1 + *own)) << look.time;
  }
  EXPECT_GE(known, 3);
}

TEST(Simulation, ASnapAndAnUndecidedStartAreTold) {
  // A blade held straight with slack may buckle to either side; pushed over, it snaps.
  const Blade blade;
  const Result<Simulation> slack = simulate(tilting({{0, 0}, {1, 0.05}}), blade, Vector3d::Zero(), {});
  ASSERT_TRUE(slack) << slack.error().message;
  EXPECT_FALSE(slack->decided);
  const Result<Simulation> over = simulate(tilting(fromSideToSide()), blade, Vector3d::Zero(), {});
  ASSERT_TRUE(over) << over.error().message;
  EXPECT_TRUE(over->decided);
  ASSERT_EQ(over->snaps.size(), 1u);
  EXPECT_GT(over->snaps[0].time, 5) << "it stays on its side for a while";
  EXPECT_GT(over->speeds->max, 100);
  const auto height = [&](const SimulatedBlade& now) {
    return now.frame.toWorld(now.blade.at(400).point).z();
  };
  EXPECT_GT(height(over->blades.front()) * -height(over->blades.back()), 0);
  // Either is an error of a design whose motion does so, unless it is told already.
  const Motion motion = tilting(fromSideToSide());
  const Findings snaps = runFindings(*over, {}, motion, {}, {}, {});
  const Finding* snap = test::findingOf<SnapsOnTheWay>(snaps);
  ASSERT_TRUE(snap);
  EXPECT_EQ(snap->severity, Severity::error);
  EXPECT_FALSE(test::findingOf<NoWay>(snaps));
  EXPECT_EQ(runFindings(*over, {}, motion, {}, {}, snaps).size(), 0u);
  const Motion still = tilting({{0, 0}, {1, 0.05}});
  const Findings undecided = runFindings(*slack, {}, still, {}, {}, {});
  const Finding* begins = test::findingOf<NoWay>(undecided);
  ASSERT_TRUE(begins);
  EXPECT_TRUE(std::get<NoWay>(begins->cause).entry);
  EXPECT_EQ(runFindings(*slack, {}, still, {}, {}, undecided).size(), 0u);
}

TEST(Simulation, MeansAreOverTheAreaThatIsCut) {
  // A straight blade over a flat surface: 100 mm on it, 10 mm up to a mm above it, and 200 mm there, in moves
  // of all lengths.
  Motion motion;
  motion.block = {Frame{{0, 0, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {500, 310, 50}};
  motion.bladeLength = 700;
  for (const auto& [time, travel, height] :
       {std::array{0.0, 0.0, 0.0}, {5.0, 100.0, 0.0}, {6.0, 110.0, 1.0}, {26.0, 310.0, 1.0}})
    motion.instants.push_back(
        {time,
         0,
         {endAt({-100, travel, height}, Vector3d::UnitX()), endAt({600, travel, height}, -Vector3d::UnitX())},
         0.0});
  SurfaceGrid shown;
  shown.columns = 26;
  for (double travel = 0; travel <= 310; travel += 10, ++shown.rows)
    for (int c = 0; c < shown.columns; ++c) shown.points.emplace_back(20 * c, travel, 0);
  const Result<Simulation> run = simulate(motion, Blade(), Vector3d::Zero(), {});
  ASSERT_TRUE(run && !run->halt);
  SurfaceGrid cut;
  const Result<SimulatedSurface> surface =
      compare(*run, shown, motion.block, PlaneFamily::across(motion.block, Vector3d::UnitY()),
              test::PlaneSampler(Vector3d::UnitZ()), {}, &cut);
  ASSERT_TRUE(surface);
  const double slope = std::hypot(10.0, 1.0), mean = (0.5 * slope + 200) / (100 + slope + 200);
  EXPECT_NEAR(surface->toDesignMean, mean, 1e-6);
  EXPECT_NEAR(surface->toTargetMean, mean, 1e-6);
  EXPECT_NEAR(surface->covered, 1, 1e-9);
  for (const auto& [most, at] :
       {std::pair(surface->toDesignMax, surface->toDesignAt), {surface->toTargetMax, surface->toTargetAt}}) {
    EXPECT_NEAR(most, 1, 1e-9);
    EXPECT_NEAR(at.place.z(), 1, 1e-9);
    EXPECT_GE(at.time, 6 - 1e-9);
    EXPECT_GE(at.place.x(), -1e-9);
    EXPECT_LE(at.place.x(), 500 + 1e-9);
    EXPECT_NEAR(at.place.y(), at.time < 6 + 1e-9 ? 110 : 110 + 10 * (at.time - 6), 1e-6);
  }
  ASSERT_TRUE(surface->speeds && run->speeds);
  for (const RunSpeeds& speeds : {*surface->speeds, *run->speeds}) {
    EXPECT_NEAR(speeds.min, 10, 1e-9);
    EXPECT_GT(speeds.minAt.time, 6);
    EXPECT_NEAR(speeds.max, 20, 1e-9);
    EXPECT_GT(speeds.maxAt.time, 0);
    EXPECT_LE(speeds.maxAt.time, 5);
  }
  // What is cut ends where the surface does, and its fields are these distances.
  ASSERT_EQ(cut.rows, 13);
  ASSERT_EQ(cut.points.size(), std::size_t(cut.rows) * std::size_t(cut.columns));
  for (int r = 0; r < cut.rows; ++r) {
    EXPECT_NEAR(cut.at(r, 0).x(), 0, 0.01);
    EXPECT_NEAR(cut.at(r, cut.columns - 1).x(), 500, 0.01);
  }
  for (std::size_t i = 0; i < cut.points.size(); ++i) {
    EXPECT_NEAR(cut.field("deviation")->values[i], cut.points[i].z(), 1e-9);
    EXPECT_NEAR(cut.field("from_shown")->values[i], cut.points[i].z(), 1e-9);
  }
}

/// An arch of 800 mm with grips tilted and apart by so much at each second.
Motion arching(const std::vector<double>& tilts, const std::vector<double>& bases,
               const std::vector<int>& stations) {
  Motion motion;
  motion.block = {Frame{}, {100, 100, 100}};
  motion.bladeLength = 800;
  for (std::size_t i = 0; i < tilts.size(); ++i) {
    const double c = std::cos(tilts[i]), s = std::sin(tilts[i]), y = 10 * double(i);
    motion.instants.push_back(
        {double(i), stations[i], {endAt({0, y, 0}, {c, 0, s}), endAt({bases[i], y, 0}, {-c, 0, s})}, 0.0});
  }
  return motion;
}

/// Its grips are tilted over and brought together, until its feet cross.
Motion closing() { return arching({0.5, 1.6, 2.3, 2.3}, {700, 400, 150, -60}, {-1, -1, 5, 10}); }

TEST(Simulation, SeesABladeThatCrossesItselfBetweenTargets) {
  const Motion motion = closing();
  const Result<Simulation> run = simulate(motion, Blade(), Vector3d::Zero(), {});
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_FALSE(run->halt) << run->halt->time << " " << run->halt->reason;
  const std::vector<RunStretch> crossings = run->crossings();
  ASSERT_EQ(crossings.size(), 1u);
  const SimulatedBlade &first = run->blades[crossings[0].first], &last = run->blades[crossings[0].last];
  EXPECT_GT(first.time, 2) << "with its feet apart it does not";
  EXPECT_LT(first.time, 3) << "and between its targets it does";
  EXPECT_EQ(last.time, 3);
  for (const SimulatedBlade& at : run->blades)
    EXPECT_EQ(at.crossesItself, at.blade.at(800).point.x() < at.blade.at(0).point.x()) << at.time;
  const Findings told = runFindings(*run, {}, motion, {}, {}, {});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].severity, Severity::error);
  EXPECT_TRUE(std::get<BladeCrosses>(told[0].cause).itself);
  EXPECT_EQ(told[0].where.stations, (StationRange{5, 10, 5, 0}));
  ASSERT_TRUE(told[0].where.point);
  const auto with = [&](const StationRange& stations) {
    return runFindings(*run, {}, motion, {}, {}, {{Severity::error, BladeCrosses{true}, {stations, {}}, {}}});
  };
  EXPECT_TRUE(with(StationRange::of(10)).empty()) << "what is told at a station is not told again";
  EXPECT_EQ(with(StationRange::of(11)).size(), 1u);
  // On the way in: no station is before it.
  Motion early = motion;
  for (MotionInstant& instant : early.instants) instant.station = -1;
  early.instants.back().station = 3;
  EXPECT_EQ(runFindings(*run, {}, early, {}, {}, {})[0].where.stations, (StationRange{-1, 3, 3, 0}));
}

TEST(Simulation, SeesARoundBladeThatDoesNotRestInItsPlane) {
  // Pressed together it would rather twist; a flat one is stiff across its plane.
  const Motion motion = arching({0.1, 0.1, 0.1}, {600, 500, 250}, {-1, 7, -1});
  Blade blade;
  const Result<Simulation> round = simulate(motion, blade, Vector3d::Zero(), {});
  ASSERT_TRUE(round && !round->halt);
  const std::vector<RunStretch> twists = round->twists();
  ASSERT_EQ(twists.size(), 1u);
  EXPECT_GT(round->blades[twists[0].first].time, 1);
  EXPECT_EQ(twists[0].last + 1, round->blades.size());
  EXPECT_EQ(twists[0].worst, twists[0].last) << "the more it is pressed";
  for (const SimulatedBlade& at : round->blades)
    EXPECT_NEAR(at.outOfPlaneMargin, marginsOf(at.blade).outOfPlane, 1e-9) << at.time;
  const Findings told = runFindings(*round, {}, motion, {}, {}, {});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<WouldTwist>(told[0].cause));
  EXPECT_EQ(told[0].where.stations, (StationRange{7, -1, 7, 0})) << "on the way out";
  blade.section = Blade::Section::flat;
  blade.width = 5;
  blade.thickness = 1;
  const Result<Simulation> flat = simulate(motion, blade, Vector3d::Zero(), {});
  ASSERT_TRUE(flat && !flat->halt);
  EXPECT_TRUE(flat->twists().empty());
  EXPECT_TRUE(runFindings(*flat, {}, motion, {}, {}, {}).empty());
}

TEST(Simulation, FasterThanTheCuttingSpeedIsAFinding) {
  const test::RowSettings settings = heavySettings();
  const Made made(settings);
  Motion fast = made.motion;
  const auto told = [&] {
    const Simulation run = simulate(fast, settings.blade, settings.weight, {}).value();
    return runFindings(run, made.compared(run).value(), fast, made.analysis, settings, {});
  };
  EXPECT_TRUE(told().empty());
  // The third move in 0.8 of its time.
  const double saved = 0.2 * (fast.instants[3].time - fast.instants[2].time);
  for (std::size_t i = 3; i < fast.instants.size(); ++i) fast.instants[i].time -= saved;
  const Findings findings = told();
  ASSERT_EQ(findings.size(), 1u);
  const auto& cause = std::get<TooFastOnTheWay>(findings[0].cause);
  EXPECT_NEAR(cause.speed, settings.cuttingSpeed / 0.8, 0.03 * settings.cuttingSpeed);
  EXPECT_EQ(cause.limit, settings.cuttingSpeed);
  EXPECT_TRUE(exceedsLimit(findings));
  ASSERT_TRUE(findings[0].where.stations);
  EXPECT_EQ(findings[0].where.stations->first, fast.instants[2].station);
}

TEST(Simulation, WhatACornerCutsAwayIsAFinding) {
  const test::RowSettings settings = heavySettings();
  const Made made(settings);
  Motion wide = made.motion;
  for (std::size_t i = 1; i + 1 < wide.instants.size(); ++i) wide.instants[i].zone = 50;
  const Result<Simulation> run = simulate(wide, settings.blade, settings.weight, {});
  ASSERT_TRUE(run);
  const SimulatedSurface cut = made.compared(*run).value();
  WayRequest request{settings.tolerance, settings.clearance, 0.5 * cut.toDesignMax};
  const Findings told = runFindings(*run, cut, wide, made.analysis, request, {});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(std::get<OffTheSurfaceShown>(told[0].cause).distance, cut.toDesignMax);
  ASSERT_TRUE(told[0].where.stations);
  EXPECT_TRUE(runFindings(*run, cut, wide, made.analysis, request, told).empty());
  request.motionTolerance = 2 * cut.toDesignMax;
  EXPECT_TRUE(runFindings(*run, cut, wide, made.analysis, request, {}).empty());
}

}  // namespace
}  // namespace bw
