// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What stands beside the kerf of a blade, and where its middle goes.
#include "bw/core/sweep/kerf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/shape/moved_sections.h"
#include "plane_sections.h"

namespace bw {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadius = 900;

/// Sections of the upper side of a sphere about the origin.
std::vector<Section> capSections(double radius = kRadius, double half = 300, double step = 100) {
  return test::sectionsOf(5, step, [=](int i) {
    return test::graphCurve(
        half, [=](double x) { return std::sqrt(radius * radius - std::pow(step * i, 2) - x * x); }, 481);
  });
}

double farthestOff(const Section& section, double radius) {
  double most = 0;
  for (const Vector2d& p : section.curve().sample(301))
    most = std::max(most, std::abs(section.frame.toWorld(p).norm() - radius));
  return most;
}

TEST(Kerf, SectionsOfTheMiddleLieBesideTheSurfaceAllOver) {
  Findings unsaid;
  const std::vector<Section> cap = capSections();
  const test::SphereSampler sphere(kRadius);
  for (const double off : {1.5, -1.5, 10.0}) {
    const Result<std::vector<Section>> middle = movedBy(cap, sphere, off, {}, unsaid);
    ASSERT_TRUE(middle) << middle.error().message;
    ASSERT_EQ(middle->size(), cap.size());
    for (std::size_t i = 0; i < cap.size(); ++i) {
      EXPECT_LT(farthestOff((*middle)[i], kRadius + off), 1e-4) << i;
      EXPECT_EQ((*middle)[i].travel, cap[i].travel) << "in the same planes";
      EXPECT_EQ((*middle)[i].frame.origin, cap[i].frame.origin);
      EXPECT_GT((*middle)[i]
                    .curve()
                    .tangent((*middle)[i].curve().start())
                    .dot(cap[i].curve().tangent(cap[i].curve().start())),
                0.99)
          << "the same way round";
    }
  }
  EXPECT_LT(farthestOff((*movedBy(cap, sphere, 0, {}, unsaid))[2], kRadius), 0.01);
}

TEST(Kerf, AreThoseOfASlantedPlaneThatIsNotAcrossTheirPlanes) {
  Findings unsaid;
  // z = −y: 45° to the planes of the sections, so that within these the middle lies √2 times as far off.
  const test::PlaneSampler slope(Vector3d(0, 1, 1).normalized());
  const std::vector<Section> level =
      test::sectionsOf(4, 50, [](int i) { return test::graphCurve(200, [=](double) { return 50.0 * i; }); });
  const Result<std::vector<Section>> middle = movedBy(level, slope, 2, {}, unsaid);
  ASSERT_TRUE(middle);
  for (std::size_t i = 0; i < level.size(); ++i)
    for (const Vector2d& p : (*middle)[i].curve().sample(21))
      EXPECT_NEAR(p.y(), 50.0 * double(i) + 2 * std::sqrt(2.0), 1e-5);
}

TEST(Kerf, OuterSectionsLieOutsideByWhatTheEdgeThatStandsNeeds) {
  // z = −y under sections that go on towards −Y: what stands below the middle begins w/2 sin 45° behind it.
  const test::PlaneSampler slope(Vector3d(0, 1, 1).normalized());
  const std::vector<Section> level =
      test::sectionsOf(4, 50, [](int i) { return test::graphCurve(200, [=](double) { return 50.0 * i; }); });
  const PlaneFamily planes = PlaneFamily::across(test::blockUnder(200, 150, -100, 300), -Vector3d::UnitY());
  const double half = 3, edge = half / std::sqrt(2.0);
  // Below, its edge would lie in front of the last plane and behind the first one; above, as far on.
  for (const int kept : {-1, 1}) {
    const std::unique_ptr<SurfaceSampler> sampler = slope.clone();
    const Result<std::vector<Section>> row = carriedOut(level, planes, *sampler, half, kept);
    ASSERT_TRUE(row);
    const std::array out = {kept < 0 ? edge : 0, 0.0, 0.0, kept > 0 ? edge : 0};
    for (std::size_t i = 0; i < level.size(); ++i) {
      const double by = i == 0 ? -out[i] : out[i];
      EXPECT_NEAR((*row)[i].travel, level[i].travel + by, 1e-9) << i;
      EXPECT_NEAR(planes.level((*row)[i].frame.origin), planes.level(level[i].frame.origin) + by, 1e-9) << i;
    }
    Findings findings;
    const Result<std::vector<Section>> middle = movedBy(*row, *sampler, -kept * half, {}, findings);
    ASSERT_TRUE(middle);
    EXPECT_TRUE(findings.empty());
    const std::size_t outer = kept < 0 ? 0 : 3;
    const Section& section = (*middle)[outer];
    for (const Vector2d& p : section.curve().sample(11)) {
      const Vector3d stands = section.frame.toWorld(p) + kept * half * Vector3d(0, 1, 1).normalized();
      EXPECT_NEAR(stands.y() + stands.z(), 0, 1e-4) << "on the surface";
      EXPECT_NEAR(stands.y(), level[outer].frame.origin.y(), 1e-4) << "in the plane in which it began";
    }
  }
  const std::unique_ptr<SurfaceSampler> sampler = slope.clone();
  EXPECT_EQ(carriedOut(level, planes, *sampler, 0, -1)->front().frame.origin, level.front().frame.origin);
  const test::PlaneSampler flat(Vector3d::UnitZ());
  const std::unique_ptr<SurfaceSampler> lying = flat.clone();
  EXPECT_EQ(carriedOut(level, planes, *lying, half, -1)->front().frame.origin, level.front().frame.origin);
}

TEST(Kerf, OuterSectionsOfPlanesThatTurnAreCarriedWithThem) {
  TurningPlanes told{{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitZ(), -Vector3d::UnitY()}, {}};
  told.turn.spans = {{-20, {0, 0, 0, 0}, {0.1, 0.002, 0, 0}}};
  told.turn.to = 170;
  const Result<PlaneFamily> planes = PlaneFamily::turning(test::blockUnder(40, 150, -100, 300), told);
  ASSERT_TRUE(planes) << planes.error().message;
  test::PlaneSampler slope(Vector3d(0, 1, 1).normalized());
  std::vector<Section> level;
  for (int i = 0; i < 4; ++i) {
    const Frame frame = planes->at(50.0 * i);
    // In each plane the line in which it meets the slope: z = −y.
    level.push_back({i, planes->travel(50.0 * i), frame, {test::graphCurve(40, [&](double x) {
                       return -frame.toWorld(Vector2d(x, 0)).y();
                     })}});
  }
  const double half = 3;
  const Result<std::vector<Section>> row = carriedOut(level, *planes, slope, half, -1);
  ASSERT_TRUE(row);
  Findings findings;
  const Result<std::vector<Section>> middle = movedBy(*row, slope, half, {}, findings);
  ASSERT_TRUE(middle);
  const Frame first = level.front().frame;
  double nearest = 1e300;
  for (const Vector2d& p : middle->front().curve().sample(41)) {
    const Vector3d stands = middle->front().frame.toWorld(p) - half * Vector3d(0, 1, 1).normalized();
    EXPECT_NEAR(stands.y() + stands.z(), 0, 1e-4);
    const double behind = first.normal.dot(stands - first.origin);
    EXPECT_LT(behind, 0.02) << "no place begins behind the plane";
    nearest = std::min(nearest, -behind);
  }
  EXPECT_LT(nearest, 0.02) << "and no more than that needs";
  EXPECT_EQ((*row)[3].frame.origin, level[3].frame.origin);
}

TEST(Kerf, RefusesWhatIsBentMoreTightly) {
  Findings unsaid;
  const test::SphereSampler ball(6);
  const std::vector<Section> cap = capSections(6, 4, 0.5);
  EXPECT_TRUE(movedBy(cap, ball, -2, {}, unsaid));
  const Result<std::vector<Section>> folded = movedBy(cap, ball, -7, {}, unsaid);
  ASSERT_FALSE(folded);
  EXPECT_EQ(folded.error().code, ErrorCode::badInput);
  EXPECT_NE(folded.error().message.find("kerf"), std::string::npos) << folded.error().message;
  // A surface that runs along the planes has no place beside it within them.
  const test::PlaneSampler upright(Vector3d::UnitY());
  const std::vector<Section> along =
      test::sectionsOf(1, 50, [](int) { return test::graphCurve(200, [](double) { return 10.0; }); });
  EXPECT_FALSE(movedBy(along, upright, 1, {}, unsaid));
}

/// A plane z = 0, but for a trough of 4 mm radius along y beside y = −50.
class Trough : public test::PlaneSampler {
 public:
  Trough() : PlaneSampler(Vector3d::UnitZ()) {}
  Result<Foot> closest(const Vector3d& p, const Foot* seed) override {
    if (std::abs(p.y() + 50) > 25) return PlaneSampler::closest(p, seed);
    const Vector3d axis(0, p.y(), 4), out = (p - axis).normalized();
    Foot foot;
    foot.point = axis + 4 * out;
    foot.normal = -out;
    foot.distance = (p - foot.point).norm();
    return foot;
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<Trough>(*this); }
};

TEST(Kerf, LeavesOutTheStationsThatCannotKeepIt) {
  const std::vector<Section> sections = test::sectionsOf(3, 50, [](int i) {
    return test::graphCurve(3, [=](double x) { return i == 1 ? 4 - std::sqrt(16 - x * x) : 0.0; });
  });
  Findings findings;
  const Result<std::vector<Section>> middle = movedBy(sections, Trough(), 9, {}, findings);
  ASSERT_TRUE(middle) << middle.error().message;
  EXPECT_EQ((*middle)[0].chosen, 0);
  EXPECT_EQ((*middle)[1].chosen, -1);
  EXPECT_EQ((*middle)[2].chosen, 0);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].where.stations->first, 1);
  EXPECT_EQ(findings[0].where.stations->count, 1);
  findings.clear();
  ASSERT_TRUE(movedBy(sections, Trough(), 2, {}, findings));
  EXPECT_TRUE(findings.empty());
}

