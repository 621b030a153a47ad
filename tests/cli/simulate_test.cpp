// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// blade simulate: programs that are read back and run.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

const std::string kModule = "out/programs/strip-0/T_ROB1/BladeLeft.mod";

/// Results of the panel with a blade that is sure of its shape.
void rationalizeTo(const Folder& folder) {
  const std::string job =
      folder.write("job.json", R"({"stations": 24, "blade": {"preset": "steel-tube-3-2.5", "length": 710}})");
  const Finished run =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  ASSERT_EQ(run.status, 0) << run.err;
}

TEST(Simulate, TheProgramCutsTheSurfaceThatIsShown) {
  const Folder folder;
  rationalizeTo(folder);
  const json summary = json::parse(slurp(folder / "out/report.json"))["summary"];
  json rapid;
  for (const std::string path : {"out", "out/programs/strip-0", "out/programs/strip-0/motion.csv",
                                 "out/programs/strip-0/motion.json"}) {
    const Finished run = blade({"simulate", folder / path});
    EXPECT_EQ(run.status, 0) << path << run.err;
    EXPECT_NE(run.err.find("of the surface shown"), std::string::npos) << run.err;
    const json told = json::parse(run.out);
    if (rapid.is_null()) rapid = told;
    EXPECT_EQ(told["entry"], "decided");
    EXPECT_TRUE(told["snaps"].empty() && told["exceeded"].empty());
    // CSV alone tells no approach and no retreat.
    EXPECT_EQ(told["warnings"].size(), path.ends_with(".csv") ? 1u : 0u) << told["warnings"];
    EXPECT_TRUE(told["barrier_min_Nmm"].is_null()) << "its shape is the only one";
    EXPECT_GE(told["barriers"].size(), 9u);
    const json& surface = told["surface"];
    EXPECT_LE(surface["deviation_to_design_max_mm"].get<double>(), 0.1);
    EXPECT_NEAR(surface["deviation_to_design_max_mm"].get<double>(),
                rapid["surface"]["deviation_to_design_max_mm"].get<double>(), 1e-3)
        << "rounding of RAPID";
    EXPECT_NEAR(surface["deviation_to_target_max_mm"].get<double>(),
                summary["program_deviation_max_mm"].get<double>(), 0.02);
    EXPECT_NEAR(surface["covered_percent"].get<double>(), 100, 0.1);
    // Where and when.
    for (const char* key :
         {"deviation_to_design_max_at", "deviation_to_target_max_at", "speed_min_at", "speed_max_at"}) {
      EXPECT_EQ(surface[key]["at"].size(), 3u) << key;
      EXPECT_GT(surface[key]["time"], 0) << key;
      EXPECT_LT(surface[key]["time"], told["seconds"]) << key;
    }
    EXPECT_EQ(surface["deviation_to_design_max_at"]["at"], surface["deviation_to_design_at"]);
    EXPECT_GT(surface["speed_min_mm_s"], 1);
    EXPECT_LT(surface["speed_min_mm_s"], surface["speed_max_mm_s"]);
    EXPECT_LE(surface["speed_max_mm_s"].get<double>(), told["speed_max_mm_s"].get<double>() + 1e-9);
    EXPECT_LE(told["speed_min_mm_s"].get<double>(), surface["speed_min_mm_s"].get<double>() + 1e-9);
  }
  ASSERT_EQ(blade({"simulate", folder / "out", "--out", folder / "sim"}).status, 0);
  EXPECT_EQ(json::parse(slurp(folder / "sim/simulation.json")), rapid);
  EXPECT_EQ(slurp(folder / "sim/cut.obj").substr(0, 1), "#");
}

TEST(Simulate, WhatIsWithinToleranceIsToldOfTheSurfaceShownWhereTheBladeBetweenIsNot) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 6, "motion_tolerance": 50})");
  const Finished made =
      blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"});
  EXPECT_NE(made.err.find(" of the surface shown within tolerance (the blade between its stations is not)"),
            std::string::npos)
      << made.err;
  EXPECT_NE(made.err.find("; take more stations, or a smaller motion tolerance"), std::string::npos);
  const Finished run = blade({"simulate", folder / "out/programs/strip-0/motion.json"});
  EXPECT_EQ(run.status, 1) << run.err;
}

