// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Each rule is broken once in a good program, and must be found at its place.

#include <gtest/gtest.h>

#include <functional>

#include "sample.h"

namespace bw::robotio {
namespace {

using sample::replace;
using sample::replaceAll;

const std::string kLeft = "T_ROB1/BladeLeft.mod", kRight = "T_ROB2/BladeRight.mod";
const std::string kLeftList = "T_ROB1/BladeLeft.pgf";

struct Mutation {
  std::string kind;                     ///< of the finding that must appear
  std::string title;                    ///< for the reader of a failure
  std::function<bool(Program&)> apply;  ///< false if the text to change was not there
  std::string place = {};               ///< if given, the start of the place of a finding of that kind
};

/// The line (from 1) on which `text` first stands.
int lineOf(const std::string& bytes, const std::string& text) {
  const std::size_t at = bytes.find(text);
  return 1 + int(std::count(bytes.begin(), bytes.begin() + std::ptrdiff_t(at), '\n'));
}

/// A mutation that replaces the first `from` in one file.
Mutation change(const std::string& kind, const std::string& path, const std::string& from,
                const std::string& to) {
  return Mutation{kind, path + ": " + from + " -> " + to,
                  [=](Program& p) { return replace(sample::file(p, path), from, to); }};
}

Mutation changeAll(const std::string& kind, const std::string& path, const std::string& from,
                   const std::string& to) {
  return Mutation{kind, path + ": all " + from + " -> " + to, [=](Program& p) {
                    std::string& bytes = sample::file(p, path);
                    const bool there = bytes.find(from) != std::string::npos;
                    replaceAll(bytes, from, to);
                    return there;
                  }};
}

Mutation changeBoth(const std::string& kind, const std::string& from, const std::string& to) {
  return Mutation{kind, "both: " + from + " -> " + to, [=](Program& p) {
                    return replace(sample::file(p, kLeft), from, to) &&
                           replace(sample::file(p, kRight), from, to);
                  }};
}

std::vector<Mutation> mutations() {
  const std::string wide = "[0.50000000,0.50000000,-0.50000000,0.50000000]";
  std::vector<Mutation> all = {
      // 1: names
      changeAll("rapid-rule-1", kLeft, "vCut", "while"),
      changeAll("rapid-rule-1", kLeft, "vCut", "vTravel"),
      changeAll("rapid-rule-1", kLeft, "vCut", "VTRAVEL"),
      changeAll("rapid-rule-1", kLeft, "vCut", "_cut"),
      changeAll("rapid-rule-1", kLeft, "vCut", "v100"),
      changeAll("rapid-rule-1", kLeft, "pRetreat", "pRetreatWithANameOf33CharactersXY"),
      changeAll("rapid-rule-1", kLeft, "pRetreat", "bladeleft"),
      // 2: files
      change("rapid-rule-2", kLeft, "\r\n", "\n"),
      change("rapid-rule-2", kRight, "for irb", "f\xC3\xBCr irb"),
      change("rapid-rule-2", kLeft, "! Bladewright", "!\x01"),
      change("rapid-rule-2", kLeft, "PROC main()", "PROC other()"),
      change("rapid-rule-2", kLeft, "MODULE BladeLeft", "MODULE BladeTop"),
      change("rapid-rule-2", kLeftList, "ISO-8859-1", "UTF-8"),
      change("rapid-rule-2", kLeftList, "BladeLeft.mod", "Other.mod"),
      change("rapid-rule-2", kLeftList, "</Program>", "<Program>"),
      change("rapid-rule-2", kLeftList, "    <Module>BladeLeft.mod</Module>\r\n", ""),
      change("rapid-rule-2", kLeft, "ENDPROC\r\n", "ENDPROC\r\n    CONST speeddata vLate := [1,1,1,1];\r\n"),
      // 4: task list and synchronisation points
      change("rapid-rule-4", kLeft, "[[\"T_ROB1\"],[\"T_ROB2\"]]", "[[\"T_ROB2\"],[\"T_ROB1\"]]"),
      change("rapid-rule-4", kRight, "\"T_ROB2\"", "\"T_ROB3\""),
      change("rapid-rule-4", kRight, "taskList{2} := [[\"T_ROB1\"],[\"T_ROB2\"]]",
             "taskList{1} := [[\"T_ROB2\"]]"),
      changeBoth("rapid-rule-4", "SyncMoveOff syncOff", "SyncMoveOff syncOn"),
      change("rapid-rule-4", kRight, "WaitSyncTask syncHome,taskList;", ""),
      change("rapid-rule-4", kRight, "WaitSyncTask syncHome", "WaitSyncTask syncOff"),
      changeBoth("rapid-rule-4", "    VAR syncident syncOff;",
                 "    VAR syncident syncOff;\r\n    VAR syncident syncSpare;"),
      // 5: the block
      changeBoth("rapid-rule-5", "WaitSyncTask syncReady,taskList;", ""),
      changeBoth("rapid-rule-5", "MoveAbsJ jtHome,vTravel,fine", "MoveAbsJ jtHome,vTravel,z1"),
      changeBoth("rapid-rule-5", "\\ID:=70,vTravel\\T:=0.5000,fine", "\\ID:=70,vTravel\\T:=0.5000,z1"),
      changeBoth("rapid-rule-5", "SyncMoveOff syncOff;", ""),
      changeBoth("rapid-rule-5", "SyncMoveOn syncOn,taskList;", ""),
      change("rapid-rule-5", kLeft, "WaitSyncTask syncReady,taskList;",
             "MoveAbsJ jtHome,vTravel,fine,tBladeLeft\\WObj:=wobj0;\r\n        WaitSyncTask "
             "syncReady,taskList;"),
      // 6: IDs
      change("rapid-rule-6", kRight, "\\ID:=40,vCut\\T:=8.3750,z1", "\\ID:=40,vCut\\T:=8.3750,z5"),
      changeBoth("rapid-rule-6", "\\ID:=40", "\\ID:=30"),
      changeBoth("rapid-rule-6", "\\ID:=40", "\\ID:=25"),
      changeBoth("rapid-rule-6", "\\ID:=40", "\\ID:=40.5"),
      change("rapid-rule-6", kRight, "\\ID:=40", "\\ID:=41"),
      change("rapid-rule-6", kRight, "\\ID:=40", ""),
      change("rapid-rule-6", kRight,
             "        MoveL p0003\\ID:=40,vCut\\T:=8.3750,z1,tBladeRight\\WObj:=wBlock;\r\n", ""),
      change("rapid-rule-6", kRight, "MoveAbsJ jtHome,", "MoveAbsJ jtHome\\ID:=5,"),
      change("rapid-rule-6", kRight, "\\ID:=40,vCut\\T:=8.3750,z1", "\\ID:=40,vCut\\T:=8.3750,fine"),
      // 13: standing still
      changeBoth("rapid-rule-13", "MoveL p0003\\ID:=40", "WaitTime 5;\r\n        MoveL p0003\\ID:=40"),
      // 7: durations
      change("rapid-rule-7", kRight, "\\ID:=40,vCut\\T:=8.3750", "\\ID:=40,vCut\\T:=8.3760"),
      change("rapid-rule-7", kRight, "\\ID:=40,vCut\\T:=8.3750", "\\ID:=40,vCut"),
      changeBoth("rapid-rule-7", "\\ID:=40,vCut\\T:=8.3750", "\\ID:=40,vCut\\T:=0"),
      changeBoth("rapid-rule-7", "\\ID:=40,vCut\\T:=8.3750", "\\ID:=40,vCut\\T:=-1"),
      changeBoth("rapid-rule-7", "\\ID:=30,vCut\\T:=8.3750", "\\ID:=30,vCut"),
      // 8: what is shared
      change("rapid-rule-8", kLeft, "TASK PERS tooldata", "PERS tooldata"),
      change("rapid-rule-8", kLeft, "TASK PERS wobjdata", "PERS wobjdata"),
      change("rapid-rule-8", kLeft, "TASK PERS tooldata", "CONST tooldata"),
      change("rapid-rule-8", kLeft, "PERS tasks", "TASK PERS tasks"),
      change("rapid-rule-8", kLeft, "CONST robtarget p0003", "PERS robtarget p0003"),
      // 9: the first approach
      changeBoth("rapid-rule-9", "        MoveAbsJ jtHome,", "        ! MoveAbsJ jtHome,"),
      change("rapid-rule-9", kLeft, "z1,tBladeLeft\\WObj:=wBlock", "z1,tBladeLeft"),
      // 10: targets
      change("rapid-rule-10", kLeft, "[-0.20862588,", "[-0.20866588,"),
      change("rapid-rule-10", kLeft, "[-0.20862588,0.20862588,0.67562952,0.67562952]",
             "[0.20862588,-0.20862588,-0.67562952,-0.67562952]"),
      change("rapid-rule-10", kLeft, "[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]",
             "[0,0,0,0],[0,9E+09,9E+09,9E+09,9E+09,9E+09]"),
      change("rapid-rule-10", kLeft, "38.8000],[9E+09", "38.8000],[9E+08"),
      change("rapid-rule-10", kLeft, "],[0,0,0,0],[", "],[0,0.5,0,0],["),
      change("rapid-rule-10", kLeft, "[[674.2469", "[[174246.9"),
      change("rapid-rule-10", kLeft, "ConfL \\Off;", ""),
      change("rapid-rule-10", kLeft, "ConfL \\Off;", "ConfL \\On;"),
      // 11: singularities
      change("rapid-rule-11", kLeft, "SingArea \\Off;", "SingArea \\Wrist;"),
      change("rapid-rule-11", kLeft, "SingArea \\Off;", ""),
      // 12: speeds
      change("rapid-rule-12", kLeft, "vCut := [20,", "vCut := [0,"),
      change("rapid-rule-12", kLeft, "vCut := [20,10", "vCut := [20,0"),
      change("rapid-rule-12", kLeft, "vCut := [20,10", "vCut := [10,10"),
      change("rapid-rule-12", kLeft, "vCut := [20,10", "vCut := [20,0.1"),
      change("rapid-rule-12", kLeft, "\\ID:=40,vCut", "\\ID:=40,v20"),
      // 13: zones, short moves, standstill
      changeBoth("rapid-rule-13", "8.3750,z1", "8.3750,z100"),
      changeBoth("rapid-rule-13", "\\ID:=40,vCut\\T:=8.3750,z1", "\\ID:=40,vCut\\T:=8.3750,fine"),
      changeBoth("rapid-rule-13", "\\ID:=40,vCut\\T:=8.3750", "\\ID:=40,vCut\\T:=0.0400"),
      changeBoth("rapid-rule-13", "MoveL p0003", "MoveL p0002"),
      // 14: tools, work objects, heat
      change("rapid-rule-14", kLeft, "[2.5,[", "[0,["),
      change("rapid-rule-14", kLeft, "[2.5,[", "[-1,["),
      change("rapid-rule-14", kLeft, "[TRUE,[[", "[FALSE,[["),
      change("rapid-rule-14", kLeft, wide, "[0.6,0.5,-0.5,0.5]"),
      change("rapid-rule-14", kLeft, "[FALSE,TRUE,", "[TRUE,TRUE,"),
      change("rapid-rule-14", kRight, "[[1650.0000,", "[[1650.1000,"),
      change("rapid-rule-14", kRight, "z1,tBladeRight\\WObj:=wBlock", "z1,tBladeRight\\WObj:=wobj0"),
      change("rapid-rule-14", kRight, "z1,tBladeRight", "z1,tool0"),
      change("rapid-rule-14", kLeft, "        WaitTime 8;\r\n", ""),
      change("rapid-rule-14", kLeft, "WaitTime 8", "WaitTime -8"),
      change("rapid-rule-14", kLeft, "        Reset doBladeHeat;\r\n", ""),
      change("rapid-rule-14", kLeft, "        Set doBladeHeat;\r\n", ""),
      change("rapid-rule-14", kLeft, "        SyncMoveOff syncOff;\r\n        Reset doBladeHeat;\r\n",
             "        Reset doBladeHeat;\r\n        SyncMoveOff syncOff;\r\n"),
      change("rapid-rule-14", kRight, "        SyncMoveOff syncOff;\r\n",
             "        SyncMoveOff syncOff;\r\n        Reset doBladeHeat;\r\n"),
      // names that do not resolve, text outside of the subset
      change("rapid-name", kLeft, "MoveL p0003", "MoveL p9999"),
      change("rapid-name", kLeft, "MoveL p0003", "MoveL jtHome"),
      change("rapid-name", kLeft, "8.3750,z1", "8.3750,z3"),
      change("rapid-name", kLeft, "        ConfL \\Off;\r\n", "        ConfL \\Off;\r\n        missing;\r\n"),
      change("rapid-syntax", kLeft, "MoveL p0003", "MoveC p0003"),
      change("rapid-syntax", kLeft, "ENDMODULE", ""),
  };
  all.push_back({"rapid-rule-2", "the last line without its end", [](Program& p) {
                   std::string& bytes = sample::file(p, kLeft);
                   bytes.resize(bytes.size() - 2);
                   return true;
                 }});
  all.push_back({"rapid-rule-2", "a task without .pgf", [](Program& p) {
                   p.erase(p.begin() + 1);
                   return true;
                 }});
  all.push_back({"rapid-rule-2", "two lists in one folder", [](Program& p) {
                   p.push_back({"T_ROB1/Second.pgf", p[1].bytes});
                   return true;
                 }});
  all.push_back({"rapid-rule-2", "old and new files mixed", [](Program& p) {
                   p[0].path = "T_ROB1/BladeLeft.modx";
                   return replace(p[1].bytes, "BladeLeft.mod", "BladeLeft.modx");
                 }});
  all.push_back({"rapid-rule-1", "a task folder whose name cannot be a task", [](Program& p) {
                   for (ProgramFile& f : p) replace(f.path, "T_ROB1", "task one");
                   return true;
                 }});
  all.push_back({"rapid-rule-4", "a task that is missing", [](Program& p) {
                   p.resize(2);
                   return true;
                 }});
  return all;
}

TEST(RapidRules, AGoodProgramHasNoFindings) {
  const auto program = sample::rapid();
  ASSERT_TRUE(program) << program.error().message;
  for (const sample::Told& issue : sample::check(*program))
    ADD_FAILURE() << issue.kind << " " << issue.place << " " << issue.message;
}

TEST(RapidRules, EachMutationIsFoundAsABreachOfItsRule) {
  const auto good = sample::rapid();
  ASSERT_TRUE(good) << good.error().message;
  for (const Mutation& mutation : mutations()) {
    Program program = *good;
    ASSERT_TRUE(mutation.apply(program)) << mutation.title;
    const std::vector<sample::Told> issues = sample::check(program);
    bool found = false;
    std::string seen;
    for (const sample::Told& issue : issues) {
      found = found || issue.kind == mutation.kind;
      seen += "\n  " + issue.kind + " " + issue.place + " " + issue.message;
      EXPECT_FALSE(issue.place.empty()) << issue.message;
      EXPECT_FALSE(issue.message.empty());
    }
    EXPECT_TRUE(found) << mutation.kind << " " << mutation.title << seen;
  }
}

TEST(RapidRules, ABreachIsReportedAtItsLine) {
  const auto good = sample::rapid();
  ASSERT_TRUE(good);
  const auto expectAt = [&](const std::string& kind, const std::string& path, const std::string& from,
                            const std::string& to) {
    Program program = *good;
    const int line = lineOf(sample::file(program, path), from);
    ASSERT_TRUE(replace(sample::file(program, path), from, to));
    const std::string place = path + ":" + std::to_string(line);
    const std::vector<sample::Told> issues = sample::check(program);
    EXPECT_TRUE(std::any_of(issues.begin(), issues.end(),
                            [&](const sample::Told& i) { return i.kind == kind && i.place == place; }))
        << kind << " at " << place;
  };
  expectAt("rapid-rule-1", kLeft, "CONST speeddata vCut", "CONST speeddata record");
  expectAt("rapid-rule-6", kRight, "\\ID:=40", "\\ID:=41");
  expectAt("rapid-rule-7", kRight, "\\ID:=50,vCut\\T:=8.3750", "\\ID:=50,vCut\\T:=8.5");
  expectAt("rapid-rule-10", kLeft, "[-0.20862588,", "[-0.20866588,");
  expectAt("rapid-rule-11", kLeft, "SingArea \\Off", "SingArea \\Wrist");
  expectAt("rapid-rule-14", kLeft, "[2.5,[", "[0,[");
  expectAt("rapid-syntax", kLeft, "MoveL p0003", "MoveC p0003");
  expectAt("rapid-name", kLeft, "MoveL p0003", "MoveL p9999");
}

TEST(RapidRules, TasksSplitAtDifferentPlacesAreFound) {
  const auto good = sample::rapid(sample::motion(4100, 600), sample::cell());
  ASSERT_TRUE(good) << good.error().message;
  Program program = *good;
  std::string& first = sample::file(program, "T_ROB2/BladeRight_001.mod");
  std::string& second = sample::file(program, "T_ROB2/BladeRight_002.mod");
  const std::size_t at = first.find("        MoveL p2000");
  ASSERT_NE(at, std::string::npos);
  const std::string line = first.substr(at, first.find("\r\n", at) + 2 - at);
  first.erase(at, line.size());
  ASSERT_TRUE(replace(second, "PROC cutPart002()\r\n", "PROC cutPart002()\r\n" + line));
  const std::vector<sample::Told> issues = sample::check(program);
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].kind, "rapid-rule-3");
}

