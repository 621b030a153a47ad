// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "bw/core/base/units.h"
#include "example_shapes.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

Setup setupOf(const Target& target, const CutSettings& settings = {}) {
  Findings findings;
  auto setup = resolveSetup(target, settings, findings);
  EXPECT_TRUE(setup) << setup.error().message;
  return *setup;
}

void expectFrame(const Frame& frame) {
  EXPECT_NEAR(frame.x.norm(), 1, 1e-12);
  EXPECT_NEAR(frame.y.norm(), 1, 1e-12);
  EXPECT_NEAR((frame.x.cross(frame.y) - frame.normal).norm(), 0, 1e-12);
}

TEST(AutoBlock, OfThePanelIsItsBaseWithAMarginBelowAndAbove) {
  const Target target = exampleTarget("panel-600x670");
  const auto setup = setupOf(target);
  expectFrame(setup.block.frame);
  EXPECT_NEAR((setup.block.frame.x - Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);
  EXPECT_NEAR((setup.block.frame.normal - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-12);
  EXPECT_NEAR(setup.block.size.x(), 600, 1e-6);
  EXPECT_NEAR(setup.block.size.y(), 670, 1e-6);
  EXPECT_NEAR(setup.block.size.z(), target.bounds().size().z() + 10, 1e-6);
  EXPECT_NEAR((setup.planes.direction() - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
}

TEST(AutoBlock, HoldsEveryExample) {
  for (const Example& e : exampleList()) {
    const auto setup = setupOf(exampleTarget(e.name));
    expectFrame(setup.block.frame);
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; j <= 20; ++j) {
        const Eigen::Vector3d p = examplePoint(e.name, i / 20.0, j / 20.0);
        const Eigen::Array3d half = 0.5 * setup.block.size;
        EXPECT_TRUE(((setup.block.frame.toLocal(p).array() - half).abs() <= half + 1e-3).all()) << e.name;
      }
    }
    EXPECT_NEAR(setup.planes.direction().norm(), 1, 1e-12);
  }
}

TEST(AutoBlock, TurnsWithATiltedSheet) {
  // A shallow bowl over 700 × 500 mm, turned about a skew axis: an axis-parallel block would be several times
  // as large.
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(fromDegrees(38), Eigen::Vector3d(2, 1, 0.5).normalized()).toRotationMatrix();
  const Target target = targetOf(stepOf([&](double u, double v) {
    const double x = 700 * u - 350, y = 500 * v - 250;
    return Eigen::Vector3d(R * Eigen::Vector3d(x, y, 30 * std::cos(x / 300) * std::cos(y / 300)) +
                           Eigen::Vector3d(5, 6, 7));
  }));
  const auto setup = setupOf(target);
  expectFrame(setup.block.frame);
  EXPECT_NEAR(setup.block.frame.normal.dot(R.col(2)), 1, 1e-3);
  EXPECT_NEAR(std::abs(setup.planes.direction().dot(R.col(0))), 1, 1e-3);
  EXPECT_NEAR(setup.block.size.maxCoeff(), 700, 1);
}

TEST(AutoBlock, OfTheTurnedPanelIsThatOfThePanelTurned) {
  // Its mean normal leans by some degrees: a block along it would cut slivers off the corners.
  const auto level = setupOf(exampleTarget("panel-600x670"));
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(fromDegrees(12), Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(fromDegrees(25), Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(fromDegrees(40), Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  const Target target = targetOf(
      stepOf([&](double u, double v) { return Eigen::Vector3d(R * examplePoint("panel-600x670", u, v)); }));
  const auto setup = setupOf(target);
  expectFrame(setup.block.frame);
  EXPECT_GT(setup.block.frame.normal.dot(R.col(2)), std::cos(fromDegrees(0.5)));
  EXPECT_GT(std::abs(setup.planes.direction().dot(R * level.planes.direction())), std::cos(fromDegrees(0.5)));
  EXPECT_NEAR(setup.block.size.minCoeff(), level.block.size.minCoeff(), 6);
  EXPECT_NEAR(setup.block.size.maxCoeff(), level.block.size.maxCoeff(), 6);
}

TEST(AutoBlock, LooksAtASheetFromAbove) {
  const Target target =
      targetOf(stepOf([](double u, double v) { return Eigen::Vector3d(400 * v, 500 * u, 20 * v * v); }));
  EXPECT_GT(setupOf(target).block.frame.normal.z(), 0.9);
}

TEST(AutoBlock, TakesAStripThatBendsRound) {
  // A half cylinder and a bit: the normals fan out over more than half a turn.
  const Target target = targetOf(stepOf([](double u, double v) {
    const double a = fromDegrees(-20 + 220 * u);
    return Eigen::Vector3d(200 * std::cos(a), 900 * v, 200 * std::sin(a));
  }));
  const auto setup = setupOf(target);
  EXPECT_NEAR(std::abs(setup.planes.direction().y()), 1, 1e-6);
  EXPECT_NEAR(setup.block.frame.normal.z(), 1, 1e-6);
}

TEST(GivenBlock, IsTakenAsItStands) {
  CutSettings settings;
  settings.block = BlockPlacement{{-100, -50, -60}, {150, 300, 200}, {0, 0, fromDegrees(30)}};
  const auto setup = setupOf(exampleTarget("saddle"), settings);
  EXPECT_EQ(setup.block.size, settings.block->size);
  EXPECT_NEAR(
      setup.block.frame.x.dot(Eigen::Vector3d(std::cos(fromDegrees(30)), std::sin(fromDegrees(30)), 0)), 1,
      1e-12);
  // "auto": along the longer side.
  EXPECT_NEAR((setup.planes.direction() - setup.block.frame.y).norm(), 0, 1e-12);
}

TEST(GivenDirection, IsNormalised) {
  CutSettings settings;
  settings.direction = Eigen::Vector3d(3, 4, 0);
  EXPECT_NEAR(
      (setupOf(exampleTarget("saddle"), settings).planes.direction() - Eigen::Vector3d(0.6, 0.8, 0)).norm(),
      0, 1e-15);
}

TEST(GivenDirection, ThroughTheSurfaceIsMentioned) {
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitZ();
  Findings findings;
  ASSERT_TRUE(resolveSetup(exampleTarget("saddle"), settings, findings));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::info);
}

}  // namespace
}  // namespace bw::geometry::test