/// A wave across the travel that changes sides about a place of it, on a small arch; heights in mm.
std::string changingSides(const Folder& folder, const std::string& wave, double arch, const json& blade,
                          int stations, const json& process = json::object()) {
  json design = {
      {"bladewright_design", 2},
      {"sources",
       {{{"id", "surface"},
         {"surface",
          {{"type", "formula"},
           {"formula", "250+" + wave + "+" + std::to_string(arch) + "*(1-((x-300)/300)^2)"},
           {"x", {0, 600}},
           {"y", {0, 800}}}}}}},
      {"stock", {{{"id", "block"}, {"block", {{"origin", {0, 0, 0}}, {"size", {600, 800, 500}}}}}}},
      {"cuts",
       {{{"id", "cut"},
         {"block", "block"},
         {"source", "surface"},
         {"direction", {0, 1, 0}},
         {"stations", stations}}}},
      {"blade", blade},
      {"process", {{"clearance", 15}, {"floor", 0}, {"motion_tolerance", 1}, {"tolerance", 10}}}};
  design["process"].update(process);
  return folder.write("sides.bladewright", design.dump());
}

TEST(Simulate, ShapesThatAreThereBetweenStationsAloneAreErrorsOfTheDesign) {
  // Each station has one shape; half a second of the way from one to the next has another, a touch away.
  const Folder folder;
  const std::string design = changingSides(folder, "13.6*((y-539)/sqrt((y-539)^2+10^2))*((x-300)/300)^3", 0.7,
                                           {{"preset", "nicr-flat-5x1"},
                                            {"width", 10},
                                            {"thickness", 0.6},
                                            {"young_modulus", 200000},
                                            {"yield_stress", 900},
                                            {"density", 7850},
                                            {"temperature", 20},
                                            {"length", 635}},
                                           24, {{"margin", 0.05}, {"motion_tolerance", 2}});
  const Finished made = blade({"design", design, "--out", folder / "out"});
  EXPECT_EQ(made.status, 1) << made.err;
  EXPECT_NE(made.err.find("error: on the way from station "), std::string::npos) << made.err;
  EXPECT_NE(made.err.find(" N mm brings it from here there), which a touch may bring about"),
            std::string::npos)
      << made.err;
  const Finished run = blade({"simulate", folder / "out/programs/strip-0/motion.json", "--design", design});
  EXPECT_EQ(run.status, 1);
  EXPECT_LT(json::parse(run.out)["barrier_min_Nmm"].get<double>(), 0.2);
}

TEST(Simulate, AMarginThatFallsShortBetweenStationsIsToldOfTheDesign) {
  const Folder folder;
  const std::string design = changingSides(folder, "15.2*((y-430)/sqrt((y-430)^2+10^2))*((x-300)/300)^3", 1.5,
                                           {{"preset", "steel-tube-3-2.5"}, {"length", 800}}, 16);
  const Finished made = blade({"design", design, "--out", folder / "out"});
  EXPECT_NE(made.err.find(" the blade rests in this shape with a margin of 0.08"), std::string::npos)
      << made.err;
  const Finished run = blade({"simulate", folder / "out/programs/strip-0/motion.json", "--design", design});
  EXPECT_NE(run.err.find("the stability margin falls to 0.08"), std::string::npos) << run.err;
}

/// Width and height of a PNG; 0 for what is none.
std::pair<int, int> sizeOf(const std::string& png) {
  if (png.size() < 24 || png.substr(0, 8) != "\x89PNG\r\n\x1a\n") return {0, 0};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = 256 * value + int(static_cast<unsigned char>(png[at + k]));
    return value;
  };
  return {number(16), number(20)};
}

