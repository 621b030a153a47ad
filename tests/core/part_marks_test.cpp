// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/part_marks.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/section_list.h"
#include "bw/core/design/surface_curves.h"
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
  EXPECT_NE(errorWith(wall(), "locked", {{"stations", {"c-column-9"}}}).find("no cut of that id"),
            std::string::npos);
  EXPECT_NE(errorWith(wall(), "hidden", {{"cut", json::array()}}).find("did you mean \"cuts\""),
            std::string::npos);
  EXPECT_NE(errorWith(wall(), "hiden", json::object()).find("did you mean \"hidden\""), std::string::npos);
  json state = wall();
  state["versions"] = {{{"name", "first"}, {"design", wall()}}};
  EXPECT_NE(errorWith(state, "name", "Wall").find("design.versions[0].design has the key hidden"),
            std::string::npos);
}

namespace {

/// A loft of three sections, the second hidden and the third locked.
json loft() {
  return json::parse(R"({
    "bladewright_design": 2, "name": "Loft",
    "sources": [{"id": "loft", "surface": {"type": "sections", "sections": [
       {"y": 0, "spline": [[0, 200], [300, 220], [600, 200]]},
       {"y": 400, "spline": [[0, 200], [300, 240], [600, 200]]},
       {"y": 800, "spline": [[0, 200], [300, 260], [600, 200]]}]}}],
    "cuts": [{"id": "c", "source": "loft", "direction": "y", "stations": 21}],
    "hidden": {"curves": ["loft/2"]}, "locked": {"curves": ["loft/3"]}
  })");
}

PartIds ofSources(std::set<std::string> ids) {
  PartIds marked;
  marked.sources = std::move(ids);
  return marked;
}

}  // namespace

TEST(PartMarks, OfCurvesStandInAListOfTheirOwn) {
  const Design design = test::designOf(loft().dump());
  EXPECT_EQ(design.marks.hidden, ofSources({"loft/2"}));
  EXPECT_EQ(design.marks.locked, ofSources({"loft/3"}));
  const json written = json::parse(designToJson(design));
  EXPECT_EQ(written["hidden"], json({{"curves", {"loft/2"}}}));
  EXPECT_EQ(written["locked"], json({{"curves", {"loft/3"}}}));
  EXPECT_EQ(test::designOf(written.dump()), design);
  // The surface itself is marked beside its curves, and curves that are gone are not written.
  Design other = design;
  other.marks.hidden.sources = {"loft", "loft/1", "loft/4", "loft/01", "loft/", "face/1"};
  EXPECT_EQ(json::parse(designToJson(other))["hidden"],
            json({{"sources", {"loft"}}, {"curves", {"loft/1"}}}));
  for (const char* id : {"loft/0", "loft/4", "loft/01", "loft", "loft/x", "face/1"})
    EXPECT_NE(errorWith(loft(), "hidden", {{"curves", {id}}}).find("has no curve of that id"),
              std::string::npos)
        << id;
  EXPECT_EQ(curveOf(design, "loft/2")->source, "loft");
  EXPECT_EQ(curveOf(design, "loft/2")->curve, 1);
}

TEST(PartMarks, OfCurvesGoWithThem) {
  const Design design = test::designOf(loft().dump());
  const auto after = [&](const Design& next) { return followed(design.marks, design, next); };
  // One comes between the first two, and one goes.
  const Design more = withSectionAfter(design, 0, 0).value();
  ASSERT_EQ(curveCount(*more.source().surface), 4);
  EXPECT_EQ(after(more).hidden, ofSources({"loft/3"}));
  EXPECT_EQ(after(more).locked, ofSources({"loft/4"}));
  EXPECT_EQ(followed(after(more), more, design), design.marks) << "and back";
  const Design less = withoutSection(design, 0, 1).value();
  EXPECT_EQ(after(less).hidden, PartIds()) << "it is gone itself";
  EXPECT_EQ(after(less).locked, ofSources({"loft/2"}));
  // One that is changed where it is stays the one it is.
  Design moved = design;
  std::get<SectionsSurface>(moved.source().surface->shape).sections[1].points[1].y() = 250;
  EXPECT_EQ(after(moved), design.marks);
  // Key blades in the place of sections are other curves; without the surface undo may bring it back.
  Design keys = design;
  keys.source().surface->shape = BladesSurface{{KeyBlade{}, KeyBlade{.y = 400}, KeyBlade{.y = 800}}};
  EXPECT_EQ(after(keys), PartMarks());
  Design renamed = design;
  renamed.source().id = renamed.cut().source = "other";
  EXPECT_EQ(after(renamed), design.marks);
}

TEST(PartMarks, KnowARowOfPolesByItsPlaceAndItsPoles) {
  const Design design = test::designOf(wall().dump());
  const DesignedSurface& face = *design.source().surface;
  EXPECT_EQ(curveCount(face), 4);
  EXPECT_TRUE(isSameCurve(face, 1, face, 1));
  EXPECT_FALSE(isSameCurve(face, 1, face, 2)) << "they are alike, but lie elsewhere";
  DesignedSurface other = face;
  std::get<PolesSurface>(other.shape).at(2, 0).height += 1;
  EXPECT_TRUE(isSameCurve(face, 1, other, 1));
  EXPECT_FALSE(isSameCurve(face, 2, other, 2));
  other = face;
  other.origin.x() = 5;
  EXPECT_FALSE(isSameCurve(face, 1, other, 1)) << "with its frame it lies elsewhere";
}

}  // namespace bw
