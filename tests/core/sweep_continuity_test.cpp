// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Blades much longer than their sections: what their ends do from station to station.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/sweep/sweep_check.h"
#include "finding_of.h"
#include "row_settings.h"

namespace bw {

namespace {

/// A section y = height(x) over x = −half … half, the i-th of a row at distances of 20 mm.
template <class Height>
Section section(int i, Height height, double half) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k <= 80; ++k) {
    const double x = half * (k / 40.0 - 1);
    points.emplace_back(x, height(x));
  }
  const double y = 20.0 * i;
  return {i,
          y,
          Frame{{0, y, 0}, -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()},
          {*PlanarCurve::points(points)}};
}

Section parabola(int i, double bend, double half) {
  return section(
      i, [bend](double x) { return bend * x * x; }, half);
}

/// An arc that bulges to the side of `radius`.
Section arc(int i, double radius, double half) {
  return section(
      i, [radius](double x) { return std::copysign(std::sqrt(radius * radius - x * x), radius); }, half);
}

Box block() {
  return {Frame{{-150, 0, -50}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
          {300, 300, 100}};
}

double largestSwing(const Sweep& sweep) {
  double largest = 0;
  for (std::size_t i = 1; i < sweep.poses.size(); ++i) {
    const BladePose &a = sweep.poses[i - 1], &b = sweep.poses[i];
    for (const double cosine : {a.leftTangent().dot(b.leftTangent()), a.rightTangent().dot(b.rightTangent())})
      largest = std::max(largest, std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  return largest;
}

Result<Sweep> sweepOf(const std::vector<Section>& sections, const test::RowSettings& settings,
                      Findings& findings) {
  return buildSweep(sections, settings, block(), PlaneFamily::across(block(), Eigen::Vector3d::UnitY()), {},
                    findings);
}

const Finding* swingOf(const Findings& findings) { return test::findingOf<EndsSwing>(findings); }

/// Hollows and bulges of 0.6 mm in turn: a blade of 1600 mm that followed them would fling its ends about.
std::vector<Section> waves() {
  std::vector<Section> sections;
  for (int i = 0; i < 9; ++i) sections.push_back(parabola(i, i % 2 == 0 ? 0.00065 : -0.00065, 30 + i));
  return sections;
}

}  // namespace

TEST(SweepContinuity, EndsOfALongBladeKeepStillOverShortSections) {
  test::RowSettings settings;
  settings.blade.length = 1600;
  settings.tolerance = 2;
  Findings findings;
  const Result<Sweep> sweep = sweepOf(waves(), settings, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  EXPECT_LT(largestSwing(*sweep), 16 * kDegree);
  EXPECT_EQ(swingOf(findings), nullptr);
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_LE(sweep->fits[i].fit.hausdorff, settings.tolerance);
    EXPECT_LE(sweep->poses[i].blade.maxCurvature(), settings.blade.maxCurvature());
    EXPECT_GT(stabilityMargin(sweep->poses[i].blade), 0);
  }
}

TEST(SweepContinuity, StepsAreWithinWhatTheToleranceAllows) {
  // The finer the tolerance, the farther the ends must go along with the sections, and that is told. A margin
  // keeps them from it.
  test::RowSettings settings;
  settings.blade = test::flatBlade(1600);
  settings.margin = 0;
  settings.tolerance = 0.01;
  Findings findings;
  const Result<Sweep> sweep = sweepOf(waves(), settings, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  EXPECT_GT(largestSwing(*sweep), 45 * kDegree);
  const Finding* swing = swingOf(findings);
  ASSERT_NE(swing, nullptr);
  EXPECT_NEAR(std::get<EndsSwing>(swing->cause).travel, 20, 1e-9);
  EXPECT_NEAR(std::get<EndsSwing>(swing->cause).angle, largestSwing(*sweep), 1e-6);
  EXPECT_TRUE(remedyOf<MoreStations>(swing->remedies));
}

TEST(SweepContinuity, EndsThatTheSectionsFlingAreAnError) {
  test::RowSettings settings;
  settings.blade.length = 1000;
  settings.blade.yieldStress = 1000;  // bends to 360 mm
  settings.tolerance = 0.1;
  std::vector<Section> sections;
  for (int i = 0; i < 4; ++i) sections.push_back(arc(i, i % 2 == 0 ? 400 : -400, 260));
  Findings findings;
  const Result<Sweep> sweep = sweepOf(sections, settings, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  EXPECT_GT(largestSwing(*sweep), 90 * kDegree);
  const Finding* swing = swingOf(findings);
  ASSERT_NE(swing, nullptr);
  EXPECT_EQ(swing->severity, Severity::error);
}

TEST(SweepContinuity, SectionsThatTellTheBladeAreFollowed) {
  // Sections of three quarters of the blade, each bent more than the one before.
  test::RowSettings settings;
  settings.blade.length = 800;
  settings.tolerance = 5;
  std::vector<Section> sections;
  for (int i = 0; i < 6; ++i) sections.push_back(parabola(i, 0.00024 * (i - 2.5), 300));
  Findings findings;
  const Result<Sweep> sweep = sweepOf(sections, settings, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  for (const StationFit& found : sweep->fits) EXPECT_LT(found.fit.R4, 1e-3);
}

TEST(SweepContinuity, SectionsFarTooRoundKeepTheBladeStill) {
  // A thread: 20 mm that bend ten times as sharply as the blade. Straight, or bent to either side, it lies
  // about as near, so that each section by itself would have it otherwise.
  for (const bool heavy : {false, true}) {
    test::RowSettings settings;
    settings.blade.length = 700;
    if (heavy) settings.weight = {0, 0, -2e-4};
    std::vector<Section> sections;
    for (int i = 0; i < 12; ++i) sections.push_back(arc(i, 22 + 0.4 * i, 10));
    Findings findings;
    const Result<Sweep> sweep = sweepOf(sections, settings, findings);
    ASSERT_TRUE(sweep) << sweep.error().message;
    EXPECT_LT(largestSwing(*sweep), 12 * kDegree);
    EXPECT_EQ(swingOf(findings), nullptr);
    for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
      EXPECT_LE(sweep->poses[i].maxCurvature(), settings.blade.maxCurvature());
      EXPECT_LE(sweep->fits[i].fit.hausdorff, settings.tolerance);
    }
  }
}

/// The largest way of a grip from one station to the next, mm.
double largestStep(const Sweep& sweep) {
  double largest = 0;
  for (std::size_t i = 1; i < sweep.poses.size(); ++i) {
    const BladePose &a = sweep.poses[i - 1], &b = sweep.poses[i];
    largest =
        std::max({largest, (a.leftPoint() - b.leftPoint()).norm(), (a.rightPoint() - b.rightPoint()).norm()});
  }
  return largest;
}

TEST(SweepContinuity, GripsDoNotJumpWhereSectionsGrowLonger) {
  // From one station to the next the section goes on by 150 mm at one end: centred blades jump by half of it.
  test::RowSettings settings;
  settings.blade.length = 1000;
  std::vector<Section> sections;
  for (int i = 0; i < 16; ++i) {
    sections.push_back(arc(i, 1200, 300));
    if (i < 8) continue;
    PlanarCurve& curve = sections.back().curve();
    curve = *curve.subCurve(curve.start(), curve.parameterAt(curve.length() - 150));
  }
  Findings findings;
  const PlaneFamily planes = PlaneFamily::across(block(), Eigen::Vector3d::UnitY());
  const Result<Sweep> centred = fitSweep(sections, settings, block(), planes, {});
  const Result<Sweep> settled = sweepOf(sections, settings, findings);
  ASSERT_TRUE(centred && settled);
  EXPECT_GT(largestStep(*centred), 70);
  EXPECT_LT(largestStep(*settled), 35);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const BladePose& pose = settled->poses[i];
    EXPECT_LT(settled->fits[i].fit.hausdorff, 0.04);
    EXPECT_NEAR(pose.before + pose.cut.length() + pose.after(), 1000, 1e-9);
    EXPECT_GT(pose.before, 100);
    EXPECT_GT(pose.after(), 100);
    EXPECT_NEAR(pose.cut.length(), sections[i].curve().length(), 0.05);
  }
}

TEST(SweepContinuity, BladesOfARowDoNotDependOnTheThreads) {
  test::RowSettings settings;
  settings.blade.length = 1600;
  settings.weight = -settings.blade.weight() * Eigen::Vector3d::UnitZ();
  Findings findings;
  std::vector<Sweep> rows;
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    const Result<Sweep> row =
        buildSweep(waves(), settings, block(), PlaneFamily::across(block(), Eigen::Vector3d::UnitY()),
                   context, findings);
    ASSERT_TRUE(row);
    rows.push_back(*row);
  }
  for (std::size_t i = 0; i < rows[0].poses.size(); ++i) {
    EXPECT_EQ(rows[0].poses[i].leftPoint(), rows[1].poses[i].leftPoint());
    EXPECT_EQ(rows[0].poses[i].rightTangent(), rows[1].poses[i].rightTangent());
  }
}

TEST(SweepContinuity, RunsFromItsLongestSection) {
  // The same row run from either end gives the same blades.
  test::RowSettings settings;
  settings.blade.length = 1600;
  std::vector<Section> sections = waves();
  Findings findings;
  const Result<Sweep> there = sweepOf(sections, settings, findings);
  std::reverse(sections.begin(), sections.end());
  const Result<Sweep> back = sweepOf(sections, settings, findings);
  ASSERT_TRUE(there && back);
  for (std::size_t i = 0; i < sections.size(); ++i)
    EXPECT_LT((there->poses[i].leftPoint() - back->poses[sections.size() - 1 - i].leftPoint()).norm(), 1e-6);
}

TEST(SweepContinuity, ABladeShorterThanOneSectionIsAnErrorWhateverItsNeighbours) {
  test::RowSettings settings;
  settings.blade.length = 610;
  std::vector<Section> sections;
  for (int i = 0; i < 5; ++i) sections.push_back(parabola(i, 1e-5, i == 2 ? 308 : 295));
  Findings findings;
  const Result<Sweep> sweep = sweepOf(sections, settings, findings);
  ASSERT_FALSE(sweep);
  EXPECT_EQ(sweep.error().code, ErrorCode::badInput);
  EXPECT_NE(sweep.error().message.find("shorter than the section of station 3"), std::string::npos)
      << sweep.error().message;
}

TEST(SweepContinuity, ABladeHeldByItsSmallestRadiusIsTold) {
  for (const bool heavy : {false, true}) {
    test::RowSettings settings;
    settings.blade.length = 300;
    settings.tolerance = 3;
    if (heavy) settings.weight = {0, 0, -2e-4};
    std::vector<Section> sections;
    for (int i = 0; i < 5; ++i) sections.push_back(arc(i, settings.blade.minRadius() - 40, 100));
    Findings findings;
    const Result<Sweep> sweep = sweepOf(sections, settings, findings);
    ASSERT_TRUE(sweep) << sweep.error().message;
    for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
      EXPECT_TRUE(sweep->fits[i].heldBack) << heavy << " " << i;
      EXPECT_GT(sweep->poses[i].maxCurvature(), 0.95 * settings.blade.maxCurvature());
      EXPECT_LE(sweep->poses[i].maxCurvature(), settings.blade.maxCurvature());
    }
  }
}

}  // namespace bw
