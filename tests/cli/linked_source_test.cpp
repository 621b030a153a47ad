// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design that links a CAD file tells when that is another than it was.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "process.h"

namespace bw::test {

TEST(LinkedSource, ThatChangedSinceTheSaveIsToldByEveryVerb) {
  const Folder folder;
  const std::string step = folder / "saddle.step", design = folder / "saddle.bladewright";
  ASSERT_EQ(blade({"example", "saddle", "--out", step}).status, 0);
  const auto save = [&](const std::string& fingerprint) {
    std::ofstream(design)
        << R"({"bladewright_design": 1, "name": "saddle", "source": {"path": "saddle.step", )"
        << R"("fingerprint": ")" << fingerprint << R"("}, "job": {"stations": 8}})";
  };
  save("9-995dc9bbdf1939fa");
  const std::string said = "saddle.step has changed since the design was saved (9 bytes then, ";
  const auto told = [&](const Finished& run) { return run.err.find(said) != std::string::npos; };
  const Finished run = blade({"design", design, "--out", folder / "out"});
  EXPECT_TRUE(told(run)) << run.err;
  const Finished picture = blade({"render", design, "--out", folder / "picture.png", "--size", "320x200"});
  EXPECT_TRUE(told(picture)) << picture.err;
  const Finished programs = blade({"export", design, "--out", folder / "programs", "--format", "csv"});
  EXPECT_TRUE(told(programs)) << programs.err;
  // The results hold what they were made from: nothing to tell any more.
  EXPECT_FALSE(told(blade({"render", folder / "out", "--out", folder / "again.png", "--size", "320x200"})));
}

}  // namespace bw::test
