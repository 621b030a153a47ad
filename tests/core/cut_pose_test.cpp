// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How blocks lie for their cuts.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "bw/core/parts/cut_pose.h"

namespace bw {
namespace {

using Eigen::Vector3d;

std::vector<CutPose> allPoses() {
  std::vector<CutPose> poses;
  for (std::size_t face = 0; face < kBlockFaces.size(); ++face)
    for (int quarters = 0; quarters < 4; ++quarters) poses.push_back({BlockFace(face), quarters});
  return poses;
}

/// A block that stands askew.
Box askew() { return BlockPlacement{{10, -20, 30}, {600, 800, 500}, {0.3, -0.2, 0.7}}.box(); }

Vector3d outwards(BlockFace face) {
  constexpr std::array<std::array<int, 3>, 6> kWays = {
      {{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  const auto& way = kWays[std::size_t(face)];
  return {double(way[0]), double(way[1]), double(way[2])};
}

TEST(CutPose, EachBringsItsFaceUpByATurn) {
  std::vector<Eigen::Matrix3d> seen;
  for (const CutPose& pose : allPoses()) {
    const Eigen::Matrix3d turn = turnOf(pose);
    EXPECT_TRUE((turn * outwards(pose.up)).isApprox(Vector3d::UnitZ()));
    EXPECT_NEAR(turn.determinant(), 1, 1e-15);
    EXPECT_TRUE((turn * turn.transpose()).isApprox(Eigen::Matrix3d::Identity()));
    for (const Eigen::Matrix3d& other : seen) EXPECT_FALSE(turn.isApprox(other));
    seen.push_back(turn);
  }
  EXPECT_EQ(seen.size(), 24u) << "all ways to lay a box";
}

TEST(CutPose, AQuarterTurnsCounterClockwiseSeenFromAbove) {
  EXPECT_TRUE((turnOf({BlockFace::top, 1}) * Vector3d::UnitX()).isApprox(Vector3d::UnitY()));
}

TEST(CutPose, TheBlockStaysInItsPlace) {
  const Box placed = askew();
  for (const CutPose& pose : allPoses()) {
    const Box lies = lying(placed, pose);
    EXPECT_TRUE(lies.center().isApprox(placed.center()));
    EXPECT_NEAR(lies.size.prod(), placed.size.prod(), 1e-6);
    EXPECT_TRUE(lies.frame.x.cross(lies.frame.y).isApprox(lies.frame.normal));
    for (const Vector3d& corner : lies.corners()) {
      const Eigen::Array3d local = placed.frame.toLocal(corner).array() / placed.size.array();
      EXPECT_LT((local - local.round()).abs().maxCoeff(), 1e-12) << "corners are corners";
    }
    const Vector3d up = placed.frame.toWorld({0, 0}) - placed.frame.origin +
                        outwards(pose.up).x() * placed.frame.x + outwards(pose.up).y() * placed.frame.y +
                        outwards(pose.up).z() * placed.frame.normal;
    EXPECT_TRUE(lies.frame.normal.isApprox(up)) << "the face that is up";
    const Box back = placedAs(lies, pose);
    EXPECT_TRUE(back.frame.origin.isApprox(placed.frame.origin));
    EXPECT_TRUE(back.frame.x.isApprox(placed.frame.x));
    EXPECT_TRUE(back.size.isApprox(placed.size));
  }
}

TEST(CutPose, TheCornerLiesLowestAtTheLeftInFront) {
  // Coordinates of the block's points as it lies are those before, turned, but for where they begin.
  const Box placed = askew();
  for (const CutPose& pose : allPoses()) {
    const Box lies = lying(placed, pose);
    const Vector3d p(123, 45, 67), q(1, 500, 20);
    const auto world = [&](const Vector3d& local) {
      return placed.frame.toWorld({local.x(), local.y()}, local.z());
    };
    const Vector3d moved = lies.frame.toLocal(world(q)) - lies.frame.toLocal(world(p));
    EXPECT_TRUE(moved.isApprox(turnOf(pose) * (q - p)));
    for (const Vector3d& corner : placed.corners()) EXPECT_GT(lies.frame.toLocal(corner).minCoeff(), -1e-9);
  }
}

TEST(CutPose, UpTurnsAgainstTheBlock) {
  // A block that stands upright: what is up while it lies is the face that was named.
  const Box placed = BlockPlacement{{0, 0, 0}, {600, 800, 500}, {0, 0, 0}}.box();
  for (const CutPose& pose : allPoses())
    EXPECT_TRUE(upAs(lying(placed, pose), pose, Vector3d::UnitZ()).isApprox(outwards(pose.up)));
  // One that leans leans the same way as it lies.
  for (const CutPose& pose : allPoses()) {
    const Box lies = lying(askew(), pose);
    const Vector3d up = upAs(lies, pose, Vector3d::UnitZ());
    const Box before = askew();
    const Vector3d local(up.dot(lies.frame.x), up.dot(lies.frame.y), up.dot(lies.frame.normal));
    const Vector3d was(before.frame.x.z(), before.frame.y.z(), before.frame.normal.z());
    EXPECT_TRUE(local.isApprox(was));
  }
}

TEST(CutPose, SidesAreThoseOfTheBlockAsItLies) {
  const Box lies = lying(askew(), {BlockFace::back, 1});
  EXPECT_TRUE(keptWay(lies, KeptSide::below).isApprox(-lies.frame.normal));
  EXPECT_TRUE(keptWay(lies, KeptSide::above).isApprox(lies.frame.normal));
  EXPECT_TRUE(keptWay(lies, KeptSide::left).isApprox(-lies.frame.x));
  EXPECT_TRUE(keptWay(lies, KeptSide::right).isApprox(lies.frame.x));
  EXPECT_TRUE(keptWay(lies, KeptSide::front).isApprox(-lies.frame.y));
  EXPECT_TRUE(keptWay(lies, KeptSide::back).isApprox(lies.frame.y));
}

}  // namespace
}  // namespace bw
