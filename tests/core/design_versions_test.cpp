// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design_versions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/variables.h"
#include "bw/core/files/file_set.h"
#include "bw/core/files/fingerprint.h"
#include "file_folder.h"
#include "read_design.h"

namespace bw {

namespace {

using nlohmann::json;
using test::designOf;
using test::errorOf;

const char* const kRipple = R"({
  "bladewright_design": 2, "name": "Ripple",
  "variables": [{"name": "amplitude", "value": 40, "min": 0, "max": 80, "unit": "mm"}],
  "sources": [{"id": "s", "surface": {"type": "poles", "poles": [
     [200, 210, 210, 200], [200, "=200 + amplitude/2", 210, 200],
     [200, 210, 210, 200], [200, 210, 210, 200]]}}],
  "stock": [{"id": "b", "block": {"origin": [0, 0, 0], "size": [600, 800, 500], "rotation_deg": [0, 0, 7]}}],
  "cuts": [{"id": "c", "source": "s", "block": "b", "direction": "y", "stations": 21}],
  "process": {"tolerance": "=amplitude/20"}
})";

/// A design that was named, changed, named again and changed again.
Design withHistory() {
  Design design = withVersion(designOf(kRipple), "first").value();
  design = withVariables(design, {{"amplitude", 30}}).value();
  design.process.kerf = 1.5;
  design = withVersion(design, "second, \"quoted\" – ä").value();
  design.cut().sections.stations = 33;
  return design;
}

json withVersions(const json& versions) {
  json object = json::parse(kRipple);
  object["versions"] = versions;
  return object;
}

json versionJson(const char* name) { return {{"name", name}, {"design", json::parse(kRipple)}}; }

Design embedded(const std::string& bytes) {
  Design design;
  design.source().path = "panel.step";
  design.source().bytes = bytes;
  return design;
}

}  // namespace

TEST(DesignVersions, RoundTripWithTheirExpressions) {
  const Design design = withHistory();
  ASSERT_EQ(design.versions.size(), 2u);
  const std::string text = designToJson(design);
  const Design again = designOf(text);
  EXPECT_EQ(again, design);
  EXPECT_EQ(designToJson(again), text);
  const Design& first = *again.versions.front().design;
  EXPECT_EQ(first, designOf(kRipple));
  EXPECT_EQ(first.bindings.at("/process/tolerance").text, "amplitude/20");
  EXPECT_EQ(first.process.tolerance, 2);
  EXPECT_EQ(again.process.tolerance, 1.5);
  // They are bound as ever: a version that is taken follows its variables.
  const Design taken = atVersion(again, "first").value();
  EXPECT_EQ(withVariables(taken, {{"amplitude", 60}}).value().process.tolerance, 3);
}

TEST(DesignVersions, AreNamedTakenRenamedAndRemoved) {
  const Design before = designOf(kRipple);
  const Design named = withVersion(before, "first").value();
  EXPECT_EQ(withoutVersions(named), before);
  Design changed = named;
  changed.process.tolerance = 0.5;
  const Design taken = atVersion(changed, "first").value();
  EXPECT_EQ(taken, named);
  const Design renamed = withVersionRenamed(changed, "first", "flat").value();
  EXPECT_EQ(renamed.versions.front().name, "flat");
  EXPECT_EQ(renamed.versions.front().design, named.versions.front().design);
  EXPECT_EQ(withVersionRenamed(changed, "first", "first").value(), changed);
  EXPECT_EQ(withoutVersion(renamed, "flat").value(), withoutVersions(changed));
  // What is named while there are versions holds none.
  const Design second = withVersion(changed, "second").value();
  EXPECT_TRUE(second.versions.back().design->versions.empty());
  EXPECT_EQ(second.versions.size(), 2u);
}

