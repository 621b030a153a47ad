// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The whole text of a small program, byte for byte. A change to these files changes what robots do: it is
// reviewed as a safety change. Run once with BLADEWRIGHT_UPDATE_GOLDEN=1 to write them anew.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bw/core/files/file_set.h"
#include "sample.h"

namespace bw::robotio {
namespace {

namespace fs = std::filesystem;

void expectGolden(const Program& program, const std::string& name) {
  const fs::path folder = fs::path(BW_TEST_DATA) / "golden" / name;
  const char* update = std::getenv("BLADEWRIGHT_UPDATE_GOLDEN");
  if (update && std::string(update) == "1") {
    FileSet files;
    for (const ProgramFile& file : program) files.add(file.path, file.bytes);
    const Result<void> written = files.commit(folder);
    ASSERT_TRUE(written) << written.error().message;
  }
  for (const ProgramFile& file : program) {
    const Result<std::string> golden = readFile(folder / file.path);
    ASSERT_TRUE(golden) << golden.error().message;
    EXPECT_EQ(*golden, file.bytes) << file.path;
  }
  std::size_t stored = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) stored += entry.is_regular_file();
  EXPECT_EQ(stored, program.size()) << "the folder holds files that are not written any more";
}

// Numbers that every computer rounds alike: no sine or cosine.
Motion simpleMotion() {
  Motion motion;
  motion.block.size = {600, 400, 200};
  motion.bladeLength = 800;
  motion.cuttingSpeed = 20;
  motion.approach = motion.retreat = Eigen::Vector3d::UnitY();
  for (int i = 0; i < 5; ++i) {
    MotionInstant instant;
    instant.time = 5.5 * i;
    instant.station = i == 0 || i == 4 ? -1 : i - 1;
    const double y = -20 + 110.0 * i;
    // Tilts by the angles of the Pythagorean triple 7, 24, 25.
    const double side = i % 2 == 0 ? 0 : 0.28, ahead = i % 2 == 0 ? 1 : 0.96;
    instant.poses.push_back(
        sample::endPose({690 - 0.5 * i, y, 100 + 4.0 * i}, {-ahead, 0, side}, Eigen::Vector3d::UnitY()));
    instant.poses.push_back(
        sample::endPose({-90 + 0.25 * i, y, 100}, {ahead, 0, side}, Eigen::Vector3d::UnitY()));
    motion.instants.push_back(instant);
  }
  return motion;
}

TEST(RapidGolden, ProgramOfFiveTargetsIsUnchanged) {
  ProgramNotes options;
  options.run = "0123456789abcdef";
  const auto program = sample::rapid(simpleMotion(), sample::cell(), options);
  ASSERT_TRUE(program) << program.error().message;
  expectGolden(*program, "five-targets");
}

}  // namespace
}  // namespace bw::robotio
