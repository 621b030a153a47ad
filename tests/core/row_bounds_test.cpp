// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a row keeps besides its distance from the sections: the clearance of both grips, and the ends,
// tangents and lengths that a request asks for.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/firm_row.h"
#include "bw/core/sweep/live_row.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalf = 250, kSection = 200;
constexpr int kStations = 9;

Box block() { return test::blockUnder(kHalf, 10.0 * (kStations - 1), -2 * kHalf, 2 * kHalf); }
PlaneFamily planes() { return PlaneFamily::across(block(), -Vector3d::UnitY()); }

/// Arches of 400 mm whose middle lies 50 mm beside that of the block.
std::vector<Section> besideTheMiddle() {
  return test::sectionsOf(kStations, 10, [](int i) {
    const double height = 12 + 0.4 * i;
    return test::graphCurve(kSection, [=](double x) { return height * std::cos(0.5 * kPi * x / kSection); })
        .transformed(0, 1, {-50, 0});
  });
}

test::RowSettings heavy(double length) {
  test::RowSettings settings;
  settings.blade.length = length;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  return settings;
}

Sweep rowOf(const FitRequest& request) {
  Findings findings;
  Result<Sweep> sweep = buildSweep(besideTheMiddle(), request, block(), planes(), {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  return std::move(*sweep);
}

/// Of the left and the right grip, mm beside the block.
std::pair<double, double> besides(const BladePose& pose) {
  return {-kHalf - std::min(pose.leftPoint().x(), pose.rightPoint().x()),
          std::max(pose.leftPoint().x(), pose.rightPoint().x()) - kHalf};
}

TEST(RowBounds, ABladeLiesLopsidedWhereAGripWouldComeTooNear) {
  // In the middle of its sections it would stand out by 120 mm at one side and by 20 mm at the other.
  const test::RowSettings settings = heavy(642);
  const Sweep row = rowOf(settings);
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const auto [left, right] = besides(row.poses[i]);
    EXPECT_GE(std::min(left, right), settings.clearance) << i;
    EXPECT_LT(std::min(left, right), settings.clearance + 2) << i << ": no farther than asked";
    EXPECT_LT(row.fits[i].fit.hausdorff, 0.2) << i;
  }
}

TEST(RowBounds, GripsShareWhatClearanceThereIs) {
  const Sweep row = rowOf(heavy(560));
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const auto [left, right] = besides(row.poses[i]);
    EXPECT_NEAR(left, right, 3) << i;
    EXPECT_GT(left, 25) << i;
    EXPECT_LT(row.fits[i].fit.hausdorff, 0.2) << i;
  }
}

Frame turned(const Frame& frame, const Eigen::Quaterniond& turn, const Vector3d& about) {
  return {about + turn * (frame.origin - about), turn * frame.x, turn * frame.y, turn * frame.normal};
}

TEST(RowBounds, GripsKeepClearOfABlockThatIsTurnedBelowThem) {
  const test::RowSettings settings = heavy(642);
  const Vector3d middle(0, -5.0 * (kStations - 1), 0);
  for (const auto& [yaw, roll] :
       {std::pair(15.0, 0.0), {-15.0, 0.0}, {0.0, 10.0}, {0.0, -10.0}, {12.0, 8.0}}) {
    Box box = block();
    box.frame = turned(box.frame,
                       Eigen::AngleAxisd(fromDegrees(yaw), Vector3d::UnitZ()) *
                           Eigen::Quaterniond(Eigen::AngleAxisd(fromDegrees(roll), Vector3d::UnitY())),
                       middle);
    Findings findings;
    const Result<Sweep> row = buildSweep(besideTheMiddle(), settings, box,
                                         PlaneFamily::across(box, -Vector3d::UnitY()), {}, findings);
    ASSERT_TRUE(row) << row.error().message;
    double least = 1e300, bare = 1e300;  // as it is, and with the blades in the middle of their sections
    for (std::size_t i = 0; i < row->poses.size(); ++i) {
      const BladePose& pose = row->poses[i];
      bare =
          std::min(bare, test::outside(box, {-50 + 0.5 * settings.blade.length, pose.frame.origin.y(), 0}));
      const double near =
          std::min(test::outside(box, pose.leftPoint()), test::outside(box, pose.rightPoint()));
      EXPECT_GE(near, settings.clearance) << yaw << " " << roll << " " << i;
      EXPECT_LT(row->fits[i].fit.hausdorff, 0.2) << yaw << " " << roll << " " << i;
      least = std::min(least, near);
    }
    EXPECT_LT(bare, settings.clearance) << "the case asks for nothing";
    // The block counts as going on along the travel: one that lies askew is cleared by what it reaches there.
    EXPECT_LT(least, settings.clearance + 25) << yaw << " " << roll << ": hardly farther than asked";
  }
}

