// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/part_marks.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/variables.h"
#include "read_design.h"

namespace bw {

namespace {

using nlohmann::json;

json wall() {
  return json::parse(R"({
    "bladewright_design": 2, "name": "Wall",
    "variables": [{"name": "width", "value": 600, "min": 300, "max": 900, "unit": "mm"}],
    "sources": [{"id": "face", "surface": {"type": "poles", "poles": [
       [200, 210, 210, 200], [200, 210, 210, 200], [200, 210, 210, 200], [200, 210, 210, 200]]}}],
    "grid": {"sizes": {"columns": ["=width", 600], "rows": 800, "layers": 500}},
    "cuts": [{"id": "c", "source": "face", "direction": "y", "stations": 21}],
    "hidden": {"stock": ["column-2"], "stations": ["c-column-1", "c-column-2"]},
    "locked": {"cuts": ["c-column-1"], "sources": ["face"]}
  })");
}

std::string errorWith(json object, const char* key, const json& value) {
  object[key] = value;
  return test::errorOf(object);
}

}  // namespace

TEST(PartMarks, AreKeptByTheFileAndByWhatChangesTheDesign) {
  const Design design = test::designOf(wall().dump());
  EXPECT_EQ(design.marks.hidden.stock, std::set<std::string>{"column-2"});
  EXPECT_EQ(design.marks.hidden.stations, (std::set<std::string>{"c-column-1", "c-column-2"}));
  EXPECT_EQ(design.marks.locked.cuts, std::set<std::string>{"c-column-1"});
  EXPECT_EQ(design.marks.locked.sources, std::set<std::string>{"face"});
  EXPECT_EQ(test::designOf(designToJson(design)), design);
  EXPECT_EQ(withVariables(design, {{"width", 650}}).value().marks, design.marks);
  // A name for a state, and going back to one, leave them as they are now.
  Design named = withVersion(design, "first").value();
  EXPECT_EQ(named.marks, design.marks);
  EXPECT_EQ(named.versions.front().design->marks, PartMarks());
  named.marks.hidden = {};
  EXPECT_EQ(atVersion(named, "first").value().marks, named.marks);
  EXPECT_EQ(test::designOf(designToJson(named)), named);
}

TEST(PartMarks, AreNothingThatDesignsDifferBy) {
  const Design design = test::designOf(wall().dump());
  Design bare = design;
  bare.marks = {};
  EXPECT_TRUE(differences(design, bare).empty());
  EXPECT_EQ(withoutVersions(design), bare);
  EXPECT_FALSE(json::parse(designToJson(bare)).contains("hidden"));
  EXPECT_FALSE(json::parse(designToJson(bare)).contains("locked"));
}

TEST(PartMarks, OfPartsThatAreGoneAreNotWritten) {
  Design design = test::designOf(wall().dump());
  design.marks.hidden.cuts = {"of before", "c-column-2"};
  design.marks.locked.stock = {"of before"};
  const json written = json::parse(designToJson(design));
  EXPECT_EQ(written["hidden"]["cuts"], json({"c-column-2"}));
  EXPECT_FALSE(written["locked"].contains("stock"));
  EXPECT_TRUE(parseDesign(written.dump()));
}

TEST(PartMarks, ThatCannotBeAreRefused) {
  EXPECT_EQ(errorWith(wall(), "hidden", {{"cuts", {"c"}}}),
            "design.hidden.cuts names \"c\", but the design has no cut of that id; take it out of the list");
  EXPECT_EQ(errorWith(wall(), "hidden", {{"stock", "column-2"}}),
            "design.hidden.stock must be a list of ids");
  EXPECT_EQ(errorWith(wall(), "locked", {{"sources", {7}}}), "design.locked.sources must be a list of ids");
  EXPECT_NE(errorWith(wall(), "locked", {{"stations", {"c-column-1"}}}).find("stations"), std::string::npos);
  EXPECT_NE(errorWith(wall(), "hidden", {{"cut", json::array()}}).find("did you mean \"cuts\""),
            std::string::npos);
  EXPECT_NE(errorWith(wall(), "hiden", json::object()).find("did you mean \"hidden\""), std::string::npos);
  json state = wall();
  state["versions"] = {{{"name", "first"}, {"design", wall()}}};
  EXPECT_NE(errorWith(state, "name", "Wall").find("design.versions[0].design has the key hidden"),
            std::string::npos);
}

}  // namespace bw
