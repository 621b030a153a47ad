// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>

#include "process.h"

namespace bw::test {

using nlohmann::json;

TEST(Blade, TellsItsVersionAndLibraries) {
  const Finished run = blade({"--version"});
  EXPECT_EQ(run.status, 0);
  for (const char* name : {"blade 0", "Eigen 3", "Ceres", "OpenCASCADE", "VTK"})
    EXPECT_NE(run.out.find(name), std::string::npos) << name;
}

TEST(Blade, HelpOfEveryVerbHasAnExample) {
  const Finished help = blade({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* verb :
       {"elastica", "fit", "piecewise", "biarc", "spline", "discrete", "relax", "length", "bvp", "info",
        "rationalize", "design", "vary", "render", "export", "check", "example"}) {
    EXPECT_NE(help.out.find(verb), std::string::npos) << verb;
    const Finished run = blade({verb, "--help"});
    EXPECT_EQ(run.status, 0) << verb;
    EXPECT_NE(run.out.find("Example:"), std::string::npos) << verb;
  }
  EXPECT_EQ(blade({"help"}).out, help.out);
  EXPECT_EQ(blade({"help", "check"}).out, blade({"check", "--help"}).out);
}

TEST(Blade, EvaluatesAndFitsThroughStandardInput) {
  const Finished elastica =
      blade({"elastica"}, R"({"elastica": {"start": [1, 2], "start_angle": 0.3, "start_curvature": 0.002,
      "force": [1e-5, -2e-5], "length": 700}, "at": [0, 350, 700]})");
  ASSERT_EQ(elastica.status, 0) << elastica.err;
  const json state = json::parse(elastica.out);
  EXPECT_EQ(state["points"][0], json({1, 2}));
  const Finished run = blade(
      {"fit", "--in", "-"}, R"({"curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]}})");
  ASSERT_EQ(run.status, 0) << run.err;
  const json result = json::parse(run.out);
  EXPECT_EQ(result["status"], "converged");
  EXPECT_LT(result["R4"].get<double>(), 2e-3);
}

TEST(Blade, MeasuresAndRelaxesThroughStandardInput) {
  const Finished length = blade({"length"}, R"({"distance": 600, "height": 120, "angle": 0.6})");
  ASSERT_EQ(length.status, 0) << length.err;
  const json measured = json::parse(length.out);
  EXPECT_GT(measured["length"].get<double>(), 600);
  EXPECT_TRUE(measured["sensitivity"]["angle"].is_number());
  EXPECT_EQ(blade({"length"}, R"({"distance": 600, "height": 9000, "angle": 0.6})").status, 3);
  EXPECT_EQ(blade({"length"}, R"({"distance": 600, "height": 120, "angel": 0.6})").status, 2);
  const Finished chain = blade(
      {"discrete"},
      R"({"start": [0, 0], "end": [600, 0], "start_angle": 0.6, "end_angle": -0.4, "length": 700, "segments": 40})");
  ASSERT_EQ(chain.status, 0) << chain.err;
  EXPECT_EQ(json::parse(chain.out)["vertices"].size(), 41u);
  const Finished relaxed =
      blade({"relax"},
            R"({"curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]}, "tolerance": 5})");
  ASSERT_EQ(relaxed.status, 0) << relaxed.err;
  EXPECT_TRUE(json::parse(relaxed.out)["is_elastica"].is_boolean());
}

TEST(Blade, FitsPointsFromCsv) {
  const Folder folder;
  std::ostringstream text;
  text << "x,y\n";
  for (int i = 0; i <= 60; ++i)
    text << 600 * std::sin(0.01 * i) << "," << 600 * (1 - std::cos(0.01 * i)) << "\n";
  const Finished run = blade({"fit", "--in", folder.write("arc.csv", text.str())});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(blade({"fit", "--in", folder.write("ARC.CSV", text.str())}).status, 0);
  EXPECT_LT(json::parse(run.out)["hausdorff"].get<double>(), 0.05);
}

TEST(Blade, TurnsPointsIntoArcsAndDrawsThem) {
  const Folder folder;
  std::ostringstream text;
  text << "# a half circle\n";
  for (int i = 0; i <= 30; ++i) text << 100 * std::cos(i * 0.1) << " " << 100 * std::sin(i * 0.1) << "\n";
  const std::string svg = folder / "arcs.svg";
  const Finished run =
      blade({"biarc", "--in", folder.write("arc.dat", text.str()), "--arcs", "2", "--svg", svg});
  ASSERT_EQ(run.status, 0) << run.err;
  const json result = json::parse(run.out);
  ASSERT_EQ(result["arcs"].size(), 2u);
  EXPECT_NEAR(result["arcs"][1]["radius"].get<double>(), 100, 0.01);
  EXPECT_EQ(slurp(svg).substr(0, 4), "<svg");
  EXPECT_EQ(blade({"biarc", "--in", folder.write("arc.dat", text.str()), "--arcs", "3"}).status, 2);
  EXPECT_EQ(
      blade({"biarc", "--in", folder.write("arc.dat", text.str()), "--arcs", "2", "--tolerance", "1e-9"})
          .status,
      1);
}

