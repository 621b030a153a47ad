// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "process.h"

namespace bw::test {

using nlohmann::json;

namespace {

/// Runs and expects that status, one line of text that holds `text`, and no output folder.
void expectRefusal(const std::vector<std::string>& arguments, int status, const std::string& text,
                   const std::string& input = {}) {
  const Finished run = blade(arguments, input);
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("terminate"), std::string::npos) << run.err;
}

}  // namespace

TEST(BadInput, UsageNamesTheNearestWord) {
  expectRefusal({"rationalise", "x"}, 2, "did you mean \"rationalize\"?");
  expectRefusal({"frobnicate"}, 2, "the verbs are");
  expectRefusal({}, 2, "see blade --help");
  expectRefusal({"fit", "--inn", "x"}, 2, "--inn");
  expectRefusal({"rationalize", "a.step"}, 2, "--out");
  expectRefusal({"elastica", "--threads", "-3"}, 2, "threads");
}

TEST(BadInput, CadFiles) {
  const Folder folder;
  const std::string whole = slurp(example("panel-600x670"));
  ASSERT_FALSE(whole.empty());
  std::string garbage;
  for (int i = 0; i < 5000; ++i) garbage += char((i * 7919) >> 3);
  expectRefusal({"info", folder / "missing.step"}, 4, "missing.step");
  for (const char* suffix : {"step", "iges", "brep"}) {
    const std::string empty = folder.write(std::string("empty.") + suffix, "");
    const std::string noise = folder.write(std::string("noise.") + suffix, garbage);
    expectRefusal({"rationalize", empty, "--out", folder / "out"}, 4, std::string("empty.") + suffix);
    expectRefusal({"rationalize", noise, "--out", folder / "out"}, 4, std::string("noise.") + suffix);
  }
  const std::string cut = folder.write("cut.step", whole.substr(0, whole.size() / 2));
  const Finished truncated = blade({"info", cut});
  EXPECT_TRUE(truncated.status == 4 || truncated.status == 2) << truncated.status << truncated.err;
  expectRefusal({"rationalize", folder / "", "--out", folder / "out"}, 4, "");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, FileWithoutFacesSaysSo) {
  const std::string file = "/usr/share/opencascade/data/occ/asahi.brep";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "occt-misc is not installed";
  const Folder folder;
  expectRefusal({"rationalize", file, "--out", folder / "out"}, 2, "no faces");
}

TEST(BadInput, JobsAndBlocks) {
  const Folder folder;
  const auto refuse = [&](const std::string& job, int status, const std::string& text) {
    expectRefusal({"rationalize", example("panel-600x670"), "--job", folder.write("job.json", job), "--out",
                   folder / "out"},
                  status, text);
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << job;
  };
  refuse(R"({"sations": 10})", 2, "did you mean \"stations\"?");
  refuse(R"({"blade": {"length": 300}})", 2, "shorter than the section");
  refuse(R"({"face": 7})", 2, "7");
  refuse(R"({"block": {"origin": [9000, 9000, 9000], "size": [100, 100, 100]}})", 2, "block");
  refuse(R"({"cell": "irb1600-pear"})", 2, "did you mean \"irb1600-pair\"?");
  refuse("not json", 2, "JSON");
}

TEST(BadInput, UnwritableFolder) {
  const Folder folder;
  const std::string file = folder.write("file", "in the way");
  const std::string job = folder.write("job.json", R"({"stations": 6, "programs": []})");
  expectRefusal({"rationalize", example("panel-600x670"), "--job", job, "--out", file}, 4, "file");
  expectRefusal({"rationalize", example("panel-600x670"), "--job", job, "--out", "/proc/nowhere/out"}, 4,
                "/proc/nowhere");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"file", "job.json"}));
}

TEST(BadInput, ErrorsAsJson) {
  const Finished run = blade({"info", "/no/such.step", "--json-errors"});
  EXPECT_EQ(run.status, 4);
  const json error = json::parse(run.err);
  EXPECT_EQ(error["error"]["code"], "cannot-read");
  const Finished usage = blade({"--json-errors", "frobnicate"});
  EXPECT_EQ(usage.status, 2);
  EXPECT_TRUE(json::accept(usage.err)) << usage.err;
}

TEST(BadInput, CurvesWithoutLengthOrNumbers) {
  expectRefusal({"fit"}, 2, "JSON", "{");
  expectRefusal({"fit"}, 2, "", R"({"curve": {"type": "points", "points": [[1,1],[1,1]]}})");
  expectRefusal({"fit"}, 2, "", R"({"curve": {"type": "bezier", "poles": [[0,0],[0,0],[0,0],[0,0]]}})");
  expectRefusal({"fit"}, 2, "too large", R"({"curve": {"type": "bezier", "poles": [[0,0],[1e999,0]]}})");
  expectRefusal(
      {"elastica"}, 2, "length",
      R"({"elastica": {"start": [0,0], "start_angle": 0, "start_curvature": 0, "force": [0,0]}, "at": []})");
}

TEST(Interrupt, LeavesNothingBehind) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 4000, "blade": {"length": 6000}})");
  const Finished run =
      blade({"rationalize", example("wavy-wall"), "--job", job, "--out", folder / "out", "--progress"}, {},
            "sections");
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(folder.files(), std::vector<std::string>{"job.json"});
}

}  // namespace bw::test