TEST(RapidRules, SlowPlannersAreToldTheRateOfTargets) {
  const auto program = sample::rapid(sample::motion(801, 33.5), sample::cell());
  ASSERT_TRUE(program) << "short moves are a warning, not an error";
  const std::vector<sample::Told> issues = sample::check(*program);
  ASSERT_FALSE(issues.empty());
  for (const sample::Told& issue : issues) {
    EXPECT_EQ(issue.kind, "rapid-rule-13");
    EXPECT_EQ(issue.severity, Severity::warning);
  }
  EXPECT_NE(issues[0].message.find("800 of 803 moves"), std::string::npos) << issues[0].message;
  EXPECT_NE(issues[0].message.find("23.9 targets a second"), std::string::npos) << issues[0].message;
}

TEST(RapidRules, FindingsOfOneKindAreCountedNotPiledUp) {
  const auto good = sample::rapid(sample::motion(1000, 600), sample::cell());
  ASSERT_TRUE(good);
  Program program = *good;
  replaceAll(sample::file(program, kRight), "9E+09]];", "0]];");
  const std::vector<sample::Told> issues = sample::check(program);
  EXPECT_LT(issues.size(), 20u);
  ASSERT_FALSE(issues.empty());
  EXPECT_NE(issues.back().message.find("more findings"), std::string::npos);
}

TEST(RapidRules, NothingToCheckIsAFinding) {
  EXPECT_FALSE(sample::check({}).empty());
  EXPECT_FALSE(sample::check({{"motion.csv", "time_s"}}).empty());
}

TEST(RapidRules, SeveralStripsAreCheckedEachForItself) {
  const auto good = sample::rapid();
  ASSERT_TRUE(good);
  Program program;
  for (const char* strip : {"strip1/", "strip2/"})
    for (const ProgramFile& file : *good) program.push_back({strip + file.path, file.bytes});
  EXPECT_TRUE(sample::check(program).empty());
  ASSERT_TRUE(replace(program[4].bytes, "\\ID:=40", "\\ID:=41"));
  const std::vector<sample::Told> issues = sample::check(program);
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues[0].place.rfind("strip2/", 0), 0u) << issues[0].place;
  const auto plan = readRapid(program);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("one at a time"), std::string::npos);
}

}  // namespace
}  // namespace bw::robotio
