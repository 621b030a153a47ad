// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <filesystem>
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

TEST(FaceSampler, TellsTheCurvaturesOfKnownSurfaces) {
  struct Known {
    const char* name;
    Eigen::Vector3d near;
    double min, max;
  };
  // Seen from above: a ball and the outer half of a torus bend away, the saddle z = x²/1600 − y²/1200 both
  // ways.
  for (const Known& k : {Known{"sphere-cap", {50, 80, 0}, -1 / 900.0, -1 / 900.0},
                         Known{"torus-patch", {0, 1000, 450}, -1 / 450.0, 0.0},
                         Known{"saddle", {0, 0, 0}, -1 / 600.0, 1 / 800.0}}) {
    const auto sampler = exampleTarget(k.name).sampler();
    const auto foot = sampler->closest(k.near, nullptr);
    ASSERT_TRUE(foot);
    const auto jet = sampler->at(foot->face, foot->uv);
    ASSERT_TRUE(jet) << jet.error().message;
    EXPECT_NEAR((jet->p - foot->point).norm(), 0, 1e-9);
    EXPECT_NEAR((jet->normal - foot->normal).norm(), 0, 1e-9);
    EXPECT_GT(jet->normal.z(), 0) << k.name;
    const auto curvature = curvatureOf(*jet);
    ASSERT_TRUE(curvature);
    EXPECT_NEAR(curvature->min, k.min, 1e-6) << k.name;
    EXPECT_NEAR(curvature->max, k.max, 1e-6) << k.name;
  }
}

TEST(FaceSampler, DerivativesAreThoseOfDifferences) {
  for (const Example& example : exampleList()) {
    const Target target = exampleTarget(example.name);
    const auto sampler = target.sampler();
    // Off the lines of knots, where second derivatives jump.
    const Eigen::Vector3d near = target.bounds().center() + Eigen::Vector3d(7.3, -11.9, 0);
    const auto foot = sampler->closest(near, nullptr);
    ASSERT_TRUE(foot);
    const auto jet = sampler->at(foot->face, foot->uv);
    ASSERT_TRUE(jet) << example.name;
    // A step of about 0.1 mm.
    const double hu = 0.1 / jet->du.norm(), hv = 0.1 / jet->dv.norm();
    const auto at = [&](double a, double b) {
      return sampler->at(foot->face, foot->uv + Eigen::Vector2d(a * hu, b * hv)).value();
    };
    const auto east = at(1, 0), west = at(-1, 0), north = at(0, 1), south = at(0, -1);
    const auto close = [&](const Eigen::Vector3d& exact, const Eigen::Vector3d& difference, double unit) {
      EXPECT_NEAR((exact - difference).norm() / unit, 0, 1e-6) << example.name;
    };
    close(jet->du, (east.p - west.p) / (2 * hu), jet->du.norm());
    close(jet->dv, (north.p - south.p) / (2 * hv), jet->dv.norm());
    close(jet->duu, (east.du - west.du) / (2 * hu), jet->du.squaredNorm());
    close(jet->duv, (north.du - south.du) / (2 * hv), jet->du.norm() * jet->dv.norm());
    close(jet->dvv, (north.dv - south.dv) / (2 * hv), jet->dv.squaredNorm());
  }
}

TEST(FaceSampler, SaysWhereItTellsNoDerivatives) {
  const auto sampler = exampleTarget("saddle").sampler();
  expectError(sampler->at(1, {0, 0}), ErrorCode::badInput, "has no face 1");
  expectError(sampler->at(-1, {0, 0}), ErrorCode::badInput, "has no face -1");
  expectError(sampler->at(0, {5, 0.5}), ErrorCode::badInput, "lie outside");
  expectError(sampler->at(0, {std::nan(""), 0.5}), ErrorCode::badInput, "lie outside");
}

TEST(FaceSampler, PoleOfASphereHasNoCurvature) {
  if (!std::filesystem::exists(BW_FOREIGN_DATA)) GTEST_SKIP() << "occt-misc is not installed";
  const auto model = CadModel::read(std::string(BW_FOREIGN_DATA) + "/occ/Ball.brep");
  ASSERT_TRUE(model) << model.error().message;
  const auto target = Target::make(*model, {FaceChoice::Kind::all, {}});
  ASSERT_TRUE(target) << target.error().message;
  const auto sampler = target->sampler();
  int poles = 0;
  for (int face = 0; face < int(model->info().faceList.size()); ++face) {
    if (model->info().faceList[std::size_t(face)].type != "sphere") continue;
    const auto below = sampler->at(face, {0.5, M_PI / 2 - 1e-3}), pole = sampler->at(face, {0.5, M_PI / 2});
    if (!below) continue;
    EXPECT_TRUE(curvatureOf(*below));
    expectError(pole, ErrorCode::noSolution, "no tangent plane");
    ++poles;
  }
  EXPECT_GT(poles, 0);
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