TEST(DesignVersions, SayWhatIsWrongWithAName) {
  const Design design = withHistory();
  EXPECT_EQ(atVersion(design, "firts").error().message,
            "the design has no version \"firts\"; did you mean \"first\"?");
  EXPECT_EQ(withoutVersion(design, "zzzzzzzz").error().message,
            "the design has no version \"zzzzzzzz\"; it has \"first\", \"second, \"quoted\" – ä\"");
  EXPECT_EQ(atVersion(Design{}, "first").error().message,
            "the design has no versions, so there is none of the name \"first\"");
  for (const char* name : {"", "  \t"})
    EXPECT_EQ(withVersion(design, name).error().message, "the name of the version is empty; give it one");
  EXPECT_NE(withVersion(design, "\xff").error().message.find("no UTF-8"), std::string::npos);
  EXPECT_NE(withVersion(design, "first").error().message.find("already"), std::string::npos);
  EXPECT_FALSE(withVersionRenamed(design, "first", design.versions.back().name));
  EXPECT_FALSE(withVersionRenamed(design, "other", "new"));
  Design full = design;
  while (full.versions.size() < std::size_t(Design::kMostVersions))
    full = withVersion(full, "version " + std::to_string(full.versions.size())).value();
  EXPECT_NE(withVersion(full, "one more").error().message.find("100 versions"), std::string::npos);
  EXPECT_EQ(designOf(designToJson(full)), full);
}

TEST(DesignVersions, AreReadAsStrictlyAsDesigns) {
  EXPECT_EQ(errorOf(withVersions(json::array())), "accepted");
  EXPECT_EQ(errorOf(withVersions({versionJson("a"), versionJson("b")})), "accepted");
  const auto third = [](const json& change) {
    json broken = versionJson("c");
    broken.merge_patch(change);
    return errorOf(withVersions({versionJson("a"), versionJson("b"), broken}));
  };
  EXPECT_EQ(third({{"name", "a"}}),
            "design.versions[2].name is \"a\", as that of another version; give each its own");
  EXPECT_EQ(third({{"name", " "}}), "design.versions[2].name is empty; give the version a name");
  EXPECT_EQ(third({{"name", 7}}), "design.versions[2].name must be a text, not number");
  EXPECT_EQ(third({{"name", nullptr}}), "design.versions[2] needs the key name: what the version is called");
  EXPECT_EQ(third({{"design", nullptr}}), "design.versions[2] needs the key design: the design as it was");
  EXPECT_EQ(third({{"design", 3}}), "design.versions[2].design must be a JSON object, not number");
  EXPECT_EQ(third({{"design", {{"bladewright_design", nullptr}}}}),
            "design.versions[2].design is not a Bladewright design: the key bladewright_design with the "
            "version is missing");
  EXPECT_NE(third({{"design", {{"bladewright_design", 3}}}}).find("newer"), std::string::npos);
  EXPECT_EQ(third({{"design", {{"process", {{"tolerance", -1}}}}}}),
            "design.versions[2].design.process.tolerance is -1 but must lie between 0.0001 and 1000");
  EXPECT_EQ(third({{"design", {{"process", {{"tolerance", "=amplitud"}}}}}}).substr(0, 44),
            "design.versions[2].design.process.tolerance,");
  EXPECT_EQ(third({{"design", {{"process", {{"tolerance", "=-amplitude"}}}}}}),
            "design.versions[2].design.process.tolerance is -40 (=-amplitude) but must lie between 0.0001 "
            "and 1000");
  EXPECT_NE(
      third({{"design", {{"cuts", {{{"block", "x"}}}}}}}).find("design.versions[2].design.cuts[0].block"),
      std::string::npos);
  EXPECT_NE(third({{"desing", 1}}).find("design.versions[2] has no key \"desing\""), std::string::npos);
  EXPECT_EQ(third({{"design", {{"versions", json::array()}}}}),
            "design.versions[2].design has versions of its own; those of a design hold none: move them up");
  EXPECT_EQ(errorOf(withVersions(json::object())), "design.versions must be a list of at most 100 entries");
  EXPECT_EQ(errorOf(withVersions(std::vector<json>(101, versionJson("a")))),
            "design.versions must be a list of at most 100 entries, not of 101");
  const Result<Design> wrong = parseDesign(
      withVersions({{{"name", "a"}, {"design", {{"bladewright_design", 2}, {"process", {{"lead", "x"}}}}}}})
          .dump());
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().where, "design.versions[0].design.process.lead");
}

