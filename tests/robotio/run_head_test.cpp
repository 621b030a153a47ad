// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Programs of different runs must not pass for one.

#include <gtest/gtest.h>

#include "sample.h"

namespace bw::robotio {
namespace {

using sample::replace;

const std::string kLeftFile = "T_ROB1/BladeLeft.mod", kRightFile = "T_ROB2/BladeRight.mod";

Program programOf(const std::string& run, int instants = 5) {
  ProgramNotes options;
  options.run = run;
  Result<Program> program = sample::rapid(sample::motion(instants), sample::cell(), options);
  return program ? *program : Program{};
}

const std::string kRunA = "00112233445566aa", kRunB = "00112233445566bb";

/// Findings of that kind and severity error whose message holds `text`.
int count(const Program& program, const std::string& kind, const std::string& text = {}) {
  int n = 0;
  for (const sample::Told& issue : sample::check(program))
    n += issue.kind == kind && issue.severity == Severity::error &&
         issue.message.find(text) != std::string::npos;
  return n;
}

}  // namespace

TEST(RunHead, StandsInEveryModule) {
  ProgramNotes options;
  options.run = kRunA;
  const auto program = sample::rapid(sample::motion(4100, 600), sample::cell(), options);
  ASSERT_TRUE(program) << program.error().message;
  int modules = 0;
  for (const ProgramFile& file : *program) {
    if (!file.path.ends_with(".mod")) continue;
    ++modules;
    EXPECT_EQ(runOfModule(file.bytes), kRunA) << file.path;
    const std::string task = file.path.substr(0, file.path.find('/'));
    EXPECT_NE(file.bytes.find("! Run " + kRunA + ", task " + task + ", free blade length 800.0000 mm\r\n"),
              std::string::npos);
  }
  EXPECT_EQ(modules, 8);
}

TEST(RunHead, OneSideOfAnotherRunIsAnError) {
  const Program a = programOf(kRunA);
  Program mixed = programOf(kRunB);
  EXPECT_TRUE(sample::check(mixed).empty());
  sample::file(mixed, kLeftFile) = a[0].bytes;
  EXPECT_EQ(count(mixed, "rapid-run", kRunA), 1);
  EXPECT_EQ(count(mixed, "rapid-run", kRunB), 1);
}

TEST(RunHead, OnePartOfAnotherRunIsAnError) {
  ProgramNotes a, b;
  a.run = kRunA;
  b.run = kRunB;
  const auto first = sample::rapid(sample::motion(4100, 600), sample::cell(), a);
  auto mixed = sample::rapid(sample::motion(4100, 600), sample::cell(), b);
  ASSERT_TRUE(first && mixed);
  Program one = *first;
  sample::file(*mixed, "T_ROB2/BladeRight_002.mod") = sample::file(one, "T_ROB2/BladeRight_002.mod");
  EXPECT_EQ(count(*mixed, "rapid-run"), 1);
}

TEST(RunHead, AModuleOfAVersionThatNamedNoRunIsAnErrorBesideOneThatDoes) {
  Program mixed = programOf(kRunA);
  ASSERT_TRUE(replace(sample::file(mixed, kRightFile),
                      "    ! Run " + kRunA + ", task T_ROB2, free blade length 800.0000 mm\r\n", ""));
  EXPECT_EQ(count(mixed, "rapid-run", "does not name"), 1);
  ASSERT_TRUE(replace(sample::file(mixed, kLeftFile),
                      "    ! Run " + kRunA + ", task T_ROB1, free blade length 800.0000 mm\r\n", ""));
  EXPECT_TRUE(sample::check(mixed).empty()) << "a program of such a version is as good as it was";
}

TEST(RunHead, ADamagedLineIsAnError) {
  for (const char* line :
       {"! Run 0011", "! Run 00112233445566ax", "! Run 00112233445566aa, free blade length x mm",
        "! Run 00112233445566aa, free blade length -1 mm", "! Run 00112233445566aa, free blade length mm",
        "! Run 00112233445566aa; 800 mm", "! Run 00112233445566aa, task , free blade length 800.0000 mm",
        "! Run 00112233445566aa, task T ROB, free blade length 800.0000 mm", "! Run"}) {
    Program program = programOf(kRunA);
    ASSERT_TRUE(replace(sample::file(program, kLeftFile),
                        "! Run " + kRunA + ", task T_ROB1, free blade length 800.0000 mm", line));
    EXPECT_GE(count(program, "rapid-run"), 1) << line;
  }
}

TEST(RunHead, OfSomebodyElseIsAComment) {
  Program program = programOf("");
  for (ProgramFile& file : program) {
    const std::string task = file.path.substr(0, file.path.find('/'));
    sample::replaceAll(file.bytes, "! Run none, task " + task + ", free blade length 800.0000 mm",
                       "! Run only by day");
    sample::replaceAll(file.bytes, "! Bladewright: ", "! Anna: ");
  }
  EXPECT_TRUE(sample::check(program).empty());
  EXPECT_EQ(runOfModule("MODULE A\r\n"), "");
  EXPECT_EQ(runOfModule(""), "");
}

TEST(RunHead, TheProgramsOfTheTwoRobotsExchangedAreAnError) {
  const Program program = programOf(kRunA);
  Program swapped = program;
  for (ProgramFile& file : swapped)
    file.path = (file.path.starts_with("T_ROB1/") ? "T_ROB2" : "T_ROB1") + file.path.substr(6);
  EXPECT_EQ(count(swapped, "rapid-rule-18", "written for the task T_ROB1"), 1);
  EXPECT_EQ(count(swapped, "rapid-rule-18", "written for the task T_ROB2"), 1);
  // RAPID's names do not distinguish case.
  Program lower = program;
  for (ProgramFile& file : lower)
    file.path.replace(0, 6, file.path.starts_with("T_ROB1") ? "t_rob1" : "t_rob2");
  EXPECT_EQ(count(lower, "rapid-rule-18"), 0);
  // Programs of a version that named no task are as good as they were.
  for (ProgramFile& file : swapped) {
    sample::replaceAll(file.bytes, ", task T_ROB1", "");
    sample::replaceAll(file.bytes, ", task T_ROB2", "");
  }
  EXPECT_TRUE(sample::check(swapped).empty());
}

TEST(RunHead, BladesOfDifferentLengthsAreAnError) {
  Program program = programOf(kRunA);
  ASSERT_TRUE(replace(sample::file(program, kRightFile), "length 800.0000 mm", "length 810.0000 mm"));
  EXPECT_EQ(count(program, "rapid-rule-16", "810"), 1);
}

}  // namespace bw::robotio
