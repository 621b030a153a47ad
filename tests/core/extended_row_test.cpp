// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rows whose blades have the ends, tangents and length of their sections, extended to the grips.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/shape/moved_sections.h"
#include "bw/core/sweep/live_row.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadius = 900;
constexpr double kHalf = 0.3;  // rad that the section reaches to both sides of the top
constexpr int kStations = 5;

Box block() { return test::blockUnder(kRadius * std::sin(kHalf), 400, 500, 1000); }
PlaneFamily planes() { return PlaneFamily::across(block(), -Vector3d::UnitY()); }

/// An arc about the origin between these angles from the top.
PlanarCurve arcBetween(double left, double right) {
  return test::arc({0, 0}, kRadius, kPi / 2 - left, kPi / 2 - right);
}

/// A cylinder along the travel that reaches `beyond` rad past both sides of the block.
std::vector<Section> cylinder(double beyond) {
  std::vector<Section> sections =
      test::sectionsOf(kStations, 100, [](int) { return arcBetween(-kHalf, kHalf); });
  for (Section& section : sections)
    if (beyond > 0) section.beyond = arcBetween(-kHalf - beyond, kHalf + beyond);
  return sections;
}

test::RowSettings asking(Extension extend, double length = 800) {
  test::RowSettings settings;
  settings.blade.length = length;
  settings.extend = extend;
  return settings;
}

Result<Sweep> extendedRowOf(const std::vector<Section>& sections, const FitRequest& request) {
  Findings unsaid;
  return buildSweep(sections, request, block(), planes(), {}, unsaid);
}

double farthestFromArc(const BladePose& pose) {
  double most = 0;
  for (const Vector3d& p : pose.bladePoints(201))
    most = std::max(most, std::abs(Vector2d(p.x(), p.z()).norm() - kRadius));
  return most;
}

/// Where a grip comes that lies `more` mm on the tangent at `angle` from the top, on the right.
Vector2d onTangent(double angle, double more) {
  return {kRadius * std::sin(angle) + more * std::cos(angle),
          kRadius * std::cos(angle) - more * std::sin(angle)};
}

TEST(ExtendedRow, BladesOfSectionsThatAreElasticaComeBackToThem) {
  for (const Extension extend : {Extension::surface, Extension::curvature}) {
    const Result<Sweep> row = extendedRowOf(cylinder(0.4), asking(extend));
    ASSERT_TRUE(row) << row.error().message;
    ASSERT_EQ(row->poses.size(), std::size_t(kStations));
    for (std::size_t i = 0; i < row->poses.size(); ++i) {
      const BladePose& pose = row->poses[i];
      EXPECT_LT(farthestFromArc(pose), 1e-6);
      EXPECT_NEAR(pose.blade.length(), 800, 1e-9);
      EXPECT_NEAR(pose.cut.length(), 2 * kHalf * kRadius, 1e-6);
      EXPECT_NEAR(pose.before, 400 - kHalf * kRadius, 1e-6);
      EXPECT_EQ(row->fits[i].fit.status, FitStatus::converged);
      EXPECT_LT(row->fits[i].fit.hausdorff, 1e-6);
      ASSERT_TRUE(row->fits[i].extended);
      EXPECT_NEAR(row->fits[i].extended->length(), 800, 0.05) << "a chain of points";
    }
  }
}

TEST(ExtendedRow, GripsLieOnTheTangentsWhereTheSurfaceEnds) {
  const double each = 400 - kHalf * kRadius;  // mm from the section to a grip
  for (const double beyond : {0.0, 0.05}) {
    const Result<Sweep> row = extendedRowOf(cylinder(beyond), asking(Extension::surface));
    ASSERT_TRUE(row) << row.error().message;
    const double angle = kHalf + beyond;
    const Vector2d grip = onTangent(angle, each - beyond * kRadius);
    for (const BladePose& pose : row->poses) {
      EXPECT_NEAR(pose.rightPoint().x(), grip.x(), 1e-6);
      EXPECT_NEAR(pose.rightPoint().z(), grip.y(), 1e-6);
      EXPECT_NEAR(pose.rightTangent().z() / pose.rightTangent().x(), -std::tan(angle), 1e-9);
      EXPECT_NEAR(pose.leftPoint().x(), -grip.x(), 1e-6);
      EXPECT_NEAR(pose.leftPoint().z(), grip.y(), 1e-6);
      EXPECT_NEAR(pose.blade.length(), 800, 1e-9);
    }
    // The blade of the block is no arc any more, and what it leaves of the section is told.
    EXPECT_GT(row->fits[2].fit.hausdorff, 0.1);
    // Without a surface beyond that is the same as to go straight on.
    if (beyond > 0) continue;
    const Result<Sweep> straight = extendedRowOf(cylinder(0.4), asking(Extension::straight));
    ASSERT_TRUE(straight);
    for (std::size_t i = 0; i < straight->poses.size(); ++i)
      EXPECT_LT((straight->poses[i].rightPoint() - row->poses[i].rightPoint()).norm(), 1e-9);
  }
}