namespace {

/// The report without what may differ between two runs.
json comparable(const std::string& folder) {
  json report = json::parse(slurp(folder + "/report.json"));
  report.erase("seconds");
  return report;
}

}  // namespace

TEST(Rationalize, WritesWhatItsReportLists) {
  const Folder folder;
  const std::string job = folder.write("job.json", panelJob(R"("stations": 24, "tolerance": 5)"));
  const std::string out = folder / "out";
  const Finished run = blade({"rationalize", example("panel-600x670"), "--job", job, "--out", out});
  ASSERT_LE(run.status, 1) << run.err;
  const json report = json::parse(slurp(out + "/report.json"));
  for (const auto& file : report["files"])
    EXPECT_FALSE(slurp(out + "/" + file.get<std::string>()).empty()) << file;
  const std::string listed = report["files"].dump();
  for (const char* name : {"report.json", "sweep.json", "surface.step", "mesh.obj", "stations.csv",
                           "deviation.csv", "programs/strip-0/T_ROB1/", "programs/strip-0/T_ROB2/"})
    EXPECT_NE(listed.find(name), std::string::npos) << name;
  ASSERT_EQ(report["strips"].size(), 1u);
  const json& stations = report["strips"][0]["stations"];
  EXPECT_EQ(stations.size(), 24u);
  for (const json& station : stations) {
    // The blade's left end is the elastica at −a, in the station's frame.
    const json& frame = station["frame"];
    const double length = station["elastica"]["length"];
    const json& ends = station["blade"]["parameter"];
    const double a = -ends[0].get<double>();
    EXPECT_NEAR(length * (ends[1].get<double>() + a), 690, 1e-6);
    double dot = 0;
    for (int i = 0; i < 3; ++i)
      dot += frame["normal"][i].get<double>() *
             (station["blade"]["left"]["point"][i].get<double>() - frame["origin"][i].get<double>());
    EXPECT_NEAR(dot, 0, 1e-6);
  }
  EXPECT_LT(report["summary"]["deviation_max_mm"].get<double>(), 5.0);
  const json sweep = json::parse(slurp(out + "/sweep.json"));
  for (const json& station : sweep["strips"][0]["stations"])
    EXPECT_EQ(station["points"].size(), sweep["points_per_station"]);

  const Finished check = blade({"check", out + "/programs/strip-0"});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  const Finished render = blade({"render", out, "--field", "deviation", "--view", "iso", "--size", "640x400",
                                 "--out", folder / "a.png"});
  ASSERT_EQ(render.status, 0) << render.err;
  EXPECT_EQ(slurp(folder / "a.png").substr(1, 3), "PNG");
  const Finished exported =
      blade({"export", out, "--format", "rapid,csv,json", "--out", folder / "programs"});
  ASSERT_EQ(exported.status, 0) << exported.err;
}

TEST(Export, RepeatsTheWarningsOfTheCheck) {
  // Sixty stations in four millimetres, slowly: closer than the smallest zone.
  const Folder folder;
  const std::string job = folder.write(
      "job.json",
      R"({"block": {"origin": [-250, -2, -300], "size": [500, 4, 600]}, "direction": "y", "stations": 60, "lead": 0, "cutting_speed": 0.05})");
  const std::string warning = "zones are larger than half of a segment";
  const Finished run =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  ASSERT_LE(run.status, 1) << run.err;
  EXPECT_NE(run.err.find(warning), std::string::npos) << run.err;
  const Finished exported = blade({"export", folder / "out", "--out", folder / "programs"});
  ASSERT_EQ(exported.status, run.status) << exported.err;
  EXPECT_NE(exported.err.find(warning), std::string::npos) << exported.err;
  EXPECT_NE(blade({"check", folder / "programs/strip-0"}).out.find(warning), std::string::npos);
}

namespace {

/// A block that is wider than the blade of 800 mm is long: the grips would have to enter it.
const std::string kGripsInside = panelJob(
    R"("stations": 12, "tolerance": 10, "direction": "y", "block": {"origin": [-150, 0, -300], "size": [900, 670, 600]})");

/// Names of files in a list that hold `text`.
int countOf(const std::vector<std::string>& names, const std::string& text) {
  return int(std::count_if(names.begin(), names.end(),
                           [&](const std::string& name) { return name.find(text) != std::string::npos; }));
}

}  // namespace

