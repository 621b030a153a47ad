// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/robotio/text/program_text.h"
#include "sample.h"

namespace bw::robotio {
namespace {

void expectEqual(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.bladeLength, b.bladeLength);
  EXPECT_EQ(a.cuttingSpeed, b.cuttingSpeed);
  EXPECT_EQ(a.block.size, b.block.size);
  EXPECT_EQ(a.block.frame.origin, b.block.frame.origin);
  EXPECT_EQ(a.block.frame.x, b.block.frame.x);
  EXPECT_EQ(a.block.frame.y, b.block.frame.y);
  EXPECT_EQ(a.block.frame.normal, b.block.frame.normal);
  ASSERT_EQ(a.instants.size(), b.instants.size());
  for (std::size_t i = 0; i < a.instants.size(); ++i) {
    EXPECT_EQ(a.instants[i].time, b.instants[i].time);
    EXPECT_EQ(a.instants[i].station, b.instants[i].station);
    ASSERT_EQ(a.instants[i].poses.size(), b.instants[i].poses.size());
    for (std::size_t end = 0; end < a.instants[i].poses.size(); ++end) {
      EXPECT_EQ(a.instants[i].poses[end].position, b.instants[i].poses[end].position);
      EXPECT_EQ(a.instants[i].poses[end].rotation.coeffs(), b.instants[i].poses[end].rotation.coeffs());
    }
  }
}

Motion oddMotion() {
  Motion motion = sample::motion(37, 12.3456789);
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  motion.block.frame.x = turn.col(0);
  motion.block.frame.y = turn.col(1);
  motion.block.frame.normal = turn.col(2);
  motion.block.size = {600.1, 1.0 / 3.0, 2e-7};
  return motion;
}

TEST(MotionCsv, RoundTripsExactly) {
  for (const Motion& motion : {sample::motion(2), oddMotion()}) {
    const auto program = writeCsv(motion);
    ASSERT_TRUE(program) << program.error().message;
    const auto read = readCsv(program->front().bytes);
    ASSERT_TRUE(read) << read.error().message;
    expectEqual(*read, motion);
    EXPECT_EQ(writeCsv(*read)->front().bytes, program->front().bytes);
  }
}

TEST(MotionJson, RoundTripsExactly) {
  for (const Motion& motion : {sample::motion(2), oddMotion()}) {
    const auto program = writeJson(motion, sample::cell());
    ASSERT_TRUE(program) << program.error().message;
    const auto read = readJson(program->front().bytes);
    ASSERT_TRUE(read) << read.error().message;
    expectEqual(*read, motion);
    EXPECT_EQ(read->approach, motion.approach);
    EXPECT_EQ(read->retreat, motion.retreat);
  }
}

TEST(MotionJson, TellsHowFarCornersAreCutWhereThatIsLessThanUsual) {
  Motion motion = sample::motion();
  const std::string usual = writeJson(motion, sample::cell())->front().bytes;
  EXPECT_EQ(usual.find("corner_tolerance"), std::string::npos) << "earlier versions read it";
  EXPECT_EQ(readJson(usual)->cornersWithin, kMostCornerCut);
  motion.cornersWithin = 0.012;
  std::string text = writeJson(motion, sample::cell())->front().bytes;
  EXPECT_EQ(readJson(text)->cornersWithin, 0.012);
  ASSERT_TRUE(sample::replace(text, "\"corner_tolerance\": 0.012", "\"corner_tolerance\": 0"));
  const auto none = readJson(text);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("motion.corner_tolerance must be greater than 0 mm"), std::string::npos)
      << none.error().message;
}

