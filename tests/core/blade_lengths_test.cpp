// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Which lengths of a blade serve a row, and what grips that are off do to it.

#include "bw/core/sweep/blade_lengths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector3d;

constexpr double kHalf = 250;
constexpr int kStations = 9;

const auto kWave = [](double x) { return 8 * std::sin(kPi * x / kHalf); };

Box block() { return test::blockUnder(kHalf, 10.0 * (kStations - 1), -2 * kHalf, 2 * kHalf); }
PlaneFamily planes() { return PlaneFamily::across(block(), -Vector3d::UnitY()); }

std::vector<Section> wave() {
  return test::sectionsOf(kStations, 10, [](int) { return test::graphCurve(kHalf, kWave); });
}

LengthRequest asked(double clearance = 50) {
  test::RowSettings settings;
  settings.clearance = clearance;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  return {settings, settings, {settings.margin, settings.lead}};
}

TEST(BladeLengths, WhatServesDoesAndWhatDoesNotFails) {
  LengthRequest request = asked();
  request.fit.tolerance = request.check.tolerance = 1;  // mm: longer blades come less near
  const Result<BladeLengths> lengths = bladeLengths(wave(), request, block(), planes(), {});
  ASSERT_TRUE(lengths) << lengths.error().message;
  ASSERT_TRUE(lengths->best);
  // However far from it the blades of a row began, they keep the margin: no length in between fails.
  ASSERT_EQ(lengths->bands().size(), 1u);
  EXPECT_GT(lengths->bands().front().to, 1.3 * lengths->bands().front().from);
  EXPECT_TRUE(std::ranges::is_sorted(lengths->trials, {}, &RowTrial::length));
  const auto rowWith = [&](double length) {
    FitRequest fit = request.fit;
    fit.blade.length = length;
    Findings findings;
    return *buildSweep(wave(), fit, block(), planes(), {}, findings);
  };
  const auto keeps = [&](double length) {
    const Sweep row = rowWith(length);
    const Result<SweepCheck> check = checkSweep(row, request.check, {});
    EXPECT_TRUE(check);
    bool all = true;
    for (std::size_t i = 0; i < row.poses.size(); ++i) {
      const StationCheck& station = check->stations[i];
      all = all && station.clearance >= request.check.clearance && station.stable &&
            station.stabilityMargin >= request.check.margin && station.outOfPlaneMargin > 0 &&
            row.fits[i].fit.hausdorff <= request.check.tolerance;
    }
    return all;
  };
  // The whole row keeps with the best length all that was asked for, and with the longest tried it does not.
  EXPECT_TRUE(keeps(*lengths->best)) << *lengths->best;
  EXPECT_GE(lengths->bands().front().from, 500 + 2 * request.check.clearance);
  EXPECT_FALSE(lengths->trials.back().serves()) << "there is an end to it";
  EXPECT_FALSE(keeps(lengths->trials.back().length)) << lengths->trials.back().length;
}

TEST(BladeLengths, ReachAcrossABlockThatIsWiderThanTheSection) {
  const std::vector<Section> narrow = test::sectionsOf(
      kStations, 10, [](int) { return test::graphCurve(100, [](double x) { return -x * x / 1500; }); });
  const Result<BladeLengths> lengths = bladeLengths(narrow, asked(), block(), planes(), {});
  ASSERT_TRUE(lengths) << lengths.error().message;
  ASSERT_TRUE(lengths->best) << lengths->trials.back().length << " is the longest tried";
  EXPECT_GT(*lengths->best, 2 * (kHalf + 50));
}

