// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "sample.h"

namespace bw::robotio {
namespace {

constexpr double kPositionAccuracy = 1e-4;  // mm
constexpr double kRotationAccuracy = 1e-6;  // of each number of a quaternion
constexpr double kDurationAccuracy = 1e-3;  // s

void expectNoFindings(const Program& program) {
  for (const sample::Told& issue : sample::check(program))
    ADD_FAILURE() << issue.kind << " " << issue.place << " " << issue.message;
}

/// The cut of a program is its motion, in poses and times, with `extra` moves (approach, retreat) at either
/// end.
void expectSameMotion(const Program& program, const Motion& motion, std::size_t extra) {
  const auto read = readRapid(program);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(sample::Moves(program).tasks[0].size(), motion.instants.size() + 2 * extra);
  EXPECT_EQ(read->approach.has_value(), extra > 0);
  EXPECT_EQ(read->retreat.has_value(), extra > 0);
  EXPECT_EQ(read->bladeLength, motion.bladeLength);
  ASSERT_EQ(read->instants.size(), motion.instants.size());
  for (std::size_t i = 0; i < motion.instants.size(); ++i) {
    const MotionInstant &a = read->instants[i], &b = motion.instants[i];
    EXPECT_NEAR(a.time, b.time - motion.instants[0].time, kDurationAccuracy)
        << "rounding errors of durations must not add up";
    ASSERT_EQ(a.poses.size(), b.poses.size());
    for (std::size_t end = 0; end < a.poses.size(); ++end) {
      const Pose &p = a.poses[end], &pose = b.poses[end];
      EXPECT_LE((p.position - pose.position).cwiseAbs().maxCoeff(), kPositionAccuracy);
      const Eigen::Quaterniond q =
          p.rotation.dot(pose.rotation) < 0 ? Eigen::Quaterniond(-pose.rotation.coeffs()) : pose.rotation;
      EXPECT_LE((p.rotation.coeffs() - q.coeffs()).cwiseAbs().maxCoeff(), kRotationAccuracy);
    }
  }
}

TEST(RapidWriter, ReadsBackAsTheMotionItWasWrittenFrom) {
  for (const int instants : {2, 5, 61, 400}) {
    const Motion motion = sample::motion(instants, 60);
    const auto program = sample::rapid(motion, sample::cell());
    ASSERT_TRUE(program) << program.error().message;
    expectSameMotion(*program, motion, 1);
    expectNoFindings(*program);
  }
}

TEST(RapidWriter, TellsHowLongTheBladeCutsAndHowLongItRuns) {
  Motion motion = sample::motion(9, 40);
  for (const std::size_t i : {1u, 2u, 7u}) motion.instants[i].station = -1;
  const auto program = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(program) << program.error().message;
  for (const ProgramFile& file : *program) {
    const bool told = file.bytes.find("! 9 targets, 25.0 s of cutting (40.0 s with entry and exit), blade") !=
                      std::string::npos;
    EXPECT_EQ(told, file.path.ends_with(".mod")) << file.path;
  }
}

TEST(RapidWriter, TimesThatAreNotRoundDoNotDriftApart) {
  Motion motion = sample::motion(400, 60);
  for (std::size_t i = 0; i < motion.instants.size(); ++i) motion.instants[i].time = double(i) * 0.123456789;
  const auto program = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(program) << program.error().message;
  expectSameMotion(*program, motion, 1);
}

TEST(RapidWriter, KeepsOneSignOfTheQuaternionsAlongThePath) {
  Motion motion = sample::motion(9);
  for (const std::size_t i : {2, 3, 7}) motion.instants[i].poses[0].rotation.coeffs() *= -1;
  motion.instants[5].poses[1].rotation.coeffs() *= -1;
  const auto program = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(program) << program.error().message;
  expectSameMotion(*program, motion, 1);
  expectNoFindings(*program);
}

TEST(RapidWriter, ApproachesAndRetreatsAlongTheCuttingDirectionWithTheShapeHeld) {
  const Motion motion = sample::motion();
  const Cell cell = sample::cell();
  const auto written = sample::rapid(motion, cell);
  ASSERT_TRUE(written) << written.error().message;
  const sample::Moves moves(*written);
  for (const std::vector<const Step*>& m : moves.tasks) {
    const Step &before = *m[0], &first = *m[1], &last = *m[m.size() - 2], &after = *m.back();
    const Eigen::Vector3d way = cell.approach * Eigen::Vector3d::UnitY();
    EXPECT_NEAR((poseOf(first).position - poseOf(before).position - way).norm(), 0, 2e-4);
    EXPECT_NEAR((poseOf(after).position - poseOf(last).position - way).norm(), 0, 2e-4);
    EXPECT_EQ(poseOf(before).rotation.coeffs(), poseOf(first).rotation.coeffs());
    EXPECT_NEAR(*first.statement->duration, cell.approach / cell.travelSpeed, 1e-4);
    for (const Step* step : {&before, &first, &after}) EXPECT_EQ(step->speed, cell.travelSpeed);
    EXPECT_EQ(before.zone, -1);
    EXPECT_EQ(last.zone, -1) << "the cut ends in a fine point";
    EXPECT_EQ(after.zone, -1);
  }
  Cell noApproach = cell;
  noApproach.approach = 0;
  const auto program = sample::rapid(motion, noApproach);
  ASSERT_TRUE(program) << program.error().message;
  expectSameMotion(*program, motion, 0);
  expectNoFindings(*program);
}

TEST(RapidWriter, ToolAndWorkObjectAreThoseOfTheCell) {
  const Cell cell = sample::cell();
  const auto written = sample::rapid();
  ASSERT_TRUE(written);
  const sample::Moves moves(*written);
  ASSERT_EQ(moves.tasks.size(), 2u);
  for (std::size_t end = 0; end < 2; ++end) {
    EXPECT_EQ(moves.linked[0].tasks[end].name, cell.tasks[end].name);
    const DataDeclaration &tool = *moves.tasks[end][0]->tool, &object = *moves.tasks[end][0]->workObject;
    EXPECT_EQ(tool.name, cell.tasks[end].toolName);
    EXPECT_EQ(tool.numbers[kToolMass], cell.tasks[end].toolMass);
    const Pose pose = poseAt(tool, kToolPosition, kToolRotation);
    EXPECT_LE((pose.position - cell.tasks[end].tool.position).norm(), 1e-4);
    EXPECT_LE((pose.rotation.coeffs() - cell.tasks[end].tool.rotation.coeffs()).norm(), 1e-7);
    EXPECT_EQ(object.name, cell.workObjectName);
    EXPECT_LE((poseAt(object, kObjectPosition, kObjectRotation).position - cell.workObject.position).norm(),
              1e-4);
  }
}

TEST(RapidWriter, LongProgramsAreSplitAtTheSamePlaceInAllTasks) {
  const Motion motion = sample::motion(4100, 600);
  const auto program = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(program) << program.error().message;
  ASSERT_EQ(program->size(), 10u) << "per task: main, three parts, one .pgf";
  EXPECT_EQ((*program)[1].path, "T_ROB1/BladeLeft_001.mod");
  expectSameMotion(*program, motion, 1);
  expectNoFindings(*program);
}

TEST(RapidWriter, RobotWare7GetsModxFiles) {
  const auto program = sample::rapid(sample::motion(), sample::cell(), {}, nullptr, true);
  ASSERT_TRUE(program);
  EXPECT_EQ((*program)[0].path, "T_ROB1/BladeLeft.modx");
  EXPECT_NE((*program)[1].bytes.find("<Module>BladeLeft.modx</Module>"), std::string::npos);
  expectNoFindings(*program);
}

TEST(RapidWriter, AnyProgramNameGivesValidNames) {
  for (const char* name : {"", "while",
                           "Fassade S\xC3\xBC"
                           "d / Nord",
                           "2", "a very long name of a very long wall that never ends", "tBlade", "p000"}) {
    const auto program = sample::rapid(sample::motion(), sample::cell(), ProgramNotes{name});
    ASSERT_TRUE(program) << name << ": " << program.error().message;
    expectNoFindings(*program);
  }
}

TEST(RapidWriter, OneAndThreeTasksAreWrittenToo) {
  for (const std::size_t ends : {std::size_t(1), std::size_t(3)}) {
    Motion motion = sample::motion();
    Cell cell = sample::cell();
    if (ends == 3) {
      CellTask third = cell.tasks[0];
      third.name = "T_ROB3";
      cell.tasks.push_back(third);
      for (MotionInstant& instant : motion.instants) instant.poses.push_back(instant.poses[0]);
    } else {
      cell.tasks.resize(1);
      for (MotionInstant& instant : motion.instants) instant.poses.resize(1);
    }
    const auto program = sample::rapid(motion, cell);
    ASSERT_TRUE(program) << program.error().message;
    expectSameMotion(*program, motion, 1);
    expectNoFindings(*program);
  }
}

TEST(RapidWriter, ZonesShrinkWithTheSegmentsAndStayOutOfFinePoints) {
  Motion motion = sample::motion(5);
  // Both ends creep between the second and the third instant.
  for (std::size_t end = 0; end < 2; ++end)
    motion.instants[2].poses[end].position =
        motion.instants[1].poses[end].position + Eigen::Vector3d(0, 0.7, 0);
  const auto program = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(program) << program.error().message;
  const sample::Moves moves(*program);
  EXPECT_EQ(moves.tasks[0][2]->zone, 0.3);
  EXPECT_EQ(moves.tasks[0][3]->zone, 0.3);
  EXPECT_EQ(moves.tasks[0][4]->zone, 1.0);
  motion.instants[2].poses[1].position = motion.instants[1].poses[1].position + Eigen::Vector3d(0, 0.2, 0);
  const auto tight = sample::rapid(motion, sample::cell());
  ASSERT_TRUE(tight) << tight.error().message;
  const sample::Moves tighter(*tight);
  EXPECT_EQ(tighter.tasks[0][2]->zone, 0.05) << "one ID has one zone in all tasks";
  EXPECT_EQ(tighter.tasks[1][2]->zone, 0.05);
}

TEST(RapidWriter, TellsWhatTheCheckWarnsOf) {
  Findings warnings;
  ASSERT_TRUE(sample::rapid(sample::motion(), sample::cell(), {}, &warnings));
  EXPECT_TRUE(warnings.empty());
  // A thousand times as many targets a second as the sample has.
  Motion hasty = sample::motion();
  for (MotionInstant& instant : hasty.instants) instant.time *= 1e-3;
  warnings.push_back({Severity::warning, ProgramDespiteErrors{1, true}, {}, {}});
  const auto program = sample::rapid(hasty, sample::cell(), {}, &warnings);
  ASSERT_TRUE(program) << program.error().message;
  ASSERT_TRUE(std::holds_alternative<ProgramDespiteErrors>(warnings.front().cause)) << "it stays";
  warnings.erase(warnings.begin());
  ASSERT_FALSE(warnings.empty());
  std::set<std::string> told, found;
  for (const Finding& finding : warnings) {
    const std::string& text = std::get<ProgramBreach>(finding.cause).text;
    EXPECT_TRUE(told.insert(text).second) << "twice: " << text;
  }
  for (const sample::Told& breach : sample::check(*program)) found.insert(breach.message);
  EXPECT_EQ(told, found);
}

TEST(RapidWriter, EndsOnTheOtherRobotsSideAreWarnedOf) {
  const Cell cell = sample::cell();
  const auto sides = [&](const Motion& motion) {
    Findings findings = checkPlacement(motion, cell);
    std::erase_if(findings,
                  [](const Finding& finding) { return !std::holds_alternative<WrongSide>(finding.cause); });
    return findings;
  };
  EXPECT_TRUE(sides(sample::motion()).empty());
  Motion crossed = sample::motion();
  for (MotionInstant& instant : crossed.instants) std::swap(instant.poses[0], instant.poses[1]);
  const Findings findings = sides(crossed);
  ASSERT_EQ(findings.size(), 2u);
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.severity, Severity::warning);
    EXPECT_TRUE(finding.where.point);
    const auto& side = std::get<WrongSide>(finding.cause);
    EXPECT_GT(side.distance, side.otherDistance);
    EXPECT_NE(side.robot, side.other);
  }
  EXPECT_EQ(std::get<WrongSide>(findings[0].cause).end, "left");
  ProgramNotes options;
  options.warnings = {"the left end is far", "so is the right"};
  const auto program = sample::rapid(crossed, cell, options);
  ASSERT_TRUE(program) << program.error().message;
  EXPECT_NE(
      program->front().bytes.find("! WARNING: the left end is far.\r\n    ! WARNING: so is the right.\r\n"),
      std::string::npos);
  EXPECT_EQ(sample::rapid(sample::motion(), cell)->front().bytes.find("WARNING"), std::string::npos);
}

