// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Faces on which the lines of one parameter run together.

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>

#include <sstream>

#include "bw/geometry/cad_model.h"

namespace bw::geometry::test {
namespace {

/// The first face of that type of a shape which was written and read.
FaceInfo faceOf(const TopoDS_Shape& shape, const std::string& type) {
  std::ostringstream text;
  BRepTools::Write(shape, text);
  const auto model = CadModel::readBytes(text.str(), "shape.brep");
  EXPECT_TRUE(model) << model.error().message;
  const auto info = model->infoInFull();
  EXPECT_TRUE(info);
  for (const FaceInfo& face : info->faceList)
    if (face.type == type) return face;
  ADD_FAILURE() << "no " << type;
  return {};
}

TEST(Poles, BallIsBentAlikeEverywhere) {
  for (const double radius : {1.0, 100.0, 12345.0}) {
    const FaceInfo ball = faceOf(BRepPrimAPI_MakeSphere(radius).Shape(), "sphere");
    EXPECT_NEAR(ball.curvatureMin * radius, -1, 1e-9);
    EXPECT_NEAR(ball.curvatureMax * radius, -1, 1e-9);
    EXPECT_NEAR(ball.minRadius, radius, 1e-9 * radius);
  }
  EXPECT_EQ(faceOf(BRepPrimAPI_MakeSphere(100).Shape(), "sphere").curved, "doubly");
}

TEST(Poles, ConeIsStraightOneWayUpToItsApex) {
  const FaceInfo cone = faceOf(BRepPrimAPI_MakeCone(100, 0, 200).Shape(), "cone");
  EXPECT_NEAR(cone.curvatureMax, 0, 1e-9);
  EXPECT_GT(cone.curvatureMin, -1);  // that of the last circle before the apex
  EXPECT_LT(cone.curvatureMin, -0.01);
  EXPECT_EQ(cone.curved, "singly");
}

}  // namespace
}  // namespace bw::geometry::test