TEST(UnsafeDesign, HasNoRobotProgramWritten) {
  const Folder folder;
  const std::string job = folder.write("job.json", kGripsInside);
  const Finished run =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("inside the block"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("no RAPID program is written, because the design has an error; mend it"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("--despite-errors"), std::string::npos) << run.err;
  EXPECT_EQ(countOf(folder.files(), ".mod"), 0);
  EXPECT_EQ(countOf(folder.files(), "motion."), 2) << "motions stay for inspection";
  const json report = json::parse(slurp(folder / "out/report.json"));
  std::vector<std::string> listed;
  for (const json& file : report["files"]) listed.push_back(file);
  for (std::string& file : listed) file = "out/" + file;
  listed.emplace_back("job.json");
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, folder.files());
  EXPECT_NE(report["issues"].dump().find("no RAPID program is written"), std::string::npos);

  // The saved design tells the same, and so does an export, which is left with nothing to write.
  const std::string design = folder / "out/design.bladewright";
  const Finished again = blade({"design", design, "--out", folder / "again"});
  EXPECT_EQ(again.status, 1) << again.err;
  EXPECT_EQ(countOf(folder.files(), ".mod"), 0);
  for (const std::string& from : {design, folder / "out"}) {
    const Finished refused = blade({"export", from, "--out", folder / "programs"});
    EXPECT_EQ(refused.status, 1) << refused.err;
    std::istringstream lines(run.err);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("error: ", 0) != 0) continue;
      EXPECT_NE(refused.err.find(line), std::string::npos) << refused.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "programs"));
  }
  const Finished motions = blade({"export", design, "--format", "csv,rapid", "--out", folder / "programs"});
  EXPECT_EQ(motions.status, 1) << motions.err;
  EXPECT_EQ(countOf(folder.files(), "programs/strip-0/motion.csv"), 3) << "of all three runs";
  EXPECT_EQ(countOf(folder.files(), ".mod"), 0);
}

TEST(UnsafeDesign, HasMarkedProgramsWrittenOnRequest) {
  const Folder folder;
  const std::string job = folder.write("job.json", kGripsInside);
  const std::string panel = example("panel-600x670");
  const Finished run =
      blade({"rationalize", panel, "--job", job, "--out", folder / "out", "--despite-errors"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("marked as not safe to run"), std::string::npos) << run.err;
  ASSERT_EQ(
      blade({"design", folder / "out/design.bladewright", "--out", folder / "again", "--despite-errors"})
          .status,
      1);
  ASSERT_EQ(blade({"export", folder / "out", "--out", folder / "programs", "--despite-errors"}).status, 1);
  for (const char* strip : {"out/programs/strip-0", "again/programs/strip-0", "programs/strip-0"}) {
    for (const char* module : {"/T_ROB1/BladeLeft.mod", "/T_ROB2/BladeRight.mod"}) {
      const std::string text = slurp(folder / (std::string(strip) + module));
      EXPECT_NE(text.find("! NOT SAFE TO RUN: stations 1 to 12"), std::string::npos) << strip << module;
    }
    const Finished check = blade({"check", folder / strip});
    EXPECT_EQ(check.status, 1);
    EXPECT_NE(check.out.find(" mm [rapid-marked]"), std::string::npos) << check.out;
    EXPECT_EQ(check.out.find("[rapid-rule"), std::string::npos) << check.out;
  }
}

TEST(UnsafeDesign, SwitchChangesNothingOfASafeOne) {
  const Folder folder;
  const std::string job = folder.write("job.json", panelJob(R"("stations": 12, "tolerance": 10)"));
  ASSERT_EQ(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "a"}).status, 0);
  ASSERT_EQ(blade({"export", folder / "a", "--out", folder / "b", "--despite-errors"}).status, 0);
  const std::string text = slurp(folder / "a/programs/strip-0/T_ROB1/BladeLeft.mod");
  EXPECT_EQ(text.find("NOT SAFE"), std::string::npos);
  EXPECT_EQ(text, slurp(folder / "b/strip-0/T_ROB1/BladeLeft.mod"));
  EXPECT_EQ(blade({"check", folder / "b/strip-0"}).status, 0);
}

