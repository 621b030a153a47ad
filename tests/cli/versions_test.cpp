// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Named versions of a design, without a window.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "process.h"

namespace bw::test {
namespace {

using nlohmann::json;

/// The example ripple-along with its amplitude at a number.
void setAmplitude(const std::string& file, const Folder& folder, double value) {
  json design = json::parse(slurp(file));
  for (json& variable : design["variables"])
    if (variable["name"] == "amplitude") variable["value"] = value;
  folder.write(std::filesystem::path(file).filename().string(), design.dump());
}

bool says(const Finished& run, const std::string& text) {
  return (run.out + run.err).find(text) != std::string::npos;
}

}  // namespace

TEST(Versions, AreNamedListedTakenMadeAndRemoved) {
  const Folder folder;
  const std::string file = folder / "ripple.bladewright";
  ASSERT_EQ(blade({"example", "ripple-along", "--out", file}).status, 0);
  Finished run = blade({"versions", file});
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(says(run, "ripple.bladewright: 0 versions\n")) << run.out;

  ASSERT_EQ(blade({"versions", file, "--name", "as ordered"}).status, 0);
  run = blade({"versions", file});
  EXPECT_TRUE(says(run, "1 version\nas ordered: as the present state\n")) << run.out;
  setAmplitude(file, folder, 12);
  run = blade({"versions", file});
  EXPECT_TRUE(says(run, "as ordered: 1 difference to the present state\n")) << run.out;
  EXPECT_TRUE(says(run, "  Variable amplitude: ")) << run.out;
  EXPECT_TRUE(says(run, " → 12 mm  (/variables/")) << run.out;
  const json list = json::parse(blade({"versions", file, "--format", "json"}).out);
  EXPECT_EQ(list["versions"][0]["name"], "as ordered");
  EXPECT_EQ(list["versions"][0]["differences"][0]["now"], "12 mm");

  // The version, and the present state, each as they are; results hold neither.
  const std::string out = folder / "out", ordered = folder / "ordered";
  ASSERT_EQ(blade({"design", file, "--out", out}).status, 0);
  ASSERT_EQ(blade({"design", file, "--version", "as ordered", "--out", ordered}).status, 0);
  EXPECT_NE(slurp(out + "/sweep.json"), slurp(ordered + "/sweep.json"));
  for (const std::string& results : {out, ordered})
    EXPECT_FALSE(json::parse(slurp(results + "/design.bladewright")).contains("versions"));
  const std::string taken = folder / "taken.bladewright";
  ASSERT_EQ(blade({"versions", file, "--take", "as ordered", "--out", taken}).status, 0);
  EXPECT_TRUE(says(blade({"versions", taken}), "as ordered: as the present state"));
  ASSERT_EQ(blade({"design", taken, "--out", folder / "again"}).status, 0);
  EXPECT_EQ(slurp(folder / "again/sweep.json"), slurp(ordered + "/sweep.json"));
  EXPECT_EQ(slurp(folder / "again/design.bladewright"), slurp(ordered + "/design.bladewright"));

  // A copy leaves the file as it was.
  const std::string before = slurp(file), less = folder / "less.bladewright";
  ASSERT_EQ(blade({"versions", file, "--drop", "as ordered", "--out", less}).status, 0);
  EXPECT_EQ(slurp(file), before);
  EXPECT_TRUE(says(blade({"versions", less}), "0 versions"));
  ASSERT_EQ(blade({"versions", file, "--drop", "as ordered"}).status, 0);
  EXPECT_TRUE(says(blade({"versions", file}), "0 versions"));
  ASSERT_EQ(blade({"design", file, "--out", folder / "without"}).status, 0);
  EXPECT_EQ(slurp(folder / "without/sweep.json"), slurp(out + "/sweep.json"));
}

TEST(Versions, TellWhatIsWrong) {
  const Folder folder;
  const std::string file = folder / "ripple.bladewright";
  ASSERT_EQ(blade({"example", "ripple-along", "--out", file}).status, 0);
  ASSERT_EQ(blade({"versions", file, "--name", "flat"}).status, 0);
  const std::string before = slurp(file), out = folder / "out";
  const auto fails = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Finished run = blade(arguments);
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_TRUE(says(run, message)) << run.err;
    EXPECT_EQ(slurp(file), before);
  };
  fails({"versions", file, "--name", "flat"}, "the design has a version \"flat\" already");
  fails({"versions", file, "--name", " "}, "the name of the version is empty");
  fails({"versions", file, "--name", ""}, "--name is empty");
  fails({"versions", file, "--drop", "flta"}, "no version \"flta\"; did you mean \"flat\"?");
  fails({"versions", file, "--take", "wavy", "--out", folder / "a.bladewright"},
        "no version \"wavy\"; it has \"flat\"");
  fails({"design", file, "--version", "falt", "--out", out}, "did you mean \"flat\"?");
  fails({"versions", file, "--take", "flat"}, "--take writes another design; give --out");
  fails({"versions", file, "--take", "flat", "--out", folder / "a.json"}, "ends in .bladewright");
  fails({"versions", file, "--take", "flat", "--out", file}, "is the input");
  fails({"versions", file, "--out", folder / "a.bladewright"}, "--out goes with");
  fails({"versions", file, "--name", "b", "--drop", "flat"}, "give one of them");
  EXPECT_EQ(blade({"versions", folder / "none.bladewright"}).status, 4);
  EXPECT_FALSE(std::filesystem::exists(out));
  // The design beside results has no versions: one with versions is not replaced by it.
  ASSERT_EQ(blade({"design", file, "--out", out}).status, 0);
  const std::string inside = out + "/design.bladewright";
  ASSERT_EQ(blade({"versions", inside, "--name", "made"}).status, 0);
  const Finished run = blade({"design", inside, "--out", out});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(says(run, "has named versions, which would be lost")) << run.err;
  EXPECT_TRUE(says(blade({"versions", inside}), "made: as the present state"));
  // Nor is one that is changed on the way, or that marks parts.
  ASSERT_EQ(blade({"versions", inside, "--drop", "made"}).status, 0);
  EXPECT_EQ(blade({"design", inside, "--out", out}).status, 0);
  std::string kept = slurp(inside);
  const Finished changed = blade({"design", inside, "--out", out, "--version", "x"});
  EXPECT_EQ(changed.status, 2);
  EXPECT_TRUE(says(changed, "would be replaced by the design that it is changed to here")) << changed.err;
  EXPECT_EQ(slurp(inside), kept);
  json marked = json::parse(kept);
  marked["locked"] = {{"cuts", {marked["cuts"][0]["id"]}}};
  std::ofstream(inside) << marked.dump();
  kept = slurp(inside);
  const Finished locked = blade({"design", inside, "--out", out});
  EXPECT_EQ(locked.status, 2);
  EXPECT_TRUE(says(locked, "hides or locks parts, which would be lost")) << locked.err;
  EXPECT_EQ(slurp(inside), kept);
}

