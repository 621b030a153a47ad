// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What neighbouring blocks leave, as the files tell it: surfaces that are read back from STEP meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bw/geometry/cad_model.h"
#include "bw/pipeline/produce.h"
#include "sample_wall.h"

namespace bw::pipeline {
namespace {

/// The largest distance between two surfaces along a boundary of length 2 `half`, and of what of the second
/// lies nearest to it from the plane of it.
struct Apart {
  double gap = 0, fromPlane = 0;  ///< mm
};
Apart apartAlong(SurfaceSampler& first, SurfaceSampler& second, SurfaceSampler& target,
                 const Boundary& boundary, const Eigen::Vector3d& along, double half) {
  constexpr int kPlaces = 801;
  Apart apart;
  for (int k = 0; k < kPlaces; ++k) {
    Eigen::Vector3d place = boundary.point + along * std::lerp(-half, half, (k + 0.5) / kPlaces);
    // Up or down to the surface asked for.
    for (int i = 0; i < 20; ++i) {
      const auto foot = target.closest(place, nullptr);
      if (!foot) return {1e300, 1e300};
      place.z() += (foot->point - place).dot(foot->normal) / foot->normal.z();
    }
    const auto one = first.closest(place, nullptr);
    if (!one) return {1e300, 1e300};
    const auto other = second.closest(one->point, nullptr);
    if (!other) return {1e300, 1e300};
    const auto back = first.closest(other->point, nullptr);
    if (!back) return {1e300, 1e300};
    apart.gap = std::max(apart.gap, (other->point - back->point).norm());
    apart.fromPlane = std::max(apart.fromPlane, std::abs(boundary.normal.dot(other->point - boundary.point)));
  }
  return apart;
}

TEST(JointsInFiles, SurfacesOfNeighboursMeetAlongTheirWholeBoundary) {
  for (const double kerf : {0.0, 4.0}) {
    Design design = test::sampleWall(2, 2, 17);
    design.process.kerf = kerf;
    const Product product = produce(design, "nothing-is-written-there", {}, {});
    ASSERT_FALSE(product.error) << product.error->message;
    const auto written = std::ranges::find(product.files.paths(), std::filesystem::path("surface.step"));
    ASSERT_NE(written, product.files.paths().end());
    const std::string& step = product.files.bytes()[std::size_t(written - product.files.paths().begin())];
    const Evaluation& e = product.evaluation;
    ASSERT_EQ(e.blocks.size(), 4u);
    const auto model = geometry::CadModel::readBytes(step, "surface.step");
    ASSERT_TRUE(model) << model.error().message;
    std::vector<std::unique_ptr<SurfaceSampler>> faces;
    for (int i = 0; i < 4; ++i) {
      FaceChoice choice;
      choice.kind = FaceChoice::Kind::indices;
      choice.indices = {i};
      const auto face = geometry::Target::make(*model, choice);
      ASSERT_TRUE(face) << face.error().message;
      faces.push_back(face->sampler());
    }
    ASSERT_TRUE(e.joints.value);
    ASSERT_EQ(e.joints.value->joints.size(), 4u);
    for (const Joint& joint : e.joints.value->joints) {
      const CutEvaluation &a = e.blocks[joint.first].cuts[0], &b = e.blocks[joint.second].cuts[0];
      const auto boundary = boundaryOf(a.setup->block, b.setup->block, 0);
      ASSERT_TRUE(boundary);
      const bool across = std::abs(boundary->normal.y()) > 0.5;
      const Eigen::Vector3d along =
          across ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : Eigen::Vector3d(Eigen::Vector3d::UnitY());
      const auto target = a.target.value->sampler();
      const Apart apart = apartAlong(*faces[joint.first], *faces[joint.second], *target, *boundary, along,
                                     across ? 300 : 400);
      EXPECT_LT(apart.gap, kerf == 0 ? 1e-3 : 0.05) << a.id << " " << b.id << ", kerf " << kerf;
      EXPECT_NEAR(apart.gap, joint.gapMax, 0.05) << "as it is told";
      if (kerf > 0) continue;  // what stands then ends beside the boundary, where the surface leans
      EXPECT_LT(apart.fromPlane, 1e-3);
      // So do the triangles.
      const SurfaceGrid &one = a.analysis.value->cut, &other = b.analysis.value->cut;
      if (!across) continue;
      for (int c = 0; c < one.columns; ++c) {
        EXPECT_LT((one.at(one.rows - 1, c) - other.at(0, c)).norm(), 0.01) << c;
        EXPECT_NEAR(one.at(one.rows - 1, c).y(), boundary->point.y(), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace bw::pipeline