TEST(Export, TakesAFormatThatIsGivenTwice) {
  const Folder folder;
  ASSERT_EQ(blade({"example", "saddle", "--out", folder / "a.bladewright"}).status, 0);
  const Finished run =
      blade({"export", folder / "a.bladewright", "--format", "csv,csv", "--out", folder / "b"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(countOf(folder.files(), "motion.csv"), 1);
}

namespace {

void expectNoFindings(const std::string& programs) {
  const Finished check = blade({"check", programs});
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  EXPECT_EQ(check.out.find("error"), std::string::npos) << check.out;
}

}  // namespace

TEST(SecondRun, LeavesNoModuleOfTheFirst) {
  const Folder folder;
  const std::string panel = example("panel-600x670");
  const auto run = [&](const std::string& job) {
    const Finished finished =
        blade({"rationalize", panel, "--job", folder.write("job.json", job), "--out", folder / "out"});
    EXPECT_LE(finished.status, 1) << finished.err;
    return finished.err;
  };
  // So slowly that no station follows too soon to be a target.
  const std::string first = run(panelJob(R"("stations": 2100, "tolerance": 10, "cutting_speed": 0.3)"));
  EXPECT_EQ(first.find("removed"), std::string::npos) << first;
  ASSERT_EQ(countOf(folder.files(), "_002.mod"), 2);
  // What others put there stays, whatever its name.
  const std::string own = "MODULE Own\r\nENDMODULE\r\n";
  folder.write("out/programs/notes.txt", "mine");
  folder.write("out/programs/strip-0/T_ROB3/Own.mod", own);
  folder.write("out/mine.mod", slurp(folder / "out/programs/strip-0/T_ROB1/BladeLeft.mod"));
  const std::string second = run(panelJob(R"("stations": 12, "tolerance": 10)"));
  EXPECT_NE(second.find("removed 4 files of an earlier run"), std::string::npos) << second;
  EXPECT_EQ(countOf(folder.files(), "_002.mod"), 0);
  EXPECT_EQ(slurp(folder / "out/programs/strip-0/T_ROB3/Own.mod"), own);
  EXPECT_EQ(countOf(folder.files(), "out/mine.mod"), 1);
  std::filesystem::remove_all(folder / "out/programs/strip-0/T_ROB3");
  expectNoFindings(folder / "out/programs");
  // No programs at all.
  const std::string third = run(panelJob(R"("stations": 12, "tolerance": 10, "programs": [])"));
  EXPECT_NE(third.find("removed 6 files of an earlier run"), std::string::npos) << third;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/programs/strip-0"));
  EXPECT_EQ(slurp(folder / "out/programs/notes.txt"), "mine");
  // A program that is refused leaves no earlier one, which belongs to another surface, beside the new report.
  run(panelJob(R"("stations": 12, "tolerance": 10)"));
  EXPECT_EQ(countOf(folder.files(), "programs/strip-0/T_ROB"), 4);
  run(kGripsInside);
  EXPECT_EQ(countOf(folder.files(), "programs/strip-0/T_ROB"), 0);
}

TEST(SecondRun, OfAnExportLeavesNoModuleOfTheFirst) {
  const Folder folder;
  ASSERT_EQ(blade({"example", "panel-600x670", "--out", folder / "a.bladewright"}).status, 0);
  const auto withStations = [&](int stations) {
    json design = json::parse(slurp(folder / "a.bladewright"));
    design["cuts"][0]["stations"] = stations;
    design["process"]["cutting_speed"] = 0.3;
    return folder.write("a.bladewright", design.dump());
  };
  const auto run = [&](int stations, const char* format) {
    const Finished finished =
        blade({"export", withStations(stations), "--format", format, "--out", folder / "out"});
    EXPECT_LE(finished.status, 1) << finished.err;
    return finished.err;
  };
  run(2100, "rapid,csv,json");
  const std::string left = folder / "out/strip-0/T_ROB1/BladeLeft";
  ASSERT_TRUE(std::filesystem::exists(left + "_001.mod"));
  // A copy under a name of its own is not a module of ours any more, and a list that somebody made is theirs.
  folder.write("out/strip-0/T_ROB1/Kept.mod", slurp(left + ".mod"));
  folder.write("out/strip-0/T_ROB1/Kept.pgf", "<Program></Program>");
  folder.write("out/strip-0/T_ROB1/Other_001.mod", "MODULE Other_001\r\nENDMODULE\r\n");
  const std::string second = run(12, "rapid");
  EXPECT_NE(second.find("removed 6 files of an earlier run"), std::string::npos) << second;
  for (const char* name : {"Kept.mod", "Kept.pgf", "Other_001.mod"}) {
    EXPECT_TRUE(std::filesystem::remove(folder / (std::string("out/strip-0/T_ROB1/") + name))) << name;
  }
  EXPECT_EQ(countOf(folder.files(), "out/"), 4);
  expectNoFindings(folder / "out");
  const std::string third = run(12, "csv");
  EXPECT_NE(third.find("removed 4 files of an earlier run"), std::string::npos) << third;
  EXPECT_EQ(countOf(folder.files(), "out/"), 1);
}

TEST(SecondRun, RemovesOnlyWhatLiesInItsPrograms) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 6, "tolerance": 50, "programs": []})");
  const std::string outside = folder.write("programs/a.mod", "not of that folder");
  json files = {"../programs/a.mod",
                "programs/../../programs/a.mod",
                outside,
                "job.mod",
                "mine/a.mod",
                "",
                "programs/link/a.mod",
                "programs",
                "programs/.",
                7,
                "programs/notes.txt",
                "programs/gone.mod"};
  folder.write("out/report.json", json{{"bladewright_report", 1}, {"files", files}}.dump());
  for (const char* name : {"out/job.mod", "out/mine/a.mod", "out/programs/notes.txt"})
    folder.write(name, "mine");
  std::filesystem::create_directory_symlink(folder / "programs", folder / "out/programs/link");
  const Finished run =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  ASSERT_LE(run.status, 1) << run.err;
  EXPECT_EQ(run.err.find("removed"), std::string::npos) << run.err;
  EXPECT_EQ(slurp(outside), "not of that folder");
  for (const char* name : {"out/job.mod", "out/mine/a.mod", "out/programs/notes.txt"})
    EXPECT_EQ(slurp(folder / name), "mine");
}