TEST(DesignVersions, ShareEmbeddedFiles) {
  const std::string panel(3000, 'p'), wall(2000, 'w');
  Design design = withVersion(embedded(wall), "wall").value();
  design.process.tolerance = 1;
  design = withVersion(design, "wall again").value();
  design.source().bytes = panel;
  design = withVersion(design, "panel").value();
  const json object = json::parse(designToJson(design));
  const json& versions = object["versions"];
  EXPECT_TRUE(versions[0]["design"]["sources"][0].contains("base64"));
  EXPECT_EQ(versions[1]["design"]["sources"][0]["base64_as"], "versions[0]");
  EXPECT_FALSE(versions[1]["design"]["sources"][0].contains("base64"));
  EXPECT_EQ(versions[2]["design"]["sources"][0]["base64_as"], "design");
  EXPECT_EQ(designOf(object.dump()), design);

  const auto broken = [&](const char* key, const json& value) {
    json other = object;
    other["versions"][1]["design"]["sources"][0][key] = value;
    return errorOf(other);
  };
  const std::string where = "design.versions[1].design.sources[0]";
  // Not what comes later, and not itself.
  for (const char* word : {"versions[1]", "versions[2]", "versions[00]", ""})
    EXPECT_EQ(broken("base64_as", word), where + ".base64_as names \"" + word +
                                             "\", but before it there is \"design\", \"versions[0]\"");
  EXPECT_EQ(broken("base64_as", 1), where + ".base64_as must be a text, not number");
  EXPECT_EQ(broken("base64", "AAAA"), where + " has its file twice, by base64 and by base64_as; keep one");
  json own = object;
  own["sources"][0]["base64_as"] = "design";
  EXPECT_NE(errorOf(own).find("design.sources[0] has no key \"base64_as\""), std::string::npos);
  json designed = withVersions(json::array({versionJson("a")}));
  designed["versions"][0]["design"]["sources"][0]["base64_as"] = "design";
  EXPECT_NE(errorOf(designed).find("has a surface of its own and the key base64_as"), std::string::npos);
}

TEST(DesignVersions, LinkedFilesAreFoundFromTheFolderOfTheFile) {
  const Folder files;
  const std::filesystem::path& folder = files.path();
  const std::filesystem::path file = folder / "panel.bladewright";
  Design design;
  design.source().path = folder / "parts" / "panel.step";
  design = withVersion(design, "first").value();
  design.source().path = folder / "other.step";
  ASSERT_TRUE(saveDesign(design, file));
  const json object = json::parse(readFile(file).value());
  EXPECT_EQ(object["sources"][0]["path"], "other.step");
  EXPECT_EQ(object["versions"][0]["design"]["sources"][0]["path"], "parts/panel.step");
  EXPECT_EQ(loadDesign(file).value(), design);
}

TEST(DesignVersions, WhatVariesTheDesignLeavesThemAlone) {
  const Design design = withHistory();
  EXPECT_EQ(withVariables(design, {{"amplitude", 11}}).value().versions, design.versions);
  EXPECT_EQ(resolved(design).value(), design);
  Design noted = design;
  noteSources(noted);
  EXPECT_EQ(noted.versions, design.versions);
}

namespace {

std::string text(const std::vector<DesignDifference>& differences) {
  std::string all;
  for (const DesignDifference& d : differences)
    all += d.pointer + "|" + d.what + "|" + d.before + "|" + d.after + "\n";
  return all;
}

}  // namespace

TEST(DesignDifference, EqualDesignsHaveNone) {
  const Design design = withHistory();
  EXPECT_EQ(text(differences(design, design)), "");
  EXPECT_EQ(text(differences(design, withoutVersions(design))), "");
  Design noted = design;
  noted.source().saved = fingerprintOf("x");
  EXPECT_EQ(text(differences(design, noted)), "");
}

