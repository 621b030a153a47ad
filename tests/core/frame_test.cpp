// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/frame.h"
#include "bw/core/base/box_in_plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "bw/core/base/units.h"

namespace bw {

TEST(Frame, WorldAndLocalAreInverse) {
  const Eigen::Matrix3d axes = rotationFromAngles({0.3, -1.2, 2});
  const Frame frame{{1, 2, 3}, axes.col(0), axes.col(1), axes.col(2)};
  EXPECT_LT((frame.x.cross(frame.y) - frame.normal).norm(), 1e-14);
  const Eigen::Vector3d local(4, -5, 6);
  EXPECT_LT((frame.toLocal(frame.toWorld(local.head<2>(), local.z())) - local).norm(), 1e-13);
}

TEST(Frame, AnglesRoundTripThroughTheRotation) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> angle(-kPi, kPi), tilt(-kPi / 2, kPi / 2);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d angles(angle(engine), tilt(engine), angle(engine));
    const Eigen::Matrix3d r = rotationFromAngles(angles);
    EXPECT_LT((rotationFromAngles(anglesFromRotation(r)) - r).norm(), 1e-12);
  }
  for (const double b : {kPi / 2, -kPi / 2}) {
    const Eigen::Matrix3d r = rotationFromAngles({0.3, b, 0.4});
    EXPECT_LT((rotationFromAngles(anglesFromRotation(r)) - r).norm(), 1e-7);
  }
}

TEST(Box, SpansItsCornersAboutItsCenter) {
  const Box box{
      Frame{{10, 0, 0}, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()},
      {1, 2, 3}};
  // The axes are exchanged: the first edge lies along y, the second along z, the third along x.
  const Eigen::Vector3d half(1.5, 0.5, 1);
  for (const Eigen::Vector3d& corner : box.corners())
    EXPECT_LT(((corner - box.center()).cwiseAbs() - half).norm(), 1e-12);
  EXPECT_LT((box.center() - Eigen::Vector3d(11.5, 0.5, 1)).norm(), 1e-12);
}

TEST(Box, IsLeftByPlanesInOutlines) {
  const Box box{Frame{{100, 0, 0}}, {1, 2, 3}};
  const auto area = [](const std::vector<Eigen::Vector2d>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
      twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * twice;
  };
  const auto leaning = [](const Eigen::Vector3d& through, const Eigen::Vector3d& normal) {
    Frame plane{through, normal.unitOrthogonal(), {}, normal.normalized()};
    plane.y = plane.normal.cross(plane.x);
    return plane;
  };
  const std::vector<Eigen::Vector2d> level = boxInPlane(box, leaning({0, 0, 1}, {0, 0, 1}));
  EXPECT_EQ(level.size(), 4u);
  EXPECT_NEAR(area(level), 2, 1e-12);
  // Through the middles of six edges of a cube; near a corner; beside it.
  const Box cube{Frame{{-1, -1, -1}}, {2, 2, 2}};
  const std::vector<Eigen::Vector2d> six = boxInPlane(cube, leaning({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(six.size(), 6u);
  EXPECT_NEAR(area(six), 1.5 * std::sqrt(3.0) * 2, 1e-12);
  EXPECT_EQ(boxInPlane(cube, leaning({0.9, 0.9, 0.9}, {1, 1, 1})).size(), 3u);
  EXPECT_TRUE(boxInPlane(cube, leaning({1.1, 1.1, 1.1}, {1, 1, 1})).empty());
}

}  // namespace bw