TEST(Rationalize, ReportHoldsEveryKeyThatScriptsRelyOn) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 60})");
  const std::string out = folder / "out";
  ASSERT_LE(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", out}).status, 1);
  const json report = json::parse(slurp(out + "/report.json"));
  const auto has = [](const json& object, const std::string& place, const std::string& key) {
    EXPECT_TRUE(object.contains(key)) << place << "." << key;
    return object.contains(key) ? object[key] : json();
  };
  const auto hasNumbers = [&](const json& object, const std::string& place,
                              const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
      EXPECT_TRUE(has(object, place, key).is_number()) << place << "." << key;
  };
  const auto hasVectors = [&](const json& object, const std::string& place, std::size_t size,
                              const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
      const json value = has(object, place, key);
      ASSERT_TRUE(value.is_array() && value.size() == size) << place << "." << key;
      for (const json& x : value) EXPECT_TRUE(x.is_number()) << place << "." << key;
    }
  };
  const json target = has(report, "", "target");
  EXPECT_TRUE(has(target, "target", "file").is_string());
  EXPECT_EQ(has(target, "target", "face"), 0);
  EXPECT_EQ(has(target, "target", "bounds_mm").size(), 2u);
  hasNumbers(target, "target", {"area_mm2"});
  hasNumbers(has(report, "", "blade"), "blade", {"length"});
  EXPECT_TRUE(has(report, "", "method").is_object());
  hasVectors(has(report, "", "block"), "block", 3, {"origin", "size", "x", "y", "z"});
  hasNumbers(has(report, "", "seconds"), "seconds",
             {"read", "sections", "fit", "extend", "check", "write", "total"});
  ASSERT_EQ(has(report, "", "strips").size(), 1u);
  hasNumbers(report["strips"][0], "strip", {"index"});
  const json stations = has(report["strips"][0], "strip", "stations");
  ASSERT_EQ(stations.size(), 60u);
  for (const json& station : stations) {
    hasNumbers(station, "station",
               {"index", "target_length", "R4", "hausdorff_mm", "max_curvature", "min_radius_mm",
                "inflections", "stability_margin", "angle_mean_deg", "angle_max_deg", "speed_ratio"});
    EXPECT_TRUE(has(station, "station", "stable").is_boolean());
    EXPECT_EQ(station["stable"], station["stability_margin"].get<double>() > 0);
    hasVectors(has(station, "station", "frame"), "frame", 3, {"origin", "x", "y", "normal"});
    const json elastica = has(station, "station", "elastica");
    hasNumbers(elastica, "elastica", {"start_angle", "start_curvature", "length"});
    hasVectors(elastica, "elastica", 2, {"start", "force"});
    hasNumbers(has(elastica, "elastica", "control_parameters"), "control_parameters",
               {"k", "s0", "l", "S", "phi", "x", "y"});
    const json held = has(station, "station", "blade");
    for (const char* end : {"left", "right"})
      hasVectors(has(held, "blade", end), end, 3, {"point", "tangent"});
    hasVectors(held, "blade", 2, {"parameter"});
  }
  hasNumbers(has(report, "", "summary"), "summary",
             {"R4_max", "R4_mean", "hausdorff_max_mm", "hausdorff_mean_mm", "deviation_max_mm",
              "deviation_mean_mm", "deviation_rms_mm", "within_tolerance_percent", "angle_max_deg",
              "angle_mean_deg", "angle_station_mean_max_deg", "speed_ratio_min", "min_radius_mm"});
  EXPECT_TRUE(has(report, "", "issues").is_array());
  for (const json& issue : report["issues"])
    for (const char* key : {"severity", "kind", "message", "where"})
      EXPECT_TRUE(has(issue, "issue", key).is_string());
  EXPECT_TRUE(has(report, "", "files").is_array());
  const json robots = has(report, "", "robots");
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots[0]["task"], "T_ROB1");
  EXPECT_EQ(robots[0]["tcp"][0].size(), 3u);
  EXPECT_EQ(robots[1]["tcp"][1].size(), 4u);
}

