// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the whole program promises, on every example and on files of other modellers: what a program cuts is
// what was shown, or an error says why not.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
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
      {"graph"},
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
  // What was told of the program before it was written.
  for (const auto& [own, theirs] : {std::pair("program_deviation_max_mm", "deviation_to_target_max_mm"),
                                    {"program_from_shown_max_mm", "deviation_to_design_max_mm"}})
    EXPECT_NEAR(surface[theirs].get<double>(), summary[own].get<double>(), 1e-3) << own;
  EXPECT_NEAR(surface["covered_percent"], 100, 0.1);
  EXPECT_TRUE(told["snaps"].empty());
  EXPECT_EQ(told["entry"], "decided");
}

class DesignsCutWhatIsShown : public testing::TestWithParam<std::string> {};

/// Designs of the gallery: each of their programs is run against its own cut.
TEST_P(DesignsCutWhatIsShown, InEachOfTheirBlocks) {
  const Folder folder;
  const std::string design = folder / GetParam() + ".bladewright", out = folder / "out";
  ASSERT_EQ(blade({"example", GetParam(), "--out", design}).status, 0);
  const Finished made = blade({"design", design, "--out", out});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.err.find("error: "), std::string::npos) << made.err;
  const json report = json::parse(slurp(out + "/report.json"));
  const json& summary = report["summary"];
  EXPECT_LE(summary["deviation_max_mm"], 0.5);
  EXPECT_NEAR(summary["covered_percent"], 100, 0.1);
  for (const json& strip : report["strips"])
    for (const json& station : strip["stations"])
      EXPECT_TRUE(station["certainty"] == "certain" || station["certainty"] == "held");
  std::vector<std::string> programs;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out + "/programs"))
    if (entry.is_directory() && entry.path().filename().string().starts_with("strip-"))
      programs.push_back(entry.path().string());
  ASSERT_EQ(programs.size(), report["strips"].size());
  double fromShown = 0, fromTarget = 0;
  for (const std::string& program : programs) {
    const Finished run = blade({"simulate", program});
    EXPECT_EQ(run.status, 0) << program << run.err;
    const json told = json::parse(run.out);
    EXPECT_TRUE(told["exceeded"].empty() && told["halted"].is_null() && told["snaps"].empty()) << program;
    EXPECT_EQ(told["entry"], "decided") << program;
    const json& surface = told["surface"];
    EXPECT_LE(surface["deviation_to_design_at_targets_max_mm"], 0.05) << program;
    EXPECT_LE(surface["deviation_to_design_max_mm"], 0.1) << program;
    EXPECT_NEAR(surface["covered_percent"], 100, 0.1) << program;
    fromShown = std::max(fromShown, surface["deviation_to_design_max_mm"].get<double>());
    fromTarget = std::max(fromTarget, surface["deviation_to_target_max_mm"].get<double>());
  }
  EXPECT_NEAR(summary["program_from_shown_max_mm"].get<double>(), fromShown, 1e-3);
  EXPECT_NEAR(summary["program_deviation_max_mm"].get<double>(), fromTarget, 1e-3);
}

/// The robots of the usual cell do not reach: the message names the cell whose do.
TEST(Cells, ThatServeAreNamed) {
  const Folder folder;
  const std::string file = example("torus-patch");
  // The blocks around the surface reach below the ends of the blade, which the grips are to clear.
  const std::string usual = folder.write("usual.json", R"({"blade": {"length": 820}})");
  const Finished made = blade({"rationalize", file, "--job", usual, "--out", folder / "out"});
  EXPECT_EQ(made.status, 1);
  EXPECT_NE(made.err.find("take the cell \"irb1600-pair-turned\" ("), std::string::npos) << made.err;
  const std::string job =
      folder.write("job.json", R"({"blade": {"length": 820}, "cell": "irb1600-pair-turned"})");
  const Finished mended = blade({"rationalize", file, "--job", job, "--out", folder / "mended"});
  EXPECT_EQ(mended.status, 0) << mended.err;
}

