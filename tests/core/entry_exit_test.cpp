// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How a blade is led into its row and out of it, and what keeps it in its shapes.

#include "bw/core/sweep/entry_exit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/sweep/row_certainty.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLength = 800;

/// A row of these blades, 10 mm apart, in a block of 100 mm.
Sweep rowOf(const std::vector<Elastica>& blades, const Vector3d& weight = Vector3d::Zero()) {
  Sweep sweep;
  sweep.block = {Frame{{-300, 0, -300}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
                 {600, 100, 600}};
  sweep.planes = PlaneFamily::across(sweep.block, Vector3d::UnitY());
  sweep.request.blade.length = kLength;
  sweep.request.weight = weight;
  for (std::size_t i = 0; i < blades.size(); ++i) {
    BladePose pose;
    pose.index = int(i);
    pose.travel = 10 * double(i + 1);
    pose.frame = sweep.planes.at(sweep.planes.entry + pose.travel);
    pose.cut = pose.blade = blades[i];
    if (!weight.isZero()) {
      const Result<Hanging> hanging = hang(blades[i], sweep.request.blade.flexuralRigidity(),
                                           {weight.dot(pose.frame.x), weight.dot(pose.frame.y)});
      if (hanging) pose.heavy = hanging->blade;
    }
    sweep.poses.push_back(pose);
    sweep.fits.push_back({*PlanarCurve::points({{-250, 0}, {0, 1}, {250, 0}})});
  }
  return sweep;
}

/// Blades that rest, of all forms that a random middle makes.
std::vector<Elastica> restingBlades(int count, double margin) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Elastica> blades;
  while (int(blades.size()) < count) {
    const double angle = 3 * number(random), bend = 8 * number(random);
    const Vector2d force(60 * number(random), 60 * number(random));
    const Result<Elastica> half =
        Elastica::make({0, 0}, angle, bend / kLength, force / (kLength * kLength), 0.5 * kLength);
    if (!half) continue;
    const Result<Elastica> blade = half->segment(-0.5 * kLength, 0.5 * kLength);
    if (blade && !blade->anchor() && stabilityMargin(*blade) >= margin) blades.push_back(*blade);
  }
  return blades;
}

/// The grips of a pose.
ClampedProblem gripsOf(const BladePose& pose) {
  const Elastica::State end = pose.blade.at(kLength);
  ClampedProblem grips;
  grips.start = pose.blade.start();
  grips.startAngle = pose.blade.startAngle();
  grips.end = end.point;
  grips.endAngle = end.angle;
  grips.length = kLength;
  grips.turning = end.angle - pose.blade.startAngle();
  return grips;
}

TEST(EntryExit, IsTheSameWhateverTheLead) {
  // In the air a blade keeps its shape: no lead helps where there is no way, and none is advised.
  for (const Elastica& blade : restingBlades(20, 0.02)) {
    const Sweep sweep = rowOf({blade, blade});
    const EntryExit usual = *planEntryExit(sweep, {0.15, 20}, {});
    for (const double lead : {0.0, 60.0, 400.0}) {
      const EntryExit other = *planEntryExit(sweep, {0.15, lead}, {});
      EXPECT_EQ(other.entry.why, usual.entry.why);
      EXPECT_EQ(other.entry.margin, usual.entry.margin);
      ASSERT_EQ(other.entry.poses.size(), usual.entry.poses.size());
      for (std::size_t i = 0; i < usual.entry.poses.size(); ++i)
        EXPECT_EQ(other.entry.poses[i].blade.at(kLength).point, usual.entry.poses[i].blade.at(kLength).point);
    }
  }
}