TEST(Rationalize, EveryEndLiesOnTheSideOfItsRobot) {
  const Folder folder;
  const auto sideIssues = [&](const std::string& job, const std::string& out) {
    const Finished run = blade({"rationalize", example("panel-600x670"), "--job",
                                folder.write("job.json", job), "--out", folder / out, "--despite-errors"});
    EXPECT_LE(run.status, 1) << run.err;
    const std::string left = slurp(folder / (out + "/programs/strip-0/T_ROB1/BladeLeft.mod"));
    EXPECT_FALSE(left.empty());
    int count = 0;
    const json report = json::parse(slurp(folder / (out + "/report.json")));
    for (const json& issue : report["issues"]) count += issue["kind"] == "cell-sides";
    EXPECT_EQ(count > 0, left.find("! WARNING") != std::string::npos) << "program and report say the same";
    EXPECT_EQ(count > 0, run.err.find("from its robot") != std::string::npos) << run.err;
    return count;
  };
  EXPECT_EQ(sideIssues(R"({"stations": 8, "programs": ["rapid"]})", "usual"), 0);
  EXPECT_EQ(sideIssues(R"({"stations": 8, "programs": ["rapid"], "direction": [0, -1, 0]})", "back"), 2);

  // The same from the numbers: the left end in the block frame, moved by the work object, against both bases.
  const json report = json::parse(slurp(folder / "usual/report.json"));
  const json cell = json::parse(slurp(std::string(BW_RESOURCES) + "/cells/irb1600-pair.json"));
  const json& object = cell["work_object"]["pose"];
  ASSERT_EQ(object["quaternion"], json({0, 0, 0, 1})) << "half a turn about z: (x, y) becomes (-x, -y)";
  for (const json& station : report["strips"][0]["stations"])
    for (const char* end : {"left", "right"}) {
      double own = 0, other = 0;
      for (int i = 0; i < 3; ++i) {
        double local = 0;
        const char* axis = i == 0 ? "x" : i == 1 ? "y" : "z";
        for (int k = 0; k < 3; ++k)
          local += report["block"][axis][k].get<double>() * (station["blade"][end]["point"][k].get<double>() -
                                                             report["block"]["origin"][k].get<double>());
        const double world = object["position"][i].get<double>() + (i < 2 ? -local : local);
        const int task = std::string(end) == "left" ? 0 : 1;
        own += std::pow(world - cell["tasks"][task]["base"]["position"][i].get<double>(), 2);
        other += std::pow(world - cell["tasks"][1 - task]["base"]["position"][i].get<double>(), 2);
      }
      EXPECT_LT(std::sqrt(own) + 300, std::sqrt(other)) << end;
    }
}

TEST(Rationalize, ReadsItsOwnSurfaceBack) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 20, "programs": [], "tolerance": 0.05})");
  ASSERT_LE(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "a"}).status, 1);
  // A surface that is swept by elastica already is met again much more closely than the design was.
  const Finished again =
      blade({"rationalize", folder / "a/surface.step", "--job", job, "--out", folder / "b"});
  ASSERT_LE(again.status, 1) << again.err;
  EXPECT_LT(comparable(folder / "b")["summary"]["R4_max"].get<double>(), 1e-4);
}

TEST(Example, EveryDesignCanBeCutAndItsProgramsKeepTheRules) {
  const Folder folder;
  std::istringstream list(blade({"example"}).out);
  int count = 0;
  for (std::string name; std::getline(list, name);) {
    if (name.empty() || name[0] == ' ') continue;
    SCOPED_TRACE(name);
    ++count;
    ASSERT_EQ(blade({"example", name, "--out", folder / (name + ".bladewright")}).status, 0);
    const Finished run = blade({"design", folder / (name + ".bladewright"), "--out", folder / name});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err.find("error: "), std::string::npos) << run.err;
    if (name != "ramp-corner-domed") {  // which no robots of the shipped cells reach
      EXPECT_EQ(blade({"check", folder / (name + "/programs")}).status, 0);
    }
    // A design of one block has its programs in one folder, one of several in one of each.
    std::vector<std::string> strips;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / (name + "/programs")))
      if (entry.is_directory() && entry.path().filename().string().starts_with("strip-"))
        strips.push_back(entry.path().string());
    ASSERT_FALSE(strips.empty());
    if (strips.size() == 1) strips = {folder / name};
    for (const std::string& strip : strips) EXPECT_EQ(blade({"simulate", strip}).status, 0) << strip;
  }
  EXPECT_EQ(count, 19);
}

TEST(Rationalize, IsTheSameForAnyNumberOfThreads) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 16})");
  for (const char* threads : {"1", "2"})
    ASSERT_LE(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / threads,
                     "--threads", threads})
                  .status,
              1);
  EXPECT_EQ(comparable(folder / "1"), comparable(folder / "2"));
  for (const char* file : {"sweep.json", "surface.step", "mesh.obj", "stations.csv", "deviation.csv"})
    EXPECT_EQ(slurp(folder / (std::string("1/") + file)), slurp(folder / (std::string("2/") + file))) << file;
}

TEST(Rationalize, ExceededToleranceIsStatusOne) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 12, "tolerance": 0.001, "programs": []})");
  const Finished run =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("more than the tolerance"), std::string::npos);
}

