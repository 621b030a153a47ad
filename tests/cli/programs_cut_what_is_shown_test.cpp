// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the whole program promises, on every example and on files of other modellers: what a program cuts is
// what was shown, or an error says why not.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

struct Case {
  std::string name;  ///< of an example, or a file of OpenCASCADE's below its data
  std::string job = "{}";
  bool cut = true;                         ///< that it ends without an error
  double atTargets = 0.05, between = 0.1;  ///< mm, of the simulated surface from the one shown
};

/// Errors of a cell say that a robot does not reach, those of others that the blade does not cut the surface.
std::vector<Case> cases() {
  const auto tube = [](const std::string& length) {
    return R"({"blade": {"preset": "steel-tube-3-2.5", "length": )" + length + "}}";
  };
  return {
      {"panel-600x670"},
      {"panel-600x670", tube("800")},
      {"panel-600x670", R"({"clearance": 30, "blade": {"length": 700}})"},
      {"panel-600x670", R"({"stations": 10, "clearance": 30, "blade": {"length": 700}})"},
      {"panel-600x670", R"({"stations": 20, "clearance": 30, "blade": {"length": 700}})"},
      {"panel-600x670", R"({"stations": 500, "clearance": 30, "blade": {"length": 700}})"},
      // Its first and its last blade are held all but taut: a tenth of a micrometre of a target moves them.
      {"graph", "{}", true, 0.07},
      {"saddle"},
      {"sphere-cap"},
      {"torus-patch", "{}", false},
      {"ramp-corner-domed", tube("1570"), false},
      {"ramp-corner-hollow", tube("1675"), false},
      {"wavy-wall", tube("2800"), false, 1e300, 1e300},
      {"occ/face1.brep"},
      {"occ/wing.brep", R"({"stations": 60})"},
      {"occ/bottle.brep", R"({"stations": 60})", false},
      {"step/screw.step"},
      {"occ/Ball.brep", "{}", false, 1e300, 1e300},
      {"occ/shell1.brep", "{}", false},
  };
}

class ProgramsCutWhatIsShown : public testing::TestWithParam<Case> {};

TEST_P(ProgramsCutWhatIsShown, OrAnErrorSaysWhyNot) {
  const Case& one = GetParam();
  const bool foreign = one.name.find('/') != std::string::npos;
  const std::string file = foreign ? "/usr/share/opencascade/data/" + one.name : example(one.name);
  if (foreign && !std::filesystem::exists(file)) GTEST_SKIP() << file << " is not installed";
  const Folder folder;
  const std::string job = folder.write("job.json", one.job);
  const Finished made = blade({"rationalize", file, "--job", job, "--out", folder / "out"});
  ASSERT_EQ(made.status, one.cut ? 0 : 1) << made.err;
  EXPECT_EQ(made.err.find("error: ") == std::string::npos, one.cut) << made.err;
  const json report = json::parse(slurp(folder / "out/report.json"));
  const json& summary = report["summary"];
  bool sure = true;
  for (const json& strip : report["strips"])
    for (const json& station : strip["stations"])
      sure = sure && (station["certainty"] == "certain" || station["certainty"] == "held");
  if (one.cut) {
    EXPECT_TRUE(sure);
    EXPECT_LE(summary["deviation_max_mm"], 2);
    EXPECT_NEAR(summary["covered_percent"], 100, 0.1);
  }
  // Programs are read back from text; where no robot may run one, the motion is.
  const Finished run = blade({"simulate", folder / "out"});
  EXPECT_EQ(run.status, one.cut ? 0 : 1) << run.err;
  const json told = json::parse(run.out);
  EXPECT_EQ(told["exceeded"].empty(), one.cut);
  if (one.cut) {
    EXPECT_TRUE(told["halted"].is_null());
  }
  if (one.between > 1e6) return;
  const json& surface = told["surface"];
  EXPECT_LE(surface["deviation_to_design_at_targets_max_mm"], one.atTargets);
  EXPECT_LE(surface["deviation_to_design_max_mm"], one.between);
  EXPECT_NEAR(surface["deviation_to_target_max_mm"].get<double>(),
              summary["program_deviation_max_mm"].get<double>(), 0.1);
  EXPECT_NEAR(surface["covered_percent"], 100, 0.1);
  EXPECT_TRUE(told["snaps"].empty());
  EXPECT_EQ(told["entry"], "decided");
}

INSTANTIATE_TEST_SUITE_P(Surfaces, ProgramsCutWhatIsShown, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& one) {
                           std::string name = std::to_string(one.index) + "_";
                           for (const char c : one.param.name) name += std::isalnum(c) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace bw::test
