// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "shapes.h"

namespace bw::geometry::test {
namespace {

std::string withUnit(std::string step, const std::string& unit) {
  const std::string millimetre = "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))";
  const std::size_t at = step.find(millimetre);
  EXPECT_NE(at, std::string::npos);
  return step.replace(at, millimetre.size(), unit);
}

TEST(CadModel, TellsWhatAStepFileHolds) {
  const CadModel model = modelOf(exampleStep("sphere-cap").value());
  const CadInfo& info = model.info();
  EXPECT_EQ(info.format, "STEP");
  EXPECT_EQ(info.unit, "mm");
  EXPECT_EQ(info.faces, 1);
  EXPECT_EQ(info.edges, 4);
  EXPECT_EQ(info.shells, 1);
  EXPECT_EQ(info.solids, 0);
  EXPECT_TRUE(info.healing.empty());
  ASSERT_EQ(info.faceList.size(), 1u);
  EXPECT_EQ(info.faceList[0].type, "sphere");
  EXPECT_EQ(info.faceList[0].index, 0);
}

TEST(CadModel, BoundsAreTight) {
  const Bounds cap = modelOf(exampleStep("sphere-cap").value()).info().bounds;
  EXPECT_NEAR((cap.min - Eigen::Vector3d(-300, -300, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((cap.max - Eigen::Vector3d(300, 300, 900 - std::sqrt(630000.0))).norm(), 0, 1e-6);
  // The extremes of the saddle lie on its borders.
  const Bounds saddle = modelOf(exampleStep("saddle").value()).info().bounds;
  EXPECT_NEAR(saddle.min.z(), -400.0 * 400 / 1200, 1e-5);
  EXPECT_NEAR(saddle.max.z(), 300.0 * 300 / 1600, 1e-5);
}

TEST(CadModel, AreaOfASphericalZoneIsExact) {
  // Over a square of half side h the area of z = sqrt(R² − x² − y²) is the integral of R/z, here by Simpson's
  // rule.
  const double R = 900, h = 300;
  const int n = 400;
  const auto weight = [&](int i) { return i == 0 || i == n ? 1.0 : i % 2 ? 4.0 : 2.0; };
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = -h + 2 * h * i / n, y = -h + 2 * h * j / n;
      sum += weight(i) * weight(j) * R / std::sqrt(R * R - x * x - y * y);
    }
  }
  const double area = sum * std::pow(2 * h / n / 3, 2);
  EXPECT_NEAR(exampleTarget("sphere-cap").area(), area, 1e-4 * area);
}

TEST(CadModel, PrincipalCurvaturesOfASphereAreOneOverItsRadius) {
  const CadInfo info = modelOf(exampleStep("sphere-cap").value()).infoInFull().value();
  EXPECT_NEAR(info.faceList[0].curvatureMin, -1.0 / 900, 1e-9);
  EXPECT_NEAR(info.faceList[0].curvatureMax, -1.0 / 900, 1e-9);
}

TEST(CadModel, PrincipalCurvaturesOfTheSaddleAreThoseOfItsVertex) {
  const CadInfo info = modelOf(exampleStep("saddle").value()).infoInFull().value();
  EXPECT_NEAR(info.faceList[0].curvatureMax, 2.0 / 1600, 1e-8);
  EXPECT_NEAR(info.faceList[0].curvatureMin, -2.0 / 1200, 1e-8);
}

TEST(CadModel, ConvertsMetresAndInches) {
  const std::string step = exampleStep("saddle").value();
  const CadModel metres = modelOf(withUnit(step, "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))"));
  EXPECT_EQ(metres.info().unit, "m");
  EXPECT_NEAR(metres.info().bounds.size().x(), 600e3, 1e-3);
  // An inch needs two more entities; their numbers follow the last of the file.
  const std::string inch = "(CONVERSION_BASED_UNIT('INCH',#9001)LENGTH_UNIT()NAMED_UNIT(#9003))";
  std::string inches = withUnit(step, inch);
  const std::size_t end = inches.rfind("ENDSEC;");
  inches.insert(end,
                "#9001=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9002);\n"
                "#9002=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                "#9003=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n");
  const CadModel model = modelOf(inches);
  EXPECT_EQ(model.info().unit, "inch");
  EXPECT_NEAR(model.info().bounds.size().x(), 600 * 25.4, 1e-5);
}

TEST(CadModel, ReadsMilesAndTellsThemFromMils) {
  for (const auto& [name, metres] : {std::pair("MILE", 1609.344), std::pair("MIL", 2.54e-5)}) {
    std::string step =
        withUnit(exampleStep("saddle").value(),
                 "(CONVERSION_BASED_UNIT('" + std::string(name) + "',#9001)LENGTH_UNIT()NAMED_UNIT(#9003))");
    step.insert(step.rfind("ENDSEC;"), "#9001=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
                                           std::to_string(metres) +
                                           "),#9002);\n"
                                           "#9002=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
                                           "#9003=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n");
    const CadModel model = modelOf(step);
    EXPECT_EQ(model.info().unit, name == std::string("MILE") ? "mile" : "mil");
    EXPECT_NEAR(model.info().bounds.size().x() / (600 * 1000 * metres), 1, 2e-2) << name;
  }
}

TEST(CadModel, TellsTheFormatFromTheContentNotTheSuffix) {
  const auto model = CadModel::readBytes(exampleStep("saddle").value(), "saddle.iges");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->info().format, "STEP");
}

TEST(CadModel, ReadsAFileAndItsBytesAlike) {
  const auto file = CadModel::read(std::string(BW_EXAMPLES) + "/panel-600x670.step");
  ASSERT_TRUE(file) << file.error().message;
  const CadModel bytes = modelOf(exampleStep("panel-600x670").value());
  EXPECT_EQ(file->info().bounds.min, bytes.info().bounds.min);
  EXPECT_EQ(file->info().bounds.max, bytes.info().bounds.max);
}

TEST(CadModel, StopsOnRequest) {
  std::stop_source source;
  source.request_stop();
  const auto model =
      CadModel::readBytes(exampleStep("saddle").value(), "saddle.step", RunContext{source.get_token()});
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::cancelled);
}

TEST(Target, MeshFollowsTheSurfaceWithinItsDeflection) {
  for (const char* name : {"sphere-cap", "torus-patch", "panel-600x670"}) {
    const Target target = exampleTarget(name);
    const double deflection = 0.5;
    const auto mesh = target.mesh(deflection);
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->normals.size(), mesh->points.size());
    const auto sampler = target.sampler();
    double area = 0;
    for (const auto& t : mesh->triangles) {
      const Eigen::Vector3d &a = mesh->points[t[0]], &b = mesh->points[t[1]], &c = mesh->points[t[2]];
      const auto foot = sampler->closest((a + b + c) / 3, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_LE(foot->distance, deflection) << name;
      // Counter-clockwise seen from the outer side, which is the upper one for a sheet.
      EXPECT_GT((b - a).cross(c - a).dot(foot->normal), 0) << name;
      EXPECT_GT(foot->normal.z(), 0) << name;
      area += 0.5 * (b - a).cross(c - a).norm();
    }
    for (std::size_t i = 0; i < mesh->points.size(); ++i) EXPECT_NEAR(mesh->normals[i].norm(), 1, 1e-9);
    EXPECT_NEAR(area, target.area(), 2e-3 * target.area()) << name;
  }
}

TEST(Target, ASheetIsSeenFromAboveWhicheverWayItsParametersRun) {
  const auto f = [](double u, double v) { return Eigen::Vector3d(600 * v, 500 * u, 40 * std::sin(3 * u)); };
  const Target target = targetOf(stepOf(f));  // du × dv points down
  const auto foot = target.sampler()->closest({300, 250, 500}, nullptr);
  ASSERT_TRUE(foot);
  EXPECT_GT(foot->normal.z(), 0.5);
}

}  // namespace
}  // namespace bw::geometry::test
