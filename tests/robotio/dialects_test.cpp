// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/robotio/dialects.h"

#include <gtest/gtest.h>

#include "bw/core/design/program_formats.h"
#include "sample.h"

namespace bw::robotio {
namespace {

TEST(Dialects, AreTheFormatsOfAJobInTheirOrder) {
  ASSERT_EQ(dialects().size(), programFormats().size());
  for (std::size_t i = 0; i < dialects().size(); ++i) {
    EXPECT_STREQ(dialects()[i].word, programFormats()[i].word);
    EXPECT_EQ(dialect(programFormats()[i].word), &dialects()[i]);
  }
  EXPECT_EQ(dialect("krl"), nullptr);
  ASSERT_TRUE(dialects().front().check) << "it speaks where a program is of no dialect";
}

TEST(Dialects, ReadBackTheMotionThatTheyWrite) {
  const Motion motion = sample::motion(9);
  for (const Dialect& d : dialects()) {
    const auto program = d.write(motion, sample::cell(), {}, nullptr);
    ASSERT_TRUE(program) << d.word << ": " << program.error().message;
    const auto read = d.read(*program);
    ASSERT_TRUE(read) << d.word << ": " << read.error().message;
    EXPECT_EQ(read->bladeLength, motion.bladeLength) << d.word;
    ASSERT_EQ(read->instants.size(), motion.instants.size()) << d.word;
    for (std::size_t i = 0; i < motion.instants.size(); ++i) {
      EXPECT_NEAR(read->instants[i].time, motion.instants[i].time, 1e-3) << d.word;
      for (std::size_t end = 0; end < 2; ++end)
        EXPECT_LT((read->instants[i].poses[end].position - motion.instants[i].poses[end].position).norm(),
                  2e-4)
            << d.word;
    }
    EXPECT_EQ(read->approach.has_value(), d.word != std::string("csv"));
    if (read->approach) {
      EXPECT_LT((*read->approach - *motion.approach).norm(), 1e-5) << d.word;
    }
    EXPECT_FALSE(d.read({})) << d.word;
  }
}

TEST(Dialects, KnowTheirFilesByNameAndTheirOwnByTheirHeads) {
  for (const Dialect& d : dialects()) {
    const auto program = d.write(sample::motion(), sample::cell(), {}, nullptr);
    ASSERT_TRUE(program);
    EXPECT_EQ(filesOf(d, *program).size(), program->size()) << d.word;
    Program heads;  // of the first folder
    const std::string folder = program->front().path.substr(0, program->front().path.rfind('/') + 1);
    for (const ProgramFile& file : *program) {
      EXPECT_EQ(dialectOfFile("strip-0/" + file.path), &d);
      EXPECT_EQ(!folder.empty(), d.check != nullptr) << "what robots run has a folder a task";
      if (file.path.starts_with(folder))
        heads.push_back({file.path.substr(folder.size()), file.bytes.substr(0, 4096)});
    }
    EXPECT_EQ(d.own(heads).size(), heads.size()) << d.word;
    for (ProgramFile& file : heads) file.bytes = "somebody's own\r\n";
    EXPECT_TRUE(d.own(heads).empty()) << d.word;
  }
  EXPECT_EQ(dialectOfFile("T_ROB1/Left.MODX"), dialect("rapid"));
  for (const char* other : {"report.json", "my-motion.csv", "mod", "stations.csv", ""})
    EXPECT_EQ(dialectOfFile(other), nullptr) << other;
}

TEST(Dialects, CopiesUnderOtherNamesAreNotOurs) {
  Program heads = *sample::rapid();
  heads.resize(2);
  for (ProgramFile& file : heads) file.path = file.path.substr(file.path.find('/') + 1);
  ASSERT_EQ(heads[0].path, "BladeLeft.mod");
  const std::string part = "MODULE BladeLeft_001\r\n    ! Run none\r\n";
  heads.push_back({"BladeLeft_001.mod", part});
  EXPECT_EQ(dialect("rapid")->own(heads).size(), 3u) << "parts are ours by the name of their module";
  heads.push_back({"Copy.mod", heads[0].bytes});
  heads.push_back({"BladeLeft_old.mod", "MODULE BladeLeft_old\r\n"});
  EXPECT_EQ(dialect("rapid")->own(heads).size(), 3u);
}

TEST(Dialects, EachChecksItsFilesAndTheFirstSpeaksWhereThereAreNone) {
  Program program = *sample::rapid();
  EXPECT_TRUE(checkProgram(program).empty());
  program.push_back({"motion.csv", "not a motion"});
  EXPECT_TRUE(checkProgram(program).empty()) << "no robot runs it";
  ASSERT_TRUE(sample::replace(program[0].bytes, "ConfL \\Off;", ""));
  EXPECT_FALSE(checkProgram(program).empty());
  const Findings none = checkProgram({{"motion.csv", "time_s"}});
  ASSERT_EQ(none.size(), 1u);
  EXPECT_NE(std::get<ProgramBreach>(none[0].cause).text.find("no RAPID module"), std::string::npos);
}

}  // namespace
}  // namespace bw::robotio
