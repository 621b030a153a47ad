// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// CurveNameMap of the curves that tell a surface.
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
using CurveNameMap = std::map<int, std::string>;

json namedLoft() {
  return json::parse(R"({
    "bladewright_design": 2, "name": "Loft",
    "variables": [{"name": "rise", "value": 240, "min": 200, "max": 300, "unit": "mm"}],
    "sources": [{"id": "loft", "surface": {"type": "sections", "sections": [
       {"y": 0, "spline": [[0, 200], [300, 220], [600, 200]]},
       {"y": 400, "spline": [[0, 200], [300, "=rise"], [600, 200]]},
       {"y": 800, "spline": [[0, 200], [300, 260], [600, 200]]}]},
       "curve_names": {"2": "ridge", "3": "eaves"}}],
    "cuts": [{"id": "c", "source": "loft", "direction": "y", "stations": 21}]
  })");
}

std::string errorOfNames(const json& names) {
  json design = namedLoft();
  design["sources"][0]["curve_names"] = names;
  return test::errorOf(design);
}

CurveNameMap curveNamesOf(const Design& design) { return design.source().curveNames; }

}  // namespace

TEST(CurveNames, AreKeptByTheFileAndByWhatChangesTheDesign) {
  const Design design = test::designOf(namedLoft().dump());
  EXPECT_EQ(curveNamesOf(design), (CurveNameMap{{1, "ridge"}, {2, "eaves"}}));
  EXPECT_EQ(curveTitle(design.source(), 0), "section 1");
  EXPECT_EQ(curveTitle(design.source(), 1), "ridge (section 2)");
  EXPECT_EQ(test::designOf(designToJson(design)), design);
  EXPECT_EQ(curveNamesOf(withVariables(design, {{"rise", 250}}).value()), curveNamesOf(design));
  const Design named = withVersion(design, "first").value();
  EXPECT_EQ(curveNamesOf(*named.versions.front().design), curveNamesOf(design));
  EXPECT_EQ(test::designOf(designToJson(named)), named);
  // A name is a difference of designs that is told.
  Design other = design;
  other.source().curveNames[1] = "crest";
  const std::vector<DesignDifference> told = differences(design, other);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(sentenceOf(told.front()).find("ridge → crest"), std::string::npos) << sentenceOf(told.front());
}

TEST(CurveNames, LeaveFilesWithoutThemAsTheyWere) {
  json without = namedLoft();
  without["sources"][0].erase("curve_names");
  const Design design = test::designOf(without.dump());
  EXPECT_TRUE(curveNamesOf(design).empty());
  EXPECT_EQ(designToJson(design).find("curve_names"), std::string::npos);
  // Of curves that are gone none is written.
  Design few = test::designOf(namedLoft().dump());
  std::get<SectionsSurface>(few.source().surface->shape).sections.pop_back();
  EXPECT_EQ(json::parse(designToJson(few))["sources"][0]["curve_names"], json({{"2", "ridge"}}));
}

TEST(CurveNames, ThatCannotBeAreRefused) {
  const std::string at = "design.sources[0].curve_names";
  EXPECT_EQ(errorOfNames({{"4", "x"}}),
            at + " names the curve \"4\", but the surface has the curves 1 to 3; take it out");
  for (const char* place : {"0", "-1", "02", "2 ", "two", ""})
    EXPECT_NE(errorOfNames({{place, "x"}}).find("names the curve"), std::string::npos) << place;
  EXPECT_EQ(errorOfNames(json::array()),
            at + " must tell names by the places of curves, as {\"2\": \"ridge\"}");
  EXPECT_EQ(errorOfNames({{"2", 7}}), at + ".2 must be a text");
  EXPECT_EQ(errorOfNames({{"2", " "}}), at + ".2: a name must not be empty");
  EXPECT_EQ(errorOfNames({{"2", std::string(61, 'a')}}), at + ".2: a name has 60 characters at most");
  EXPECT_NE(errorOfNames({{"2", "a\nb"}}).find("one line of text"), std::string::npos);
  EXPECT_EQ(errorOfNames({{"1", "a"}, {"2", "a"}}),
            at + " calls two curves \"a\"; give each a name of its own");
  json file = namedLoft();
  file["sources"][0].erase("surface");
  file["sources"][0]["path"] = "roof.step";
  EXPECT_NE(test::errorOf(file).find("the source has no curves"), std::string::npos);
}

TEST(CurveNames, GoWithTheCurvesThatStay) {
  const Design design = test::designOf(namedLoft().dump());
  const auto after = [&](Design next) {
    followNames(design, next);
    return curveNamesOf(next);
  };
  const Design more = withSectionAfter(design, 0, 0).value();
  EXPECT_EQ(after(more), (CurveNameMap{{2, "ridge"}, {3, "eaves"}}));
  EXPECT_EQ(after(withoutSection(design, 0, 1).value()), (CurveNameMap{{1, "eaves"}}));
  EXPECT_EQ(after(withoutSection(design, 0, 0).value()), (CurveNameMap{{0, "ridge"}, {1, "eaves"}}));
  // One that is changed where it is stays the one it is.
  Design moved = design;
  std::get<SectionsSurface>(moved.source().surface->shape).sections[1].points[1].y() = 250;
  EXPECT_EQ(after(moved), curveNamesOf(design));
  Design keys = design;
  keys.source().surface->shape = BladesSurface{{KeyBlade{}, KeyBlade{.y = 400}, KeyBlade{.y = 800}}};
  EXPECT_TRUE(after(keys).empty()) << "key blades in the place of sections are other curves";
  // A step that gives a name itself is left alone.
  Design given = more;
  given.source().curveNames = {{1, "new"}};
  EXPECT_EQ(after(given), (CurveNameMap{{1, "new"}}));
}

}  // namespace bw
