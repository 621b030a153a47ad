// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rows whose blades a small push would bring into another shape.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/core/sweep/grips_off.h"
#include "bw/core/sweep/live_row.h"
#include "plane_sections.h"
#include "row_settings.h"
#include "sweep/firm_row.h"
#include "sweep/held_blade.h"
#include "sweep/row_station.h"
#include "sweep/smooth_way.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kHalf = 300;
constexpr int kStations = 13;

Box block() { return test::blockUnder(kHalf, 20.0 * (kStations - 1), -kHalf, kHalf); }
PlaneFamily planes() { return PlaneFamily::across(block(), -Vector3d::UnitY()); }

/// Waves that grow along the travel.
std::vector<Section> waves(double phase, double lift = 0) {
  return test::sectionsOf(kStations, 20, [=](int i) {
    const double height = 8 + 0.3 * i;
    return test::graphCurve(kHalf,
                            [=](double x) { return lift + height * std::sin(kPi * x / kHalf + phase); });
  });
}

test::RowSettings flat(double length, double barrier) {
  test::RowSettings settings = test::flatRow(length);
  settings.barrier = barrier;
  return settings;
}

Sweep rowOf(const FitRequest& request, double phase) {
  Findings findings;
  Result<Sweep> sweep = buildSweep(waves(phase), request, block(), planes(), {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  return std::move(*sweep);
}

/// N mm: of the station that gives way first, found from nothing but its blade. Empty where all are certain.
std::optional<double> leastBarrier(const Sweep& row) {
  const Result<RowCertainty> certainty = certaintyOf(row, {});
  EXPECT_TRUE(certainty);
  std::optional<double> least;
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    if (certainty->stations[i].certain()) continue;
    const Result<HeavyRivals> rivals = rivalsOf(*row.poses[i].heavy, row.request.blade.flexuralRigidity());
    EXPECT_TRUE(rivals && rivals->barrier) << i;
    if (rivals && rivals->barrier) least = std::min(least.value_or(1e300), *rivals->barrier);
  }
  return least;
}

double farthest(const Sweep& row) {
  double farthest = 0;
  for (const StationFit& fit : row.fits) farthest = std::max(farthest, fit.fit.hausdorff);
  return farthest;
}

constexpr double kTwoWays = 0.5 * kPi;  // the blade may leave to either side, over two passes
constexpr double kHopeless = 0.8;

TEST(FirmRow, ABladeBearsAPushWhereTheToleranceLetsIt) {
  const test::RowSettings settings = flat(760, 1);
  const Sweep row = rowOf(settings, kTwoWays);
  ASSERT_TRUE(leastBarrier(row));
  EXPECT_LT(*leastBarrier(row), 0.5);
  const Result<FirmRow> firm = firmRow(row, {});
  ASSERT_TRUE(firm && firm->row);
  ASSERT_TRUE(leastBarrier(*firm->row));
  EXPECT_GE(*leastBarrier(*firm->row), settings.barrier);
  EXPECT_LE(farthest(*firm->row), settings.tolerance);
  // What is told of the row is what a search of each station finds.
  std::optional<double> told;
  for (const StationCertainty& station : firm->certainty.stations)
    if (station.barrier) told = std::min(told.value_or(1e300), *station.barrier);
  ASSERT_TRUE(told);
  EXPECT_NEAR(*told, *leastBarrier(*firm->row), 1e-6);
}

/// N mm: the least on the ways between stations, by a search of all shapes at three places of each.
double leastBetween(const Sweep& row, const RowCertainty& told) {
  const sweep::SmoothWay smooth(row);
  const double stiffness = row.request.blade.flexuralRigidity();
  double least = 1e300;
  EXPECT_EQ(told.between.size() + 1, row.poses.size());
  for (std::size_t i = 0; i + 1 < row.poses.size(); ++i) {
    std::optional<HeavyBranch> own = sweep::standing(row, row.poses[i]);
    double here = 1e300;
    for (const double share : {0.25, 0.5, 0.75}) {
      const std::optional<BladePose> pose =
          smooth.at(std::lerp(row.poses[i].travel, row.poses[i + 1].travel, share));
      EXPECT_TRUE(pose && own && own->moveTo(sweep::heldAt(row, *pose))) << i;
      if (!pose || !own) return 0;
      const Result<HeavyRivals> rivals = rivalsOf(own->blade(), stiffness);
      EXPECT_TRUE(rivals) << i;
      if (rivals && rivals->next && rivals->nextEnergy - rivals->energy < 0.04 * std::abs(rivals->energy))
        here = std::min(here, rivals->barrier.value_or(0));
    }
    EXPECT_NEAR(told.between[i].value_or(here), here, 1e-6) << i;
    least = std::min(least, here);
  }
  return least;
}

TEST(FirmRow, ABladeBearsThePushBetweenItsStationsToo) {
  const test::RowSettings settings = flat(760, 1);
  const Sweep row = rowOf(settings, kTwoWays);
  const Result<FirmRow> firm = firmRow(row, {});
  ASSERT_TRUE(firm && firm->row);
  EXPECT_GE(leastBetween(*firm->row, firm->certainty), settings.barrier);
  EXPECT_LE(*firm->certainty.leastBarrier(), leastBetween(*firm->row, firm->certainty) + 1e-6);
}

/// True if a blade snaps somewhere around with one of its grips off.
bool snapsAround(const Sweep& row, std::size_t i, const CheckRequest& request) {
  constexpr int kWays = 48;
  const std::optional<HeavyBranch> own = sweep::standing(row, row.poses[i]);
  if (!own) return true;
  for (int k = 0; k < kWays; ++k)
    for (const bool start : {true, false})
      for (const double turned : {-request.gripAngle, request.gripAngle}) {
        HeavyProblem off = holdOf(own->blade(), row.request.blade.flexuralRigidity());
        const double way = 2 * kPi * k / kWays;
        (start ? off.grips.start : off.grips.end) +=
            request.gripError * Eigen::Vector2d(std::cos(way), std::sin(way));
        *(start ? off.grips.startAngle : off.grips.endAngle) += turned;
        off.grips.turning.reset();
        HeavyBranch there = *own;
        const Result<ClampedBranch::Move> move = there.moveTo(off);
        if (move && move->snapped) return true;
      }
  return false;
}

TEST(FirmRow, WhatAGripThatIsOffLetsSnapIsTold) {
  const test::RowSettings settings = flat(760, 1);
  const Sweep row = rowOf(settings, kTwoWays);
  const Result<FirmRow> firm = firmRow(row, {});
  ASSERT_TRUE(firm && firm->row);
  const RowRest held{std::vector<Rest>(row.poses.size(), Rest::held)};
  int told = 0, quiet = 0;
  for (const double error : {0.0, 0.02, 0.1, 0.5, 1.0}) {
    CheckRequest request;
    request.gripError = error;
    request.gripAngle = 0.4 * error * kDegree;
    RowRest rest = held;
    ASSERT_TRUE(judgeGripsOff(*firm->row, firm->certainty, request, {}, rest));
    for (std::size_t i = 0; i < row.poses.size(); ++i) {
      const bool snaps = snapsAround(*firm->row, i, request);
      const auto found = std::ranges::find_if(rest.findings, [&](const Finding& finding) {
        const StationRange& at = *finding.where.stations;
        return int(i) >= at.first && int(i) <= at.last;
      });
      if (found == rest.findings.end()) {
        EXPECT_FALSE(snaps) << i << " " << error;
        ++quiet;
        continue;
      }
      ++told;
      const HeldByLittle& cause = std::get<HeldByLittle>(found->cause);
      EXPECT_EQ(found->severity, cause.barrier > 0 ? Severity::warning : Severity::error);
      EXPECT_EQ(rest.stations[i], cause.barrier > 0 ? Rest::held : Rest::lost);
      EXPECT_LT(cause.barrier, kLeastBarrier);
      if (cause.barrier == 0 && found->where.stations->worst == int(i)) {
        EXPECT_TRUE(snaps) << i << " " << error;
      }
    }
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(quiet, 0);
  // What is certain, or lost anyway, is not told of.
  RowRest certain{std::vector<Rest>(row.poses.size(), Rest::certain)};
  ASSERT_TRUE(judgeGripsOff(*firm->row, firm->certainty, {}, {}, certain));
  EXPECT_TRUE(certain.findings.empty());
}

TEST(FirmRow, ItGoesOnBearingThePushWhileAHandMovesTheSections) {
  const test::RowSettings settings = flat(760, 1);
  const Result<FirmRow> firm = firmRow(rowOf(settings, kTwoWays), {});
  ASSERT_TRUE(firm && firm->row);
  std::optional<LiveRow> live = LiveRow::of(*firm->row, {});
  ASSERT_TRUE(live);
  for (int step = 1; step <= 4; ++step)
    ASSERT_TRUE(live->follow(waves(kTwoWays - 0.01 * step, step), block(), planes(), {})) << step;
  ASSERT_TRUE(leastBarrier(live->sweep()));
  EXPECT_GE(*leastBarrier(live->sweep()), settings.barrier);
  EXPECT_LE(farthest(live->sweep()), settings.tolerance);
}

TEST(FirmRow, SlopesOfAStationAreThoseOfItsSection) {
  test::RowSettings settings = flat(760, 0);
  settings.fitEndpoints = settings.fitTangents = true;
  settings.fitLength = FitOptions::Length::exact;
  Sweep sweep = rowOf(settings, kTwoWays);
  const RunContext context;
  const sweep::Row row(sweep, context);
  std::optional<sweep::Station> station = row.following(4);
  ASSERT_TRUE(station && station->good);
  // Its grips stay where its slopes were found, its section does not.
  PlanarCurve& section = sweep.fits[4].target;
  section = section.transformed(2e-3, 1.002, {0.3, 0.7});
  sweep::Station anew = *station;
  row.take(*station, 4);
  row.look(*station, false);
  row.look(*station);
  row.take(anew, 4);
  row.look(anew);
  ASSERT_TRUE(station->good && anew.good);
  EXPECT_GT(anew.byDemands.row(2).norm(), 1e-3);
  EXPECT_GT(anew.byDemands.row(4).norm(), 1e-2);
  EXPECT_LT((station->byDemands - anew.byDemands).norm(), 1e-3);
  EXPECT_LT((station->byOwn - anew.byOwn).norm(), 1e-3);
}

TEST(FirmRow, NoBladeStandsWorseThanInTheRowBefore) {
  int firmed = 0;
  for (const double margin : {0.15, 0.9})
    for (const double length : {700.0, 760.0})
      for (const double phase : {kTwoWays, kTwoWays - 0.2}) {
        test::RowSettings settings = flat(length, 3);
        settings.margin = margin;
        const Sweep row = rowOf(settings, phase);
        const Result<FirmRow> firm = firmRow(row, {});
        ASSERT_TRUE(firm);
        if (!firm->row) continue;
        ++firmed;
        const auto marginOf = [](const Sweep& of, std::size_t i) {
          return marginsOf(*of.poses[i].heavy).inPlane;
        };
        for (std::size_t i = 0; i < row.poses.size(); ++i) {
          const std::string at = std::to_string(margin) + " " + std::to_string(length) + " " +
                                 std::to_string(phase) + " " + std::to_string(i);
          if (marginOf(row, i) >= margin) {
            EXPECT_GE(marginOf(*firm->row, i), margin) << at;
          }
          EXPECT_LE(firm->row->fits[i].fit.hausdorff, std::max(row.fits[i].fit.hausdorff, settings.tolerance))
              << at;
          EXPECT_FALSE(firm->row->fits[i].snapsAt && !row.fits[i].snapsAt) << at;
        }
      }
  EXPECT_GT(firmed, 0);
}

TEST(FirmRow, ARowIsRefusedWhereOneBladeStandsWorse) {
  const Sweep row = rowOf(flat(760, 3), kTwoWays);
  EXPECT_TRUE(sweep::keepsUp(row, row));
  const auto refused = [&](const char* what, const auto& worsen) {
    Sweep next = row;
    worsen(next);
    EXPECT_FALSE(sweep::keepsUp(next, row)) << what;
    EXPECT_TRUE(sweep::keepsUp(next, next)) << what << ": it stood no better before";
  };
  refused("snaps", [](Sweep& next) { next.fits[2].snapsAt = 0.5; });
  refused("is not known", [](Sweep& next) { next.fits[2].unknown = "why"; });
  refused("has no shape", [](Sweep& next) { next.fits[2].fit.status = FitStatus::infeasible; });
  refused("lies farther off", [](Sweep& next) { next.fits[2].fit.hausdorff = 1.1 * next.request.tolerance; });
  refused("has less margin", [](Sweep& next) { next.request.margin = 1e3; });
}

TEST(FirmRow, ARowThatCannotStaysAsItIs) {
  const Sweep row = rowOf(flat(760, 1), kHopeless);
  const Result<FirmRow> firm = firmRow(row, {});
  ASSERT_TRUE(firm);
  EXPECT_FALSE(firm->row) << "it would lie beyond the tolerance";
  const auto weak = [](const StationCertainty& station) {
    return station.unsure() && station.barrier && *station.barrier < 1;
  };
  EXPECT_TRUE(std::ranges::any_of(firm->certainty.stations, weak));
}

TEST(FirmRow, NothingIsBentWhereNothingIsAsked) {
  const Result<FirmRow> firm = firmRow(rowOf(flat(760, 0), kTwoWays), {});
  ASSERT_TRUE(firm);
  EXPECT_FALSE(firm->row);
  std::stop_source source;
  source.request_stop();
  RunContext stopped;
  stopped.stop = source.get_token();
  const Result<FirmRow> none = firmRow(rowOf(flat(760, 1), kTwoWays), stopped);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::cancelled);
}

TEST(FirmRow, AStretchOfWhichNoBarrierIsKnownIsHeldByNothing) {
  StationCertainty sure, unsure, known;
  sure.energy = unsure.energy = known.energy = 10;
  unsure.other = known.other = OtherRest{9, 30};
  known.barrier = 4;
  const auto least = [](std::vector<StationCertainty> stations) {
    return RowCertainty{std::move(stations)}.leastBarrier();
  };
  EXPECT_EQ(least({sure, sure}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(least({sure, unsure, known, sure}), 4) << "neighbours of one stretch share what is known";
  EXPECT_EQ(least({known, sure, unsure}), std::nullopt);
}

}  // namespace
}  // namespace bw
