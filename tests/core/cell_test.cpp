// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bw/core/base/units.h"

namespace bw {
namespace {

const char* const kOneTask = R"({
  "tasks": [{
    "name": "T_ROB1", "robot": "irb1600-10-1.45",
    "base": {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]},
    "tool": {"name": "tBlade", "pose": {"position": [1, 2, 150], "quaternion": [0.5, 0.5, -0.5, 0.5]}, "mass": 3},
    "home_deg": [0, -20, 30, 0, 90, 180]
  }],
  "work_object": {"pose": {"position": [1000, 0, 500], "quaternion": [0, 0, 0, 1]}}
})";

/// The text with the first `from` replaced; `from` must be there.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = kOneTask;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expectFault(const std::string& text, const std::string& words) {
  const auto cell = parseCell(text, "test");
  ASSERT_FALSE(cell) << words;
  EXPECT_EQ(cell.error().code, ErrorCode::badInput);
  EXPECT_NE(cell.error().message.find(words), std::string::npos) << cell.error().message;
}

TEST(Cell, ReadsDegreesAsRadiansAndFillsTheRest) {
  const auto cell = parseCell(kOneTask, "test");
  ASSERT_TRUE(cell) << cell.error().message;
  EXPECT_EQ(cell->name, "test");
  ASSERT_EQ(cell->tasks.size(), 1u);
  const CellTask& task = cell->tasks[0];
  EXPECT_EQ(task.toolName, "tBlade");
  EXPECT_EQ(task.toolMass, 3);
  EXPECT_EQ(task.tool.position, Eigen::Vector3d(1, 2, 150));
  EXPECT_EQ(task.tool.rotation.coeffs(), Eigen::Vector4d(0.5, -0.5, 0.5, 0.5))
      << "the file's order is w, x, y, z";
  ASSERT_EQ(task.home.size(), 6u);
  EXPECT_DOUBLE_EQ(task.home[4], kPi / 2);
  EXPECT_EQ(cell->workObjectName, "wBlock");
  EXPECT_EQ(cell->heatSignal, "") << "a cell need not switch the heat";
  EXPECT_EQ(cell->workObject.rotation.z(), 1);
}

TEST(Cell, ThePairOfTheResourcesHoldsTheBladeByTheConvention) {
  const auto cell = loadCell("irb1600-pair");
  ASSERT_TRUE(cell) << cell.error().message;
  ASSERT_EQ(cell->tasks.size(), 2u);
  EXPECT_EQ(cell->tasks[0].name, "T_ROB1");
  EXPECT_EQ(cell->tasks[1].name, "T_ROB2");
  EXPECT_EQ(cell->heatSignal, "doBladeHeat");
  EXPECT_GT(cell->heatDwell, 0);
  // With both arms stretched straight at each other the flanges' z axes point across the block (the robots'
  // zero pose: flange z = base x, flange x = −base z). The blade's tangents then point at each other and both
  // ends have one and the same cutting direction.
  Eigen::Matrix3d R_BF;
  R_BF << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  const Eigen::Matrix3d left = cell->tasks[0].base.rotation * R_BF * cell->tasks[0].tool.rotation;
  const Eigen::Matrix3d right = cell->tasks[1].base.rotation * R_BF * cell->tasks[1].tool.rotation;
  EXPECT_NEAR((left.col(0) + right.col(0)).norm(), 0, 1e-9) << "tangents point at each other";
  EXPECT_NEAR((left.col(2) - right.col(2)).norm(), 0, 1e-9) << "one cutting direction";
  // The usual travel is along the block's +y with its z up. The start of the section curves, the left end,
  // then lies on the block's +x side (docs/conventions.md), and that is where the first task stands.
  const Eigen::Matrix3d R_WO = cell->workObject.rotation.toRotationMatrix();
  EXPECT_NEAR(left.col(2).dot(R_WO.col(1)), 1, 1e-9);
  EXPECT_NEAR(R_WO(2, 2), 1, 1e-9) << "the block stands upright";
  EXPECT_NEAR(left.col(0).dot(R_WO.col(0)), -1, 1e-9) << "the left tangent points to the block's -x";
  for (const auto& [task, side] : {std::pair{0, 1.0}, std::pair{1, -1.0}}) {
    const Eigen::Vector3d p_O =
        R_WO.transpose() * (cell->tasks[std::size_t(task)].base.position - cell->workObject.position);
    EXPECT_GT(side * (p_O.x() - 300), 1000) << task << ": beside a block of 600 mm";
  }
}