TEST(RapidWriter, SameInputGivesTheSameBytes) {
  const auto a = sample::rapid(sample::motion(50), sample::cell()),
             b = sample::rapid(sample::motion(50), sample::cell());
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->size(), b->size());
  for (std::size_t i = 0; i < a->size(); ++i) EXPECT_EQ((*a)[i].bytes, (*b)[i].bytes);
}

/// Writes and expects an error whose message holds `words`.
void expectRefused(const Motion& motion, const Cell& cell, const std::string& words) {
  const auto program = sample::rapid(motion, cell);
  ASSERT_FALSE(program) << words;
  EXPECT_EQ(program.error().code, ErrorCode::badInput);
  EXPECT_NE(program.error().message.find(words), std::string::npos) << program.error().message;
}

TEST(RapidWriter, RefusesMotionsThatCannotBeRun) {
  const Cell cell = sample::cell();
  const auto broken = [&](auto&& change) {
    Motion motion = sample::motion();
    change(motion);
    return motion;
  };
  expectRefused(Motion{}, cell, "0 instants");
  expectRefused(broken([](Motion& m) { m.instants[2].time = std::numeric_limits<double>::quiet_NaN(); }),
                cell, "instant 2");
  expectRefused(broken([](Motion& m) { m.retreat.reset(); }), cell, "approach, retreat");
  expectRefused(broken([](Motion& m) { m.approach = {0, 1.1, 0}; }), cell, "unit vector");
  expectRefused(broken([](Motion& m) { m.instants[2].time = m.instants[1].time; }), cell, "not after");
  expectRefused(broken([](Motion& m) { m.instants[2].time = m.instants[1].time + 1e-6; }), cell, "0.1 ms");
  expectRefused(broken([](Motion& m) {
                  m.instants[3].poses[1].position.x() = std::numeric_limits<double>::infinity();
                }),
                cell, "instant 3 right");
  expectRefused(broken([](Motion& m) { m.instants[3].poses[0].position.x() = 2e5; }), cell, "wrong unit");
  expectRefused(broken([](Motion& m) { m.instants[1].poses[0].rotation.w() += 0.1; }), cell, "norm");
  expectRefused(broken([](Motion& m) { m.instants[1].poses.pop_back(); }), cell, "1 poses");
  expectRefused(broken([](Motion& m) {
                  for (MotionInstant& i : m.instants) i.poses.pop_back();
                }),
                cell, "1 blade ends");
  expectRefused(broken([](Motion& m) { m.instants[3].poses = m.instants[2].poses; }), cell, "rapid-rule-13");
}