TEST(Versions, FindTheFilesThatTheyLink) {
  const Folder folder;
  ASSERT_EQ(blade({"example", "saddle", "--out", folder / "saddle.step"}).status, 0);
  const std::string file = folder.write(
      "saddle.bladewright",
      R"({"bladewright_design": 2, "sources": [{"id": "s", "path": "saddle.step"}], "cuts": [{"stations": 8}]})");
  // Named from its own folder and from another.
  const std::string cd = "cd " + std::filesystem::path(file).parent_path().string() + " && ";
  ASSERT_EQ(shell(cd + "$BLADE versions saddle.bladewright --name here").status, 0);
  ASSERT_EQ(shell(cd + "mkdir -p sub && cd sub && $BLADE versions ../saddle.bladewright --name there").status,
            0);
  ASSERT_EQ(shell(cd + "$BLADE versions saddle.bladewright --take here --out sub/taken.bladewright").status,
            0);
  const json design = json::parse(slurp(file)), taken = json::parse(slurp(folder / "sub/taken.bladewright"));
  for (const json& version : design["versions"])
    EXPECT_EQ(version["design"]["sources"][0]["path"], "saddle.step");
  EXPECT_EQ(taken["sources"][0]["path"], "../saddle.step");
  for (const json& version : taken["versions"])
    EXPECT_EQ(version["design"]["sources"][0]["path"], "../saddle.step");
}

}  // namespace bw::test