TEST(Simulate, DrawsWhatTheProgramCuts) {
  const Folder folder;
  rationalizeTo(folder);
  const Finished run = blade({"simulate", folder / "out", "--out", folder / "sim"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string target = slurp(folder / "sim/cut.png"), shown = slurp(folder / "sim/cut-from-shown.png");
  EXPECT_EQ(sizeOf(target), std::pair(1280, 800));
  EXPECT_EQ(sizeOf(shown), std::pair(1280, 800));
  EXPECT_NE(target, shown);
  // It is that of the program: of another one it is another.
  const std::string path = "out/programs/strip-0/motion.json";
  json motion = json::parse(slurp(folder / path));
  motion["instants"].erase(motion["instants"].begin() + int(motion["instants"].size()) / 2,
                           motion["instants"].end());
  ASSERT_EQ(blade({"simulate", folder.write(path, motion.dump()), "--out", folder / "half"}).status, 1);
  EXPECT_EQ(sizeOf(slurp(folder / "half/cut.png")), std::pair(1280, 800));
  EXPECT_NE(slurp(folder / "half/cut.png"), target);
  // Without a design there is no surface to hold it against.
  ASSERT_EQ(
      blade({"simulate", folder.write("alone/motion.json", motion.dump()), "--out", folder / "own"}).status,
      0);
  EXPECT_EQ(sizeOf(slurp(folder / "own/cut.png")), std::pair(1280, 800));
  EXPECT_FALSE(std::filesystem::exists(folder / "own/cut-from-shown.png"));
}

TEST(Simulate, RationalizeTellsWhatItTells) {
  const Folder folder;
  for (const auto& [name, job] :
       {std::pair("panel-600x670",
                  R"({"stations": 24, "blade": {"preset": "steel-tube-3-2.5", "length": 710}})"),
        {"saddle", "{}"},
        {"sphere-cap", R"({"stations": 30})"},
        {"torus-patch", R"({"stations": 12})"}}) {
    const std::string out = folder / name;
    const Finished made =
        blade({"rationalize", example(name), "--job", folder.write("job.json", job), "--out", out});
    const json summary = json::parse(slurp(out + "/report.json"))["summary"];
    const json surface = json::parse(blade({"simulate", out}).out)["surface"];
    // What is written is rounded.
    constexpr double kRounded = 2e-3;
    for (const auto& [own, theirs] : {std::pair("program_from_shown_max_mm", "deviation_to_design_max_mm"),
                                      {"program_deviation_max_mm", "deviation_to_target_max_mm"},
                                      {"program_deviation_mean_mm", "deviation_to_target_mean_mm"}})
      EXPECT_NEAR(summary[own].get<double>(), surface[theirs].get<double>(), kRounded) << name << " " << own;
    const std::string words = "the program cuts within ";
    const std::size_t at = made.err.find(words);
    ASSERT_NE(at, std::string::npos) << made.err;
    EXPECT_NE(made.err.find(" mm of this surface; ", at), std::string::npos) << made.err;
    EXPECT_NEAR(std::stod(made.err.substr(at + words.size())),
                surface["deviation_to_design_max_mm"].get<double>(),
                kRounded + 0.005 * surface["deviation_to_design_max_mm"].get<double>())
        << name;
  }
}

TEST(Simulate, AChangedTargetBreaksALimit) {
  const Folder folder;
  rationalizeTo(folder);
  // A target of the left robot in the middle of the cut, 4 mm higher.
  std::string text = slurp(folder / kModule);
  const std::size_t at = text.find("CONST robtarget p0025");
  ASSERT_NE(at, std::string::npos);
  const std::size_t end = text.find(']', at), comma = text.rfind(',', end);
  const double z = std::stod(text.substr(comma + 1, end - comma - 1));
  text.replace(comma + 1, end - comma - 1, std::to_string(z + 4));
  folder.write(kModule, text);
  const Finished run = blade({"simulate", folder / "out/programs/strip-0"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_NE(run.err.find("motion tolerance"), std::string::npos) << run.err;
  const json surface = json::parse(run.out)["surface"];
  EXPECT_GT(surface["deviation_to_design_max_mm"], 0.5);
  // At that target, in the middle of the cut.
  EXPECT_NEAR(surface["deviation_to_design_max_at"]["instant"].get<double>(), 25, 1);
  EXPECT_NE(run.err.find(" mm (motion tolerance 0.1 mm), at "), std::string::npos) << run.err;
}

TEST(Simulate, WhatBreaksARuleOrHurriesIsTold) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string good = slurp(folder / kModule);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    folder.write(kModule, text);
    return blade({"simulate", folder / "out/programs/strip-0"});
  };
  // The work object of one robot alone, then the duration of one move.
  const Finished apart = changed("[[1650.0000,", "[[1700.0000,");
  EXPECT_EQ(apart.status, 1);
  EXPECT_NE(apart.err.find("rapid-rule-14"), std::string::npos) << apart.err;
  const std::string path = "out/programs/strip-0/motion.json";
  json motion = json::parse(slurp(folder / path));
  for (auto& instant : motion["instants"]) instant["time"] = instant["time"].get<double>() / 3;
  const Finished hurried = blade({"simulate", folder.write(path, motion.dump())});
  EXPECT_EQ(hurried.status, 1);
  EXPECT_NE(hurried.err.find("cutting speed 20 mm/s"), std::string::npos) << hurried.err;
}

TEST(Simulate, AProgramBesideTheSurfaceIsNotCalledNearIt) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string path = "out/programs/strip-0/motion.json";
  json motion = json::parse(slurp(folder / path));
  for (json& instant : motion["instants"])
    for (json& pose : instant["poses"]) pose["position"][1] = pose["position"][1].get<double>() + 2000;
  const Finished run = blade({"simulate", folder.write(path, motion.dump())});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("no part of the blade comes over"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("cuts within"), std::string::npos) << run.err;
  EXPECT_TRUE(json::parse(run.out)["surface"].is_null());
}

constexpr const char* kOther = "out/programs/strip-0/T_ROB2/BladeRight.mod";

/// A module with a number of a target changed: of its position, or of the angles of a home.
std::string changedNumber(std::string text, const std::string& name, int number, double by) {
  std::size_t at = text.find(" " + name + " := [[");
  EXPECT_NE(at, std::string::npos) << name;
  at = text.find("[[", at) + 2;
  for (int k = 0; k < number; ++k) at = text.find(',', at) + 1;
  const std::size_t end = text.find_first_of(",]", at);
  text.replace(at, end - at, std::to_string(std::stod(text.substr(at, end - at)) + by));
  return text;
}

void expectTold(const Finished& run, int status, const std::string& text,
                std::initializer_list<const char*> words) {
  EXPECT_EQ(run.status, status) << text;
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

TEST(Simulate, TheWayToTheBlockAndFromItIsRunAndHeldAgainstTheDesign) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string left = slurp(folder / kModule), right = slurp(folder / kOther);
  const auto write = [&](const std::string& first, const std::string& second) {
    folder.write(kModule, first);
    folder.write(kOther, second);
  };
  const auto both = [&](std::initializer_list<const char*> words) {
    const Finished run = blade({"simulate", folder / "out"});
    expectTold(run, 1, run.err, words);
    const Finished check = blade({"check", folder / "out"});
    expectTold(check, 1, check.out, words);
  };
  // Both ends 230 mm farther: the approach begins in the block.
  write(changedNumber(left, "pApproach", 1, 230), changedNumber(right, "pApproach", 1, 230));
  both({"on the way to \"pApproach\" the blade meets the block \"block-1\"", " mm deep; take the targets",
        "the target \"pApproach\", by which the blade comes to the block, is 230 mm off"});
  // The retreat leads back.
  write(changedNumber(left, "pRetreat", 1, -400), changedNumber(right, "pRetreat", 1, -400));
  both({"on the way to \"pRetreat\" the blade meets the block", "\"pRetreat\", by which the blade leaves"});
  // One end only: the blade is bent on the way.
  write(left, changedNumber(right, "pRetreat", 2, 30));
  both({"rapid-rule-19", "is 30 mm off the one that the design planned"});
  // Ends that are pulled apart.
  write(changedNumber(left, "pApproach", 0, 90), right);
  both({"on the way to \"pApproach\" the grips come ", "it would tear"});
  write(changedNumber(left, "jtHome", 3, 4), right);
  both({"the home \"jtHome\" is not the one that the design planned: its axis 4 is 4 degrees off"});
  // A way that is only a little other keeps clear of the block, and is not the one planned all the same.
  write(changedNumber(left, "pApproach", 1, -10), changedNumber(right, "pApproach", 1, -10));
  const Finished longer = blade({"simulate", folder / "out"});
  expectTold(longer, 1, longer.err, {"is 10 mm off the one that the design planned"});
  EXPECT_EQ(longer.err.find("meets the block"), std::string::npos) << longer.err;
  // Another work object leaves the blade as it lies.
  const auto shiftedObject = [](std::string text) {
    const std::string object = "[[1650.0000,";
    text.replace(text.find(object), object.size(), "[[1655.0000,");
    return text;
  };
  write(shiftedObject(left), shiftedObject(right));
  const Finished object = blade({"simulate", folder / "out"});
  expectTold(object, 0, object.err, {"the work object is 5 mm off", "the cut lies as far off"});
  // As it was written it is what the design planned.
  write(left, right);
  EXPECT_EQ(blade({"simulate", folder / "out"}).status, 0);
  EXPECT_EQ(blade({"check", folder / "out"}).status, 0);

  const std::string path = "out/programs/strip-0/motion.json";
  json motion = json::parse(slurp(folder / path));
  motion["approach"] = {0, 0.8, 0.6};
  const Finished turned = blade({"simulate", folder.write(path, motion.dump())});
  expectTold(turned, 1, turned.err, {"the approach is not the one that the design planned", "36.87° off"});
  motion["approach"] = {0, -1, 0};
  const Finished through = blade({"simulate", folder.write(path, motion.dump())});
  expectTold(through, 1, through.err, {"180° off", "on the way to \"approach\" the blade meets the block"});
  const Finished check = blade({"check", folder / path});
  expectTold(check, 1, check.out, {"180° off", "meets the block"});
}

TEST(Simulate, AColdBladeIsTold) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string good = slurp(folder / kModule);
  const auto with = [&](std::initializer_list<std::pair<const char*, const char*>> changes) {
    std::string text = good;
    for (const auto& [from, to] : changes)
      for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from))
        text.replace(at, std::string(from).size(), to);
    folder.write(kModule, text);
    return std::pair(blade({"simulate", folder / "out"}), blade({"check", folder / "out"}));
  };
  const auto [cold, coldCheck] = with({{"        Set doBladeHeat;\r\n", ""},
                                       {"        WaitTime 8;\r\n", ""},
                                       {"        Reset doBladeHeat;\r\n", ""}});
  expectTold(
      cold, 1, cold.err,
      {"nothing switches the heat \"doBladeHeat\" on", "but for the ways around the cut and the heat"});
  expectTold(coldCheck, 1, coldCheck.out, {"the program: nothing switches the heat"});
  const auto [other, otherCheck] = with({{"doBladeHeat", "doLamp"}});
  expectTold(other, 1, other.err, {"it switches \"doLamp\" on", "is heated by \"doBladeHeat\""});
  expectTold(otherCheck, 1, otherCheck.out, {"it switches \"doLamp\" on"});
  const auto [soon, soonCheck] = with({{"WaitTime 8;", "WaitTime 1;"}});
  expectTold(soon, 0, soon.err, {"the blade has 1 s to heat up, in the design 8 s"});
  expectTold(soonCheck, 0, soonCheck.out, {"the blade has 1 s to heat up"});
  const auto [never, neverCheck] = with({{"        WaitTime 8;\r\n", ""}});
  expectTold(never, 1, never.err, {"rapid-rule-14", "the blade has 0 s to heat up"});
  expectTold(neverCheck, 1, neverCheck.out, {"rapid-rule-14"});
  // Other letters are the same name.
  EXPECT_EQ(with({{"doBladeHeat", "DOBLADEHEAT"}}).first.status, 0);
  // A cell that is not known.
  const auto [lost, lostCheck] = with({{"in the cell irb1600-pair.", "in the cell my-cell."}});
  expectTold(lost, 0, lost.err, {"it is for the cell \"my-cell\", the design is for \"irb1600-pair\""});
  expectTold(lostCheck, 0, lostCheck.out, {"my-cell"});
}