TEST(Kerf, OffsetsAreThoseFromWhereTheMiddleGoes) {
  const std::unique_ptr<SurfaceSampler> moved = movedBy(std::make_unique<test::SphereSampler>(kRadius), 2);
  for (const std::unique_ptr<SurfaceSampler>& one : {moved->clone(), moved->clone()}) {
    const Vector3d p(0, 0, 903);
    EXPECT_NEAR(one->offset(p, *one->closest(p, nullptr)), 1, 1e-9);
  }
}

TEST(Kerf, WhatStandsLiesOnTheSideThatIsKept) {
  SurfaceGrid swept;
  swept.rows = 41;
  swept.columns = 61;
  for (int r = 0; r < swept.rows; ++r)
    for (int c = 0; c < swept.columns; ++c) {
      const double x = 10.0 * (c - 30), y = 10.0 * (r - 20);
      swept.points.emplace_back(x, y, std::sqrt(901.0 * 901 - x * x - y * y));
    }
  swept.fields.push_back({"deviation", "", "mm", std::vector<double>(swept.points.size(), 7)});
  const auto radii = [](const SurfaceGrid& grid) {
    std::pair<double, double> range(1e300, 0);
    for (const Vector3d& p : grid.points) {
      range.first = std::min(range.first, p.norm());
      range.second = std::max(range.second, p.norm());
    }
    return range;
  };
  const SurfaceGrid below = standingBeside(swept, {2, {}, 0, -Vector3d::UnitZ()});
  EXPECT_NEAR(radii(below).first, 900, 1e-3);
  EXPECT_NEAR(radii(below).second, 900, 1e-3);
  EXPECT_EQ(below.fields.front().values, swept.fields.front().values);
  const SurfaceGrid above = standingBeside(swept, {2, {}, 0, Vector3d::UnitZ()});
  EXPECT_NEAR(radii(above).first, 902, 1e-3);
  EXPECT_NEAR(radii(above).second, 902, 1e-3);
  EXPECT_EQ(standingBeside(swept, {}).points, swept.points);
}

}  // namespace
}  // namespace bw
