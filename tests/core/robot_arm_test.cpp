// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/robot_arm.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "bw/core/base/units.h"

namespace bw {
namespace {

RobotArm irb1600() { return **findRobotArm("irb1600-10-1.45"); }

/// The chain joint by joint, as its product specification has it.
Eigen::Isometry3d chain(const std::vector<double>& q) {
  const auto turn = [](double angle, const Eigen::Vector3d& axis) { return Eigen::AngleAxisd(angle, axis); };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose = pose * turn(q[0], z) * Eigen::Translation3d(150, 0, 486.5) * turn(q[1], y) *
         Eigen::Translation3d(0, 0, 700) * turn(q[2], y) * Eigen::Translation3d(600, 0, 0) * turn(q[3], x) *
         turn(q[4], y) * turn(q[5], x) * Eigen::Translation3d(65, 0, 0);
  Eigen::Matrix3d zero;
  zero << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  pose.rotate(zero);
  return pose;
}

TEST(RobotArm, HasItsFlangeWhereTheChainHasIt) {
  const RobotArm arm = irb1600();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-2, 2);
  for (int n = 0; n < 200; ++n) {
    std::vector<double> q(6);
    for (double& a : q) a = angle(random);
    const Eigen::Isometry3d there = chain(q);
    const Pose pose = arm.flange(q);
    EXPECT_LT((pose.position - there.translation()).norm(), 1e-9);
    EXPECT_LT((pose.rotation.toRotationMatrix() - there.linear()).norm(), 1e-12);
  }
}

TEST(RobotArm, FindsTheJointAnglesOfWhatItReaches) {
  const RobotArm arm = irb1600();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.02, 0.98), little(-0.02, 0.02);
  for (int n = 0; n < 2000; ++n) {
    std::vector<double> q(6), near(6);
    for (std::size_t k = 0; k < 6; ++k) {
      q[k] = arm.range[k][0] + share(random) * (arm.range[k][1] - arm.range[k][0]);
      near[k] = q[k] + little(random);
    }
    const Pose flange = arm.flange(q);
    const auto found = arm.jointsFor(flange, near);
    ASSERT_TRUE(found) << n;
    const Pose back = arm.flange(*found);
    EXPECT_LT((back.position - flange.position).norm(), 1e-8);
    EXPECT_LT(back.rotation.angularDistance(flange.rotation), 1e-7);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_GE((*found)[k], arm.range[k][0] - 1e-12);
      EXPECT_LE((*found)[k], arm.range[k][1] + 1e-12);
    }
    // From near by, and away from where two postures meet, it is the same.
    if (std::abs(std::sin(q[4])) > 0.2 && std::abs(std::cos(q[2])) > 0.2) {
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR((*found)[k], q[k], 0.1) << n << ' ' << k;
    }
  }
}

TEST(RobotArm, DoesNotReachBeyondItsArms) {
  const RobotArm arm = irb1600();
  Pose flange = arm.flange(std::vector<double>(6, 0.0));
  const std::vector<double> near(6, 0.0);
  ASSERT_TRUE(arm.jointsFor(flange, near));
  flange.position.x() += 600;
  EXPECT_FALSE(arm.jointsFor(flange, near));
  EXPECT_GT(arm.wristDistance(flange), arm.reach());
  EXPECT_DOUBLE_EQ(arm.reach(), 1300);
}

TEST(RobotArm, FaultsNameTheKey) {
  const std::string good =
      R"({"version": 1, "links": {"d1": 1, "a1": 0, "a2": 700, "a3": 0, "d4": 600, "d6": 65}, "axes": [)"
      R"({"from_deg": -1, "to_deg": 1}, {"from_deg": -1, "to_deg": 1}, {"from_deg": -1, "to_deg": 1},)"
      R"({"from_deg": -1, "to_deg": 1}, {"from_deg": -1, "to_deg": 1}, {"from_deg": -1, "to_deg": 1}]})";
  ASSERT_TRUE(parseRobotArm(good, "x")) << parseRobotArm(good, "x").error().message;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const Result<RobotArm> arm = parseRobotArm(text, "x");
    return arm ? std::string("read") : arm.error().message;
  };
  EXPECT_NE(changed("\"d4\": 600", "\"d4\": 0").find("d4"), std::string::npos);
  EXPECT_NE(changed("\"d6\": 65", "\"d7\": 65").find("d6"), std::string::npos);
  EXPECT_NE(changed("\"to_deg\": 1", "\"to_deg\": -2").find("to_deg"), std::string::npos);
  EXPECT_NE(changed("{\"from_deg\": -1, \"to_deg\": 1}, ", "").find("six"), std::string::npos);
  EXPECT_FALSE(**findRobotArm("irb1600-10-1.45") == RobotArm());
  EXPECT_FALSE(findRobotArm("no-such-robot")->has_value());
  EXPECT_FALSE(findRobotArm("../cells/irb1600-pair")->has_value());
}

}  // namespace
}  // namespace bw