TEST(Simulate, ABladeThatIsSlowerThanItsDesignOrStandsStillIsTold) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string left = slurp(folder / kModule), right = slurp(folder / kOther);
  const auto changed = [&](std::string text, bool waits) {
    std::size_t at = text.find("MoveL p0050\\ID");
    EXPECT_NE(at, std::string::npos);
    if (waits) return text.insert(at, "WaitTime 5;\r\n        ");
    at = text.find("\\T:=", at) + 4;
    const std::size_t end = text.find(',', at);
    return text.replace(at, end - at, std::to_string(4 * std::stod(text.substr(at, end - at))).substr(0, 6));
  };
  const auto run = [&](bool waits) {
    folder.write(kModule, changed(left, waits));
    folder.write(kOther, changed(right, waits));
    return blade({"simulate", folder / "out"});
  };
  const Finished slow = run(false);
  expectTold(
      slow, 0, slow.err,
      {"warning: from \"p0049\" to \"p0050\", through the block \"block-1\"",
       "to \"p0050\" the fastest point of the blade goes at 5 mm/s, in the time of the design at 20 mm/s",
       "the move to \"p0050\" lasts "});
  const Finished slowCheck = blade({"check", folder / "out"});
  expectTold(slowCheck, 0, slowCheck.out, {"goes at 5 mm/s, in the time of the design at 20 mm/s"});
  const Finished still = run(true);
  expectTold(still, 1, still.err,
             {"rapid-rule-13", "at \"p0049\" the hot blade stands still in the block \"block-1\" for 5 s"});
  folder.write(kModule, left);
  folder.write(kOther, right);

  const std::string path = "out/programs/strip-0/motion.json";
  const json good = json::parse(slurp(folder / path));
  const std::size_t middle = good["instants"].size() / 2;
  const auto later = [&](std::size_t from, double seconds) {
    json motion = good;
    for (std::size_t i = from; i < motion["instants"].size(); ++i)
      motion["instants"][i]["time"] = motion["instants"][i]["time"].get<double>() + seconds;
    return motion;
  };
  const Finished slower = blade({"simulate", folder.write(path, later(middle, 1).dump())});
  expectTold(slower, 0, slower.err,
             {"slower than its design", ("instants[" + std::to_string(middle) + "]").c_str()});
  json waits = later(middle, 3);
  waits["instants"].insert(waits["instants"].begin() + int(middle), waits["instants"][middle - 1]);
  waits["instants"][middle]["time"] = good["instants"][middle - 1]["time"].get<double>() + 3;
  const Finished stands = blade({"simulate", folder.write(path, waits.dump())});
  expectTold(stands, 1, stands.err, {"the hot blade stands still in the block \"block-1\" for 3 s"});

  // As a table: each time twice as late.
  std::string table;
  std::istringstream rows(slurp(folder / "out/programs/strip-0/motion.csv"));
  for (std::string row; std::getline(rows, row);) {
    const std::size_t comma = row.find(',');
    table += (table.empty() ? row.substr(0, comma) : std::to_string(2 * std::stod(row.substr(0, comma)))) +
             row.substr(comma) + "\n";
  }
  const Finished half =
      blade({"simulate", folder.write("out/programs/strip-0/motion.csv", "\xEF\xBB\xBF" + table)});
  expectTold(half, 0, half.err,
             {"slower than its design", "the fastest point of the blade goes at 10 mm/s", "design at 20 mm/s",
              "the move to \"line 3\" lasts ", "the way to the block and the way from it"});
}

