// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <random>

#include "sample.h"

namespace bw::robotio {
namespace {

/// A small program as a person might write it: predefined speeds, no durations, keywords in other cases.
const char* const kByHand =
    "MODULE BladeLeft\r\n"
    "    PERS tasks taskList{2} := [[\"T_ROB1\"],[\"T_ROB2\"]];\r\n"
    "    VAR syncident syncAtStart;\r\n"
    "    VAR syncident syncOn;\r\n"
    "    VAR syncident syncOff;\r\n"
    "    TASK PERS tooldata tBlade := [TRUE,[[0,0,120],[1,0,0,0]],[2.5,[0,0,60],[1,0,0,0],0,0,0]];\r\n"
    "    TASK PERS wobjdata wBlock := [FALSE,TRUE,\"\",[[1200,0,600],[1,0,0,0]],[[0,0,10],[1,0,0,0]]];\r\n"
    "    const jointtarget jtStart := [[0,-20,30,0,50,0],[9E+09,9E+09,9E9,9E+09,9E+09,9E+09]];\r\n"
    "    CONST RobTarget p0001 := [[ 0 ,-400, "
    "+0.5],[0.70710678,0,0.70710678,0],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]; ! here\r\n"
    "    CONST robtarget p0002 := "
    "[[0,-360,0.5],[0.70710678,0,0.70710678,0],[0,0,-1,0],[9E+09,9E+09,9E+09,9E+09,"
    "9E+09,9E+09]];\r\n"
    "    PROC main()\r\n"
    "        ConfL \\Off;\r\n"
    "        SingArea \\Off;\r\n"
    "        MoveAbsJ jtStart,v200,fine,tBlade\\WObj:=wobj0;\r\n"
    "        WaitSyncTask syncAtStart,taskList;\r\n"
    "        SyncMoveOn syncOn,taskList;\r\n"
    "        movel P0001\\ID:=10,v20,fine,TBLADE\\WObj:=wBlock;\r\n"
    "        MoveL p0002\\ID:=20,v20,fine,tBlade\\WObj:=wBlock;\r\n"
    "        SyncMoveOff syncOff;\r\n"
    "        MoveAbsJ jtStart,v200,fine,tBlade\\WObj:=wobj0;\r\n"
    "    ENDPROC\r\n"
    "ENDMODULE\r\n";

TEST(RapidReader, ReadsAProgramWrittenByHand) {
  const Program program = {{"T_ROB1/BladeLeft.mod", kByHand}};
  const auto motion = readRapid(program);
  ASSERT_TRUE(motion) << motion.error().message;
  EXPECT_EQ(motion->bladeLength, 0) << "nothing tells it";
  EXPECT_FALSE(motion->approach || motion->retreat);
  EXPECT_EQ(motion->cuttingSpeed, 20);
  ASSERT_EQ(motion->instants.size(), 2u) << "moves outside of the synchronised block are not listed";
  ASSERT_EQ(motion->instants[0].poses.size(), 1u);
  EXPECT_EQ(motion->instants[0].poses[0].position, Eigen::Vector3d(0, -400, 0.5));
  EXPECT_EQ(motion->instants[0].poses[0].rotation.w(), 0.70710678);
  EXPECT_EQ(motion->instants[1].time, 2) << "40 mm at 20 mm/s";
  const sample::Moves moves(program);
  ASSERT_EQ(moves.tasks.size(), 1u);
  EXPECT_EQ(moves.linked[0].tasks[0].name, "T_ROB1");
  EXPECT_EQ(moves.linked[0].tasks[0].modules[0].name, "BladeLeft");
  const Step& move = *moves.tasks[0][0];
  EXPECT_EQ(move.tool->numbers[kToolMass], 2.5);
  EXPECT_EQ(poseAt(*move.tool, kToolPosition, kToolRotation).position, Eigen::Vector3d(0, 0, 120));
  EXPECT_EQ(move.statement->id, 10);
  EXPECT_FALSE(move.statement->duration);
  EXPECT_EQ(move.zone, -1);
  EXPECT_EQ(move.statement->line, 17);
}

TEST(RapidReader, TasksThatDoNotMoveTogetherAreNoProgram) {
  Program program = *sample::rapid();
  std::string& right = sample::file(program, "T_ROB2/BladeRight.mod");
  const std::size_t at = right.find("        MoveL p0002");
  right.erase(at, right.find('\n', at) + 1 - at);
  const auto plan = readRapid(program);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("task T_ROB2 are not 7 linear ones"), std::string::npos)
      << plan.error().message;
}

/// Expects the reader to refuse a text at a line, with words in the message.
void expectFault(const std::string& text, int line, const std::string& words) {
  const auto plan = readRapid({{"T_ROB1/M.mod", text}});
  ASSERT_FALSE(plan) << text;
  EXPECT_EQ(plan.error().code, ErrorCode::badInput);
  EXPECT_EQ(plan.error().where, "T_ROB1/M.mod:" + std::to_string(line)) << plan.error().message;
  EXPECT_NE(plan.error().message.find(words), std::string::npos) << plan.error().message;
}

TEST(RapidReader, TellsFileLineAndTextOfWhatItDoesNotKnow) {
  const std::string head = "MODULE M\n", tail = "\nENDMODULE\n", proc = "MODULE M\nPROC main()\n",
                    end = "\nENDPROC\nENDMODULE\n";
  expectFault("", 1, "file ends");
  expectFault("hello", 1, "\"hello\"");
  expectFault("MODULE", 1, "name of the module");
  expectFault("MODULE M\n\n", 3, "file ends");
  expectFault(head + "ENDMODULE\nmore", 3, "more");
  expectFault(head + "CONST num n := 3;" + tail, 2, "\"num\"");
  expectFault(head + "CONST robtarget p := [[0,0],[1,0,0,0]];" + tail, 2, "\"]\"");
  expectFault(head + "CONST robtarget p := [[0,0,0,0]];" + tail, 2, "\",\"");
  expectFault(head + "CONST robtarget p := 3;" + tail, 2, "\"[\"");
  expectFault(head + "CONST speeddata v := [1e999,1,1,1];" + tail, 2, "1e999");
  expectFault(head + "CONST speeddata v := [1,TRUE,1,1];" + tail, 2, "TRUE");
  expectFault(head + "CONST speeddata v := [1,-,1,1];" + tail, 2, "number");
  expectFault(head + "CONST zonedata z := [0,1,1,1,1,1,1];" + tail, 2, "TRUE or FALSE");
  expectFault(head + "VAR speeddata v := [1,1,1,1];" + tail, 2, "CONST");
  expectFault(head + "CONST syncident s;" + tail, 2, "VAR syncident");
  expectFault(head + "PERS tasks t{0} := [];" + tail, 2, "1 to 64");
  expectFault(head + "PERS tasks t{1e9} := [];" + tail, 2, "1 to 64");
  expectFault(head + "PERS tasks t{1} := [[\"T_ROB1]];" + tail, 2, "T_ROB1");
  expectFault(proc + "IF TRUE THEN" + end, 3, "\"IF\"");
  expectFault(proc + "MoveJ p,v,z,t;" + end, 3, "\"MoveJ\"");
  expectFault(proc + "MoveL p\\Conc,v,z,t;" + end, 3, "\"Conc\"");
  expectFault(proc + "MoveL [[0,0,0]],v,z,t;" + end, 3, "target");
  expectFault(proc + "SingArea \\Sideways;" + end, 3, "Off or Wrist");
  expectFault(proc + "WaitTime soon;" + end, 3, "time");
  expectFault(proc + "x := 3;" + end, 3, "\"x\"");
  expectFault(proc + "\x80\xFF" + end, 3, "?");
  expectFault(proc + "main;" + end, 3, "called twice");
  expectFault(proc + "other;" + end, 3, "not a procedure");
}

TEST(RapidReader, FollowsEachProcedureOnceSoThatRunsCannotExplode) {
  std::string text = "MODULE M\nPROC main()\na;\na;\nENDPROC\nPROC a()\nENDPROC\nENDMODULE\n";
  expectFault(text, 4, "called twice");
  text = "MODULE M\nPROC main()\na;\nENDPROC\nPROC a()\nb;\nENDPROC\nPROC b()\nENDPROC\nENDMODULE\n";
  expectFault(text, 6, "only main may call");
  text = "MODULE M\nPROC main()\nENDPROC\nPROC a()\nENDPROC\nENDMODULE\n";
  expectFault(text, 4, "never called");
}

TEST(RapidReader, SurvivesDeepNestingAndEndlessTokens) {
  EXPECT_FALSE(readRapid({{"T/M.mod", "MODULE M CONST robtarget p := " + std::string(1000000, '[')}}));
  EXPECT_FALSE(readRapid({{"T/M.mod", std::string(1000000, 'M')}}));
  EXPECT_FALSE(readRapid({{"T/M.mod", "MODULE M CONST speeddata v := [" + std::string(1000000, '9')}}));
  EXPECT_FALSE(readRapid({{"T/M.mod", "MODULE M " + std::string(1000000, '"')}}));
  EXPECT_FALSE(readRapid({{"T/M.mod", std::string(1000, '\0')}}));
}

/// Whatever bytes a good program is spoilt with, reader and checker answer.
TEST(RapidReader, SurvivesSpoiltPrograms) {
  const auto good = sample::rapid();
  ASSERT_TRUE(good);
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    Program program = *good;
    std::string& bytes = program[random() % program.size()].bytes;
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = random() % bytes.size(), n = random() % 30;
      switch (random() % 3) {
        case 0:
          bytes.erase(at, n);
          break;
        case 1:
          bytes.insert(at, bytes.substr(random() % bytes.size(), n));
          break;
        default:
          bytes[at] = char(random() % 256);
      }
      if (bytes.empty()) bytes = "x";
    }
    const bool read = readRapid(program).has_value();
    const bool clean = sample::check(program).empty();
    EXPECT_TRUE(read || !clean) << "what cannot be read cannot be clean";
    refused += !clean;
  }
  EXPECT_GT(refused, 1500);
}

}  // namespace
}  // namespace bw::robotio