TEST(EntryExit, LeadsAnArcIntoEachShapeThatRests) {
  // Followed once more without weight, by the branch of the elastica itself.
  for (const Elastica& blade : restingBlades(150, 0.16)) {
    const Sweep sweep = rowOf({blade, blade});
    const Result<EntryExit> plan = planEntryExit(sweep, {}, {});
    ASSERT_TRUE(plan);
    ASSERT_FALSE(plan->entry.poses.empty()) << plan->entry.why;
    EXPECT_TRUE(plan->findings.empty());
    const std::vector<BladePose>& poses = plan->entry.poses;
    EXPECT_GE(plan->entry.margin, 0.15);
    EXPECT_NEAR(poses.front().blade.maxCurvature(), 2 * fromDegrees(10) / kLength, 1e-9);
    Result<ClampedBranch> branch = ClampedBranch::from(poses.front().blade);
    ASSERT_TRUE(branch) << branch.error().message;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Result<ClampedBranch::Move> move = branch->moveTo(gripsOf(poses[i]));
      ASSERT_TRUE(move) << move.error().message;
      EXPECT_FALSE(move->snapped);
      EXPECT_GT(stabilityMargin(branch->blade()), 0.14);
    }
    for (int k = 0; k <= 20; ++k) {
      const double s = kLength * k / 20;
      EXPECT_LT((branch->blade().point(s) - blade.point(s)).norm(), 1e-3);
    }
  }
}

TEST(EntryExit, StaysClearOfTheBlockAndRunsBothWays) {
  const std::vector<Elastica> blades = restingBlades(3, 0.3);
  const double weight = -rowOf(blades).request.blade.weight();
  const Sweep sweep = rowOf(blades, weight * Vector3d::UnitZ());
  const Result<EntryExit> plan = planEntryExit(sweep, {.margin = 0.15, .lead = 35}, {});
  ASSERT_TRUE(plan);
  ASSERT_FALSE(plan->entry.poses.empty() || plan->exit.poses.empty());
  for (const BladePose& pose : plan->entry.poses) {
    EXPECT_NEAR(pose.leftPoint().y(), -35, 1e-9);
    ASSERT_TRUE(pose.heavy);
    // At rest by itself, with its weight.
    const Result<Hanging> hanging =
        hang(pose.blade, sweep.request.blade.flexuralRigidity(), {0, weight * pose.frame.y.z()});
    ASSERT_TRUE(hanging);
    EXPECT_LT((hanging->blade.at(400).point - pose.heavy->at(400).point).norm(), 1e-4);
  }
  for (const BladePose& pose : plan->exit.poses) EXPECT_NEAR(pose.rightPoint().y(), 135, 1e-9);
  const auto turn = [](const BladePose& pose) { return pose.blade.startAngle(); };
  EXPECT_NEAR(turn(plan->entry.poses.back()), turn(sweep.poses.front()), 1e-12);
  EXPECT_NEAR(turn(plan->exit.poses.front()), turn(sweep.poses.back()), 1e-12);

  Findings findings;
  const Result<Motion> motion =
      buildMotion(sweep, *plan, sweep.poses, {.cuttingSpeed = 20, .lead = 35}, findings);
  ASSERT_TRUE(motion) << motion.error().message;
  const std::size_t entry = plan->entry.poses.size(), exit = plan->exit.poses.size();
  // Lead-in and lead-out have instants of their own: the first station lies 10 mm behind the face.
  ASSERT_EQ(motion->instants.size(), entry + 1 + 3 + 1 + exit);
  for (std::size_t i = 0; i < motion->instants.size(); ++i) {
    const MotionInstant& instant = motion->instants[i];
    EXPECT_EQ(instant.station >= 0, i > entry && i < entry + 4) << i;
    EXPECT_LE((instant.poses[0].position - instant.poses[1].position).norm(), kLength);
    if (i > 0) {
      EXPECT_GT(instant.time, motion->instants[i - 1].time);
    }
  }
  EXPECT_NEAR(motion->cuttingTime(), motion->instants[entry + 4].time - motion->instants[entry].time, 1e-12);
  EXPECT_LT(motion->cuttingTime(), motion->duration());
}