TEST(BladeLengths, OfManyStationsAreConfirmedOnAllOfThem) {
  // More than are tried: of these thirty and the longest are, and the best on all.
  constexpr int kMany = 33;
  const std::vector<Section> many = test::sectionsOf(kMany, 10.0 * (kStations - 1) / (kMany - 1),
                                                     [](int) { return test::graphCurve(kHalf, kWave); });
  const Result<BladeLengths> lengths = bladeLengths(many, asked(), block(), planes(), {});
  ASSERT_TRUE(lengths) << lengths.error().message;
  EXPECT_LT(lengths->stations, kMany);
  ASSERT_TRUE(lengths->best);
  ASSERT_TRUE(lengths->at(*lengths->best));
  EXPECT_TRUE(lengths->at(*lengths->best)->serves());
  EXPECT_LT(lengths->at(*lengths->best)->deviation, asked().check.tolerance);
}

TEST(BladeLengths, AreTheSameForAnyNumberOfThreads) {
  RunContext one;
  one.threads = 1;
  const Result<BladeLengths> a = bladeLengths(wave(), asked(), block(), planes(), one),
                             b = bladeLengths(wave(), asked(), block(), planes(), {});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->best, b->best);
  ASSERT_EQ(a->trials.size(), b->trials.size());
  for (std::size_t i = 0; i < a->trials.size(); ++i) {
    EXPECT_EQ(a->trials[i].length, b->trials[i].length);
    EXPECT_EQ(a->trials[i].margin, b->trials[i].margin);
    EXPECT_EQ(a->trials[i].rest, b->trials[i].rest);
  }
}

TEST(BladeLengths, NoneServesWhereABentBladeIsToRestAsAStraightOne) {
  LengthRequest request = asked();
  request.check.margin = 0.99;
  const Result<BladeLengths> lengths = bladeLengths(wave(), request, block(), planes(), {});
  ASSERT_TRUE(lengths) << lengths.error().message;
  EXPECT_FALSE(lengths->best);
  EXPECT_TRUE(lengths->bands().empty());
  EXPECT_FALSE(lengths->trials.empty());
  EXPECT_EQ(lengths->at(1), nullptr);
  EXPECT_EQ(lengths->at(1e6), &lengths->trials.back());
}

TEST(BladeLengths, HaveTheLimitsOfTheMargins) {
  // A trial of a length is that of the margin asked for with a blade of that length.
  LengthRequest request = asked();
  const Result<BladeLengths> lengths = bladeLengths(wave(), request, block(), planes(), {});
  ASSERT_TRUE(lengths && lengths->best);
  int serving = 0, failing = 0;
  for (const RowTrial& trial : lengths->trials) {
    int& seen = trial.serves() ? serving : failing;
    if (++seen > 2) continue;
    request.fit.blade.length = trial.length;
    const Result<MarginTrade> trade = marginTrade(wave(), request, block(), planes(), {});
    ASSERT_TRUE(trade) << trade.error().message;
    const auto same = std::ranges::find(trade->trials, request.check.margin, &RowTrial::asked);
    ASSERT_NE(same, trade->trials.end());
    EXPECT_EQ(same->rest, trial.rest) << trial.length;
    EXPECT_EQ(same->margin, trial.margin) << trial.length;
    EXPECT_EQ(same->deviation, trial.deviation) << trial.length;
    EXPECT_EQ(same->reaches, trial.reaches) << trial.length;
    EXPECT_EQ(trade->best == request.check.margin, trial.serves()) << trial.length;
  }
  EXPECT_GT(serving, 0);
  EXPECT_GT(failing, 0);
}

/// Of blades that are to rest so firmly, near to their sections, none serves with that clearance.
LengthRequest firm(double clearance) {
  LengthRequest request = asked(clearance);
  request.fit.margin = request.check.margin = request.ends.margin = 0.4;
  request.fit.tolerance = request.check.tolerance = 1;
  return request;
}