TEST(RowBounds, ARowIsTheSameHoweverAllOfItLies) {
  const test::RowSettings settings = heavy(642);
  const Sweep upright = rowOf(settings);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.5, 0.8).normalized()));
  test::RowSettings elsewhere = settings;
  elsewhere.weight = turn * settings.weight;
  std::vector<Section> sections = besideTheMiddle();
  for (Section& section : sections) section.frame = turned(section.frame, turn, Vector3d::Zero());
  Box box = block();
  box.frame = turned(box.frame, turn, Vector3d::Zero());
  PlaneFamily family = planes();
  family.frame = turned(family.frame, turn, Vector3d::Zero());
  Findings findings;
  const Result<Sweep> row = buildSweep(sections, elsewhere, box, family, {}, findings);
  ASSERT_TRUE(row) << row.error().message;
  ASSERT_EQ(row->poses.size(), upright.poses.size());
  for (std::size_t i = 0; i < upright.poses.size(); ++i) {
    const BladePose &there = row->poses[i], &here = upright.poses[i];
    EXPECT_LT((there.leftPoint() - turn * here.leftPoint()).norm(), 1e-3) << i;
    EXPECT_LT((there.rightPoint() - turn * here.rightPoint()).norm(), 1e-3) << i;
    EXPECT_GE(std::min(test::outside(box, there.leftPoint()), test::outside(box, there.rightPoint())),
              settings.clearance);
  }
}

/// How fast the grips of neighbours slide along their sections, mm a mm of travel.
double fastestSlide(const Sweep& row) {
  double fastest = 0;
  for (std::size_t i = 1; i < row.poses.size(); ++i) {
    const BladePose &from = row.poses[i - 1], &to = row.poses[i];
    const double slid =
        0.5 * (to.leftPoint().x() + to.rightPoint().x() - from.leftPoint().x() - from.rightPoint().x());
    fastest = std::max(fastest, std::abs(slid) / std::abs(to.travel - from.travel));
  }
  return fastest;
}

TEST(RowBounds, GripsSlideNoFasterThanTheyTravel) {
  for (const double jump : {40.0, 80.0, 120.0}) {
    // One arch all along, of which some stations have only a piece at one side.
    const auto sections = test::sectionsOf(kStations, 10, [jump](int i) {
      const double half = i % 4 == 2 ? kSection - jump : kSection, middle = i % 4 == 2 ? jump : 0;
      return test::graphCurve(half,
                              [=](double x) { return 12 * std::cos(0.5 * kPi * (x + middle) / kSection); })
          .transformed(0, 1, {middle, 0});
    });
    Findings findings;
    const Result<Sweep> row = buildSweep(sections, heavy(700), block(), planes(), {}, findings);
    ASSERT_TRUE(row) << row.error().message;
    EXPECT_LT(fastestSlide(*row), 1.15) << jump << ": 1 but for what the sections weigh";
    for (const StationFit& fit : row->fits) EXPECT_LT(fit.fit.hausdorff, 0.3) << jump;
  }
}

/// How much farther grips turn from a station to the next than they may: a quarter of the blade turns by 5 mm
/// a mm of travel, and 1.5 times as far as the end of the section does. In parts of that.
double fastestTurn(const Sweep& row) {
  double fastest = 0;
  const double arm = 0.25 * row.request.blade.length;
  for (std::size_t i = 1; i < row.poses.size(); ++i) {
    const BladePose &from = row.poses[i - 1], &to = row.poses[i];
    const PlanarCurve &before = row.fits[i - 1].target, &now = row.fits[i].target;
    const auto between = [](const Vector2d& a, const Vector2d& b) {
      return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
    };
    for (const bool last : {false, true}) {
      const Vector3d a = last ? from.rightTangent() : from.leftTangent(),
                     b = last ? to.rightTangent() : to.leftTangent();
      const double turned = between({a.x(), a.z()}, {b.x(), b.z()});
      const double own = between(before.tangent(last ? before.end() : before.start()),
                                 now.tangent(last ? now.end() : now.start()));
      const double most = 5 * std::abs(to.travel - from.travel) / arm + 1.5 * own;
      fastest = std::max(fastest, turned / most);
    }
  }
  return fastest;
}

