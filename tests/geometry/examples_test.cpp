// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bw/core/files/file_set.h"
#include "example_shapes.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

class Examples : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, Examples,
                         testing::Values("panel-600x670", "graph", "saddle", "sphere-cap", "torus-patch",
                                         "wavy-wall", "ramp-corner-hollow", "ramp-corner-domed"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// The sign of the Gaussian curvature of the formula by central differences.
double gaussian(const std::string& name, double u, double v) {
  const double h = 1e-3;
  const auto p = [&](double a, double b) { return examplePoint(name, a, b); };
  const Eigen::Vector3d su = (p(u + h, v) - p(u - h, v)) / (2 * h),
                        sv = (p(u, v + h) - p(u, v - h)) / (2 * h);
  const Eigen::Vector3d suu = (p(u + h, v) - 2 * p(u, v) + p(u - h, v)) / (h * h);
  const Eigen::Vector3d svv = (p(u, v + h) - 2 * p(u, v) + p(u, v - h)) / (h * h);
  const Eigen::Vector3d suv =
      (p(u + h, v + h) - p(u - h, v + h) - p(u + h, v - h) + p(u - h, v - h)) / (4 * h * h);
  const Eigen::Vector3d n = su.cross(sv).normalized();
  const double metric = su.squaredNorm() * sv.squaredNorm() - std::pow(su.dot(sv), 2);
  return (suu.dot(n) * svv.dot(n) - std::pow(suv.dot(n), 2)) / metric;
}

TEST_P(Examples, SurfaceIsItsFormulaWithinAThousandth) {
  const auto sampler = exampleTarget(GetParam()).sampler();
  double worst = 0;
  for (int i = 0; i <= 61; ++i) {
    for (int j = 0; j <= 61; ++j) {
      const auto foot = sampler->closest(examplePoint(GetParam(), i / 61.0, j / 61.0), nullptr);
      ASSERT_TRUE(foot);
      worst = std::max(worst, foot->distance);
    }
  }
  EXPECT_LT(worst, 1e-3);
}

TEST_P(Examples, CommittedFileIsTheGeneratorsOutput) {
  const auto file = readFile(std::string(BW_EXAMPLES) + "/" + GetParam() + ".step");
  ASSERT_TRUE(file) << file.error().message;
  if (std::getenv("BW_WRITE_EXAMPLES")) {
    ASSERT_TRUE(writeFile(std::string(BW_EXAMPLES) + "/" + GetParam() + ".step", generatedStep(GetParam())));
    GTEST_SKIP() << "written anew";
  }
  EXPECT_TRUE(*file == generatedStep(GetParam())) << "BW_WRITE_EXAMPLES=1 writes it anew";
  EXPECT_TRUE(*file == exampleStep(GetParam()).value());
}

TEST_P(Examples, GivesASectionAtEveryStation) {
  CutSettings settings;
  settings.stations = 30;
  const Cut cut = cutOf(exampleTarget(GetParam()), settings);
  EXPECT_EQ(cut.sections.size(), 30u);
  EXPECT_TRUE(cut.findings.empty());
}

TEST(ExampleList, NamesEachExampleOnce) {
  const auto list = exampleList();
  ASSERT_EQ(list.size(), 8u);
  EXPECT_EQ(list.front().name, "panel-600x670");
  for (const Example& e : list) {
    EXPECT_FALSE(e.title.empty());
    EXPECT_NE(e.formula.find("mm"), std::string::npos);
    EXPECT_TRUE(exampleStep(e.name)) << e.name;
  }
}

TEST(ExampleList, UnknownNameSuggestsTheNearest) {
  expectError(exampleStep("panel-600x760"), ErrorCode::badInput, "\"panel-600x670\"");
}

TEST(ExampleShapes, HaveTheSizesTheyAreNamedAfter) {
  EXPECT_NEAR((exampleTarget("panel-600x670").bounds().size().head<2>() - Eigen::Vector2d(600, 670)).norm(),
              0, 1e-6);
  EXPECT_NEAR((exampleTarget("wavy-wall").bounds().size().head<2>() - Eigen::Vector2d(4200, 2400)).norm(), 0,
              1e-6);
  EXPECT_NEAR(exampleTarget("ramp-corner-domed").bounds().size().z(), 854.10, 1e-6);
}

TEST(ExampleShapes, GaussianCurvatureHasThePromisedSigns) {
  int panelPositive = 0, panelNegative = 0;
  for (int i = 1; i < 30; ++i) {
    for (int j = 1; j < 30; ++j) {
      const double u = i / 30.0, v = j / 30.0;
      EXPECT_GT(gaussian("sphere-cap", u, v), 0);
      EXPECT_LT(gaussian("saddle", u, v), 0);
      EXPECT_LT(gaussian("ramp-corner-hollow", u, v), 0);
      EXPECT_GT(gaussian("ramp-corner-domed", u, v), 0);
      (gaussian("panel-600x670", u, v) > 0 ? panelPositive : panelNegative)++;
    }
  }
  EXPECT_GT(panelPositive, 200);
  EXPECT_GT(panelNegative, 200);
}

TEST(ExampleShapes, RampProfilesHaveTheReportedLengths) {
  for (const char* name : {"ramp-corner-hollow", "ramp-corner-domed"}) {
    const bool hollow = std::string(name) == "ramp-corner-hollow";
    for (const double v : {0.0, 0.5, 1.0}) {
      std::vector<Eigen::Vector2d> profile;
      for (int i = 0; i <= 2000; ++i) {
        const Eigen::Vector3d p = examplePoint(name, i / 2000.0, v);
        profile.push_back({p.x(), p.z()});
      }
      const double length = PlanarCurve::points(profile)->length();
      EXPECT_NEAR(length, (v == 0.5) == hollow ? 1342.6 : 1459.8, 0.1) << name << " " << v;
    }
  }
}

}  // namespace
}  // namespace bw::geometry::test
