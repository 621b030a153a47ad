// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/cad_model.h"

#include <cmath>
#include <set>

#include "shapes.h"
#include "step_merge.h"

namespace bw::geometry::test {
namespace {

/// Strips of 100 × 50 mm side by side, each bent a little more than the one before.
CadModel strips(int count) {
  std::vector<std::string> files;
  for (int k = 0; k < count; ++k)
    files.push_back(stepOf(
        [k](double u, double v) { return Eigen::Vector3d(100 * u, 60.0 * k + 50 * v, k * std::sin(3 * u)); },
        9, 9));
  return modelOf(bw::test::mergedStep(files));
}

TEST(FaceMesh, HasTrianglesOfEveryFaceEachWithItsIndex) {
  const CadModel model = strips(5);
  ASSERT_EQ(model.info().faces, 5);
  const auto mesh = faceMesh(model);
  ASSERT_TRUE(mesh) << mesh.error().message;
  ASSERT_EQ(mesh->faces.size(), mesh->mesh.triangles.size());
  ASSERT_EQ(mesh->mesh.normals.size(), mesh->mesh.points.size());
  std::vector<double> area(5, 0.0);
  for (std::size_t k = 0; k < mesh->faces.size(); ++k) {
    const int face = mesh->faces[k];
    ASSERT_GE(face, 0);
    ASSERT_LT(face, 5);
    const Bounds& bounds = model.info().faceList[std::size_t(face)].bounds;
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh->mesh.points[std::size_t(mesh->mesh.triangles[k][i])];
      EXPECT_GE(p[i].y(), bounds.min.y() - 1e-6);
      EXPECT_LE(p[i].y(), bounds.max.y() + 1e-6);
    }
    area[std::size_t(face)] += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
  }
  for (std::size_t face = 0; face < 5; ++face)
    EXPECT_NEAR(area[face], model.info().faceList[face].area, 0.01 * area[face]);
}

TEST(FaceMesh, StopsWhenAsked) {
  RunContext context;
  std::stop_source stop;
  stop.request_stop();
  context.stop = stop.get_token();
  expectError(faceMesh(strips(2), context), ErrorCode::cancelled, "");
}

}  // namespace
}  // namespace bw::geometry::test