TEST(Simulate, ExchangedGripsAreTold) {
  const Folder folder;
  rationalizeTo(folder);
  json motion = json::parse(slurp(folder / "out/programs/strip-0/motion.json"));
  for (json& instant : motion["instants"]) std::swap(instant["poses"][0], instant["poses"][1]);
  // Beside its design, which knows where its grips stand, and alone, by the planes of its block.
  for (const char* place : {"out/programs/strip-0/motion.json", "alone/motion.json"}) {
    const Finished run = blade({"simulate", folder.write(place, motion.dump())});
    EXPECT_EQ(run.status, 1) << place << run.err;
    EXPECT_NE(run.err.find("error: the grips are exchanged"), std::string::npos) << place << run.err;
    EXPECT_EQ(json::parse(run.out)["exceeded"].size(), 1u) << "the blade itself does what it did";
  }
}

TEST(Simulate, WhatNoBladeCanDoIsStatusOneAndSaysWhereAndWhen) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string path = "out/programs/strip-0/motion.json";
  const json good = json::parse(slurp(folder / path));
  const std::size_t middle = good["instants"].size() / 2;
  const auto halted = [&](std::size_t at, auto change) {
    json motion = good;
    change(motion["instants"][at]["poses"]);
    return blade({"simulate", folder.write(path, motion.dump()), "--out", folder / "sim"});
  };
  const auto told = [&] { return json::parse(slurp(folder / "sim/simulation.json")); };
  const auto torn = [](json& poses) {
    for (int k = 0; k < 3; ++k)
      poses[0]["position"][k] =
          1.5 * poses[0]["position"][k].get<double>() - 0.5 * poses[1]["position"][k].get<double>();
  };
  const Finished tears = halted(middle, torn);
  EXPECT_EQ(tears.status, 1) << tears.err;
  EXPECT_NE(tears.err.find("more than the blade of 710 mm is long; it would tear"), std::string::npos)
      << tears.err;
  EXPECT_NE(tears.err.find(" s, run up to "), std::string::npos) << tears.err;
  const json part = told();
  EXPECT_EQ(part["halted"]["why"], "tears");
  EXPECT_EQ(part["halted"]["instant"], middle - 1);
  EXPECT_GT(part["halted"]["time"], good["instants"][middle - 1]["time"]);
  EXPECT_LE(part["halted"]["time"], good["instants"][middle]["time"]);
  EXPECT_GT(part["surface"]["covered_percent"], 20);
  EXPECT_LT(part["surface"]["covered_percent"], 80);
  EXPECT_LE(part["surface"]["deviation_to_design_mean_mm"].get<double>(), 0.05) << "up to there it is right";

  const Finished off = halted(
      middle, [](json& poses) { poses[0]["position"][1] = poses[0]["position"][1].get<double>() + 2; });
  EXPECT_EQ(off.status, 1) << off.err;
  EXPECT_NE(off.err.find("not in one plane"), std::string::npos) << off.err;
  EXPECT_EQ(told()["halted"]["why"], "off-plane");
  // From the first instant on: there is nothing to tell of the blade.
  const Finished never = halted(0, torn);
  EXPECT_EQ(never.status, 1) << never.err;
  const json nothing = told();
  EXPECT_EQ(nothing["halted"]["time"], 0);
  EXPECT_EQ(nothing["moments"], 0);
  for (const char* key : {"entry", "margin_min", "min_radius_mm", "surface"})
    EXPECT_TRUE(nothing[key].is_null()) << key;
  EXPECT_EQ(never.err.find("margin"), std::string::npos) << never.err;
  EXPECT_TRUE(json::parse(blade({"simulate", folder.write(path, good.dump())}).out)["halted"].is_null());
}

