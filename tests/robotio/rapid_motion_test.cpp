// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rules 16 and 17: no target tears the blade, none leaps.

#include <gtest/gtest.h>

#include "bw/core/text/number_text.h"
#include "sample.h"

namespace bw::robotio {
namespace {

/// A robtarget declaration of a module.
struct Declared {
  std::string name;
  std::size_t at = 0, end = 0;  ///< of the three coordinates in the text
  Eigen::Vector3d position;
};

std::vector<Declared> targetsOf(const std::string& module) {
  std::vector<Declared> targets;
  const std::string word = "CONST robtarget ";
  for (std::size_t at = 0; (at = module.find(word, at)) != std::string::npos;) {
    at += word.size();
    Declared target;
    target.name = module.substr(at, module.find(' ', at) - at);
    target.at = module.find("[[", at) + 2;
    target.end = module.find(']', target.at);
    std::size_t from = target.at;
    for (int i = 0; i < 3; ++i) {
      const std::size_t to = std::min(module.find(',', from), target.end);
      target.position[i] = parseNumber(module.substr(from, to - from)).value_or(NAN);
      from = to + 1;
    }
    targets.push_back(target);
  }
  return targets;
}

Program moved(Program program, const std::string& path, const Declared& target, const Eigen::Vector3d& by) {
  const Eigen::Vector3d p = target.position + by;
  sample::file(program, path)
      .replace(target.at, target.end - target.at,
               fixedText(p.x(), 4) + "," + fixedText(p.y(), 4) + "," + fixedText(p.z(), 4));
  return program;
}

std::vector<sample::Told> errorsOf(const Program& program) {
  std::vector<sample::Told> errors;
  for (const sample::Told& issue : sample::check(program))
    if (issue.severity == Severity::error) errors.push_back(issue);
  return errors;
}

std::string listed(const std::vector<sample::Told>& issues) {
  std::string text;
  for (const sample::Told& issue : issues)
    text += "\n" + issue.kind + " " + issue.place + " " + issue.message;
  return text;
}

constexpr const char* kModules[] = {"T_ROB1/BladeLeft.mod", "T_ROB2/BladeRight.mod"};

}  // namespace

TEST(RapidMotion, OutsideOfTheFoamTheBladeIsCarriedAsItLies) {
  const auto good = sample::rapid();
  ASSERT_TRUE(good) << good.error().message;
  for (const char* path : kModules)
    for (const char* name : {"pApproach", "pRetreat"}) {
      Program copy = *good;
      for (const Declared& target : targetsOf(sample::file(copy, path))) {
        if (target.name != name) continue;
        const std::vector<sample::Told> told = errorsOf(moved(*good, path, target, {0, 0, 3}));
        ASSERT_EQ(told.size(), 1u) << path << name << listed(told);
        EXPECT_EQ(told[0].kind, "rapid-rule-19");
        EXPECT_NE(told[0].message.find(std::string("at \"") + name + "\" the right end is held 3 mm"),
                  std::string::npos)
            << told[0].message;
        EXPECT_TRUE(errorsOf(moved(*good, path, target, {0, 0, 0.05})).empty()) << "as rounding moves it";
      }
    }
}

TEST(RapidMotion, WhatStandsStillStandsTwiceInTheMotion) {
  Program text = *sample::rapid();
  const auto before = readRapid(text);
  ASSERT_TRUE(before) << before.error().message;
  for (const char* path : kModules)
    ASSERT_TRUE(
        sample::replace(sample::file(text, path), "MoveL p0004", "WaitTime 5;\r\n        MoveL p0004"));
  const auto waits = readRapid(text);
  ASSERT_TRUE(waits) << waits.error().message;
  EXPECT_NEAR(waits->duration(), before->duration() + 5, 1e-9);
  ASSERT_EQ(waits->instants.size(), before->instants.size() + 1);
  EXPECT_EQ(waits->instants[2].poses[0].position, waits->instants[3].poses[0].position);
  EXPECT_NEAR(waits->instants[3].time - waits->instants[2].time, 5, 1e-9);
  EXPECT_EQ(waits->instants[2].zone, 0) << "it comes to rest there";
  const std::vector<sample::Told> told = errorsOf(text);
  ASSERT_EQ(told.size(), 2u) << listed(told);
  for (const sample::Told& one : told) {
    EXPECT_EQ(one.kind, "rapid-rule-13");
    EXPECT_NE(one.message.find("stand still for 5 s at \"p0003\""), std::string::npos) << one.message;
  }
}

TEST(RapidMotion, EveryTargetMovedByAMetreIsAnErrorThatNamesIt) {
  int tried = 0;
  for (const auto& [instants, seconds] :
       {std::pair{5, 33.5}, {5, 600.0}, {60, 33.5}, {60, 1200.0}, {400, 600.0}}) {
    const auto good = sample::rapid(sample::motion(instants, seconds), sample::cell());
    ASSERT_TRUE(good) << good.error().message;
    ASSERT_TRUE(errorsOf(*good).empty()) << listed(errorsOf(*good));
    for (const char* path : kModules) {
      Program copy = *good;
      const std::vector<Declared> targets = targetsOf(sample::file(copy, path));
      ASSERT_EQ(targets.size(), std::size_t(instants) + 2);
      for (std::size_t i = 0; i < targets.size(); i += std::size_t(std::max(1, instants / 30)))
        for (const Eigen::Vector3d& way :
             {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
          for (const double metre : {1000.0, -1000.0}) {
            ++tried;
            const std::vector<sample::Told> errors = errorsOf(moved(*good, path, targets[i], metre * way));
            const bool named = std::any_of(errors.begin(), errors.end(), [&](const sample::Told& issue) {
              return (issue.kind == "rapid-rule-16" || issue.kind == "rapid-rule-17") &&
                     issue.message.find("\"" + targets[i].name + "\"") != std::string::npos;
            });
            EXPECT_TRUE(named) << path << " " << targets[i].name << " by " << (metre * way).transpose()
                               << " of " << instants << " in " << seconds << " s" << listed(errors);
          }
    }
  }
  EXPECT_GT(tried, 1000);
}

TEST(RapidMotion, GripsFurtherApartThanTheBladeIsLongAreAnError) {
  const auto good = sample::rapid(sample::motion(60), sample::cell());
  ASSERT_TRUE(good);
  Program copy = *good;
  const std::vector<Declared> left = targetsOf(sample::file(copy, kModules[0])),
                              right = targetsOf(sample::file(copy, kModules[1]));
  std::size_t farthest = 0;
  const auto distance = [&](std::size_t i) { return (left[i].position - right[i].position).norm(); };
  for (std::size_t i = 0; i < left.size(); ++i)
    if (distance(i) > distance(farthest)) farthest = i;
  const auto forBladeOf = [&](double length) {
    Program program = *good;
    for (ProgramFile& file : program)
      sample::replaceAll(file.bytes, "length 800.0000 mm", "length " + fixedText(length, 4) + " mm");
    return errorsOf(program);
  };
  EXPECT_TRUE(forBladeOf(distance(farthest) + 0.001).empty());
  const std::vector<sample::Told> errors = forBladeOf(distance(farthest) - 0.5);
  ASSERT_FALSE(errors.empty());
  for (const sample::Told& issue : errors) EXPECT_EQ(issue.kind, "rapid-rule-16");
  EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [&](const sample::Told& issue) {
    return issue.message.find("at \"" + right[farthest].name + "\" the grips are ") == 0 &&
           issue.message.find("0.5 mm more than the blade") != std::string::npos;
  })) << listed(errors);
}

TEST(RapidMotion, AProgramThatTellsNoLengthIsCheckedForLeapsOnly) {
  auto program = sample::rapid(sample::motion(60), sample::cell());
  ASSERT_TRUE(program);
  for (ProgramFile& file : *program) sample::replaceAll(file.bytes, ", free blade length 800.0000 mm", "");
  const Declared target = targetsOf(sample::file(*program, kModules[1]))[30];
  EXPECT_TRUE(errorsOf(moved(*program, kModules[1], target, {-15, 0, 0})).empty());
  const std::vector<sample::Told> errors = errorsOf(moved(*program, kModules[1], target, {-1000, 0, 0}));
  ASSERT_FALSE(errors.empty());
  for (const sample::Told& issue : errors) EXPECT_EQ(issue.kind, "rapid-rule-17");
}

TEST(RapidMotion, ALeapIsSeenAtPredefinedSpeedsToo) {
  auto program = sample::rapid(sample::motion(60), sample::cell());
  ASSERT_TRUE(program);
  for (ProgramFile& file : *program) {
    sample::replaceAll(file.bytes, ", free blade length 800.0000 mm", "");
    sample::replaceAll(file.bytes, ",vCut\\T", ",v20\\T");
    sample::replaceAll(file.bytes, ",vTravel\\T", ",v100\\T");
  }
  const std::size_t before = errorsOf(*program).size();
  const Declared last = targetsOf(sample::file(*program, kModules[1])).back();
  const std::vector<sample::Told> errors = errorsOf(moved(*program, kModules[1], last, {-1000, 0, 0}));
  // It leaps, and the blade is not carried as it lies.
  ASSERT_EQ(errors.size(), before + 2) << listed(errors);
  for (const char* kind : {"rapid-rule-17", "rapid-rule-19"})
    EXPECT_TRUE(std::ranges::any_of(errors,
                                    [&](const sample::Told& one) {
                                      return one.kind == kind &&
                                             one.message.find("\"" + last.name + "\"") != std::string::npos;
                                    }))
        << kind << listed(errors);
}

TEST(RapidMotion, ATargetThatTurnsAgainstTheRatesBesideItLeaps) {
  Motion still = sample::motion(60);  // no tool turns
  for (MotionInstant& instant : still.instants)
    for (std::size_t end = 0; end < instant.poses.size(); ++end)
      instant.poses[end].rotation = still.instants[0].poses[end].rotation;
  for (const Motion& motion : {sample::motion(60), still}) {
    const auto good = sample::rapid(motion, sample::cell());
    ASSERT_TRUE(good);
    Program program = *good;
    std::string& module = sample::file(program, kModules[0]);
    const Declared target = targetsOf(module)[30];
    const std::size_t at = module.find('[', target.end), end = module.find(']', at);
    module.replace(at, end - at, "[0.00000000,0.70710678,0.70710678,0.00000000");
    const std::vector<sample::Told> errors = errorsOf(program);
    ASSERT_FALSE(errors.empty());
    EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [&](const sample::Told& issue) {
      return issue.kind == "rapid-rule-17" &&
             issue.message.find("\"" + target.name + "\" turns by") != std::string::npos;
    })) << listed(errors);
  }
}

TEST(RapidMotion, WithoutTimesALeapIsSeenInThePath) {
  auto program = sample::rapid(sample::motion(60), sample::cell());
  ASSERT_TRUE(program);
  for (ProgramFile& file : *program)
    for (std::size_t at = 0; (at = file.bytes.find("\\T:=", at)) != std::string::npos;)
      file.bytes.erase(at, file.bytes.find(',', at) - at);
  const auto leaps = [&](const Program& p) {
    const std::vector<sample::Told> errors = errorsOf(p);
    return std::count_if(errors.begin(), errors.end(),
                         [](const sample::Told& i) { return i.kind == "rapid-rule-17"; });
  };
  EXPECT_EQ(leaps(*program), 0);
  const Declared target = targetsOf(sample::file(*program, kModules[0]))[30];
  EXPECT_GE(leaps(moved(*program, kModules[0], target, {0, 0, -60})), 1);
}

}  // namespace bw::robotio