TEST(RapidWriter, RefusesCellsWhoseDataCannotStandInAProgram) {
  const auto broken = [&](auto&& change) {
    Cell cell = sample::cell();
    change(cell);
    return cell;
  };
  expectRefused(sample::motion(), broken([](Cell& c) { c.tasks[0].toolMass = 0; }), "mass");
  expectRefused(sample::motion(), broken([](Cell& c) { c.tasks[0].toolName = "while"; }), "reserved word");
  expectRefused(sample::motion(), broken([](Cell& c) { c.tasks[0].toolName = "p0001"; }), "rapid-rule-1");
  expectRefused(sample::motion(), broken([](Cell& c) { c.workObjectName = "1st"; }), "letter");
  expectRefused(sample::motion(), broken([](Cell& c) { c.heatSignal = "do heat"; }), "heat signal");
  expectRefused(sample::motion(), broken([](Cell& c) { c.tasks[1].home.pop_back(); }), "six axes");
  expectRefused(sample::motion(), broken([](Cell& c) { c.travelSpeed = 0; }), "travel speed");
  expectRefused(sample::motion(), broken([](Cell& c) {
                  c.tasks[1].tool.position.x() = std::numeric_limits<double>::quiet_NaN();
                }),
                "finite");
}

TEST(RapidWriter, MarksEveryModuleOfADesignWithErrors) {
  ProgramNotes options;
  options.errors = {
      "stations 1 to 12 (worst: 1): a grip would be 148 mm inside the block; the blade of 800 mm is too "
      "short for it",
      "the blade turns by 95° − more than it may", std::string(200, 'x')};
  for (const int instants : {5, 4100}) {  // in one module and in several
    const Result<Program> program =
        sample::rapid(sample::motion(instants, 10.0 * instants), sample::cell(), options);
    ASSERT_TRUE(program) << program.error().message;
    for (const ProgramFile& file : *program) {
      if (file.path.ends_with(".pgf")) continue;
      EXPECT_EQ(file.bytes.find("    ! NOT SAFE TO RUN: stations 1 to 12 (worst: 1): a grip"),
                file.bytes.find("\r\n") + 2)
          << file.path;
      EXPECT_NE(file.bytes.find("! NOT SAFE TO RUN: the blade turns by 95 deg - more"), std::string::npos)
          << file.path;
      const std::string mark = file.bytes.substr(0, file.bytes.find("    ! Bladewright"));
      for (std::size_t at = 0, end; (end = mark.find("\r\n", at)) != std::string::npos; at = end + 2)
        EXPECT_LE(end - at, 80u) << mark.substr(at, end - at);
    }
    expectSameMotion(*program, sample::motion(instants, 10.0 * instants), 1);
    // Each error once, whatever the number of modules, and nothing else.
    const std::vector<sample::Told> issues = sample::check(*program);
    ASSERT_EQ(issues.size(), 3u);
    for (const sample::Told& issue : issues) {
      EXPECT_EQ(issue.severity, Severity::error);
      EXPECT_EQ(issue.kind, "rapid-marked");
    }
    EXPECT_NE(issues[0].message.find(options.errors[0]), std::string::npos) << issues[0].message;
    EXPECT_EQ(issues[0].place, "T_ROB1/BladeLeft.mod:2");
  }
}

TEST(RapidWriter, MarksNoMoreErrorsThanAHeadCanHold) {
  ProgramNotes options;
  for (int i = 0; i < 50; ++i) options.errors.push_back("error " + std::to_string(i));
  const Result<Program> program = sample::rapid(sample::motion(), sample::cell(), options);
  ASSERT_TRUE(program) << program.error().message;
  const std::string& bytes = program->front().bytes;
  EXPECT_NE(bytes.find("! NOT SAFE TO RUN: error 19\r\n"), std::string::npos);
  EXPECT_EQ(bytes.find("error 20"), std::string::npos);
  EXPECT_NE(bytes.find("! NOT SAFE TO RUN: 30 more errors"), std::string::npos);
}

}  // namespace
}  // namespace bw::robotio
