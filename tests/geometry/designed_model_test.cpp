// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Surfaces that were never in a file.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bw/core/shape/designed_surface.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/export.h"
#include "bw/geometry/sections.h"

namespace bw::geometry {

namespace {

SplineSurface somePoles() {
  PolesSurface surface;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> height(180, 260);
  for (SurfacePole& pole : surface.poles) pole.height = height(random);
  return splineOf(DesignedSurface{surface}).value();
}

Setup designedSetup(const Target& target) {
  Findings findings;
  SetupRequest request;
  request.block = BlockPlacement{{0, 0, 0}, {600, 800, 500}, Eigen::Vector3d::Zero()};
  request.direction = Eigen::Vector3d::UnitY();
  return resolveSetup(target, request, findings).value();
}

}  // namespace

TEST(DesignedModel, IsTheFaceThatTheSameSurfaceMakesThroughAFile) {
  const SplineSurface spline = somePoles();
  const CadModel model = CadModel::of(spline, "designed").value();
  const CadModel read = CadModel::readBytes(stepText(spline, "designed").value(), "a.step").value();
  EXPECT_EQ(model.info().format, "designed");
  ASSERT_EQ(model.info().faces, 1);
  EXPECT_EQ(model.info().edges, 4);
  EXPECT_EQ(model.info().faceList[0].type, "bspline");
  EXPECT_NEAR(model.info().faceList[0].area, read.info().faceList[0].area, 1e-6);
  EXPECT_LT((model.info().bounds.min - read.info().bounds.min).norm(), 1e-6);
  EXPECT_LT((model.info().bounds.max - read.info().bounds.max).norm(), 1e-6);
  const Target one = Target::make(model, {}).value(), other = Target::make(read, {}).value();
  const geometry::Setup setup = designedSetup(one);
  ASSERT_EQ(setup, designedSetup(other));
  Findings findings;
  const auto sections = cutSections(one, setup, {33, {}}, {}, findings).value();
  const auto others = cutSections(other, setup, {33, {}}, {}, findings).value();
  EXPECT_TRUE(findings.empty());
  ASSERT_EQ(sections.size(), 33u);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    ASSERT_GE(sections[i].chosen, 0);
    EXPECT_NEAR(sections[i].curve().length(), others[i].curve().length(), 1e-6);
  }
}

TEST(DesignedModel, ItsPointsAreThoseOfTheSpline) {
  const SplineSurface spline = somePoles();
  const CadModel model = CadModel::of(spline, "designed").value();
  const Target target = Target::make(model, {}).value();
  const auto sampler = target.sampler();
  for (const double u : {0.01, 0.4, 0.99})
    for (const double v : {0.02, 0.55, 0.98}) {
      const auto foot = sampler->closest(spline.value(u, v), nullptr).value();
      EXPECT_LT(foot.distance, 1e-6);
      EXPECT_GT(foot.normal.z(), 0) << "the outer side is above";
    }
}

TEST(DesignedModel, OfALoftWithKnotsAcrossAndOfAFormulaToo) {
  SectionsSurface loft;
  loft.sections = {{0, SectionCurve::Kind::spline, {{0, 200}, {200, 230}, {350, 235}, {600, 210}}},
                   {400, SectionCurve::Kind::bezier, {{0, 200}, {300, 280}, {600, 220}}},
                   {800, SectionCurve::Kind::spline, {{0, 210}, {150, 215}, {600, 205}}}};
  for (const SurfaceShape& shape :
       {SurfaceShape(loft), SurfaceShape(FormulaSurface{{}, "200 + 20*sin(x/90)", {}})}) {
    const SplineSurface spline = splineOf(DesignedSurface{shape}).value();
    const CadModel model = CadModel::of(spline, "designed").value();
    const Target target = Target::make(model, {}).value();
    Findings findings;
    const auto sections = cutSections(target, designedSetup(target), {9, {}}, {}, findings);
    ASSERT_TRUE(sections) << sections.error().message;
    for (const Section& section : *sections) EXPECT_GE(section.chosen, 0);
  }
}

TEST(DesignedModel, NumbersThatMakeNoFaceAreAnError) {
  SplineSurface spline = somePoles();
  spline.knotsU.pop_back();
  EXPECT_NE(CadModel::of(spline, "designed").error().message.find("knots"), std::string::npos);
  spline = somePoles();
  spline.poles[7].z() = NAN;
  EXPECT_NE(CadModel::of(spline, "designed").error().message.find("pole 7 is not finite"), std::string::npos);
}

}  // namespace bw::geometry
