// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <filesystem>

#include "bw/core/files/file_set.h"
#include "bw/robotio/dialects.h"
#include "bw/robotio/text/program_text.h"
#include "sample.h"

namespace bw::robotio {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, empty at the start.
fs::path freshFolder(const std::string& name) {
  const fs::path folder = fs::path(BW_TEST_OUTPUT) / "load_program" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void store(const Program& program, const fs::path& folder) {
  FileSet files;
  for (const ProgramFile& file : program) files.add(file.path, file.bytes);
  ASSERT_TRUE(files.commit(folder));
}

TEST(LoadProgram, AFolderGivesBackWhatWasWritten) {
  const auto program = sample::rapid();
  ASSERT_TRUE(program);
  const fs::path folder = freshFolder("whole");
  store(*program, folder);
  ASSERT_TRUE(writeFile(folder / "report.json", "{}"));
  const auto loaded = loadProgram(folder);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->size(), program->size()) << "other files are left alone";
  for (std::size_t i = 0; i < program->size(); ++i) {
    EXPECT_EQ((*loaded)[i].path, (*program)[i].path);
    EXPECT_EQ((*loaded)[i].bytes, (*program)[i].bytes);
  }
  EXPECT_TRUE(sample::check(*loaded).empty());
}

TEST(LoadProgram, TheFolderOfOneTaskAndASingleModuleKeepTheTasksName) {
  const auto program = sample::rapid();
  ASSERT_TRUE(program);
  const fs::path folder = freshFolder("task");
  store(*program, folder);
  for (const fs::path& path : {folder / "T_ROB1", folder / "T_ROB1/"}) {
    const auto task = loadProgram(path);
    ASSERT_TRUE(task) << task.error().message;
    ASSERT_EQ(task->size(), 2u);
    EXPECT_EQ((*task)[0].path, "T_ROB1/BladeLeft.mod");
  }
  const auto single = loadProgram(folder / "T_ROB2" / "BladeRight.mod");
  ASSERT_TRUE(single) << single.error().message;
  ASSERT_EQ(single->size(), 1u);
  EXPECT_EQ((*single)[0].path, "T_ROB2/BladeRight.mod");
  EXPECT_TRUE(readRapid(*single));
  EXPECT_FALSE(sample::check(*single).empty()) << "half a program is not a clean one";
}

TEST(LoadProgram, AParentOfStripsGivesThemAll) {
  const auto program = sample::rapid();
  ASSERT_TRUE(program);
  const fs::path folder = freshFolder("strips");
  store(*program, folder / "strip_1");
  store(*program, folder / "strip_2");
  const auto loaded = loadProgram(folder);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->size(), 8u);
  EXPECT_EQ((*loaded)[4].path, "strip_2/T_ROB1/BladeLeft.mod");
  EXPECT_TRUE(sample::check(*loaded).empty());
}

TEST(LoadProgram, AMotionFileIsLoadedUnderItsName) {
  const fs::path folder = freshFolder("csv");
  store(*writeCsv(sample::motion()), folder);
  const auto loaded = loadProgram(folder / "motion.csv");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ((*loaded)[0].path, "motion.csv");
  EXPECT_TRUE(readCsv((*loaded)[0].bytes));
}

TEST(LoadProgram, TellsWhyNothingWasRead) {
  const fs::path folder = freshFolder("nothing");
  const auto missing = loadProgram(folder / "none");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::cannotRead);
  EXPECT_NE(missing.error().message.find("no program at"), std::string::npos);
  const auto empty = loadProgram(folder);
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().message.find("no .mod"), std::string::npos);
  const auto device = loadProgram("/dev/null");
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().message.find("neither a file nor a folder"), std::string::npos);
  fs::create_directories(folder / "T_ROB1");
  ASSERT_TRUE(writeFile(folder / "T_ROB1" / "Large.mod", std::string(std::size_t(65) << 20, ' ')));
  const auto large = loadProgram(folder);
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("larger than"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace bw::robotio