TEST(MotionJson, AnOlderTextIsReadAndLacksTheWaysOnlyWhereAProgramIsMade) {
  Motion motion = sample::motion();
  motion.approach = {0.6, 0, 0.8};
  std::string text = writeJson(motion, sample::cell())->front().bytes;
  ASSERT_TRUE(sample::replace(text, "  \"approach\": [0.6, 0, 0.8],\n  \"retreat\": [0, 1, 0],\n", ""));
  const auto read = readJson(text);
  ASSERT_TRUE(read) << read.error().message;
  expectEqual(*read, motion);
  EXPECT_FALSE(read->approach);
  EXPECT_FALSE(read->retreat);
  EXPECT_EQ(writeJson(*read, sample::cell())->front().bytes, text) << "what is not known is not made up";
  const auto plan = planProgram(*read, sample::cell());
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("approach, retreat"), std::string::npos) << plan.error().message;
  Cell at = sample::cell();
  at.approach = 0;
  EXPECT_TRUE(planProgram(*read, at)) << "nothing is travelled outside of the motion";
}

TEST(MotionText, OfADesignWithErrorsIsMarked) {
  const Motion motion = sample::motion(5);
  ProgramNotes notes;
  for (int i = 1; i <= 7; ++i)
    notes.errors.push_back("error " + std::to_string(i) + ":\nthe blade \"snaps\" " + std::string(300, 'x'));
  const std::string csv = writeCsv(motion, notes)->front().bytes;
  EXPECT_EQ(csv.substr(0, 34), "# NOT SAFE TO RUN: error 1:\\nthe b");
  EXPECT_NE(csv.find("\n# NOT SAFE TO RUN: 2 more errors\ntime_s,station,"), std::string::npos);
  EXPECT_LT(csv.find("time_s"), 2000u) << "near enough to the beginning to be known by it";
  const Result<Motion> read = readCsv(csv);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(writeCsv(*read)->front().bytes, writeCsv(motion)->front().bytes);
  EXPECT_FALSE(readCsv("# NOT SAFE TO RUN: all of it"));
  EXPECT_FALSE(readCsv("#\n#"));
  const std::string json = writeJson(motion, sample::cell(), notes)->front().bytes;
  EXPECT_EQ(nlohmann::json::parse(json)["not_safe_to_run"].size(), 7u);
  EXPECT_EQ(nlohmann::json::parse(json)["not_safe_to_run"][0], notes.errors[0]);
  ASSERT_TRUE(readJson(json)) << readJson(json).error().message;
  EXPECT_EQ(writeJson(motion, sample::cell())->front().bytes.find("not_safe_to_run"), std::string::npos);
}

TEST(MotionCsv, HeaderNamesColumnsWithUnits) {
  const std::string text = writeCsv(sample::motion())->front().bytes;
  EXPECT_EQ(
      text.rfind("time_s,station,left_x_mm,left_y_mm,left_z_mm,left_qw,left_qx,left_qy,left_qz,right_x_mm,",
                 0),
      0u);
}

TEST(MotionCsv, ReadsWindowsLineEndsAndSpaces) {
  std::string text = writeCsv(sample::motion())->front().bytes;
  sample::replaceAll(text, "\n", "\r\n");
  sample::replaceAll(text, ",", ", ");
  const auto read = readCsv(text + "\r\n\r\n");
  ASSERT_TRUE(read) << read.error().message;
  expectEqual(*read, sample::motion());
}

TEST(MotionText, AByteOrderMarkIsNoPartOfIt) {
  const std::string mark = "\xEF\xBB\xBF";
  const auto csv = readCsv(mark + writeCsv(sample::motion())->front().bytes);
  ASSERT_TRUE(csv) << csv.error().message;
  expectEqual(*csv, sample::motion());
  const auto json = readJson(mark + writeJson(sample::motion(), sample::cell())->front().bytes);
  ASSERT_TRUE(json) << json.error().message;
  expectEqual(*json, sample::motion());
  // A controller does not take it, and that alone is told.
  Program program = *sample::rapid();
  sample::file(program, "T_ROB1/BladeLeft.mod").insert(0, mark);
  const std::vector<sample::Told> told = sample::check(program);
  ASSERT_FALSE(told.empty());
  for (const sample::Told& one : told) {
    EXPECT_EQ(one.kind, "rapid-rule-2");
    EXPECT_NE(one.message.find("byte order mark"), std::string::npos) << one.message;
  }
  // Other marks are of other text.
  for (const std::string& other : {std::string("\xFF\xFEt\0i\0", 6), std::string("\xFE\xFF\0t\0i", 6)}) {
    EXPECT_NE(readCsv(other).error().message.find("UTF-16"), std::string::npos);
    EXPECT_NE(readJson(other).error().message.find("UTF-16"), std::string::npos);
  }
  std::string semicolons = writeCsv(sample::motion())->front().bytes;
  sample::replaceAll(semicolons, ",", ";");
  EXPECT_NE(readCsv(semicolons).error().message.find("semicolons; save it with commas"), std::string::npos);
}