TEST(Simulate, AnOpenLengthIsThatOfTheResults) {
  const Folder folder;
  const std::string given = folder.write("given.json", panelJob(R"("stations": 24, "programs": ["json"])"));
  ASSERT_EQ(blade({"rationalize", example("panel-600x670"), "--job", given, "--out", folder / "out"}).status,
            0);
  const std::string job = folder.write(
      "open.json",
      R"({"clearance": 40, "stations": 24, "blade": {"preset": "steel-tube-3-2.5", "length": "auto"}})");
  ASSERT_EQ(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "open"}).status,
            0);
  json report = json::parse(slurp(folder / "open/report.json"));
  const double taken = report["blade"]["length"];
  ASSERT_NE(taken, 690);
  const Finished run = blade({"simulate", folder / "open"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["blade_length"], taken);
  // The stored design stays open: its programs are those of the length that was found.
  ASSERT_EQ(blade({"export", folder / "open", "--format", "json", "--out", folder / "again"}).status, 0);
  EXPECT_EQ(slurp(folder / "again/strip-0/motion.json"), slurp(folder / "open/programs/strip-0/motion.json"));
  // A design that leaves the length open has that of the program that it is given for.
  const Finished fits = blade({"simulate", folder / "out", "--design", folder / "open/design.bladewright"});
  EXPECT_EQ(fits.status, 0) << fits.err;
  EXPECT_EQ(json::parse(fits.out)["blade_length"], 690);
  // Results were made with one length, and a program of another one is not theirs.
  const Finished other = blade({"simulate", folder / "out", "--design", folder / "open"});
  EXPECT_EQ(other.status, 2) << other.err;
  EXPECT_NE(other.err.find("a blade of 690 mm, the design has one of"), std::string::npos) << other.err;
  report["blade"]["length"] = taken + 15;
  report["blade"]["lengths"]["best"] = taken + 15;
  folder.write("open/report.json", report.dump());
  const Finished changed = blade({"simulate", folder / "open"});
  EXPECT_EQ(changed.status, 2) << "it is not searched anew: " << changed.err;
  const auto exported = [&](const std::string& out) {
    EXPECT_EQ(blade({"export", folder / "open", "--format", "json", "--out", folder / out}).status, 0);
    return json::parse(slurp(folder / out + "/strip-0/motion.json"))["blade_length"].get<double>();
  };
  EXPECT_EQ(exported("told"), taken + 15) << "nor for programs";
  // Where none was found to serve, or the report does not tell, it is.
  report["blade"]["lengths"]["best"] = nullptr;
  folder.write("open/report.json", report.dump());
  EXPECT_EQ(exported("sought"), taken);
}

