// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rows in parallel planes that meet the block obliquely: their sections wander from one of its sides to the
// other, and go on beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../support/analytic_surfaces.h"
#include "../support/finding_of.h"
#include "../support/plane_sections.h"
#include "../support/row_settings.h"
#include "bw/core/base/line_in_box.h"
#include "bw/core/base/units.h"
#include "bw/core/motion/motion.h"
#include "bw/core/sweep/row_motion.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using HeightOver = std::function<double(double x, double y)>;

constexpr double kSlantedWide = 600;
constexpr int kSlantedStations = 25;

/// z = height(x, y), its places told straight below.
class OverHeight : public test::PlaneSampler {
 public:
  explicit OverHeight(HeightOver height) : PlaneSampler(Vector3d::UnitZ()), height_(std::move(height)) {}
  Result<Foot> closest(const Vector3d& p, const Foot*) override {
    const double z = height_(p.x(), p.y());
    return Foot{0, p.head<2>(), {p.x(), p.y(), z}, Vector3d::UnitZ(), std::abs(p.z() - z), false};
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<OverHeight>(*this); }

 private:
  HeightOver height_;
};

struct SlantedRow {
  Box block;
  PlaneFamily planes;
  std::vector<Section> sections;

  /// In planes turned by `tilt` (rad) about the upright.
  SlantedRow(double deep, double tilt, const HeightOver& height)
      : block{Frame{{0, 0, 0}, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
              {kSlantedWide, deep, 500}},
        planes(PlaneFamily::across(block, Vector3d(std::sin(tilt), std::cos(tilt), 0))) {
    const double apart = (planes.exit - planes.entry) / (kSlantedStations - 1);
    for (int i = 0; i < kSlantedStations; ++i) {
      const double level = planes.entry + apart * i;
      const Frame frame = planes.at(level);
      // What lies in the block, or comes in where it is carried to the next plane.
      const auto counts = [&](double x) {
        const Vector3d place = frame.toWorld(Vector2d(x, 0)) + Vector3d(0, 0, 250 - frame.origin.z());
        return lineInBox(block.size, block.frame.toLocal(place - apart * frame.normal),
                         block.frame.toLocal(place + apart * frame.normal), 1e-9)
            .has_value();
      };
      double from = 1e300, to = -1e300;
      for (double x = -2000; x <= 2000; x += 0.5) {
        if (!counts(x)) continue;
        from = std::min(from, x);
        to = std::max(to, x);
      }
      std::vector<Vector2d> chain;
      for (int k = 0; k <= 200; ++k) {
        const double x = from + (to - from) * k / 200;
        const Vector3d place = frame.toWorld(Vector2d(x, 0));
        chain.emplace_back(x, (height(place.x(), place.y()) - frame.origin.z()) / frame.y.z());
      }
      sections.push_back({i, planes.travel(level), frame, {*PlanarCurve::points(chain)}});
    }
  }
};

test::RowSettings slantedSettings(double length) {
  test::RowSettings settings;
  settings.blade.length = length;
  settings.weight = -settings.blade.weight() * Vector3d::UnitZ();
  return settings;
}

double slantedArch(double x) { return 250 - 40 * std::pow((x - 300) / 300, 2); }

struct SlantedRun {
  Sweep sweep;
  SweepAnalysis analysis;
  RowMotion motion;
  WayDeviation way;
};
SlantedRun slantedRun(const SlantedRow& row, const test::RowSettings& settings, const HeightOver& height) {
  Findings findings;
  Result<Sweep> sweep = buildSweep(row.sections, settings, row.block, row.planes, {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  const OverHeight target(height);
  Result<RowMotion> motion = followRow(*sweep, settings, {});
  EXPECT_TRUE(motion);
  const Result<SweepCheck> check = checkSweep(*sweep, settings, {});
  EXPECT_TRUE(check);
  Result<SweepAnalysis> analysis =
      analyzeSweep(*sweep, motion->course, *check, settings, target, test::interpolated, {});
  EXPECT_TRUE(analysis);
  EXPECT_EQ(motion->snaps, 0);
  Result<WayDeviation> way = deviationOf(*motion, *sweep, *analysis, settings, target, {});
  EXPECT_TRUE(way);
  return {std::move(*sweep), std::move(*analysis), std::move(*motion), std::move(*way)};
}

TEST(SlantedRow, BladesNeitherBendForWhatLiesBesideTheBlockNorAreFoundFarFromIt) {
  // Ripples of 3 and 8 mm in front of the block, which are less than 0.02 mm in it.
  for (const auto& [high, before, wide] : {std::array{3.0, 70.0, 15.0}, {8.0, 90.0, 25.0}}) {
    const HeightOver height = [=](double x, double y) {
      return slantedArch(x) +
             high * std::sin(2 * kPi * x / 90) * std::exp(-std::pow((y + before) / wide, 2) / 2);
    };
    const SlantedRun row = slantedRun({800, fromDegrees(15), height}, slantedSettings(1000), height);
    EXPECT_LT(row.analysis.summary.deviationMax, 1) << high;
    EXPECT_LT(row.analysis.summary.deviationMean, 0.02) << high;
    EXPECT_LT(row.way.deviationMax, 1) << high;
    // The map tells of the block, as the numbers do; what bends the blade is told beside it too.
    const SurfaceGrid& cut = row.analysis.cut;
    double farthest = 0, steepest = 0;
    std::size_t beside = 0;
    for (std::size_t k = 0; k < cut.points.size(); ++k) {
      const double deviation = cut.field("deviation")->values[k], angle = cut.field("angle")->values[k];
      EXPECT_TRUE(std::isfinite(cut.field("curvature")->values[k]));
      const bool in = test::outside(row.sweep.block, cut.points[k]) <= 0;
      EXPECT_TRUE(!in || std::isfinite(deviation));
      EXPECT_EQ(std::isfinite(deviation), std::isfinite(angle));
      if (!std::isfinite(deviation)) {
        ++beside;
        continue;
      }
      farthest = std::max(farthest, std::abs(deviation));
      steepest = std::max(steepest, angle);
    }
    EXPECT_GT(beside, cut.points.size() / 50);
    EXPECT_LE(farthest, row.analysis.summary.deviationMax) << high;
    EXPECT_NEAR(farthest, row.analysis.summary.deviationMax, 1e-3) << "what lies between columns comes to it";
    EXPECT_LT(steepest, toDegrees(row.analysis.summary.angleMax) + 2) << high;
  }
}

TEST(SlantedRow, ABladeNeedNotRunAlongItselfWithItsSections) {
  // The sections of the short block are 85 mm and come past all of its 600 mm.
  for (const auto& [deep, tilt, length] : {std::array{800.0, 3.0, 1000.0},
                                           {800.0, 5.7, 1000.0},
                                           {800.0, 15.0, 1000.0},
                                           {800.0, 40.0, 1200.0},
                                           {60.0, 44.0, 1200.0}}) {
    const SlantedRun row =
        slantedRun({deep, fromDegrees(tilt), [](double x, double) { return slantedArch(x); }},
                   slantedSettings(length), [](double x, double) { return slantedArch(x); });
    // The surface follows where the sections begin to end earlier from station to station.
    EXPECT_LT(row.analysis.summary.deviationMax, 0.06) << tilt;
    EXPECT_LT(row.analysis.summary.deviationMean, 0.002) << tilt;
    for (const StationFit& fit : row.sweep.fits) EXPECT_LT(fit.fit.hausdorff, 0.1) << tilt;
    EXPECT_LT(toDegrees(row.analysis.summary.angleMax), 25) << tilt;
    const std::vector<BladePose>& poses = row.sweep.poses;
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (const Vector3d& grip : {poses[i].leftPoint(), poses[i].rightPoint()})
        EXPECT_GT(test::outside(row.sweep.block, grip), row.sweep.request.clearance) << tilt << " " << i;
  }
}

TEST(SlantedRow, GripsKeepClearOfCornersBetweenTheStationsToo) {
  const HeightOver height = [](double x, double) { return slantedArch(x); };
  const test::RowSettings settings = slantedSettings(1000);
  for (const double tilt : {3.0, 15.0, 30.0}) {
    const SlantedRun row = slantedRun({800, fromDegrees(tilt), height}, settings, height);
    Findings findings;
    const Result<Motion> motion = buildMotion(row.sweep, {}, row.motion.targets, settings, findings);
    ASSERT_TRUE(motion);
    EXPECT_FALSE(test::findingOf<GripTooNear>(findings)) << tilt;
    for (std::size_t i = 1; i < motion->instants.size(); ++i)
      for (std::size_t grip = 0; grip < 2; ++grip)
        for (int k = 0; k <= 20; ++k) {
          const Vector3d &from = motion->instants[i - 1].poses[grip].position,
                         &to = motion->instants[i].poses[grip].position;
          const Vector3d place = from + k / 20.0 * (to - from);
          EXPECT_GT(test::outside(row.sweep.block, row.sweep.block.frame.toWorld(place.head<2>(), place.z())),
                    settings.clearance - 0.1)
              << tilt << " " << i;
        }
  }
}

TEST(SlantedRow, AShortBladeGoesWithItsSections) {
  const HeightOver height = [](double x, double) { return slantedArch(x); };
  const SlantedRun row = slantedRun({60, fromDegrees(44), height}, slantedSettings(260), height);
  EXPECT_LT(row.analysis.summary.deviationMax, 0.1);
  for (const BladePose& pose : row.sweep.poses)
    for (const Vector3d& grip : {pose.leftPoint(), pose.rightPoint()})
      EXPECT_GT(test::outside(row.sweep.block, grip), row.sweep.request.clearance - 1) << pose.index;
}

TEST(SlantedRow, TheFarthestPlaceIsFoundBetweenColumnsToo) {
  // A ridge that no blade follows, halfway between two of the columns 6 mm apart.
  const auto sectionHeight = [](double x, double) { return slantedArch(x); };
  for (const double at : {303.0, 351.0, 404.0}) {
    const HeightOver target = [&](double x, double) {
      return slantedArch(x) + 2.8 * std::exp(-std::pow((x - at) / 4, 2));
    };
    const SlantedRun run = slantedRun({800, 0, sectionHeight}, slantedSettings(1000), target);
    EXPECT_NEAR(run.analysis.summary.deviationMax, 2.8, 0.1) << at;
    EXPECT_LT(run.analysis.summary.withinTolerance, 1);
    EXPECT_NEAR(run.way.deviationMax, 2.8, 0.1) << at;
    EXPECT_NEAR(run.way.worst.x(), at, 1) << at;
  }
}

TEST(SlantedRow, ABladeThatLeavesTheBlockIsOffWhatLiesInIt) {
  // It rises to 250 mm, the block and its target to less: at the right nothing of the blade is in the block.
  const auto sectionHeight = [](double x, double) { return 200 + x / 12; };
  const HeightOver target = [&](double x, double y) {
    return sectionHeight(x, y) - 5 * std::pow(std::clamp(x / kSlantedWide, 0.0, 1.0), 2);
  };
  SlantedRow row(200, 0, sectionHeight);
  row.block.size.z() = 246;
  const SlantedRun run = slantedRun(row, slantedSettings(1000), target);
  EXPECT_GT(run.analysis.summary.deviationMax, 4.8);
  EXPECT_GT(run.way.deviationMax, 4.8);
}

}  // namespace
}  // namespace bw