TEST(ClearanceTrade, FindsTheLargestThatServesAndTheBladeForIt) {
  LengthRequest request = firm(150);
  const Result<BladeLengths> lengths = bladeLengths(wave(), request, block(), planes(), {});
  ASSERT_TRUE(lengths);
  ASSERT_FALSE(lengths->best) << "no length does with the clearance asked for";
  request.fit.blade.length = lengths->trials.front().length;
  const Result<ClearanceTrade> trade = clearanceTrade(wave(), request, block(), planes(), {});
  ASSERT_TRUE(trade) << trade.error().message;
  ASSERT_TRUE(trade->best && trade->best->serves());
  EXPECT_EQ(trade->least(), kLeastClearance);
  const double clearance = trade->best->clearance;
  EXPECT_GT(clearance, kLeastClearance);
  EXPECT_LT(clearance, 150);
  int beyond = 0;
  for (const RowTrial& trial : trade->trials) {
    if (trial.clearance <= clearance) continue;
    EXPECT_FALSE(trial.serves()) << trial.clearance << " " << trial.length;
    beyond += trial.clearance == clearance + 5;
  }
  EXPECT_GT(beyond, 4) << "the next larger one was tried";
  // The blade in use comes before others.
  request.fit.blade.length = trade->best->length;
  const Result<ClearanceTrade> own = clearanceTrade(wave(), request, block(), planes(), {});
  ASSERT_TRUE(own && own->best);
  EXPECT_EQ(own->best->length, request.fit.blade.length);
  EXPECT_GE(own->best->clearance, clearance);
}

TEST(ClearanceTrade, TriesNothingNearerThanGripsMayCome) {
  const Result<ClearanceTrade> trade = clearanceTrade(wave(), firm(kLeastClearance), block(), planes(), {});
  ASSERT_TRUE(trade);
  EXPECT_TRUE(trade->trials.empty() && !trade->best && !trade->least());
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const Result<ClearanceTrade> stopped = clearanceTrade(wave(), firm(150), block(), planes(), context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_EQ(clearanceTrade({}, firm(150), block(), planes(), {}).error().code, ErrorCode::badInput);
}

TEST(BladeLengths, AStopEndsTheSearch) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const Result<BladeLengths> lengths = bladeLengths(wave(), asked(), block(), planes(), context);
  ASSERT_FALSE(lengths);
  EXPECT_EQ(lengths.error().code, ErrorCode::cancelled);
}

TEST(BladeLengths, TheBestIsTheFirstThatServesAsAWhole) {
  BladeLengths lengths;
  const auto anew = [&] {
    lengths.trials.clear();
    for (int k = 0; k < 6; ++k) {
      RowTrial trial{600.0 + 10 * k, Rest::certain};
      trial.margin = 0.3 - 0.01 * k;  // the shorter the firmer
      lengths.trials.push_back(trial);
    }
  };
  const auto restOf = [&](double length) { return lengths.at(length)->rest; };
  int asked = 0;
  anew();
  confirm(lengths, [&](RowTrial&) { return ++asked > 0; });
  EXPECT_EQ(lengths.best, 600);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(lengths.bands().front().to, 650) << "nothing speaks against the others";
  // Where the sections alone misled, of the others it is not known.
  anew();
  asked = 0;
  confirm(lengths, [&](RowTrial& trial) {
    ++asked;
    return trial.length == 610;
  });
  EXPECT_EQ(lengths.best, 610);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(restOf(600), Rest::lost);
  EXPECT_EQ(restOf(610), Rest::certain);
  EXPECT_EQ(restOf(620), Rest::unknown);
  ASSERT_EQ(lengths.bands().size(), 1u);
  EXPECT_EQ(lengths.bands().front().to, 610);
  // It is not asked for ever.
  anew();
  asked = 0;
  confirm(lengths, [&](RowTrial& trial) {
    ++asked;
    return trial.length == 650;
  });
  EXPECT_FALSE(lengths.best);
  EXPECT_EQ(asked, kMostConfirmed);
  EXPECT_TRUE(lengths.bands().empty());
}