TEST(RowBounds, GripsTurnNoFasterThanTheSectionsAndTheTravelLetThem) {
  // Short arches that become hollows from a station to the next: what a blade does beyond them is hardly told
  // by them, and goes on to turn, by 1.67 of what it may where nothing is asked for.
  for (const double height : {1.58, 1.6}) {
    const auto sections = test::sectionsOf(kStations, 2, [height](int i) {
      const double up = i < kStations / 2 ? height : -height;
      return test::graphCurve(60, [=](double x) { return up * std::cos(0.5 * kPi * x / 60); });
    });
    Findings findings;
    const Result<Sweep> row = buildSweep(sections, heavy(700), block(), planes(), {}, findings);
    ASSERT_TRUE(row) << row.error().message;
    EXPECT_LT(fastestTurn(*row), 1.15) << height << ": 1 but for what the sections weigh";
    for (const StationFit& fit : row->fits) EXPECT_LT(fit.fit.hausdorff, row->request.tolerance) << height;
  }
}

TEST(RowBounds, TheBladeThatHangsHasTheEndsTangentsAndLengthsAskedFor) {
  test::RowSettings settings = heavy(700);
  settings.fitEndpoints = settings.fitTangents = true;
  settings.fitLength = FitOptions::Length::exact;
  const Sweep row = rowOf(settings);
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const BladePose& pose = row.poses[i];
    const PlanarCurve& section = row.fits[i].target;
    ASSERT_TRUE(pose.heavy) << i;
    std::array<Elastica::State, 2> ends;
    const std::array<double, 2> arcs = {pose.before, pose.before + pose.cut.length()};
    pose.at(arcs, ends);
    EXPECT_NEAR(pose.cut.length(), section.length(), 1e-3) << i;
    for (int end = 0; end < 2; ++end) {
      const double t = end == 0 ? section.start() : section.end();
      EXPECT_LT((ends[std::size_t(end)].point - section.value(t)).norm(), 1e-3) << i;
      const Vector2d tangent = section.tangent(t);
      EXPECT_NEAR(
          std::remainder(ends[std::size_t(end)].angle - std::atan2(tangent.y(), tangent.x()), 2 * kPi), 0,
          1e-5)
          << i;
    }
    EXPECT_NE(row.fits[i].fit.status, FitStatus::infeasible);
    EXPECT_LT(row.fits[i].fit.hausdorff, 1) << i;
  }
}

