// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "finding_of.h"
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

/// Where the ends of the blade are in the work object at the homes of a cell.
std::vector<Pose> homeOf(const Cell& cell) {
  const auto in = [](const Pose& pose) {
    return Eigen::Isometry3d(Eigen::Translation3d(pose.position) * pose.rotation);
  };
  std::vector<Pose> ends;
  for (const CellTask& task : cell.tasks) {
    const Eigen::Isometry3d end =
        in(cell.workObject).inverse() * in(task.base) * in(task.arm->flange(task.home)) * in(task.tool);
    ends.push_back({end.translation(), Eigen::Quaterniond(end.linear())});
  }
  return ends;
}

TEST(ProgramPlan, BeginsAtHomeWithTheBladeAsItLiesAtTheFirstInstant) {
  const Motion motion = sample::motion();
  const Cell cell = *loadCell("irb1600-pair");
  const auto plan = planProgram(motion, cell);
  ASSERT_TRUE(plan) << plan.error().message;
  const std::vector<Pose> before = homeOf(cell), now = homeOf(plan->cell);
  const std::vector<Pose>& first = motion.instants.front().poses;
  ASSERT_EQ(plan->moves[0].poses.size(), 2u);
  // The same shape, moved to where the cell has its home.
  const auto middle = [](const std::vector<Pose>& ends) -> Eigen::Vector3d {
    return 0.5 * (ends[0].position + ends[1].position);
  };
  EXPECT_LT((middle(now) - middle(before)).norm(), 1e-6);
  for (std::size_t end = 0; end < 2; ++end) {
    const Pose& asked = plan->moves[0].poses[end];
    EXPECT_LT((now[end].position - asked.position).norm(), 1e-6);
    EXPECT_LT(now[end].rotation.angularDistance(first[end].rotation), 1e-6);
    EXPECT_LT(((now[end].position - middle(now)) - (first[end].position - middle(first))).norm(), 1e-6);
  }
  EXPECT_TRUE(checkPlacement(motion, cell).empty());
}

TEST(ProgramPlan, TellsWhereAHomeIsOutOfReachOrNotKnown) {
  const Motion motion = sample::motion();
  Cell cell = *loadCell("irb1600-pair");
  cell.tasks[1].base.position.x() += 2000;
  const Findings findings = checkPlacement(motion, cell);
  const Finding* far = test::findingOf<HomeOutOfReach>(findings);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->severity, Severity::error);
  const auto& cause = std::get<HomeOutOfReach>(far->cause);
  EXPECT_EQ(cause.reach, 1300);
  EXPECT_GT(cause.distance, cause.reach);
  // With --despite-errors it is written all the same, with the home of the cell.
  const auto plan = planProgram(motion, cell);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->cell.tasks[0].home, cell.tasks[0].home);
  // Home in reach, but not the block.
  Cell high = *loadCell("irb1600-pair");
  high.workObject.position.z() += 2500;
  const Findings above = checkPlacement(motion, high);
  const Finding* target = test::findingOf<HomeOutOfReach>(above);
  ASSERT_TRUE(target);
  EXPECT_TRUE(target->where.point) << "at a target";
  EXPECT_GT(std::get<HomeOutOfReach>(target->cause).distance, 1300);
  const Findings unknown = checkPlacement(motion, sample::cell());
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_EQ(unknown[0].severity, Severity::warning);
  EXPECT_EQ(std::get<HomeUnknown>(unknown[0].cause).robots, "\"irb1600-10-1.45\"") << "each once";
}

