// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/block_contact.h"

#include <gtest/gtest.h>

#include <vector>

namespace bw {
namespace {

using Eigen::Vector3d;

/// 100 × 200 × 50 mm, turned by a quarter about z: its x is the file's y.
Box block() {
  Box box;
  box.frame = {{10, 20, 30}, Vector3d::UnitY(), -Vector3d::UnitX(), Vector3d::UnitZ()};
  box.size = {100, 200, 50};
  return box;
}

/// A straight blade along the x of the block, in its frame.
std::vector<Vector3d> blade(double y, double z, double from = -50, double to = 150) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 100; ++k) {
    const Vector3d local(from + (to - from) * k / 100, y, z);
    points.push_back(block().frame.toWorld(local.head<2>(), local.z()));
  }
  return points;
}

TEST(BlockContact, IsWhereTheBladeFirstMeetsTheBlock) {
  const auto contact = contactOnWay(block(), blade(-100, 10), blade(100, 10));
  ASSERT_TRUE(contact);
  const Vector3d local = block().frame.toLocal(contact->place);
  EXPECT_GE(local.x(), 0);
  EXPECT_LE(local.x(), 100);
  EXPECT_NEAR(local.y(), 0.5, 1);
  EXPECT_NEAR(local.z(), 10, 1e-9);
  EXPECT_NEAR(contact->share, 0.5, 0.01);
  EXPECT_NEAR(contact->depth, 10, 1e-9) << "the bottom is nearer than what it came through";
}

TEST(BlockContact, SeesWhatPassesBetweenAndWhatStands) {
  EXPECT_TRUE(contactOnWay(block(), blade(-100, 20), blade(300, 20))) << "out on the other side";
  const auto standing = contactOnWay(block(), blade(30, 40), blade(30, 40));
  ASSERT_TRUE(standing);
  EXPECT_EQ(standing->share, 0);
  EXPECT_NEAR(standing->depth, 10, 1e-9);
  // Both ends of a piece are outside.
  const std::vector<Vector3d> one = {block().frame.toWorld({-50, 100}, 25),
                                     block().frame.toWorld({150, 100}, 25)};
  EXPECT_TRUE(contactOnWay(block(), one, one));
}

TEST(BlockContact, IsNoneBesideTheBlockAndAlongItsFaces) {
  EXPECT_FALSE(contactOnWay(block(), blade(-100, 10), blade(-1, 10)));
  EXPECT_FALSE(contactOnWay(block(), blade(-100, 51), blade(300, 51))) << "over it";
  EXPECT_FALSE(contactOnWay(block(), blade(-100, 50), blade(300, 50))) << "along its face";
  EXPECT_FALSE(contactOnWay(block(), blade(100, 25, 101, 300), blade(100, 25, 101, 300)));
  // Across a corner that the boxes around both share.
  EXPECT_FALSE(contactOnWay(block(), blade(-100, 49), blade(10, 160)));
}

}  // namespace
}  // namespace bw