TEST(BladeLengths, OfThoseThatAreAsFirmNotTheNeighboursOfOneThatFailsAreTriedNext) {
  BladeLengths lengths;
  for (double length = 710; length < 1240; length += 20)
    lengths.trials.push_back({length, length < 750 ? Rest::lost : Rest::certain});
  for (RowTrial& trial : lengths.trials) trial.margin = 1;
  int asked = 0;
  confirm(lengths, [&](RowTrial& trial) {
    ++asked;
    return trial.length > 840;
  });
  ASSERT_TRUE(lengths.best);
  EXPECT_NEAR(*lengths.best, 960, 30) << "in the middle of those that may serve";
  EXPECT_EQ(asked, 2);
}

TEST(BladeLengths, BandsJoinNeighboursThatServeAlike) {
  BladeLengths lengths;
  for (const auto& [length, rest] : {std::pair(600.0, Rest::lost),
                                     {610.0, Rest::certain},
                                     {620.0, Rest::certain},
                                     {630.0, Rest::held},
                                     {640.0, Rest::lost},
                                     {650.0, Rest::held}})
    lengths.trials.push_back({length, rest});
  const std::vector<BladeLengths::Band> bands = lengths.bands();
  ASSERT_EQ(bands.size(), 3u);
  EXPECT_EQ(bands[0].from, 610);
  EXPECT_EQ(bands[0].to, 620);
  EXPECT_EQ(bands[1].from, 630);
  EXPECT_EQ(bands[1].to, 630);
  EXPECT_EQ(bands[1].rest, Rest::held);
  EXPECT_EQ(bands[2].from, 650);
  EXPECT_EQ(lengths.at(635)->length, 630);
}

/// The blade of a pose, followed to where a grip is moved and turned.
HeavyBlade followed(const BladePose& pose, const Blade& blade, double weight, int grip,
                    const Eigen::Vector2d& moved, double turned) {
  HeavyProblem problem;
  const Elastica::State end = pose.blade.at(blade.length);
  problem.grips.start = pose.blade.start();
  problem.grips.end = end.point;
  problem.grips.startAngle = pose.blade.startAngle();
  problem.grips.endAngle = end.angle;
  problem.grips.length = blade.length;
  problem.stiffness = blade.flexuralRigidity();
  problem.weight = {0, -weight};
  (grip == 0 ? problem.grips.start : problem.grips.end) += moved;
  *(grip == 0 ? problem.grips.startAngle : problem.grips.endAngle) += turned;
  auto branch = HeavyBranch::from(*pose.heavy, problem.stiffness);
  EXPECT_TRUE(branch);
  const auto move = branch->moveTo(problem);
  EXPECT_TRUE(move && !move->snapped);
  return branch->blade();
}

/// How far that moves the part that cuts across itself, as half the way from one side to the other.
double movedAcross(const BladePose& pose, const Blade& blade, double weight, int grip,
                   const Eigen::Vector2d& moved, double turned) {
  const HeavyBlade there = followed(pose, blade, weight, grip, moved, turned),
                   back = followed(pose, blade, weight, grip, -moved, -turned);
  double farthest = 0;
  for (const double s : pose.cutArcs(26)) {
    const double angle = pose.heavy->at(s).angle;
    const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
    farthest = std::max(farthest, 0.5 * std::abs(normal.dot(there.at(s).point - back.at(s).point)));
  }
  return farthest;
}

