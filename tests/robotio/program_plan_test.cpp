// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "sample.h"

namespace bw::robotio {
namespace {

TEST(ProgramPlan, GoesHomeApproachesCutsAndRetreats) {
  const Motion motion = sample::motion(5);
  const Cell cell = sample::cell();
  const auto plan = planProgram(motion, cell);
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->bladeLength, motion.bladeLength);
  EXPECT_EQ(plan->cuttingTime, 33.5);
  const MoveRole roles[] = {MoveRole::home, MoveRole::approach, MoveRole::approach, MoveRole::cut,
                            MoveRole::cut,  MoveRole::cut,      MoveRole::cut,      MoveRole::retreat};
  const int instants[] = {-1, -1, 0, 1, 2, 3, 4, -1};
  ASSERT_EQ(plan->moves.size(), std::size(roles));
  for (std::size_t i = 0; i < plan->moves.size(); ++i) {
    const ProgramMove& move = plan->moves[i];
    EXPECT_EQ(move.role, roles[i]) << i;
    EXPECT_EQ(move.instant, instants[i]) << i;
    EXPECT_EQ(move.poses.size(), i == 0 ? 0u : 2u);
    EXPECT_EQ(move.zone, i > 2 && i < 6 ? 1 : 0) << i;
    if (move.role == MoveRole::cut)
      EXPECT_GE(move.speed, motion.cuttingSpeed);
    else
      EXPECT_EQ(move.speed, cell.travelSpeed);
  }
}

TEST(ProgramPlan, ComesAndGoesTheWaysOfTheMotionAndNotThoseOfItsPoses) {
  Motion motion = sample::motion();
  motion.approach = {1, 0, 0};
  motion.retreat = {0, 0, 1};
  const Cell cell = sample::cell();
  const auto plan = planProgram(motion, cell);
  ASSERT_TRUE(plan) << plan.error().message;
  const std::vector<ProgramMove>& m = plan->moves;
  for (std::size_t end = 0; end < 2; ++end) {
    EXPECT_LT(
        (m[2].poses[end].position - m[1].poses[end].position - Eigen::Vector3d(cell.approach, 0, 0)).norm(),
        1e-9);
    EXPECT_LT(
        (m[7].poses[end].position - m[6].poses[end].position - Eigen::Vector3d(0, 0, cell.approach)).norm(),
        1e-9);
  }
}

TEST(ProgramPlan, NoMoveIsFasterThanItSays) {
  const auto plan = planProgram(sample::motion(60), sample::cell());
  ASSERT_TRUE(plan);
  for (std::size_t i = 2; i < plan->moves.size(); ++i)
    for (std::size_t end = 0; end < 2; ++end) {
      const ProgramMove &a = plan->moves[i - 1], &b = plan->moves[i];
      EXPECT_LE((b.poses[end].position - a.poses[end].position).norm() / b.duration, b.speed * (1 + 1e-9));
      EXPECT_LE(b.poses[end].rotation.angularDistance(a.poses[end].rotation) / b.duration, b.turnSpeed);
    }
}

}  // namespace
}  // namespace bw::robotio