TEST(RowBounds, EndsAndTangentsAreMetWhereAnArchBecomesAHollow) {
  // Between both the sections are flat, and no arch of the blade bears its weight.
  constexpr int kRows = 25;
  constexpr double kWide = 300, kHigh = 14;
  const auto sections = test::sectionsOf(kRows, 20, [](int i) {
    const double up = kHigh * (1 - 2.0 * i / (kRows - 1));
    return test::graphCurve(kWide, [=](double x) { return up * std::cos(0.5 * kPi * x / kWide); });
  });
  const Box foam = test::blockUnder(kWide, 20.0 * (kRows - 1), -kWide, kWide);
  test::RowSettings settings = test::flatRow(800);
  settings.fitEndpoints = settings.fitTangents = true;
  settings.barrier = 1;
  Findings findings;
  const Result<Sweep> row = buildSweep(sections, settings, foam,
                                       PlaneFamily::across(foam, -Eigen::Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(row) << row.error().message;
  const Result<FirmRow> firm = firmRow(*row, {});
  ASSERT_TRUE(firm) << firm.error().message;
  const Sweep& found = firm->row ? *firm->row : *row;
  for (std::size_t i = 0; i < found.fits.size(); ++i) {
    const StationFit& fit = found.fits[i];
    EXPECT_NE(fit.fit.status, FitStatus::infeasible) << i;
    EXPECT_FALSE(fit.snapsAt) << i;
    EXPECT_LT(fit.fit.hausdorff, settings.tolerance) << i;
    ASSERT_TRUE(found.poses[i].heavy) << i;
    EXPECT_GE(marginsOf(*found.poses[i].heavy).inPlane, settings.margin) << i;
  }
}

TEST(RowBounds, WhereEndsAndTangentsAreAskedForGripsGoStraightOnBesideSectionsThatDo) {
  // The same curve everywhere, higher or lower: what a blade that meets its ends has left to choose costs
  // next to nothing, and no solver that is led along the border of what is asked for comes to its end.
  constexpr int kRows = 21;
  constexpr double kWide = 300, kPitch = 40;
  const auto sections = test::sectionsOf(kRows, kPitch, [](int i) {
    return test::graphCurve(kWide, [=](double x) {
      return 25 * std::cos(kPi * (x + 400) / 900) + 6 * std::sin(kPitch * i / 180);
    });
  });
  const Box foam = test::blockUnder(kWide, kPitch * (kRows - 1), -kWide, kWide);
  test::RowSettings settings = test::flatRow(800);
  settings.fitEndpoints = settings.fitTangents = true;
  Findings findings;
  const Result<Sweep> row = buildSweep(sections, settings, foam,
                                       PlaneFamily::across(foam, -Eigen::Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(row) << row.error().message;
  for (std::size_t i = 0; i < row->poses.size(); ++i) {
    EXPECT_NE(row->fits[i].fit.status, FitStatus::infeasible) << i;
    EXPECT_LT(row->fits[i].fit.hausdorff, settings.tolerance) << i;
    if (i == 0) continue;
    const Eigen::Vector3d moved = row->poses[i].leftPoint() - row->poses[i - 1].leftPoint();
    EXPECT_LT(std::abs(moved.x()), 0.5 * kPitch) << i << ": along the section";
  }
}

TEST(RowBounds, ARowThatFollowsAHandLiesAsNearAsOneFoundAnew) {
  const test::RowSettings settings = heavy(642);
  const auto found = [&](const std::vector<Section>& sections) {
    Findings findings;
    Result<Sweep> sweep = buildSweep(sections, settings, block(), planes(), {}, findings);
    EXPECT_TRUE(sweep) << sweep.error().message;
    return std::move(*sweep);
  };
  std::vector<Section> sections = besideTheMiddle();
  std::optional<LiveRow> row = LiveRow::of(found(sections), {});
  ASSERT_TRUE(row);
  for (int step = 0; step < 8; ++step) {
    for (Section& section : sections)
      for (PlanarCurve& branch : section.branches)
        branch = branch.transformed(1e-3, step % 2 ? 1.004 : 0.997, {0.3, 1.7});
    ASSERT_TRUE(row->follow(sections, block(), planes(), {})) << step;
    const Sweep &now = row->sweep(), anew = found(sections);
    for (std::size_t i = 0; i < anew.poses.size(); ++i) {
      const BladePose& pose = now.poses[i];
      EXPECT_LT((anew.poses[i].leftPoint() - pose.leftPoint()).norm(), 0.2) << step << " " << i;
      EXPECT_NEAR(anew.fits[i].fit.hausdorff, now.fits[i].fit.hausdorff, 0.01) << step << " " << i;
      // It is the blade that hangs between these very grips.
      ASSERT_TRUE(pose.heavy) << i;
      const Result<Hanging> hanging =
          hang(pose.blade, settings.blade.flexuralRigidity(),
               {settings.weight.dot(pose.frame.x), settings.weight.dot(pose.frame.y)});
      ASSERT_TRUE(hanging) << i;
      for (const double s : {0.2, 0.5, 0.8}) {
        const std::array<double, 1> arc = {s * pose.blade.length()};
        std::array<Elastica::State, 1> is, must;
        pose.at(arc, is);
        hanging->blade.at(arc, must);
        EXPECT_LT((is[0].point - must[0].point).norm(), 1e-5) << step << " " << i;
      }
    }
  }
  // What is none of it.
  std::vector<Section> fewer = sections;
  fewer.pop_back();
  EXPECT_FALSE(row->follow(fewer, block(), planes(), {}));
}

TEST(RowBounds, ARowThatAHandFlingsIsFoundAnew) {
  const test::RowSettings settings = heavy(642);
  Findings findings;
  std::vector<Section> sections = besideTheMiddle();
  const Result<Sweep> sweep = buildSweep(sections, settings, block(), planes(), {}, findings);
  ASSERT_TRUE(sweep);
  std::optional<LiveRow> row = LiveRow::of(*sweep, {});
  ASSERT_TRUE(row);
  // Longer than the blade: none lies on it.
  for (Section& section : sections)
    for (PlanarCurve& branch : section.branches) branch = branch.transformed(0, 1.7, {0, 0});
  EXPECT_FALSE(row->follow(sections, block(), planes(), {}));
}

TEST(RowBounds, WhatIsAskedForAndCannotBeIsTold) {
  // Tangents that a blade of so small a bend cannot have.
  test::RowSettings settings = heavy(700);
  settings.fitEndpoints = settings.fitTangents = true;
  settings.fitLength = FitOptions::Length::exact;
  settings.blade.outerDiameter = 60;
  settings.blade.innerDiameter = 40;
  const Sweep row = rowOf(settings);
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const FitResult& fit = row.fits[i].fit;
    const bool told = fit.status == FitStatus::infeasible && !fit.conflict.empty();
    EXPECT_TRUE(told || row.poses[i].maxCurvature() > settings.blade.maxCurvature()) << i;
  }
}

}  // namespace
}  // namespace bw