TEST(GripErrors, MoveTheCutAsFarAsABladeThatIsFollowed) {
  LengthRequest request = asked();
  request.fit.blade.length = 720;  // where it rests firmly
  Findings findings;
  const Result<Sweep> sweep = buildSweep(wave(), request.fit, block(), planes(), {}, findings);
  ASSERT_TRUE(sweep);
  const double weight = request.fit.blade.weight();
  const auto movedBy = [&](double error, double angle) {
    request.check.gripError = error;
    request.check.gripAngle = angle;
    return checkSweep(*sweep, request.check, {})->stations[4].movedByGrip;
  };
  const BladePose& pose = sweep->poses[4];
  constexpr double kSmall = 0.01, kTurn = 1e-5;
  double moves = 0, turns = 0;
  for (const int grip : {0, 1}) {
    for (int k = 0; k < 180; ++k)
      moves = std::max(
          moves, movedAcross(pose, request.fit.blade, weight, grip,
                             kSmall * Eigen::Vector2d(std::cos(kPi * k / 180), std::sin(kPi * k / 180)), 0));
    for (const double turn : {-kTurn, kTurn})
      turns =
          std::max(turns, movedAcross(pose, request.fit.blade, weight, grip, Eigen::Vector2d::Zero(), turn));
  }
  EXPECT_NEAR(movedBy(kSmall, 0) / moves, 1, 1e-3);
  EXPECT_NEAR(movedBy(0, kTurn) / turns, 1, 1e-3);
  // Off by as much as its slack is, it is moved by more than that tells.
  const Eigen::Vector2d along = (pose.blade.at(pose.blade.length()).point - pose.blade.start()).normalized();
  double most = 0;
  for (const int grip : {0, 1})
    for (const double way : {-0.5, 0.5}) {
      const HeavyBlade there = followed(pose, request.fit.blade, weight, grip, way * along, 0);
      for (const double at : pose.cutArcs(26)) {
        const Elastica::State was = pose.heavy->at(at);
        const Eigen::Vector2d normal(-std::sin(was.angle), std::cos(was.angle));
        most = std::max(most, std::abs(normal.dot(there.at(at).point - was.point)));
      }
    }
  EXPECT_GT(most, 0.5 * moves / kSmall);
  EXPECT_GE(movedBy(0.5, 0), 0.95 * most);
  EXPECT_LE(movedBy(0.5, 0), 1.2 * most);
  EXPECT_GT(movedBy(0.5, fromDegrees(0.2)), movedBy(0.5, 0));
}

TEST(GripErrors, NearTheMarginTheyAreThoseOfABladeThatIsFollowed) {
  // Of flat waves, which give way by more than the first order tells, in steps that are a hundredth of it.
  constexpr int kSteps = 100;
  LengthRequest request = asked();
  request.fit.blade = bladePreset("steel-tube-3-2.5").value();
  request.fit.weight.setZero();
  double beyond = 1;  // the most by which the first order falls short
  for (const double height : {3.0, 6.0, 12.0}) {
    request.fit.blade.length = 800;
    const auto row = test::sectionsOf(3, 10, [&](int) {
      return test::graphCurve(kHalf, [&](double x) { return height * std::sin(kPi * x / kHalf); });
    });
    Findings findings;
    const Result<Sweep> sweep = buildSweep(row, request.fit, block(), planes(), {}, findings);
    ASSERT_TRUE(sweep);
    const BladePose& pose = sweep->poses[1];
    const double stiffness = request.fit.blade.flexuralRigidity();
    const Result<Hanging> light = hang(pose.blade, stiffness, Eigen::Vector2d::Zero());
    ASSERT_TRUE(light);
    const Eigen::Vector2d along =
        (pose.blade.at(pose.blade.length()).point - pose.blade.start()).normalized();
    const auto farthest = [&](double share) {
      double most = 0;
      for (const int grip : {0, 1})
        for (const double way : {-1.0, 1.0})
          for (const double turn : {-1.0, 1.0}) {
            auto branch = HeavyBranch::from(light->blade, stiffness);
            EXPECT_TRUE(branch);
            for (int i = 1; i <= kSteps; ++i) {
              HeavyProblem problem = holdOf(light->blade, stiffness);
              const double part = share * i / kSteps;
              (grip == 0 ? problem.grips.start : problem.grips.end) += 0.5 * part * way * along;
              *(grip == 0 ? problem.grips.startAngle : problem.grips.endAngle) +=
                  part * turn * fromDegrees(0.2);
              problem.grips.turning.reset();
              const auto move = branch->moveTo(problem);
              EXPECT_TRUE(move && !move->snapped) << height;
            }
            for (const double at : pose.cutArcs(26)) {
              const Elastica::State was = light->blade.at(at);
              const Eigen::Vector2d normal(-std::sin(was.angle), std::cos(was.angle));
              most = std::max(most, std::abs(normal.dot(branch->blade().at(at).point - was.point)));
            }
          }
      return most;
    };
    const Result<SweepCheck> check = checkSweep(*sweep, request.check, {});
    ASSERT_TRUE(check);
    const double whole = farthest(1);
    EXPECT_NEAR(check->stations[1].movedByGrip / whole, 1, 0.04)
        << height << ": " << whole << " mm, slack " << pose.slack() << " mm, margin "
        << check->stations[1].stabilityMargin;
    beyond = std::max(beyond, whole / (farthest(0.01) / 0.01));
  }
  EXPECT_GT(beyond, 1.2) << "else nothing is asked";
}