TEST(EntryExit, AStraightBladeIsLetGoToWhereItsWeightPulls) {
  // To the other side it would sag first and then be snapped through by its grips.
  const Elastica straight = *Elastica::make({-kLength / 2, 0}, 0, 0, Vector2d::Zero(), kLength);
  for (const double down : {-1.0, 1.0}) {
    const Sweep sweep = rowOf({straight, straight}, down * 1.7e-4 * Vector3d::UnitZ());
    const Result<EntryExit> plan = planEntryExit(sweep, {}, {});
    ASSERT_TRUE(plan && plan->findings.empty());
    for (const BladePose* slack : {&plan->entry.poses.front(), &plan->exit.poses.back()}) {
      const std::vector<Vector3d> places = slack->bladePoints(3);
      EXPECT_GT(down * (places[1].z() - places[0].z()), 10);
    }
    Findings findings;
    const Motion motion = buildMotion(sweep, *plan, sweep.poses, test::RowSettings(), findings).value();
    const Result<Simulation> run = simulate(motion, sweep.request.blade, sweep.request.weight, {});
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_TRUE(run->snaps.empty());
    EXPECT_LT(run->speeds->max, 1.1 * motion.cuttingSpeed);
  }
}

/// mm of the lowest of the poses over the bottom of the block.
double lowestOf(const Sweep& sweep, const std::vector<BladePose>& poses) {
  double lowest = 1e300;
  for (const BladePose& pose : poses)
    for (const Vector3d& point : pose.bladePoints(401))
      lowest = std::min(lowest, sweep.block.frame.toLocal(point).z());
  return lowest;
}

TEST(EntryExit, StaysAboveTheFloorAsTheStationDoes) {
  int lower = 0;
  for (const double bend : {-0.1, 0.1}) {
    // All but straight: led out of an arc whose ends lie tens of mm below its middle, or above it.
    const Elastica half = *Elastica::make({0, 0}, 0, bend / kLength, Vector2d::Zero(), 0.5 * kLength);
    const Elastica blade = *half.segment(-0.5 * kLength, 0.5 * kLength);
    const Sweep sweep = rowOf({blade, blade}, -1.7e-4 * Vector3d::UnitZ());
    const double station = lowestOf(sweep, sweep.poses), floor = station - 1;
    const EntryExit unasked = planEntryExit(sweep, {}, {}).value(),
                    asked = planEntryExit(sweep, {.floor = floor}, {}).value();
    const MotionRequest motion{.floor = floor};
    Findings told, none;
    const Motion low = buildMotion(sweep, unasked, sweep.poses, motion, told).value();
    ASSERT_TRUE(buildMotion(sweep, asked, sweep.poses, motion, none));
    EXPECT_FALSE(test::findingOf<NearBottom>(none));
    for (const bool entry : {true, false}) {
      const std::vector<BladePose>&is = entry ? asked.entry.poses : asked.exit.poses,
            &was = entry ? unasked.entry.poses : unasked.exit.poses;
      ASSERT_FALSE(is.empty());
      ASSERT_EQ(is.size(), was.size());
      EXPECT_GE(lowestOf(sweep, is), floor - 0.01);
      // The shapes are the same, the one next to the station where it was.
      for (std::size_t i = 0; i < is.size(); ++i)
        EXPECT_NEAR((is[i].leftPoint() - is[i].rightPoint()).norm(),
                    (was[i].leftPoint() - was[i].rightPoint()).norm(), 1e-9);
      const auto atStation = [entry](const std::vector<BladePose>& way) {
        return entry ? way.back().leftPoint() : way.front().leftPoint();
      };
      EXPECT_NEAR((atStation(is) - atStation(was)).norm(), 0, 1e-9);
    }
    if (lowestOf(sweep, unasked.entry.poses) >= floor) continue;
    ++lower;
    // Told of the way in and of the way out, with the lowest place.
    ASSERT_EQ(std::ranges::count(told, FindingKind::floor, &Finding::kind), 2);
    const Finding* in = test::findingOf<NearBottom>(told);
    EXPECT_EQ(*in->where.stations, (StationRange{-1, 0, 0, 0}));
    EXPECT_EQ(*told.back().where.stations, (StationRange{1, -1, 1, 0}));
    EXPECT_NEAR(std::get<NearBottom>(in->cause).height, lowestOf(sweep, unasked.entry.poses), 0.05);
    EXPECT_NEAR(sweep.block.frame.toLocal(*in->where.point).z(), std::get<NearBottom>(in->cause).height, 1);
    EXPECT_TRUE(exceedsLimit(told));
    // A station that is as low is told of by the check of the row.
    Findings known;
    const EntryExit beside = planEntryExit(sweep, {.floor = station + 5}, {}).value();
    ASSERT_TRUE(buildMotion(sweep, beside, sweep.poses, {.floor = station + 5}, known));
    EXPECT_FALSE(test::findingOf<NearBottom>(known));
  }
  EXPECT_EQ(lower, 1);
}