TEST(Cell, HomeOfThePairHoldsAnOrdinaryBladeStraightAndSlack) {
  const auto cell = loadCell("irb1600-pair");
  ASSERT_TRUE(cell);
  std::vector<Eigen::Isometry3d> ends;
  for (const CellTask& task : cell->tasks) {
    const Eigen::Isometry3d base = Eigen::Translation3d(task.base.position) * task.base.rotation;
    const Eigen::Isometry3d tool = Eigen::Translation3d(task.tool.position) * task.tool.rotation;
    const Pose flange = task.arm->flange(task.home);  // held against the chain in robot_arm_test.cpp
    ends.push_back(base * (Eigen::Translation3d(flange.position) * flange.rotation) * tool);
  }
  const Eigen::Vector3d chord = ends[1].translation() - ends[0].translation();
  EXPECT_GT(chord.norm(), 790) << "nearly straight";
  EXPECT_LT(chord.norm(), 799) << "an 800 mm blade is slack";
  EXPECT_NEAR(ends[0].linear().col(0).dot(chord.normalized()), 1, 1e-6) << "x points into the blade";
  EXPECT_NEAR(ends[1].linear().col(0).dot(chord.normalized()), -1, 1e-6);
  const Eigen::Isometry3d X_OW =
      (Eigen::Translation3d(cell->workObject.position) * cell->workObject.rotation).inverse();
  for (const auto& end : ends) {
    EXPECT_NEAR((X_OW.linear() * end.linear())(1, 2), 1, 1e-6) << "z points across the block";
    EXPECT_LT((X_OW * end.translation()).y(), -100) << "in front of the block";
  }
  EXPECT_GT((X_OW * ends[0].translation()).x(), (X_OW * ends[1].translation()).x()) << "left at +x";
}

TEST(Cell, FaultsNameTheKeyAndTheRemedy) {
  expectFault("", "empty");
  expectFault("[]", "must be a JSON object");
  expectFault("{", "not valid JSON");
  expectFault("{}", "needs the key tasks");
  expectFault(changed("\"home_deg\"", "\"home_dge\""), "home_deg");
  expectFault(changed("\"robot\"", "\"robto\""), "robot");
  expectFault(changed("\"mass\": 3", "\"mass\": 3, \"colour\": 1"), "no key \"colour\"");
  expectFault(changed("{\n", "{\n \"travel_spede\": 5,"), "did you mean \"travel_speed\"");
  expectFault(changed("\"mass\": 3", "\"mass\": 0"), "mass is 0");
  expectFault(changed("\"mass\": 3", "\"mass\": \"3\""), "must be a number");
  expectFault(changed("T_ROB1", "T ROB1"), "identifier");
  expectFault(changed("tBlade", "1st"), "identifier");
  expectFault(changed("[0.5, 0.5, -0.5, 0.5]", "[0.5, 0.5, -0.5, 0.6]"), "norm");
  expectFault(changed("[0.5, 0.5, -0.5, 0.5]", "[0, 0, 0, 0]"), "norm");
  expectFault(changed("[0.5, 0.5, -0.5, 0.5]", "[1, 0, 0]"), "four numbers");
  expectFault(changed("[0, -20, 30, 0, 90, 180]", "[0, -20, 30, 0, 90]"), "joint angles in degrees");
  expectFault(changed("[0, -20, 30, 0, 90, 180]", "[0, -20, 30, 0, 90, 1e9]"), "home_deg");
  expectFault(changed("[1000, 0, 500]", "[1000, 0, 1e7]"), "position[2]");
  expectFault(changed("{\n", "{\n \"version\": 2,"), "version");
  expectFault(changed("{\n", "{\n \"heat\": {\"dwell\": 3},"), "signal");
  expectFault(changed("{\n", "{\n \"approach\": -1,"), "approach is -1");
}

TEST(Cell, TwoTasksOfOneNameAreRefused) {
  std::string text = kOneTask;
  const std::size_t open = text.find('['), close = text.find("}],\n");
  const std::string task = text.substr(open + 1, close - open);
  std::string second = task;
  second.replace(second.find("T_ROB1"), 6, "t_rob1");
  text.insert(close + 1, "," + second);
  expectFault(text, "names must differ");
}

TEST(Cell, AnUnknownWordNamesTheNearestCell) {
  const auto names = cellNames();
  ASSERT_TRUE(names) << names.error().message;
  EXPECT_NE(std::find(names->begin(), names->end(), "irb1600-pair"), names->end());
  const auto typo = loadCell("irb1600-piar");
  ASSERT_FALSE(typo);
  EXPECT_NE(typo.error().message.find("did you mean \"irb1600-pair\""), std::string::npos)
      << typo.error().message;
  const auto unknown = loadCell("x");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("irb1600-pair"), std::string::npos) << unknown.error().message;
  const auto missing = loadCell("/nowhere/cell.json");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::cannotRead);
}

TEST(Cell, EveryCellOfTheResourcesCanBeRead) {
  const auto names = cellNames();
  ASSERT_TRUE(names) << names.error().message;
  for (const std::string& name : *names) {
    const auto cell = loadCell(name);
    EXPECT_TRUE(cell) << (cell ? "" : cell.error().message);
  }
}

}  // namespace
}  // namespace bw