TEST(GripErrors, ABladeThatIsHeldStraightBuckles) {
  // At its full length, or slack by less than the error: what a push of a grip does grows with its root.
  LengthRequest request = asked();
  request.fit.weight.setZero();
  request.check.gripAngle = 0;
  const auto movedWith = [&](double sagitta) {
    const auto arch = test::sectionsOf(3, 10, [&](int) {
      return test::graphCurve(kHalf,
                              [&](double x) { return sagitta * std::pow(std::cos(kPi * x / 650), 2); });
    });
    request.fit.blade.length = 650;
    Findings findings;
    const Result<Sweep> sweep = buildSweep(arch, request.fit, block(), planes(), {}, findings);
    EXPECT_TRUE(sweep);
    const Result<SweepCheck> check = checkSweep(*sweep, request.check, {});
    EXPECT_TRUE(check);
    return check->stations[1].movedByGrip;
  };
  // A clamped blade that is pushed together: of a cosine, whose slack is (π sag)²/4L.
  EXPECT_NEAR(movedWith(0), 2 / kPi * std::sqrt(0.5 * 650), 0.05) << "beside its middle";
  const double slack = kPi * kPi * 100 / (4 * 650), sag = 10;  // 0.38 mm
  const double closer = 2 / kPi * std::sqrt((slack + 0.5) * 650) - sag;
  EXPECT_NEAR(movedWith(sag) / std::max(closer, sag), 1, 0.15);
}

TEST(GripErrors, AGripThatTakesUpAllTheSlackPullsTheBladeFlat) {
  // It moves by as much as it rises, turned or not: by more at each of these arches, which become higher.
  constexpr int kArches = 61;
  LengthRequest request = asked();
  request.fit.blade = bladePreset("steel-tube-3-2.5").value();
  request.fit.blade.length = 750;
  const auto row = test::sectionsOf(kArches, 10, [&](int i) {
    const double height = 2.4 + 9.6 * i / (kArches - 1);
    return test::graphCurve(kHalf, [&](double x) { return height * std::cos(kPi * x / (2 * kHalf)); });
  });
  Findings findings;
  const Result<Sweep> sweep = buildSweep(row, request.fit, block(), planes(), {}, findings);
  ASSERT_TRUE(sweep);
  const Result<SweepCheck> check = checkSweep(*sweep, request.check, {});
  ASSERT_TRUE(check);
  int pulled = 0;
  for (std::size_t i = 1; i < check->stations.size(); ++i) {
    const double slack = sweep->poses[i].slack();
    if (slack < 0.15 || slack > 0.48) continue;
    ++pulled;
    EXPECT_GT(check->stations[i].movedByGrip, 0.98 * check->stations[i - 1].movedByGrip)
        << i << ", slack " << slack;
  }
  EXPECT_GT(pulled, 10);
}

}  // namespace
}  // namespace bw