TEST(Rationalize, TellsWhatTheBladeCutsBetweenFewStations) {
  // The skin through few stations keeps the tolerance, the blade along the chords between them does not. With
  // targets added between, it does what is shown, whatever that is.
  const Folder folder;
  for (const auto& [stations, skin, moved, made] :
       {std::tuple{10, 1.58, 6.23, 2.23}, {20, 1.06, 2.00, 1.05}}) {
    const std::string job = folder.write(
        "job.json",
        "{\"stations\": " + std::to_string(stations) +
            R"(, "blade": "nicr-flat-5x1", "weight": false, "direction": "y", "tolerance": 1.9, "motion_tolerance": 100, "programs": []})");
    const std::string out = folder / std::to_string(stations);
    const Finished run = blade({"rationalize", example("panel-600x670"), "--job", job, "--out", out});
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_NE(run.err.find("as the robots move it"), std::string::npos) << run.err;
    const json summary = json::parse(slurp(out + "/report.json"))["summary"];
    EXPECT_NEAR(summary["deviation_max_mm"].get<double>(), skin, 0.01);
    EXPECT_NEAR(summary["program_deviation_max_mm"].get<double>(), moved, 0.02);
    const std::string closer = slurp(job);
    folder.write("job.json", std::string(closer).replace(closer.find("100"), 3, "0.1"));
    blade({"rationalize", example("panel-600x670"), "--job", job, "--out", out});
    const json shown = json::parse(slurp(out + "/report.json"))["summary"];
    EXPECT_LE(shown["program_from_shown_max_mm"].get<double>(), 0.1);
    EXPECT_NEAR(shown["program_deviation_max_mm"].get<double>(), shown["deviation_max_mm"].get<double>(),
                0.1);
    EXPECT_NEAR(shown["deviation_max_mm"].get<double>(), made, 0.05);
  }
}