TEST(Simulate, TellsHowLittleBringsTheBladeIntoAnotherShape) {
  const Folder folder;
  const std::string job = folder.write("job.json", R"({"stations": 12, "clearance": 30, "programs": ["json"],
      "tolerance": 0.3, "blade": {"preset": "nicr-flat-5x1", "length": 720}})");
  ASSERT_EQ(blade({"rationalize", example("panel-600x670"), "--job", job, "--out", folder / "out"}).status,
            1);
  double least = 1e300;
  const json report = json::parse(slurp(folder / "out/report.json"));
  for (const json& station : report["strips"][0]["stations"])
    if (station["barrier_Nmm"].is_number()) least = std::min(least, station["barrier_Nmm"].get<double>());
  const Finished run = blade({"simulate", folder / "out"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find(" N mm brings the blade into another shape"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("; least energy barrier "), std::string::npos) << run.err;
  const json told = json::parse(run.out);
  EXPECT_NEAR(told["barrier_min_Nmm"].get<double>(), least, 0.02 * least) << "as the row has it";
  bool there = false;
  for (const json& look : told["barriers"]) {
    EXPECT_TRUE(!look["sure"] || look["barrier_Nmm"].is_null());
    there = there || (look["barrier_Nmm"] == told["barrier_min_Nmm"] &&
                      look["time"] == told["barrier_min_at"]["time"]);
  }
  EXPECT_TRUE(there);
}

TEST(Simulate, RefusesWhatItCannotRun) {
  const Folder folder;
  rationalizeTo(folder);
  const std::string other = folder.write("job.json", panelJob(R"("stations": 12, "programs": ["json"])"));
  ASSERT_EQ(
      blade({"rationalize", example("panel-600x670"), "--job", other, "--out", folder / "other"}).status, 0);
  const Finished blades = blade({"simulate", folder / "out", "--design", folder / "other"});
  EXPECT_EQ(blades.status, 2);
  EXPECT_NE(blades.err.find("a blade of 710 mm, the design has one of 690 mm"), std::string::npos)
      << blades.err;
  EXPECT_EQ(blades.out, "");
  EXPECT_EQ(blade({"simulate", folder / "nothing"}).status, 4);
  EXPECT_EQ(blade({"simulate", folder / "out/report.json"}).status, 2);
  const Finished named = blade({"simulate", folder.write("mine.csv", "time_s\n")});
  EXPECT_EQ(named.status, 2);
  EXPECT_NE(named.err.find("mine.csv is no robot program or motion by its name"), std::string::npos)
      << named.err;
  // Alone, without its design: the shape is followed, and that is said.
  folder.write("alone/motion.json", slurp(folder / "out/programs/strip-0/motion.json"));
  const Finished alone = blade({"simulate", folder / "alone/motion.json"});
  EXPECT_EQ(alone.status, 0) << alone.err;
  EXPECT_NE(alone.err.find("without weight"), std::string::npos) << alone.err;
  EXPECT_TRUE(json::parse(alone.out)["surface"].is_null());
  EXPECT_TRUE(json::parse(alone.out)["barriers"].empty()) << "how stiff the blade is is not known";
}

}  // namespace
}  // namespace bw::test