/// Straight blades at their full length: the least slack lets them sag.
TEST(RuledSurfaces, AreCutByStraightBladesThatStaySo) {
  const Folder folder;
  const std::string file = folder / "ripple.bladewright";
  ASSERT_EQ(blade({"example", "ripple-along", "--out", file}).status, 0);
  json design = json::parse(slurp(file));
  design.erase("variables");
  for (const char* formula : {"250 + 0.1*x + 0.05*y", "250 + 0.35*(x - 300)*sin(2*pi*y/800)",
                              "250 + 0.2*(x - 100)*cos(pi*y/800)", "250 + 40*sin(2*pi*y/800)"}) {
    design["sources"][0]["surface"]["formula"] = formula;
    const Finished made =
        blade({"design", folder.write("ruled.bladewright", design.dump()), "--out", folder / "out"});
    EXPECT_EQ(made.status, 0) << formula << made.err;
    EXPECT_EQ(made.err.find("warning: "), std::string::npos) << formula << made.err;
    const json summary = json::parse(slurp(folder / "out/report.json"))["summary"];
    const Finished run = blade({"simulate", folder / "out"});
    EXPECT_EQ(run.status, 0) << formula << run.err;
    const json told = json::parse(run.out);
    EXPECT_LE(told["surface"]["deviation_to_design_at_targets_max_mm"], 0.05) << formula;
    EXPECT_LE(told["surface"]["deviation_to_design_max_mm"], 0.1) << formula;
    EXPECT_NEAR(told["surface"]["deviation_to_design_max_mm"].get<double>(),
                summary["program_from_shown_max_mm"].get<double>(), 1e-3)
        << formula;
    EXPECT_LE(told["instants"], 250) << formula;
  }
}

/// Flat at one end and arched at the other: an arch that its weight would press flat does not come down to a
/// straight blade.
TEST(FlatSurfaces, ThatRiseToAnArchAreCutByArches) {
  const Folder folder;
  const std::string file = folder / "ripple.bladewright";
  ASSERT_EQ(blade({"example", "ripple-along", "--out", file}).status, 0);
  json design = json::parse(slurp(file));
  design.erase("variables");
  design["sources"][0]["surface"]["formula"] = "250 + 10*sin(pi*x/600)*max(0, y - 400)/400";
  design["blade"] = {{"preset", "steel-tube-3-2.5"}, {"length", 780}};
  const Finished made =
      blade({"design", folder.write("rising.bladewright", design.dump()), "--out", folder / "out"});
  EXPECT_EQ(made.status, 0) << made.err;
  const json summary = json::parse(slurp(folder / "out/report.json"))["summary"];
  EXPECT_LE(summary["deviation_max_mm"], 0.4);
  EXPECT_LE(summary["program_from_shown_max_mm"], 0.1);
  const Finished run = blade({"simulate", folder / "out"});
  EXPECT_EQ(run.status, 0) << run.err;
}

/// Designs of CAD files, with the cells that they ship with: from home to the end.
TEST(ShippedExamples, OfCadFilesRunAsTheyAre) {
  for (const char* name : {"ramp-corner-hollow", "torus-patch", "wavy-wall"}) {
    const Folder folder;
    const std::string design = folder / "design.bladewright", out = folder / "out";
    ASSERT_EQ(blade({"example", name, "--out", design}).status, 0) << name;
    const Finished made = blade({"design", design, "--out", out});
    EXPECT_EQ(made.status, 0) << name << made.err;
    const Finished run = blade({"simulate", out});
    EXPECT_EQ(run.status, 0) << name << run.err;
    EXPECT_TRUE(json::parse(run.out)["warnings"].empty()) << name << run.err;
    const Finished check = blade({"check", out});
    EXPECT_EQ(check.status, 0) << name << check.out;
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, DesignsCutWhatIsShown,
                         testing::Values("single-block", "block-wall", "ripple-along", "ripple-across",
                                         "ruled-between-curves", "twist", "bump", "key-blade-fan",
                                         "turning-blades", "three-block-wall", "two-crossing-cuts"),
                         [](const testing::TestParamInfo<std::string>& one) {
                           std::string name;
                           for (const char c : one.param) name += std::isalnum(c) ? c : '_';
                           return name;
                         });

INSTANTIATE_TEST_SUITE_P(Surfaces, ProgramsCutWhatIsShown, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& one) {
                           std::string name = std::to_string(one.index) + "_";
                           for (const char c : one.param.name) name += std::isalnum(c) ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace bw::test
