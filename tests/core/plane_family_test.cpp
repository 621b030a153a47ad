// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/plane_family.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace bw {

namespace {

const Box kBlock{Frame{{10, 20, 30}}, {400, 300, 200}};

}  // namespace

TEST(PlaneFamily, LiesAcrossItsDirectionWithYUpwards) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d(3, 4, 0) / 5);
  EXPECT_NEAR((planes.direction() - Eigen::Vector3d(0.6, 0.8, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((planes.frame.y - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((planes.frame.x.cross(planes.frame.y) - planes.direction()).norm(), 0, 1e-15);
  EXPECT_NEAR(planes.entry, 0.6 * 10 + 0.8 * 20, 1e-12);
  EXPECT_NEAR(planes.exit, 0.6 * 410 + 0.8 * 320, 1e-12);
}

TEST(PlaneFamily, TakesTheBlocksOwnYWhereTheBladeTravelsUpwards) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR((planes.frame.y - Eigen::Vector3d::UnitY()).norm(), 0, 1e-15);
}

TEST(PlaneFamily, CountsTravelFromTheBlock) {
  const PlaneFamily planes = PlaneFamily::across(kBlock, Eigen::Vector3d::UnitY());
  EXPECT_NEAR(planes.travel(25), 5, 1e-12);
  const Frame plane = planes.at(25);
  EXPECT_NEAR(plane.origin.dot(planes.direction()), 25, 1e-12);
  EXPECT_EQ(plane.x, planes.frame.x);
}

}  // namespace bw