TEST(ProgramPlan, IsReadBackFromItsText) {
  const auto plan = planProgram(sample::motion(), sample::cell());
  ASSERT_TRUE(plan);
  Program text = *writeRapid(*plan);
  const auto read = readRapidPlan(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->cell.name, "irb1600-pair");
  ASSERT_EQ(read->moves.size(), plan->moves.size());
  for (std::size_t i = 0; i < plan->moves.size(); ++i) {
    EXPECT_EQ(read->moves[i].role, plan->moves[i].role) << i;
    EXPECT_EQ(read->moves[i].instant, plan->moves[i].instant) << i;
    EXPECT_NEAR(read->moves[i].duration, plan->moves[i].duration, 1e-4) << i;
    EXPECT_EQ(read->moves[i].wait, 0) << i;
  }
  EXPECT_EQ(read->moves[0].names, (std::vector<std::string>{"jtHome", "jtHome"}));
  EXPECT_EQ(read->moves[1].names[1], "pApproach");
  EXPECT_EQ(read->moves[7].names[0], "pRetreat");
  EXPECT_TRUE(planDifferences(*read, *plan, true).empty());
  // What stands still in the block stands twice in the motion, and later things come later.
  const double end = readRapid(text)->duration();
  for (const char* file : {"T_ROB1/BladeLeft.mod", "T_ROB2/BladeRight.mod"})
    ASSERT_TRUE(
        sample::replace(sample::file(text, file), "MoveL p0004", "WaitTime 5;\r\n        MoveL p0004"));
  EXPECT_EQ(readRapidPlan(text)->moves[4].wait, 5);
  const auto waits = readRapid(text);
  ASSERT_TRUE(waits);
  EXPECT_NEAR(waits->duration(), end + 5, 1e-9);
  ASSERT_EQ(waits->instants.size(), 6u);
  EXPECT_EQ(waits->instants[2].poses[0].position, waits->instants[3].poses[0].position);
}

TEST(ProgramPlan, WhatDiffersFromTheDesignIsNamed) {
  const auto planned = planProgram(sample::motion(), sample::cell());
  ASSERT_TRUE(planned);
  const auto read = readRapidPlan(*writeRapid(*planned));
  ASSERT_TRUE(read);
  const auto told = [&](auto change) {
    ProgramPlan other = *read;
    change(other);
    std::string text;
    for (const Finding& finding : planDifferences(other, *planned, true)) {
      const auto& breach = std::get<ProgramBreach>(finding.cause);
      text += severityName(finding.severity) + std::string(" ") + breach.place + " " + breach.text + "\n";
    }
    return text;
  };
  const auto tells = [&](const std::string& text, std::initializer_list<const char*> words) {
    for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
  };
  tells(told([](ProgramPlan& p) { p.cell.tasks[1].home[2] += 0.1; }),
        {"error T_ROB2", "\"jtHome\"", "axis 3 is 5.73 degrees off"});
  tells(told([](ProgramPlan& p) { p.moves[1].poses[0].position.y() += 30; }),
        {"error T_ROB1", "\"pApproach\"", "is 30 mm off"});
  tells(told([](ProgramPlan& p) { p.moves.back().poses[1].position.z() -= 12; }),
        {"error T_ROB2", "\"pRetreat\"", "is 12 mm off"});
  tells(told([](ProgramPlan& p) { p.moves[4].poses[1].position.z() -= 0.5; }),
        {"warning T_ROB2", "\"p0003\" is 0.5 mm off"});
  tells(told([](ProgramPlan& p) { p.moves[4].duration = 12; }),
        {"warning T_ROB1", "\"p0003\" lasts 12 s, in the design 8.375 s"});
  tells(told([](ProgramPlan& p) { p.moves.pop_back(); }), {"error the program its retreat has 0 targets"});
  tells(told([](ProgramPlan& p) { p.cell.workObject.position.x() += 4; }),
        {"warning T_ROB1 the work object is 4 mm", "unless that is meant, write it anew"});
  tells(told([](ProgramPlan& p) { p.cell.heatSignal.clear(); }),
        {"error the program nothing switches the heat"});
  tells(told([](ProgramPlan& p) { p.cell.heatSignal = "doLamp"; }),
        {"error the program it switches \"doLamp\""});
  tells(told([](ProgramPlan& p) { p.cell.heatDwell /= 2; }), {"warning the program the blade has "});
  EXPECT_EQ(told([](ProgramPlan& p) { p.cell.heatDwell *= 2; }), "");
  // Of a motion that robots do not run the targets alone are known.
  ProgramPlan motion = *read;
  motion.cell.heatSignal.clear();
  motion.cell.tasks[0].home[0] += 1;
  motion.moves[1].poses[0].position.y() += 30;
  EXPECT_TRUE(planDifferences(motion, *planned, false).empty());
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
