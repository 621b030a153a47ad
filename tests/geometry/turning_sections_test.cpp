// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Sections by planes that turn as the blade travels.

#include <cmath>

#include "bw/core/base/units.h"
#include "shapes.h"
#include "turning_planes.h"

namespace bw::geometry::test {
namespace {

double height(double x, double y) { return 60 * std::cos(x / 200) * std::cos(y / 150); }

Target bowl() {
  return targetOf(stepOf([](double u, double v) {
    const double x = 400 * u - 200, y = 300 * v - 150;
    return Eigen::Vector3d(x, y, height(x, y));
  }));
}

SetupRequest fan(double turn) { return {{}, {}, {}, bw::test::fanAlongY(100, turn)}; }

TEST(TurningSections, LieInTheirPlanesAndOnTheSurface) {
  const Target target = bowl();
  Findings findings;
  const auto setup = resolveSetup(target, fan(fromDegrees(24)), findings).value();
  ASSERT_TRUE(setup.planes.turns());
  for (const SectionRoute route : {SectionRoute::traced, SectionRoute::kernel}) {
    findings.clear();
    const std::vector<Section> sections = cutSections(target, setup, {17, {}, route}, {}, findings).value();
    int followed = 0;
    double before = -1;
    for (const Section& section : sections) {
      // The first plane and the last one leave the surface in a corner.
      const bool end = section.index == 0 || section.index == 16;
      ASSERT_TRUE(section.chosen == 0 || end) << section.index;
      if (section.chosen < 0) continue;
      ++followed;
      EXPECT_GT(section.travel, before);
      before = section.travel;
      const double level = setup.planes.entry + section.travel;
      EXPECT_NEAR((section.frame.normal - setup.planes.at(level).normal).norm(), 0, 1e-9);
      for (const Eigen::Vector2d& p : section.curve().sample(33)) {
        const Eigen::Vector3d place = section.frame.toWorld(p);
        EXPECT_NEAR(place.z(), height(place.x(), place.y()), 0.01);
        EXPECT_NEAR(setup.planes.level(place), level, 1e-6);
      }
    }
    EXPECT_GE(followed, 15);
  }
}

TEST(TurningSections, AreConfirmedAndCounted) {
  const Target target = bowl();
  Findings findings;
  const auto setup = resolveSetup(target, fan(fromDegrees(24)), findings).value();
  const auto sections = cutSections(target, setup, {17, {}}, {}, findings);
  ASSERT_TRUE(sections);
  const auto confirmed = confirmSections(target, setup, {17, {}}, {}, findings);
  ASSERT_TRUE(confirmed);
  EXPECT_FALSE(confirmed->has_value());
  const Result<StationCount> count = stationsFor(target, setup, 2, {});
  ASSERT_TRUE(count);
  EXPECT_GE(count->stations, StationCount::kLeast);
  ASSERT_TRUE(count->between);
  EXPECT_LT(*count->between, 1);
}

TEST(TurningSections, OfPlanesThatMeetInTheBlockAreAnError) {
  const Target target = bowl();
  Findings findings;
  expectError(resolveSetup(target, fan(fromDegrees(70)), findings), ErrorCode::badInput,
              "meet in the block, near x = -2");
}

TEST(TurningSections, AreAcrossADirectionThatIsGivenInTheirPlace) {
  const Target target = bowl();
  Findings findings;
  SetupRequest request = fan(fromDegrees(24));
  request.direction = Eigen::Vector3d::UnitX();
  EXPECT_FALSE(resolveSetup(target, request, findings).value().planes.turns());
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::info);
  const auto& told = std::get<PlanesNotTurned>(findings[0].cause);
  EXPECT_NEAR(told.least, fromDegrees(-12), 1e-12);
  EXPECT_NEAR(told.most, fromDegrees(12), 1e-12);
}

}  // namespace
}  // namespace bw::geometry::test