TEST(EntryExit, SaysWhereNoWayIsKnown) {
  // A blade that its grips hold in a shape that does not rest.
  std::vector<Elastica> blades;
  for (double force = 45; blades.empty(); force += 5) {
    const Elastica half =
        *Elastica::make({0, 0}, 0, 1.5 / kLength, Vector2d(force, 0) / (kLength * kLength), 0.5 * kLength);
    const Elastica blade = *half.segment(-0.5 * kLength, 0.5 * kLength);
    if (stabilityMargin(blade) < -0.05) blades.assign(2, blade);
  }
  const Result<EntryExit> plan = planEntryExit(rowOf(blades), {}, {});
  ASSERT_TRUE(plan);
  EXPECT_TRUE(plan->entry.poses.empty());
  EXPECT_FALSE(plan->entry.why.empty());
  ASSERT_EQ(plan->findings.size(), 2u);
  EXPECT_EQ(plan->findings[0].severity, Severity::error);
  const auto* cause = std::get_if<NoWay>(&plan->findings[0].cause);
  ASSERT_TRUE(cause);
  EXPECT_TRUE(cause->entry);
  EXPECT_TRUE(exceedsLimit(plan->findings));
  Findings findings;
  EXPECT_TRUE(buildMotion(rowOf(blades), *plan, rowOf(blades).poses, {}, findings))
      << "the stations are timed all the same";
}

/// What is known of five stations, each with a higher shape besides its own.
struct Judged {
  Sweep sweep = rowOf(restingBlades(5, 0.3));
  SweepCheck check;
  RowCertainty certainty;
  BladeWay entry;
  RowMotion motion;
  Judged() {
    check.stations.assign(5, {});
    for (StationCheck& station : check.stations) station.stabilityMargin = 0.5;
    certainty.stations.assign(5, {10, 0.5, OtherRest{5, 50}, 3.0});
    entry = {{sweep.poses[0]}, 0.4, ""};
    motion.reached = {0, 1, 1, 1, 1};
  }
  RowRest rest() const { return restOf(sweep, check, certainty, entry, motion, 0.15); }
};

std::string told(const RowRest& row) {
  std::string all;
  for (const Rest rest : row.stations) all += restName(rest)[0];
  return all;
}

TEST(RowRest, IsHeldAlongAWayThatRestsFirmly) {
  const RowRest row = Judged().rest();
  EXPECT_EQ(told(row), "hhhhh");
  ASSERT_EQ(row.findings.size(), 1u);
  EXPECT_EQ(row.findings[0].severity, Severity::info);
  const auto& cause = std::get<OtherShape>(row.findings[0].cause);
  EXPECT_EQ(cause.lost, OtherShape::Lost::no);
  EXPECT_EQ(cause.barrier, 3.0);
}