TEST(ExtendedRow, TheBranchIsTheNearestOfAllThatHaveTheseGrips) {
  // An S: beside it there are shapes of other turnings and bows to both sides.
  const auto wave = [](double x) { return 700 + 25 * std::sin(kPi * x / 260); };
  const std::vector<Section> sections =
      test::sectionsOf(3, 100, [&](int) { return test::graphCurve(260, wave, 961); });
  const Result<Sweep> row = extendedRowOf(sections, asking(Extension::straight));
  ASSERT_TRUE(row) << row.error().message;
  const BladePose& pose = row->poses[1];
  const Elastica::State end = pose.blade.at(pose.blade.length());
  const ClampedProblem grips{pose.blade.start(), end.point, pose.blade.startAngle(), end.angle,
                             pose.blade.length()};
  const auto distance = [&](const Elastica& shape) {
    double most = 0;
    for (int k = 0; k <= 100; ++k) {
      const Vector2d p = shape.point(shape.length() * k / 100);
      const PlanarCurve& curve = *row->fits[1].extended;
      most = std::max(most, (curve.value(curve.nearestParameter(p)) - p).norm());
    }
    return most;
  };
  const Result<ClampedAnswer> all = solveAllClamped(grips);
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_GT(all->solutions.size(), 1u);
  EXPECT_LT(distance(pose.blade), 10);
  const double own = distance(pose.blade);
  for (const ClampedSolution& solution : all->solutions)
    EXPECT_GE(distance(solution.elastica), own - 1e-6) << solution.turning;
  // It is the second bow, in which no blade rests: the design is shown as it is meant, and told to snap.
  const Result<SweepCheck> check = checkSweep(*row, asking(Extension::straight), {});
  ASSERT_TRUE(check);
  const bool rests = std::ranges::any_of(all->solutions, [&](const ClampedSolution& solution) {
    return solution.stable && distance(solution.elastica) < own + 1e-6;
  });
  EXPECT_EQ(check->stations[1].stable, rests);
}

TEST(ExtendedRow, ABladeThatLeavesLessThanTheClearanceIsAnErrorThatTellsTheLengthNeeded) {
  const double section = 2 * kHalf * kRadius;
  const Result<Sweep> row = extendedRowOf(cylinder(0.4), asking(Extension::surface, section + 99));
  ASSERT_FALSE(row);
  EXPECT_EQ(row.error().code, ErrorCode::badInput);
  EXPECT_NE(row.error().message.find("leaves less than the clearance of 50 mm at both ends of the section"),
            std::string::npos)
      << row.error().message;
  const OtherLength* needed = remedyOf<OtherLength>(row.error().remedies);
  ASSERT_TRUE(needed);
  EXPECT_TRUE(extendedRowOf(cylinder(0.4), asking(Extension::surface, needed->length)));
  // No longer one is advised where none bends as sharply.
  test::RowSettings stiff = asking(Extension::surface, section + 99);
  stiff.blade.yieldStress *= 0.5 * stiff.blade.minRadius() / kRadius;
  ASSERT_GT(stiff.blade.minRadius(), 1.5 * kRadius);
  const Result<Sweep> none = extendedRowOf(cylinder(0.4), stiff);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("bends sharper than the blade may"), std::string::npos)
      << none.error().message;
  EXPECT_FALSE(remedyOf<OtherLength>(none.error().remedies));
  // One sharp place, far shorter than a third of the section, leaves the advice as it is.
  const std::vector<Section> crest = test::sectionsOf(3, 100, [](int) {
    return test::graphCurve(
        260, [](double x) { return 700 + 10 * std::exp(-x * x / 200); }, 961);
  });
  const test::RowSettings asked = asking(Extension::straight, crest[0].curve().length() + 99);
  ASSERT_GT(asked.blade.minRadius(), 30) << "the crest has a radius of 10 mm";
  const Result<Sweep> sharp = extendedRowOf(crest, asked);
  ASSERT_FALSE(sharp);
  EXPECT_TRUE(remedyOf<OtherLength>(sharp.error().remedies)) << sharp.error().message;
}

TEST(ExtendedRow, TheHeavyBladeHangsBetweenTheSameGrips) {
  test::RowSettings settings = asking(Extension::surface);
  settings.weight = -4 * settings.blade.weight() * Vector3d::UnitZ();
  const Result<Sweep> heavy = extendedRowOf(cylinder(0.4), settings);
  const Result<Sweep> light = extendedRowOf(cylinder(0.4), asking(Extension::surface));
  ASSERT_TRUE(heavy && light);
  for (std::size_t i = 0; i < heavy->poses.size(); ++i) {
    const BladePose &hangs = heavy->poses[i], &rests = light->poses[i];
    EXPECT_LT((hangs.rightPoint() - rests.rightPoint()).norm(), 1e-9);
    EXPECT_LT((hangs.leftTangent() - rests.leftTangent()).norm(), 1e-9);
    ASSERT_TRUE(hangs.heavy);
    EXPECT_GT(heavy->fits[i].fit.hausdorff, 1e-3) << "what it sags by is in the distance";
    EXPECT_NEAR(heavy->fits[i].fit.hausdorff, hangs.movedByWeight(), 0.05 * hangs.movedByWeight());
  }
}

TEST(ExtendedRow, WhatLiesBeyondIsMovedWithTheSection) {
  Findings unsaid;
  const test::SphereSampler sphere(kRadius);
  std::vector<Section> sections = cylinder(0.3);
  sections.resize(1);  // at y = 0 it is a section of the sphere
  const Result<std::vector<Section>> middle = movedBy(sections, sphere, 2, {}, unsaid);
  ASSERT_TRUE(middle);
  ASSERT_TRUE(middle->front().beyond);
  for (const Vector2d& p : middle->front().beyond->sample(101)) EXPECT_NEAR(p.norm(), kRadius + 2, 1e-4);
}

TEST(ExtendedRow, IsFoundAnewRatherThanFollowed) {
  const Result<Sweep> row = extendedRowOf(cylinder(0.4), asking(Extension::surface));
  ASSERT_TRUE(row);
  EXPECT_FALSE(LiveRow::of(*row, {})) << "a row that follows the hand chooses its grips itself";
}

}  // namespace
}  // namespace bw