void expectCsvFault(const std::string& text, const std::string& words) {
  const auto read = readCsv(text);
  ASSERT_FALSE(read) << words;
  EXPECT_EQ(read.error().code, ErrorCode::badInput);
  EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().message;
}

TEST(MotionCsv, FaultsNameLineAndColumn) {
  const std::string good = writeCsv(sample::motion())->front().bytes;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_TRUE(sample::replace(text, from, to)) << from;
    return text;
  };
  expectCsvFault("", "empty");
  expectCsvFault("\n\n  \n", "empty");
  expectCsvFault("a,b,c\n", "line 1");
  expectCsvFault(good.substr(0, good.find('\n')), "0 instants");
  expectCsvFault(changed("left_qw", "left_q1"), "\"left_qw\", not \"left_q1\"");
  expectCsvFault(changed("\n8.375,", "\nfast,"), "line 3: \"fast\" in column time_s");
  expectCsvFault(changed("\n8.375,", "\nnan,"), "column time_s");
  expectCsvFault(changed("\n8.375,", "\n-1,"), "instant 1");
  expectCsvFault(changed("\n8.375,0,", "\n8.375,0.5,"), "whole number");
  expectCsvFault(changed("\n8.375,0,", "\n8.375,"), "cells");
  expectCsvFault(changed("\n8.375,0,", "\n8.375,0,,"), "cells");
  expectCsvFault(changed(",800,", ",,"), "blade_length_mm");
  expectCsvFault(good + std::string(1000000, ','), "cells");
}

void expectJsonFault(const std::string& text, const std::string& words) {
  const auto read = readJson(text);
  ASSERT_FALSE(read) << words;
  EXPECT_EQ(read.error().code, ErrorCode::badInput);
  EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().message;
}

TEST(MotionJson, FaultsNameTheKey) {
  const std::string good = writeJson(sample::motion(), sample::cell())->front().bytes;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_TRUE(sample::replace(text, from, to)) << from;
    return text;
  };
  expectJsonFault("", "line 1");
  expectJsonFault("[]", "must be an object");
  expectJsonFault("{\n\"schema\": }", "line 2");
  expectJsonFault("{}", "schema");
  expectJsonFault(changed("bladewright-motion", "other"), "another kind of file");
  expectJsonFault(changed("\"version\": 1", "\"version\": 2"), "reads version 1");
  expectJsonFault(changed("\"blade_length\"", "\"blade_lenght\""), "did you mean \"blade_length\"");
  expectJsonFault(changed("\"time\": 8.375", "\"time\": \"late\""), "motion.instants[1].time");
  expectJsonFault(changed("\"quaternion\": [0.7", "\"quaternion\": [9.7"), "norm");
  expectJsonFault(changed("\"approach\": [0, 1, 0]", "\"approach\": [0, 1]"), "motion.approach");
  expectJsonFault(changed("\"retreat\": [0, 1, 0]", "\"retreat\": [0, 2, 0]"),
                  "retreat is not a unit vector");
  expectJsonFault(changed("\"size\": [600, 670, 200]", "\"size\": [600, 670]"), "motion.block.size");
  expectJsonFault(std::string(200000, '['), "line 1");
}

TEST(MotionText, WritersRefuseMotionsThatAreNotFinite) {
  Motion motion = sample::motion();
  motion.instants[1].poses[0].position.y() = std::nan("");
  EXPECT_FALSE(writeCsv(motion));
  EXPECT_FALSE(writeJson(motion, sample::cell()));
  EXPECT_FALSE(writeCsv(Motion{}));
}

}  // namespace
}  // namespace bw::robotio