TEST(RowRest, IsLostForEachOfItsReasons) {
  using Lost = OtherShape::Lost;
  const auto reason = [](const RowRest& row) {
    const Finding* finding = test::findingOf<OtherShape>(row.findings);
    EXPECT_EQ(finding->severity, Severity::error);
    return std::get<OtherShape>(finding->cause).lost;
  };
  Judged noEntry;
  noEntry.entry = {{}, 1, "none"};
  EXPECT_EQ(told(noEntry.rest()), "lllll");
  EXPECT_EQ(reason(noEntry.rest()), Lost::noEntry);
  Judged leaves;
  leaves.motion.reached[2] = 0;
  EXPECT_EQ(told(leaves.rest()), "hhlll");
  EXPECT_EQ(reason(leaves.rest()), Lost::leaves);
  Judged margin;
  margin.check.stations[3].stabilityMargin = 0.1;
  EXPECT_EQ(told(margin.rest()), "hhhll") << "what comes after went through it";
  EXPECT_EQ(reason(margin.rest()), Lost::lowMargin);
  Judged entry;
  entry.entry.margin = 0.1;
  EXPECT_EQ(told(entry.rest()), "lllll");
  Judged barrier;
  barrier.certainty.stations[4].barrier = 0.9;
  EXPECT_EQ(told(barrier.rest()), "lllll") << "the least of the stretch counts";
  EXPECT_EQ(reason(barrier.rest()), Lost::lowBarrier);
  Judged unknown;
  for (StationCertainty& station : unknown.certainty.stations) station.barrier.reset();
  EXPECT_EQ(reason(unknown.rest()), Lost::unknownBarrier);
}

TEST(RowRest, IsAnErrorWhereNothingIsKnownOfOtherShapes) {
  Judged judged;
  for (const int i : {1, 2}) judged.certainty.stations[std::size_t(i)] = {std::nan(""), {}, {}};
  const RowRest row = judged.rest();
  EXPECT_EQ(told(row), "huuhh");
  const auto unsought = std::ranges::find_if(row.findings, [](const Finding& finding) {
    return std::get<OtherShape>(finding.cause).lost == OtherShape::Lost::unsought;
  });
  ASSERT_NE(unsought, row.findings.end());
  EXPECT_EQ(unsought->severity, Severity::error);
  EXPECT_EQ(unsought->where.stations->first, 1);
  EXPECT_EQ(unsought->where.stations->last, 2);
  EXPECT_TRUE(exceedsLimit(row.findings));
  // Of a blade that does not rest the check tells.
  judged.check.stations[1].stable = judged.check.stations[2].stable = false;
  EXPECT_TRUE(std::ranges::none_of(judged.rest().findings, [](const Finding& finding) {
    return std::get<OtherShape>(finding.cause).lost == OtherShape::Lost::unsought;
  }));
}

TEST(RowRest, BeginsAnewWhereAStationIsCertain) {
  Judged judged;
  judged.entry = {{}, 1, "none"};
  judged.check.stations[1].stabilityMargin = 0.1;
  judged.certainty.stations[2].other.reset();
  EXPECT_EQ(told(judged.rest()), "llchh");
  judged.certainty.stations[4].energy = std::nan("");
  EXPECT_EQ(told(judged.rest()), "llchu");
}

TEST(RowRest, IsAMapWhereEachRowTakesTheNearestStation) {
  const RowRest rest{{Rest::lost, Rest::unknown, Rest::held, Rest::certain}};
  SurfaceGrid cut;
  cut.rows = 10;
  cut.columns = 2;
  cut.points.resize(20);
  const Field field = certaintyField(rest, {0, 3, 6, 9}, cut);
  std::string told;
  for (std::size_t i = 0; i < field.values.size(); i += 2) {
    EXPECT_EQ(field.values[i], field.values[i + 1]);
    told += mapWord("certainty", field.values[i])[0];
  }
  EXPECT_EQ(told, "lluuuhhhcc");
}

}  // namespace
}  // namespace bw
