// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <random>

#include "example_shapes.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

constexpr double kAccuracy = 1e-6;  // mm, as promised

TEST(FaceSampler, FindsTheFootOnASphereFromInsideAndOutside) {
  const auto sampler = exampleTarget("sphere-cap").sampler();
  const Eigen::Vector3d center(0, 0, -std::sqrt(630000.0));
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> side(-250, 250), height(-60, 60);
  for (int i = 0; i < 500; ++i) {
    Eigen::Vector3d d(side(engine), side(engine), 0);
    d.z() = std::sqrt(810000 - d.squaredNorm());
    const Eigen::Vector3d p = center + d * (1 + height(engine) / 900);
    const auto foot = sampler->closest(p, nullptr);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, std::abs((p - center).norm() - 900), kAccuracy);
    EXPECT_NEAR((foot->point - (center + d)).norm(), 0, 10 * kAccuracy);
    EXPECT_NEAR((foot->normal - d / 900).norm(), 0, 1e-6);
    EXPECT_FALSE(foot->onBoundary);
  }
}

TEST(FaceSampler, FindsTheFootOnATorus) {
  const auto sampler = exampleTarget("torus-patch").sampler();
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> x(-280, 280), y(720, 1280), h(-40, 40);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d q(x(engine), y(engine));
    const double beyond = q.norm() - 1000;
    const Eigen::Vector3d on(q.x(), q.y(), std::sqrt(450 * 450 - beyond * beyond));
    const Eigen::Vector3d tube(q.x() / q.norm() * 1000, q.y() / q.norm() * 1000, 0);
    const double height = h(engine);
    const auto foot = sampler->closest(on + (on - tube).normalized() * height, nullptr);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, std::abs(height), kAccuracy);
  }
}

TEST(FaceSampler, PointOnTheSurfaceHasDistanceZero) {
  for (const char* name : {"panel-600x670", "saddle", "wavy-wall", "ramp-corner-domed"}) {
    const Target target = exampleTarget(name);
    const auto sampler = target.sampler();
    const auto first = sampler->closest(target.bounds().center(), nullptr);
    ASSERT_TRUE(first);
    const auto again = sampler->closest(first->point, &*first);
    ASSERT_TRUE(again);
    EXPECT_LT(again->distance, 1e-9);
  }
}

TEST(FaceSampler, ResidualIsPerpendicularToTheSurface) {
  const auto sampler = exampleTarget("panel-600x670").sampler();
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> x(20, 580), y(20, 650), z(0, 200);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p(x(engine), y(engine), z(engine));
    const auto foot = sampler->closest(p, nullptr);
    ASSERT_TRUE(foot);
    if (foot->onBoundary) continue;
    const Eigen::Vector3d r = p - foot->point;
    // Within 1/1000 of its distance beside a border still counts as above the surface.
    EXPECT_LT((r - r.dot(foot->normal) * foot->normal).norm(), kAccuracy + 1e-3 * foot->distance);
  }
}

TEST(FaceSampler, NoSampleOfTheSurfaceIsNearerThanTheFoot) {
  const std::string name = "wavy-wall";
  const auto sampler = exampleTarget(name).sampler();
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i <= 210; ++i) {
    for (int j = 0; j <= 120; ++j) samples.push_back(examplePoint(name, i / 210.0, j / 120.0));
  }
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<double> x(-200, 4400), y(-200, 2600), z(-600, 600);
  for (int k = 0; k < 60; ++k) {
    const Eigen::Vector3d p(x(engine), y(engine), z(engine));
    double nearest = 1e300;
    for (const auto& s : samples) nearest = std::min(nearest, (s - p).norm());
    const auto foot = sampler->closest(p, nullptr);
    ASSERT_TRUE(foot);
    EXPECT_LE(foot->distance, nearest + 1e-3);
    // The spacing of the samples bounds the distance from below.
    EXPECT_GE(foot->distance, nearest - 15);
  }
}

TEST(FaceSampler, SeedChangesTheTimeNotTheResult) {
  const auto sampler = exampleTarget("panel-600x670").sampler();
  std::mt19937_64 engine(8);
  std::uniform_real_distribution<double> x(-10, 610), y(-10, 680), z(0, 200);
  std::optional<SurfaceSampler::Foot> seed;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p(x(engine), y(engine),
                            z(engine));  // far from its predecessor: the seed is a bad one
    const auto seeded = sampler->closest(p, seed ? &*seed : nullptr), fresh = sampler->closest(p, nullptr);
    ASSERT_TRUE(seeded && fresh);
    EXPECT_NEAR(seeded->distance, fresh->distance, kAccuracy);
    seed = *seeded;
  }
}

TEST(FaceSampler, PointBesideTheFaceGoesToItsBorder) {
  // Natural borders (a spline) and trimmed ones (a sphere) alike.
  for (const char* name : {"saddle", "sphere-cap"}) {
    const Target target = exampleTarget(name);
    const auto sampler = target.sampler();
    const Bounds b = target.bounds();
    const auto foot = sampler->closest({b.max.x() + 100, 0, 0}, nullptr);
    ASSERT_TRUE(foot);
    EXPECT_TRUE(foot->onBoundary) << name;
    EXPECT_NEAR(foot->point.x(), b.max.x(), kAccuracy) << name;
    const Eigen::Vector3d corner(b.max.x(), b.max.y(), examplePoint(name, 1, 1).z());
    const auto atCorner = sampler->closest(corner + Eigen::Vector3d(50, 50, 0), nullptr);
    ASSERT_TRUE(atCorner);
    EXPECT_NEAR((atCorner->point - corner).norm(), 0, 1e-5) << name;
    EXPECT_TRUE(atCorner->onBoundary) << name;
  }
}

TEST(FaceSampler, PointJustAboveTheBorderKeepsItsSide) {
  const auto sampler = exampleTarget("saddle").sampler();
  const auto foot = sampler->closest(
      Eigen::Vector3d(300, 0, 300 * 300 / 1600.0) + 2 * Eigen::Vector3d(-0.375, 0, 1).normalized(), nullptr);
  ASSERT_TRUE(foot);
  EXPECT_FALSE(foot->onBoundary);
  EXPECT_NEAR(foot->distance, 2, 1e-5);
}

TEST(FaceSampler, CloneAnswersAlike) {
  const auto sampler = exampleTarget("graph").sampler();
  const auto clone = sampler->clone();
  const Eigen::Vector3d p(123, 456, 78);
  EXPECT_EQ(sampler->closest(p, nullptr)->point, clone->closest(p, nullptr)->point);
}

TEST(FaceSampler, OutlivesTheTargetItWasMadeOf) {
  std::unique_ptr<SurfaceSampler> sampler;
  {
    const Target target = exampleTarget("saddle");
    sampler = target.sampler();
  }
  EXPECT_TRUE(sampler->closest({0, 0, 10}, nullptr));
}

}  // namespace
}  // namespace bw::geometry::test