TEST(DesignDifference, NumbersHaveTheirNamesAndUnits) {
  const Design design = withHistory();
  EXPECT_EQ(text(differences(*design.versions[0].design, design)),
            "/variables/0/value|Variable amplitude|40 mm|30 mm\n"
            "/cuts/0/stations|Cut c: stations|21|33\n"
            "/process/kerf|Kerf|0 mm|1.5 mm\n");
  Design other = design;
  other.process.maxPeriods = 1.25;
  other.process.gripAngle = 0.3;
  other.blade.length += 1e-9;
  other.block().placement->size.z() = 400;
  other.block().placement->rotation.z() = 0;
  other.cut().direction.reset();
  other.process.tolerance = 7;  // freed from its expression
  const std::string told = text(differences(design, other));
  EXPECT_NE(told.find("/stock/0/block/size/2|Block b: block, size z|500 mm|400 mm\n"), std::string::npos)
      << told;
  EXPECT_NE(told.find("/stock/0/block/rotation_deg/2|Block b: block, rotation z|7 °|0 °\n"),
            std::string::npos)
      << told;
  EXPECT_NE(told.find("/cuts/0/direction|Cut c: direction|[0.0,1.0,0.0]|auto\n"), std::string::npos) << told;
  EXPECT_NE(told.find("/process/tolerance|Tolerance|=amplitude/20|7 mm\n"), std::string::npos) << told;
  EXPECT_NE(told.find("/process/fit/max_periods|Most waves|1|1.25\n"), std::string::npos) << told;
  EXPECT_NE(told.find("|0.2 °|0.3 °\n"), std::string::npos) << told;
  // However little it is, it is told.
  EXPECT_NE(told.find("000001 mm\n"), std::string::npos) << told;
}

TEST(DesignDifference, PartsAreComparedByTheirNames) {
  const Design design = designOf(kRipple);
  Design other = design;
  Cut more = design.cut();
  more.id = "before";
  more.pose.quarters = 1;
  other.cuts.insert(other.cuts.begin(), more);
  EXPECT_EQ(text(differences(design, other)), "/cuts/0|Cut before||there\n");
  EXPECT_EQ(text(differences(other, design)), "/cuts/0|Cut before|there|\n");
  other.cuts[1].pose.quarters = 2;
  EXPECT_EQ(text(differences(design, other)),
            "/cuts/0|Cut before||there\n/cuts/1/turn_deg|Cut c: turn||180 °\n");
}

TEST(DesignDifference, ManyNumbersOfOneListAreOne) {
  const Design design = designOf(kRipple);
  Design other = design;
  for (SurfacePole& pole : std::get<PolesSurface>(other.source().surface->shape).poles) pole.height += 3;
  std::get<PolesSurface>(other.source().surface->shape).poles.back().height += 2;
  EXPECT_EQ(text(differences(design, other)),
            "/sources/0/surface/poles|Surface s: poles||16 values differ, by at most 5 mm\n");
}

TEST(DesignDifference, IsTold) {
  const Design design = designOf(kRipple);
  Design other = design;
  other.process.kerf = 2;
  other.cut().pose.quarters = 1;
  for (SurfacePole& pole : std::get<PolesSurface>(other.source().surface->shape).poles) pole.height += 3;
  std::string all;
  for (const DesignDifference& difference : differences(design, other)) all += sentenceOf(difference) + "\n";
  EXPECT_EQ(all,
            "Surface s: poles: 16 values differ, by at most 3 mm\n"
            "Cut c: turn: not there → 90 °\n"
            "Kerf: 0 mm → 2 mm\n");
}

TEST(DesignDifference, OfAnotherKindOfSurfaceIsToldAsThatAlone) {
  const Design design = designOf(kRipple);
  Design other = design;
  FormulaSurface formula;
  formula.formula = "250";
  other.source().surface->shape = formula;
  EXPECT_EQ(text(differences(design, other)), "/sources/0/surface/type|Surface s|grid of poles|formula\n");
}

TEST(DesignDifference, EmbeddedFilesAreComparedByTheirBytes) {
  EXPECT_EQ(text(differences(embedded(std::string(2048, 'a')), embedded(std::string(2048, 'b')))),
            "/sources/0/base64|Surface source-1: embedded CAD file|2 KB|another file of 2 KB\n");
  EXPECT_EQ(text(differences(embedded(""), embedded(std::string(1024, 'b')))),
            "/sources/0/base64|Surface source-1: embedded CAD file||1 KB\n");
}

}  // namespace bw