TEST(Rationalize, ChoosesTheGripsForTheBladeThatHangs) {
  // Grips that hold the curve of the section lose this flat blade in 44 of 60 stations.
  const Folder folder;
  const auto tried = [&](const std::string& rest) {
    const std::string job =
        folder.write("job.json", "{\"direction\": \"y\", \"stations\": 60, " + rest + "}");
    std::filesystem::remove_all(folder / "out");
    return blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  };
  const auto report = [&] { return nlohmann::json::parse(slurp(folder / "out/report.json")); };
  const auto snapped = [&] {
    int count = 0;
    const nlohmann::json all = report();
    for (const nlohmann::json& station : all["strips"][0]["stations"])
      count += station["snaps_at"].is_number();
    return count;
  };
  // Near both ends of the row its slack is as small as what a grip may be off, and there it is lost.
  const Finished loose = tried(R"("blade": "nicr-flat-5x1")");
  EXPECT_EQ(loose.status, 1) << loose.err;
  EXPECT_NE(loose.err.find("a grip that is off by 0.5 mm and 0.2° makes the blade snap; a blade of "),
            std::string::npos)
      << loose.err;
  EXPECT_NE(loose.err.find("or let the grips be held more exactly"), std::string::npos) << loose.err;
  int lostOnes = 0;
  const json told = report();
  for (const json& station : told["strips"][0]["stations"]) {
    EXPECT_EQ(station["certainty"] == "lost", station["grip_error_mm"].is_null());
    lostOnes += station["certainty"] == "lost";
  }
  EXPECT_GT(lostOnes, 0);
  EXPECT_LT(lostOnes, 12);
  const Finished flat = tried(R"("blade": "nicr-flat-5x1", "grip_error": {"mm": 0.05, "deg": 0.02})");
  EXPECT_EQ(flat.status, 0) << flat.err;
  EXPECT_EQ(snapped(), 0);
  const nlohmann::json held = report();
  EXPECT_LT(held["summary"]["deviation_max_mm"], 1.5);
  EXPECT_LT(held["summary"]["program_deviation_max_mm"], 1.5);
  // It is the higher of two shapes, and no push of less than 1 N mm brings it out of it: without that asked
  // for 0.04 N mm did.
  for (const nlohmann::json& station : held["strips"][0]["stations"]) {
    EXPECT_GT(station["stability_margin"], 0.15);
    EXPECT_TRUE(station["certainty"] == "held" || station["certainty"] == "certain");
    if (station["certainty"] == "certain") continue;
    ASSERT_TRUE(station["barrier_Nmm"].is_number());
    EXPECT_GE(station["barrier_Nmm"], 1);
  }
  // Where the tolerance leaves no room for that, little brings it out.
  const Finished tight = tried(R"("tolerance": 0.3, "blade": "nicr-flat-5x1")");
  EXPECT_EQ(tight.status, 1) << tight.err;
  EXPECT_NE(tight.err.find("which a touch may bring about"), std::string::npos) << tight.err;
  EXPECT_NE(tight.err.find("no RAPID program is written"), std::string::npos) << tight.err;
  const Finished checked = blade({"check", folder / "out"});
  EXPECT_EQ(checked.status, 1);
  EXPECT_NE(checked.out.find("report.json: the design has an error: "), std::string::npos) << checked.out;
  const nlohmann::json lost = report();
  EXPECT_EQ(lost["strips"][0]["stations"][14]["certainty"], "lost");
  EXPECT_LT(lost["strips"][0]["stations"][0]["barrier_Nmm"], 1);
  // The grips keep a tube of that length in its plane, and in the only shape that it has there.
  const Finished tubeAsLong = tried(R"("blade": "steel-tube-3-2.5")");
  EXPECT_EQ(tubeAsLong.status, 0) << tubeAsLong.err;
  const nlohmann::json out = report();
  for (const nlohmann::json& station : out["strips"][0]["stations"]) {
    EXPECT_EQ(station["certainty"], "certain");
    EXPECT_GT(station["out_of_plane_margin"], 0.15);
  }
  EXPECT_LT(out["summary"]["program_deviation_max_mm"], 1);
  // A longer one keeps its margin only beyond the tolerance; lengths that need not are told.
  const Finished stretched = tried(R"("blade": {"preset": "steel-tube-3-2.5", "length": 1200})");
  EXPECT_NE(stretched.err.find("more than the tolerance"), std::string::npos) << stretched.err;
  EXPECT_NE(stretched.err.find("lengths that serve the stations that they were tried on"), std::string::npos)
      << stretched.err;
  // Left open, the length is the best of those that serve.
  const Finished open = tried(R"("blade": {"preset": "steel-tube-3-2.5", "length": "auto"})");
  EXPECT_EQ(open.status, 0) << open.err;
  EXPECT_NE(open.err.find("mm was taken, which serves all stations; "), std::string::npos) << open.err;
  const nlohmann::json taken = report();
  EXPECT_EQ(taken["blade"]["length"], taken["blade"]["lengths"]["best"]);
  EXPECT_LT(taken["blade"]["length"], 730);
  EXPECT_GT(taken["blade"]["lengths"]["serving"].back()["to"], 900);
  EXPECT_EQ(taken["blade"]["length_auto"], true);
  EXPECT_EQ(taken["blade"]["lengths"]["best_computed"], true);
  EXPECT_GT(taken["blade"]["lengths"]["stations_tried"], 10);
  EXPECT_EQ(blade({"simulate", folder / "out"}).status, 0);
  // N mm of the two shapes that a fine chain between the same grips rests in.
  EXPECT_NEAR(lost["strips"][0]["stations"][14]["energy_ratio"], 22.344 / 11.523, 0.005);
  // One that is too weak in any length is told, and gets no program.
  const Finished longer = tried(R"("blade": {"preset": "nicr-flat-5x1", "thickness": 0.5, "length": 1000})");
  EXPECT_EQ(longer.status, 1);
  EXPECT_NE(longer.err.find("no length of this blade is known to serve all stations"), std::string::npos)
      << longer.err;
  EXPECT_NE(longer.err.find("no RAPID program is written"), std::string::npos) << longer.err;
  EXPECT_EQ(longer.err.find(".mod"), std::string::npos) << "no program for it: " << longer.err;
  const Finished weightless =
      tried(R"("blade": {"preset": "nicr-flat-5x1", "length": 700}, "clearance": 40, "weight": false)");
  EXPECT_EQ(weightless.status, 0) << weightless.err;
  EXPECT_EQ(tried(R"("blade": "nicr-flat-5x1", "up": [0, 0, 0])").status, 2);
  const Finished tube = tried(R"("blade": {"preset": "steel-tube-3-2.5", "length": 710})");
  EXPECT_EQ(tube.status, 0) << tube.err;
  EXPECT_EQ(tube.err.find("another shape"), std::string::npos) << tube.err;
  const nlohmann::json lowest = report();
  for (const nlohmann::json& station : lowest["strips"][0]["stations"])
    EXPECT_EQ(station["certainty"], "certain");
}

TEST(Rationalize, MissedClearanceIsStatusOne) {
  const Folder folder;
  for (const auto& [clearance, status] : {std::pair{"50", 0}, {"500", 1}}) {
    const std::string job = folder.write(
        "job.json", std::string(R"({"stations": 20, "programs": [], "clearance": )") + clearance + "}");
    const Finished run = blade({"rationalize", example("saddle"), "--job", job, "--out", folder / clearance});
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.err.find("less than the clearance") != std::string::npos, status == 1) << run.err;
  }
}

TEST(Rationalize, TellsOnceWhyAllStationsAreLeftOut) {
  // A block below the top of the cap and above its border: each plane across it cuts the flanks on both
  // sides.
  const Folder folder;
  const std::string job = folder.write(
      "job.json",
      R"({"stations": 5, "direction": "y", "block": {"origin": [-300, -50, 60], "size": [600, 100, 30]}})");
  const Finished run = blade({"rationalize", example("sphere-cap"), "--job", job, "--out", folder / "out"});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_NE(
      run.err.find("stations 1 to 5 are left out: their planes cut the target in 2 separate curves each"),
      std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("none of the 5 planes"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("left out"), run.err.rfind("left out")) << run.err;
}

}  // namespace bw::test
