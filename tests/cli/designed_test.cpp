// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// From a surface that is designed to its programs, without a window.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

std::string exampleIn(const Folder& folder, const std::string& name) {
  const std::string file = folder / (name + ".bladewright");
  EXPECT_EQ(blade({"example", name, "--out", file}).status, 0);
  return file;
}

class DesignedExamples : public testing::TestWithParam<std::string> {};

TEST_P(DesignedExamples, BecomeProgramsFromTheirDesignAlone) {
  const Folder folder;
  const std::string design = exampleIn(folder, GetParam()), out = folder / "out";
  const Finished run = blade({"design", design, "--out", out});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = json::parse(slurp(out + "/report.json"));
  EXPECT_FALSE(report["target"]["surface"].is_null());
  for (const json& issue : report["issues"]) EXPECT_NE(issue["severity"], "error") << issue;
  const Finished check = blade({"check", out});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  const Finished picture = blade({"render", out, "--size", "320x200", "--out", folder / "a.png"});
  EXPECT_EQ(picture.status, 0) << picture.err;
  // The results hold the design: the same again.
  ASSERT_EQ(blade({"design", out + "/design.bladewright", "--out", folder / "again"}).status, 0);
  EXPECT_EQ(slurp(folder / "again/sweep.json"), slurp(out + "/sweep.json"));
}

INSTANTIATE_TEST_SUITE_P(, DesignedExamples, testing::Values("single-block", "ripple-along", "twist", "bump"),
                         [](const auto& one) {
                           std::string name = one.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(Designed, WritesTheSameBytesWithAnyNumberOfThreads) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along");
  for (const char* threads : {"1", "2", "5"})
    ASSERT_EQ(blade({"design", design, "--out", folder / threads, "--threads", threads}).status, 0);
  for (const std::string& file : folder.files()) {
    if (file.rfind("1/", 0) != 0 || file == "1/report.json") continue;
    const std::string name = file.substr(2);
    EXPECT_EQ(slurp(folder / ("2/" + name)), slurp(folder / file)) << name;
    EXPECT_EQ(slurp(folder / ("5/" + name)), slurp(folder / file)) << name;
  }
}

TEST(Designed, VariablesAreSetOnTheCommandLine) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along"), out = folder / "out";
  const Finished run =
      blade({"design", design, "--out", out, "--set", "amplitude=1.5 cm", "--set", "waves=1,25"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = json::parse(slurp(out + "/report.json"));
  EXPECT_EQ(report["variables"]["amplitude"], 15.0);
  EXPECT_EQ(report["variables"]["waves"], 1.25);
  const json stored = json::parse(slurp(out + "/design.bladewright"));
  EXPECT_EQ(stored["variables"][0]["value"], 15.0);
  EXPECT_NEAR(report["target"]["bounds_mm"][1][2].get<double>(), 315, 0.1);
}

TEST(Designed, SlipsInWhatIsSetAreNamed) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along");
  const auto said = [&](const std::string& set) {
    const Finished run = blade({"design", design, "--out", folder / "out", "--set", set});
    EXPECT_EQ(run.status, 2) << set;
    return run.err;
  };
  EXPECT_NE(said("amplitud=3").find("did you mean \"amplitude\"?"), std::string::npos);
  EXPECT_NE(said("amplitude=300").find("amplitude is 300 mm but must lie between 0 and 60 mm"),
            std::string::npos);
  EXPECT_NE(said("amplitude").find("NAME=VALUE"), std::string::npos);
  EXPECT_NE(said("amplitude=a lot").find("amplitude"), std::string::npos);
  EXPECT_EQ(blade({"design", design, "--out", folder / "out", "--set", "waves=1", "--set", "waves=2"}).status,
            2);
  EXPECT_TRUE(
      json::parse(blade({"design", design, "--out", folder / "out", "--set", "rise=1", "--json-errors"}).err)
          .contains("error"));
}

TEST(Designed, ExamplesAreListedAndWrittenAsSteps) {
  const Finished list = blade({"example"});
  for (const char* name : {"single-block", "ripple-along", "twist", "bump", "panel-600x670"})
    EXPECT_NE(list.out.find(std::string(name) + "\n"), std::string::npos) << name;
  const Folder folder;
  const std::string step = folder / "twist.step";
  ASSERT_EQ(blade({"example", "twist", "--out", step}).status, 0);
  const Finished info = blade({"info", step});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(json::parse(info.out)["faces"], 1);
  const Finished unknown = blade({"example", "ripple-alonge"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("did you mean \"ripple-along\"?"), std::string::npos);
}

}  // namespace
}  // namespace bw::test
