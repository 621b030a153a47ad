// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// From a surface that is designed to its programs, without a window.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

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

INSTANTIATE_TEST_SUITE_P(, DesignedExamples,
                         testing::Values("single-block", "ripple-along", "ripple-across",
                                         "ruled-between-curves", "twist", "bump", "three-block-wall",
                                         "block-wall", "key-blade-fan", "turning-blades"),
                         [](const auto& one) {
                           std::string name = one.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(Designed, ExamplesAreCutAtTheEndsOfTheirSlidersToo) {
  const Folder folder;
  for (const char* name : {"ripple-across", "ruled-between-curves"}) {
    const std::string file = exampleIn(folder, name);
    for (const json& variable : json::parse(slurp(file))["variables"])
      for (const char* end : {"min", "max"}) {
        const std::string set = variable["name"].get<std::string>() + "=" + variable[end].dump();
        const Finished run = blade({"design", file, "--set", set, "--out", folder / "out"});
        EXPECT_EQ(run.status, 0) << name << " " << set << "\n" << run.err;
      }
  }
}

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

TEST(Designed, AVariableIsVariedOverItsRange) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along"), out = folder / "vary";
  const Finished run = blade(
      {"vary", design, "--over", "amplitude=10:0,03 m", "--count", "3", "--set", "waves=1", "--out", out});
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream table(slurp(out + "/vary.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].substr(0, 35), "amplitude,status,deviation_max_mm,d");
  EXPECT_EQ(lines[1].substr(0, 13), "10.000000,ok,");
  EXPECT_EQ(lines[2].substr(0, 13), "20.000000,ok,");
  EXPECT_EQ(lines[3].substr(0, 13), "30.000000,ok,");
  for (const char* name : {"/vary-01.png", "/vary-02.png", "/vary-03.png"})
    EXPECT_EQ(slurp(out + name).substr(1, 3), "PNG") << name;
  // Each is what the design with that value alone is.
  const Finished alone =
      blade({"design", design, "--set", "amplitude=20", "--set", "waves=1", "--out", folder / "alone"});
  ASSERT_EQ(alone.status, 0) << alone.err;
  const json report = json::parse(slurp(folder / "alone" + "/report.json"));
  const double deviation = report["summary"]["deviation_max_mm"];
  EXPECT_NEAR(std::stod(lines[2].substr(13)), deviation, 1e-4);
  // What lies between the targets has a column of its own, before the words.
  EXPECT_TRUE(lines[0].ends_with("cutting_time_s,way_deviation_max_mm,findings")) << lines[0];
  const std::string rest = lines[2].substr(0, lines[2].rfind(','));
  EXPECT_GE(std::stod(rest.substr(rest.rfind(',') + 1)), deviation - 1e-3) << lines[2];
  EXPECT_FALSE(std::filesystem::exists(out + "/programs"));
  // What an earlier run left there of pictures goes, and nothing else.
  folder.write("vary/vary-notes.png", "mine");
  ASSERT_EQ(blade({"vary", design, "--over", "waves", "--count", "2", "--out", out}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/vary-02.png"));
  EXPECT_FALSE(std::filesystem::exists(out + "/vary-03.png"));
  EXPECT_TRUE(std::filesystem::exists(out + "/vary-notes.png"));
}

TEST(Designed, AValueThatMakesNoDesignIsALineOfItsOwn) {
  const Folder folder;
  json design = json::parse(slurp(exampleIn(folder, "ripple-along")));
  design["variables"].push_back({{"name", "long"}, {"value", 800}, {"min", 0}, {"max", 900}});
  design["blade"]["length"] = "=long";
  const std::string file = folder.write("long.bladewright", design.dump());
  const Finished run =
      blade({"vary", file, "--over", "long=0:800", "--count", "2", "--no-pictures", "--out", folder / "out"});
  EXPECT_EQ(run.status, 1) << run.err;
  const std::string table = slurp(folder / "out/vary.csv");
  EXPECT_NE(table.find("\n0.000000,failed,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n800.000000,ok,"), std::string::npos) << table;
}

TEST(Designed, SlipsInWhatIsVariedAreNamed) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along");
  const auto said = [&](const std::string& over, const std::string& count) {
    const Finished run =
        blade({"vary", design, "--over", over, "--count", count, "--no-pictures", "--out", folder / "out"});
    EXPECT_EQ(run.status, 2) << over;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    return run.err;
  };
  EXPECT_NE(said("amplitud", "3").find("no variable \"amplitud\""), std::string::npos);
  EXPECT_NE(said("amplitude=10", "3").find("FROM:TO"), std::string::npos);
  EXPECT_NE(said("amplitude=10:300", "3").find("300 is not between 0 and 60"), std::string::npos);
  EXPECT_NE(said("amplitude=10:much", "3").find("--over"), std::string::npos);
  EXPECT_NE(said("amplitude=10:10", "3").find("the same"), std::string::npos);
  EXPECT_NE(said("amplitude=10:20", "1").find("--count"), std::string::npos);
  EXPECT_NE(said("amplitude=10:20", "100000").find("--count"), std::string::npos);
  EXPECT_EQ(
      blade({"vary", design, "--over", "amplitude", "--set", "amplitude=3", "--out", folder / "out"}).status,
      2);
  EXPECT_EQ(blade({"vary", design, "--over", "amplitude", "--out", design}).status, 4);
}

TEST(Designed, IsHandedOverWithItsReportAndPictures) {
  const Folder folder;
  const std::string design = exampleIn(folder, "three-block-wall");
  // As it is without a word, on two threads and on one.
  ASSERT_EQ(shell("$BLADE design '" + design + "' --out '" + folder / "2" + "' --threads 2").status, 0);
  ASSERT_EQ(blade({"design", design, "--out", folder / "1", "--handover", "--threads", "1"}).status, 0);
  const std::string html = slurp(folder / "1/report.html"), pdf = slurp(folder / "1/report.pdf");
  EXPECT_NE(html.find("All stated limits hold."), std::string::npos);
  EXPECT_NE(html.find("Stations of column-3"), std::string::npos);
  EXPECT_NE(html.find("data:image/png;base64,iVBOR"), std::string::npos);
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  for (const char* file : {"report.html", "report.pdf", "pictures/deviation.png", "pictures/angle.png",
                           "surface-strip-2.iges", "mesh.stl", "curves.dxf", "curves.step"}) {
    EXPECT_FALSE(slurp(folder / ("1/" + std::string(file))).empty()) << file;
    EXPECT_EQ(slurp(folder / ("1/" + std::string(file))), slurp(folder / ("2/" + std::string(file)))) << file;
  }
  const json report = json::parse(slurp(folder / "1/report.json"));
  bool listed = false;
  for (const json& file : report["files"]) listed = listed || file == "report.pdf";
  EXPECT_TRUE(listed) << report["files"];
}

TEST(Designed, TheReportTellsWhatIsExceededAndWhatItWasMadeWith) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along");
  json root = json::parse(slurp(design));
  root["cuts"][0]["blade_length"] = 850;
  for (json& variable : root["variables"])
    if (variable["name"] == "height") variable["min"] = 0;
  std::ofstream(design) << root;
  const auto page = [&](const std::vector<std::string>& set, const char* out) {
    std::vector<std::string> words = {"design", design, "--handover", "--out", folder / out};
    words.insert(words.end(), set.begin(), set.end());
    const Finished run = blade(words);
    return std::pair(run.status, slurp(folder / (out + std::string("/report.html"))));
  };
  const auto [status, html] = page({}, "high");
  EXPECT_EQ(status, 0);
  const std::string own = "<td>Length of the blade between the grips</td><td>850 mm</td>";
  EXPECT_NE(html.find(own), std::string::npos);
  EXPECT_NE(html.find("over the face that its block lies on"), std::string::npos);
  EXPECT_EQ(html.find("exceeded"), std::string::npos);
  EXPECT_EQ(json::parse(slurp(folder / "high/report.json"))["strips"][0]["blade_length"], 850);
  const auto [lowStatus, low] = page({"--set", "height=90", "--set", "rise=40"}, "low");
  EXPECT_EQ(lowStatus, 1);
  EXPECT_NE(low.find("A stated limit is exceeded"), std::string::npos);
  const std::size_t floor = low.find("over the face that its block lies on");
  ASSERT_NE(floor, std::string::npos);
  EXPECT_NE(low.substr(floor, 200).find("exceeded"), std::string::npos) << low.substr(floor, 200);
}

TEST(Designed, ACutIsToldByTheFewestKeyBlades) {
  const Folder folder;
  const std::string design = exampleIn(folder, "bump"), keys = folder / "keys.bladewright";
  const Finished made = blade({"keys", design, "--tolerance", "0.4", "--out", keys});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find(" key blades for 33 sections, within 0."), std::string::npos) << made.err;
  const json surface = json::parse(slurp(keys))["sources"][0]["surface"];
  EXPECT_EQ(surface["type"], "blades");
  EXPECT_LT(surface["blades"].size(), 15u);
  // The sections of the new surface against those of the old: by their STEPs, at stations of the same planes.
  ASSERT_EQ(blade({"design", design, "--out", folder / "old"}).status, 0);
  const Finished run = blade({"design", keys, "--out", folder / "new"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json old = json::parse(slurp(folder / "old/report.json")),
             now = json::parse(slurp(folder / "new/report.json"));
  const json &before = old["strips"][0]["stations"], &after = now["strips"][0]["stations"];
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(before[i]["target_length"].get<double>(), after[i]["target_length"].get<double>(), 1.0) << i;
    EXPECT_NEAR(before[i]["frame"]["origin"][1].get<double>(), after[i]["frame"]["origin"][1].get<double>(),
                1e-9)
        << i;
  }
  // A surface of elastica is cut better than one that is none.
  EXPECT_LT(now["summary"]["deviation_max_mm"].get<double>(), 0.6);
  // What cannot be told so is written as near as it comes, and status 1 says it.
  const Finished fine = blade({"keys", design, "--tolerance", "0.001", "--out", folder / "fine.bladewright"});
  EXPECT_EQ(fine.status, 1) << fine.err;
  EXPECT_NE(fine.err.find("as near as the elastica fitted to each section comes"), std::string::npos)
      << fine.err;
  EXPECT_EQ(blade({"keys", design, "--out", design}).status, 2);
  EXPECT_EQ(blade({"keys", design, "--cut", "cat", "--out", keys}).status, 2);
  EXPECT_EQ(blade({"keys", design, "--out", folder / "keys.json"}).status, 2);
}

TEST(Designed, FourKeyBladesComeBackAsFour) {
  const Folder folder;
  const Finished made =
      blade({"keys", exampleIn(folder, "key-blade-fan"), "--out", folder / "keys.bladewright"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("4 key blades for 33 sections, within 0."), std::string::npos) << made.err;
}

TEST(Designed, ACutWhosePlanesTurnIsToldByKeyBladesThatTurn) {
  const Folder folder;
  const std::string design = exampleIn(folder, "turning-blades");
  ASSERT_EQ(blade({"design", design, "--out", folder / "old"}).status, 0);
  const json old = json::parse(slurp(folder / "old/report.json"));
  for (const bool adopt : {false, true}) {
    const std::string keys = folder / (adopt ? "adopted.bladewright" : "keys.bladewright");
    std::vector<std::string> words = {"keys", design, "--tolerance", "0.2", "--out", keys};
    if (adopt) words.push_back("--adopt");
    const Finished made = blade(words);
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_NE(
        made.err.find(adopt ? " key blades for 33 blades, within 0." : "5 key blades for 33 sections, "),
        std::string::npos)
        << made.err;
    EXPECT_NE(made.err.find("; in planes that turn"), std::string::npos) << made.err;
    const json told = json::parse(slurp(keys));
    bool turns = false;
    for (const json& key : told["sources"][0]["surface"]["blades"]) turns = turns || key.contains("turn_deg");
    EXPECT_TRUE(turns);
    const std::string out = folder / (adopt ? "adopted" : "new");
    const Finished run = blade({"design", keys, "--out", out});
    ASSERT_EQ(run.status, 0) << run.err;
    const json now = json::parse(slurp(out + "/report.json"));
    EXPECT_EQ(now["method"]["planes"], "turning");
    for (const char* end : {"first", "last", "least", "most"})
      EXPECT_NEAR(now["method"]["planes_turned_deg"][end].get<double>(),
                  old["method"]["planes_turned_deg"][end].get<double>(), 0.1);
  }
}

TEST(Designed, TwoMouldsAreMadeForAPanel) {
  const Folder folder;
  const std::string design = exampleIn(folder, "bump"), moulds = folder / "moulds.bladewright";
  const Finished made = blade({"moulds", design, "--thickness", "3cm", "--out", moulds});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("1 upper mould for 1 block\n"), std::string::npos) << made.err;
  const std::string text = slurp(moulds);
  for (const char* zero : {"-0.0,", "-0.0\n", "-0,", "-0\n"})
    EXPECT_EQ(text.find(zero), std::string::npos) << text;
  const Finished run = blade({"design", moulds, "--out", folder / "out"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = json::parse(slurp(folder / "out/report.json"));
  ASSERT_EQ(report["blocks"].size(), 2u);
  EXPECT_EQ(report["blocks"][1]["cuts"][0]["keep"], "above");
  EXPECT_EQ(report["blocks"][1]["cuts"][0]["offset_mm"], 15.0);
  EXPECT_GT(report["summary"]["covered_percent"].get<double>(), 99.9);
  EXPECT_EQ(blade({"check", folder / "out"}).status, 0);
  for (const char* thickness : {"0", "-3", "5000", "3 kg", ""})
    EXPECT_EQ(blade({"moulds", design, "--thickness", thickness, "--out", moulds}).status, 2) << thickness;
  EXPECT_EQ(
      blade({"moulds", exampleIn(folder, "two-crossing-cuts"), "--thickness", "30", "--out", moulds}).status,
      2);
}

TEST(Designed, EveryCutOfAWallGetsKeyBladesOfItsOwn) {
  const Folder folder;
  const std::string design = exampleIn(folder, "three-block-wall"), keys = folder / "keys.bladewright";
  const Finished made = blade({"keys", design, "--tolerance", "0.5", "--out", keys});
  ASSERT_EQ(made.status, 0) << made.err;
  const Finished run = blade({"design", keys, "--out", folder / "out"});
  EXPECT_LE(run.status, 1) << run.err;
  const json report = json::parse(slurp(folder / "out/report.json"));
  ASSERT_EQ(report["blocks"].size(), 3u);
  for (const json& strip : report["strips"]) EXPECT_EQ(strip["stations"].size(), 33u);
  // One of them alone.
  const Finished one = blade({"keys", design, "--cut", "cut-column-2", "--out", folder / "one.bladewright"});
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.err.find("column-1"), std::string::npos) << one.err;
}

TEST(Designed, AWatchedDesignIsWrittenAgainWhenItIsSaved) {
  const Folder folder;
  json other = json::parse(slurp(exampleIn(folder, "ripple-along")));
  other["variables"][0]["value"] = 12.5;
  folder.write("other.bladewright", other.dump());
  // A shell waits for the first results, saves a broken design, one with another variable, one as large whose
  // time is set back, and ends the watch.
  const Finished run = shell("cd '" + (folder / "") + "' || exit" + R"sh(
    $BLADE design ripple-along.bladewright --out out --watch 2> err.txt & watch=$!
    await() {
      for i in $(seq 900); do
        [ "$(grep -c watching err.txt 2> /dev/null)" -ge "$1" ] && return
        sleep 0.1
      done
    }
    await 1; cp out/report.json first.json
    echo '{' > ripple-along.bladewright; await 2
    cp other.bladewright ripple-along.bladewright; await 3; cp out/report.json second.json
    written=$(stat -c %y ripple-along.bladewright)
    sed 's/12\.5/11.5/' other.bladewright > ripple-along.bladewright
    touch -d "$written" ripple-along.bladewright; await 4; cp out/report.json third.json
    kill -TERM $watch; wait $watch; echo $?)sh");
  const std::string said = slurp(folder / "err.txt");
  EXPECT_EQ(run.out, "130\n") << said;
  EXPECT_NE(said.find("changed; once more"), std::string::npos) << said;
  EXPECT_NE(json::parse(slurp(folder / "first.json"))["variables"]["amplitude"], 12.5);
  EXPECT_EQ(json::parse(slurp(folder / "second.json"))["variables"]["amplitude"], 12.5) << said;
  EXPECT_EQ(json::parse(slurp(folder / "third.json"))["variables"]["amplitude"], 11.5) << said;
}

TEST(Designed, WhatAWatchWritesItselfIsNotWatched) {
  const Folder folder;
  const std::string design = exampleIn(folder, "ripple-along");
  ASSERT_EQ(blade({"design", design, "--out", folder / "out"}).status, 0);
  const Finished run =
      blade({"design", folder / "out/design.bladewright", "--out", folder / "out", "--watch"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("would never end"), std::string::npos) << run.err;
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

TEST(Blocks, OfAWallHaveJointsProgramsAndOneSurface) {
  const Folder folder;
  const std::string design = exampleIn(folder, "three-block-wall"), out = folder / "out";
  const Finished run = blade({"design", design, "--out", out});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("3 blocks, 99 stations"), std::string::npos) << run.err;
  const json report = json::parse(slurp(out + "/report.json"));
  EXPECT_LT(report["summary"]["joint_gap_max_mm"].get<double>(), 0.1);
  EXPECT_LT(report["summary"]["joint_angle_max_deg"].get<double>(), 1);
  ASSERT_EQ(report["joints"].size(), 2u);
  EXPECT_EQ(report["joints"][1]["blocks"], json::array({"column-2", "column-3"}));
  EXPECT_EQ(report["joints"][1]["places"], 129);
  ASSERT_EQ(report["blocks"].size(), 3u);
  EXPECT_EQ(report["blocks"][2]["origin"], json::array({1200.0, 0.0, 0.0}));
  EXPECT_EQ(report["blocks"][2]["cuts"][0]["strips"], json::array({2}));
  ASSERT_EQ(report["strips"].size(), 3u);
  for (const json& strip : report["strips"])
    for (const json& station : strip["stations"]) {
      const std::string rest = station["certainty"];
      EXPECT_TRUE(rest == "certain" || rest == "held") << strip["block"] << " " << station["index"];
    }
  for (const char* module : {"column-1/strip-0/T_ROB1/BladeLeft.mod",
                             "column-2/strip-1/T_ROB2/BladeRight.mod", "column-3/strip-2/motion.json"})
    EXPECT_FALSE(slurp(out + "/programs/" + module).empty()) << module;
  // What is written meets as the report says, by another file. Curves run towards -x where the travel is y.
  const json sweep = json::parse(slurp(out + "/sweep.json"));
  ASSERT_EQ(sweep["strips"].size(), 3u);
  for (std::size_t b = 0; b + 1 < 3; ++b)
    for (std::size_t i = 0; i < 33; ++i) {
      const json left = sweep["strips"][b]["stations"][i]["points"].front(),
                 right = sweep["strips"][b + 1]["stations"][i]["points"].back();
      double off = 0;
      for (std::size_t k = 0; k < 3; ++k) off += std::pow(left[k].get<double>() - right[k].get<double>(), 2);
      EXPECT_LT(std::sqrt(off), 0.1) << b << " " << i;
    }
  const Finished info = blade({"info", out + "/surface.step"});
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(json::parse(info.out)["faces"], 3);
  EXPECT_EQ(json::parse(info.out)["shells"], 1) << "OpenCASCADE sews them along their boundaries";
  EXPECT_EQ(blade({"check", out}).status, 0);
  // The rules are asked of the programs in the folders of blocks, too.
  const std::string module = out + "/programs/column-3/strip-2/T_ROB1/BladeLeft.mod", written = slurp(module);
  const std::size_t move = written.find("MoveL");
  ASSERT_NE(move, std::string::npos);
  std::ofstream(module) << std::string(written).replace(move, 5, "MoveZ");
  const Finished broken = blade({"check", out});
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.out.find("[rapid-"), std::string::npos) << broken.out;
  EXPECT_NE(broken.out.find("column-3"), std::string::npos) << broken.out;
  std::ofstream(module) << written;
  // A strip of it is run against its own block; the folder of all is not one program.
  const Finished simulated = blade({"simulate", out + "/programs/column-2/strip-1", "--out", folder / "sim"});
  EXPECT_EQ(simulated.status, 0) << simulated.err;
  const json simulation = json::parse(slurp(folder / "sim/simulation.json"));
  EXPECT_LT(simulation["surface"]["deviation_to_design_max_mm"].get<double>(), 0.2);
  const Finished all = blade({"simulate", out});
  EXPECT_EQ(all.status, 2);
  EXPECT_NE(all.err.find("programs of 3 strips"), std::string::npos) << all.err;
  // The stored design is the grid, not its list.
  EXPECT_TRUE(json::parse(slurp(out + "/design.bladewright")).contains("grid"));
  // A result of one block in the same folder leaves none of their programs.
  ASSERT_EQ(blade({"design", exampleIn(folder, "bump"), "--out", out}).status, 0);
  for (const std::string& file : folder.files())
    EXPECT_EQ(file.find("out/programs/column"), std::string::npos) << file;
}

TEST(Designed, CutsOfOneBlockThatFoundTheirOwnLengthsAreRunWithThem) {
  const Folder folder;
  const auto surface = [](const char* id, const char* formula) {
    return json{
        {"id", id},
        {"surface", {{"type", "formula"}, {"x", {-300, 900}}, {"y", {-300, 1100}}, {"formula", formula}}}};
  };
  const auto cut = [](const char* id, const char* source, const char* direction, const char* keep, int turn) {
    return json{{"id", id},     {"source", source}, {"block", "block"}, {"direction", direction},
                {"keep", keep}, {"stations", 21},   {"turn_deg", turn}};
  };
  const json design = {
      {"bladewright_design", 2},
      {"name", "two"},
      {"sources",
       {surface("low", "180+25*cos(pi*(x-300)/800)"), surface("top", "330+30*cos(pi*(y-400)/900)")}},
      {"stock", {{{"id", "block"}, {"block", {{"origin", {0, 0, 0}}, {"size", {600, 800, 500}}}}}}},
      {"cuts", {cut("low", "low", "y", "above", 0), cut("high", "top", "x", "below", 90)}},
      {"blade", {{"preset", "nicr-flat-5x1"}, {"length", "auto"}}}};
  std::ofstream(std::string(folder / "two.bladewright")) << design;
  const std::string out = folder / "out";
  const Finished made = blade({"design", folder / "two.bladewright", "--out", out});
  ASSERT_EQ(made.status, 0) << made.err;
  const json strips = json::parse(slurp(out + "/report.json"))["strips"];
  ASSERT_EQ(strips.size(), 2u);
  EXPECT_LT(strips[0]["blade_length"].get<double>() + 100, strips[1]["blade_length"].get<double>())
      << "across 600 and 800 mm of foam";
  for (const char* strip : {"strip-0", "strip-1"}) {
    const std::string program = out + "/programs/" + strip;
    for (const std::string& about : {out, std::string(folder / "two.bladewright")}) {
      const Finished run = blade({"simulate", program, "--design", about});
      EXPECT_EQ(run.status, 0) << strip << " " << about << " " << run.err;
    }
  }
  const Finished exported = blade({"export", out, "--format", "json", "--out", folder / "again"});
  EXPECT_EQ(exported.status, 0) << exported.err;
  EXPECT_EQ(blade({"render", out, "--size", "320x200", "--out", folder / "a.png"}).status, 0);
}

TEST(Blocks, AreWrittenAlikeWithAnyNumberOfThreads) {
  const Folder folder;
  const std::string design = exampleIn(folder, "three-block-wall");
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(blade({"design", design, "--out", folder / threads, "--threads", threads}).status, 0);
  for (const std::string& file : folder.files()) {
    if (file.rfind("1/", 0) != 0 || file == "1/report.json") continue;
    EXPECT_EQ(slurp(folder / ("3/" + file.substr(2))), slurp(folder / file)) << file;
  }
}

TEST(Blocks, OfLayersThatDoNotMeetEndWithStatusOneToo) {
  // A surface that rises through two layers along the planes of the blade: nobody looked there.
  const Folder folder;
  const auto layers = [&](const std::string& join) {
    return folder.write("layers-" + join + ".bladewright",
                        R"json({"bladewright_design": 2,
      "sources": [{"id": "s", "surface": {"type": "formula", "x": [0, 600], "y": [0, 800],
                   "formula": "300 + 0.9*(x - 300) + 60*sin((x - 300)/110)"}}],
      "grid": {"columns": 1, "layers": 2, "sizes": {"columns": 600, "rows": 800, "layers": 300}},
      "cuts": [{"id": "cut", "source": "s", "stations": 9, "direction": [0, 1, 0]}],
      "blade": {"preset": "nicr-flat-5x1", "length": 900},
      "output": {"programs": ["csv"]},
      "process": {"join": {"type": ")json" +
                            join + R"json("}}})json");
  };
  const auto jointOf = [&](const std::string& join, Finished& run) {
    const std::string out = folder / ("out-" + join);
    run = blade({"design", layers(join), "--out", out});
    const json report = json::parse(slurp(out + "/report.json"));
    EXPECT_EQ(report["joints"].size(), 1u);
    return report["joints"][0];
  };
  Finished run;
  const json apart = jointOf("none", run);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("layer-1 and layer-2 meet with a gap"), std::string::npos) << run.err;
  EXPECT_GT(apart["gap_max_mm"], 0.3);
  EXPECT_GT(apart["places"], 10);
  const json joined = jointOf("tangent-planes", run);
  EXPECT_EQ(run.err.find("meet with"), std::string::npos) << run.err;
  EXPECT_LT(joined["gap_max_mm"], 1e-3);
  EXPECT_LT(joined["angle_max_deg"], 0.01);
}

/// The least ratio of speeds of each row.
std::vector<double> speedRatios(const json& report) {
  std::vector<double> ratios;
  for (const json& strip : report["strips"]) {
    ratios.push_back(1);
    for (const json& station : strip["stations"])
      ratios.back() = std::min(ratios.back(), station["speed_ratio"].get<double>());
  }
  return ratios;
}

TEST(Designed, ABladeOneEndOfWhichNearlyStandsStillIsToldWhatHelps) {
  const Folder folder;
  // The example whose key blades turn, as far as its slider goes.
  json design = json::parse(slurp(exampleIn(folder, "turning-blades")));
  for (json& variable : design["variables"])
    if (variable["name"] == "turn") variable["value"] = variable["max"];
  const std::string file = folder.write("turned.bladewright", design.dump());
  const Finished run = blade({"design", file, "--out", folder / "out"});
  const json report = json::parse(slurp(folder / "out/report.json"));
  json speed;
  for (const json& issue : report["issues"])
    if (issue["kind"] == "speed" && (speed.is_null() || issue["speed_ratio"] < speed["speed_ratio"]))
      speed = issue;
  ASSERT_FALSE(speed.is_null()) << run.err;
  EXPECT_NEAR(speed["speed_ratio"].get<double>(), speedRatios(report)[0], 1e-9);
  EXPECT_NE(run.err.find("split across the blade at "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("in parallel planes, travelling along (0, 1, 0), it is "), std::string::npos)
      << run.err;
  // Both are what designs with them come to.
  const auto done = [&](const char* name) {
    const Finished again = blade(
        {"design", folder.write(std::string(name) + ".bladewright", design.dump()), "--out", folder / name});
    const json now = json::parse(slurp(folder / (std::string(name) + "/report.json")));
    for (const json& issue : now["issues"]) EXPECT_NE(issue["kind"], "speed") << issue;
    return speedRatios(now);
  };
  EXPECT_EQ(speed["planes"]["family"], "parallel");
  design["cuts"][0]["direction"] = speed["planes"]["direction"];
  EXPECT_NEAR(done("parallel")[0], speed["planes"]["speed_ratio"].get<double>(), 1e-6);
  design["cuts"][0].erase("direction");
  design["cuts"][0].erase("block");
  const json block = design["stock"][0]["block"], parts = speed["split"]["parts"];
  EXPECT_EQ(speed["split"]["along"], "x");
  ASSERT_GE(parts.size(), 2u);
  json widths = json::array();
  for (const json& part : parts)
    widths.push_back(part["to_mm"].get<double>() - part["from_mm"].get<double>());
  design.erase("stock");
  design["grid"] = {
      {"origin", block["origin"]},
      {"columns", parts.size()},
      {"sizes", {{"columns", widths}, {"rows", block["size"][1]}, {"layers", block["size"][2]}}}};
  const std::vector<double> ratios = done("split");
  ASSERT_EQ(ratios.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    EXPECT_NEAR(ratios[i], parts[i]["speed_ratio"].get<double>(), 1e-6) << i;
}

TEST(Blocks, OneThatNoBladeCutsLeavesTheOthersToBeRun) {
  const Folder folder;
  json design = json::parse(slurp(exampleIn(folder, "three-block-wall")));
  design["grid"]["sizes"]["columns"] = {500, 800, 500};
  const std::string file = folder.write("wide.bladewright", design.dump()), out = folder / "out";
  const Finished run = blade({"design", file, "--out", out, "--no-handover"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("error: column-2: nothing is cut of the block: the blade of 800 mm is shorter"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("2 blocks and 1 that cannot be cut"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/programs/column-2"));
  for (const char* column : {"column-1", "column-3"}) {
    const Finished alone = blade({"simulate", out + "/programs/" + column});
    EXPECT_EQ(alone.status, 0) << column << alone.err;
  }
}

TEST(Blocks, ThatDoNotMeetEndWithStatusOne) {
  const Folder folder;
  json design = json::parse(slurp(exampleIn(folder, "three-block-wall")));
  design["process"]["join"]["type"] = "none";
  design["process"]["join"]["gap_mm"] = 0.001;
  const std::string file = folder.write("open.bladewright", design.dump());
  const Finished run = blade({"design", file, "--out", folder / "out"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("column-1 and column-2 meet with a gap"), std::string::npos) << run.err;
  // And bad grids with a sentence.
  design["grid"]["rows"] = 0;
  folder.write("open.bladewright", design.dump());
  const Finished none = blade({"design", file, "--out", folder / "none"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("design.grid.rows is 0"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace bw::test
