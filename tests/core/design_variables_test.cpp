// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/variables.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/design/blade_bindings.h"
#include "bw/core/design/design.h"
#include "bw/core/design/section_list.h"
#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/section_tangents.h"
#include "read_design.h"

namespace bw {

namespace {

using nlohmann::json;
using test::designOf;
using test::errorOf;

const char* const kDesign = R"({
  "bladewright_design": 2, "name": "Ripple",
  "variables": [{"name": "amplitude", "value": 40, "min": 0, "max": 80, "unit": "mm"},
                {"name": "width", "value": 600, "min": 300, "max": 700, "unit": "mm"},
                {"name": "n", "value": 33, "min": 2, "max": 100}],
  "sources": [{"id": "s", "surface": {"type": "poles", "x": [0, "=width"], "poles": [
     [200, 210, 210, 200], [200, {"height": "=200 + amplitude/2", "moved": [5, "=-amplitude"]}, 210, 200],
     [200, 210, 210, 200], [200, 210, 210, 200]]}}],
  "stock": [{"id": "b", "block": {"origin": [0, 0, 0], "size": ["=width", 800, 500], "rotation_deg": [0, 0, "=n/3"]}}],
  "cuts": [{"source": "s", "block": "b", "direction": "y", "stations": "=n"}],
  "blade": {"preset": "steel-tube-3-2.5", "length": "=width + 200"},
  "process": {"tolerance": "=amplitude/20", "fit": {"max_periods": "=1 + 0.01"}}
})";

const PolesSurface& polesOf(const Design& design) {
  return std::get<PolesSurface>(design.source().surface->shape);
}

json withSurface(const std::string& surface) {
  return {{"bladewright_design", 2},
          {"variables", {{{"name", "amplitude"}, {"value", 40}, {"min", 0}, {"max", 80}}}},
          {"sources", {{{"surface", json::parse(surface)}}}}};
}

}  // namespace

TEST(DesignVariables, NumbersMayBeToldByExpressions) {
  const Design design = designOf(kDesign);
  EXPECT_EQ(polesOf(design).over.max.x(), 600);
  EXPECT_EQ(polesOf(design).at(1, 1).height, 220);
  EXPECT_EQ(polesOf(design).at(1, 1).moved, Eigen::Vector2d(5, -40));
  EXPECT_EQ(design.block().placement->size.x(), 600);
  EXPECT_NEAR(design.block().placement->rotation.z(), 11 * kDegree, 1e-15);
  EXPECT_EQ(design.cut().sections.stations, 33);
  EXPECT_EQ(design.blade.length, 800);
  EXPECT_EQ(design.process.tolerance, 2);
  EXPECT_EQ(design.process.maxPeriods, 1.01);
  EXPECT_EQ(design.bindings.size(), 9u);
  EXPECT_EQ(design.bindings.at("/sources/0/surface/poles/1/1/height").text, "200 + amplitude/2");
}

TEST(DesignVariables, WhatWasWrittenIsSavedAgain) {
  const Design design = designOf(kDesign);
  const std::string once = designToJson(design);
  const json object = json::parse(once);
  EXPECT_EQ(object["sources"][0]["surface"]["poles"][1][1]["height"], "=200 + amplitude/2");
  EXPECT_EQ(object["stock"][0]["block"]["rotation_deg"][2], "=n/3");
  EXPECT_EQ(object["cuts"][0]["stations"], "=n");
  EXPECT_EQ(object["blade"]["length"], "=width + 200");
  EXPECT_EQ(object["process"]["fit"]["max_periods"], "=1 + 0.01");
  const Design again = designOf(once);
  EXPECT_EQ(designToJson(again), once);
  EXPECT_EQ(again.source(), design.source());
  EXPECT_EQ(again.variables, design.variables);
}

TEST(DesignVariables, ExpressionsOfPolesAndFramesStayWhereTheyComeToNothing) {
  const Design design = designOf(withSurface(R"({"type": "poles", "degree": [1, 1], "poles": [
      [1, {"height": "=amplitude"}], [{"height": 2, "moved": ["=amplitude - 40", 0]}, "=amplitude*2"]],
      "frame": {"origin": [0, 0, "=amplitude - 40"], "rotation_deg": [0, 0, 0]}})")
                                     .dump());
  EXPECT_EQ(design.bindings.size(), 4u);
  const Design other = withVariables(design, {{"amplitude", 41}}).value();
  EXPECT_EQ(polesOf(other).at(0, 1).height, 41);
  EXPECT_EQ(polesOf(other).at(1, 0).moved.x(), 1);
  EXPECT_EQ(polesOf(other).at(1, 1).height, 82);
  EXPECT_EQ(other.source().surface->origin.z(), 1);
  EXPECT_EQ(withVariables(other, {{"amplitude", 40}}).value(), design);
}

TEST(DesignVariables, ExpressionsStayWhereTheyComeToWhatIsUsual) {
  json object = json::parse(kDesign);
  object["variables"].push_back({{"name", "turn"}, {"value", 0}, {"min", 0}, {"max", 270}});
  object["cuts"][0]["turn_deg"] = "=turn";
  object["cuts"][0]["offset"] = "=turn/10";
  object["blade"]["thickness"] = "=turn/90";  // which a tube has not
  const Design design = designOf(object.dump());
  EXPECT_EQ(design.bindings.size(), 12u);
  const json written = json::parse(designToJson(design));
  EXPECT_EQ(written["cuts"][0]["turn_deg"], "=turn");
  EXPECT_EQ(written["cuts"][0]["offset"], "=turn/10");
  EXPECT_EQ(written["blade"]["thickness"], "=turn/90");
  EXPECT_EQ(designOf(written.dump()), design);
  const Design turned = withVariables(design, {{"turn", 90}}).value();
  EXPECT_EQ(turned.cut().pose.quarters, 1);
  EXPECT_EQ(turned.cut().offset, 9);
  EXPECT_EQ(turned.blade.thickness, 1);
  EXPECT_EQ(withVariables(turned, {{"turn", 0}}).value(), design);
  // One that was changed since is free, and as usual it is left out.
  Design freed = turned;
  freed.cut().pose.quarters = 0;
  EXPECT_EQ(json::parse(designToJson(freed))["cuts"][0].value("turn_deg", 0), 0);
  EXPECT_EQ(withVariables(freed, {{"turn", 180}}).value().cut().pose.quarters, 0);
  // So do those of the cuts under a grid.
  object.erase("stock");
  object["grid"] = {{"columns", 2}, {"sizes", {{"columns", "=width"}}}};
  object["cuts"][0].erase("block");
  const Design wall = designOf(object.dump());
  EXPECT_EQ(json::parse(designToJson(wall))["cuts"][0]["turn_deg"], "=turn");
  const Design half = withVariables(wall, {{"turn", 180}}).value();
  for (const Cut& cut : half.cuts) EXPECT_EQ(cut.pose.quarters, 2);
}

TEST(DesignVariables, ExpressionsOfCutsUnderAGridStayWithTheirCuts) {
  json object = json::parse(kDesign);
  object.erase("stock");
  object["grid"] = {{"columns", 3}};
  // The cut of one block stands before that of all.
  object["cuts"] = {{{"id", "own"}, {"block", "column-3"}, {"stations", "=n + 8"}},
                    {{"id", "cut-column-2"}, {"block", "column-2"}, {"stations", "=n + 4"}},
                    {{"id", "cut"}, {"stations", "=n"}}};
  const Design design = designOf(object.dump());
  const auto stationsOf = [](const Design& of) {
    std::map<std::string, int> stations;
    for (const Cut& cut : of.cuts) stations[cut.id] = cut.sections.stations.value_or(0);
    return stations;
  };
  using Stations = std::map<std::string, int>;
  EXPECT_EQ(stationsOf(design),
            (Stations{{"cut-column-1", 33}, {"cut-column-2", 37}, {"cut-column-3", 33}, {"own", 41}}));
  const std::string text = designToJson(design);
  std::map<std::string, std::string> told;
  const json written = json::parse(text);
  for (const json& cut : written["cuts"]) told[cut["id"]] = cut["stations"].dump();
  EXPECT_EQ(told, (std::map<std::string, std::string>{
                      {"cut", "\"=n\""}, {"cut-column-2", "\"=n + 4\""}, {"own", "\"=n + 8\""}}));
  EXPECT_EQ(designToJson(designOf(text)), text);
  EXPECT_EQ(stationsOf(withVariables(design, {{"n", 20}}).value()),
            (Stations{{"cut-column-1", 20}, {"cut-column-2", 24}, {"cut-column-3", 20}, {"own", 28}}));
}

TEST(DesignVariables, AnotherValueChangesWhatHangsOnItAlone) {
  const Design design = designOf(kDesign);
  const Result<Design> wide = withVariables(design, {{"width", 650}, {"amplitude", 60}});
  ASSERT_TRUE(wide) << wide.error().message;
  EXPECT_EQ(polesOf(*wide).over.max.x(), 650);
  EXPECT_EQ(polesOf(*wide).at(1, 1).height, 230);
  EXPECT_EQ(wide->blade.length, 850);
  EXPECT_EQ(wide->process.tolerance, 3);
  EXPECT_EQ(wide->cut(), design.cut());
  EXPECT_EQ(withVariables(*wide, {{"width", 600}, {"amplitude", 40}}).value(), design);
  EXPECT_EQ(resolved(design).value(), design);
}

TEST(DesignVariables, ANumberThatIsTypedOverIsFreeOfItsExpression) {
  Design design = designOf(kDesign);
  design.process.tolerance = 1.25;
  EXPECT_EQ(json::parse(designToJson(design))["process"]["tolerance"], 1.25);
  const Design other = withVariables(design, {{"amplitude", 80}}).value();
  EXPECT_EQ(other.process.tolerance, 1.25);
  EXPECT_EQ(other.bindings.count("/process/tolerance"), 0u);
  EXPECT_EQ(other.bindings.count("/process/fit/max_periods"), 1u);
}

TEST(DesignVariables, UnknownNamesAndValuesOutOfRangeAreErrorsThatSayMore) {
  const Design design = designOf(kDesign);
  EXPECT_EQ(withVariables(design, {{"amplitud", 3}}).error().message,
            "the design has no variable \"amplitud\"; did you mean \"amplitude\"?");
  EXPECT_EQ(withVariables(design, {{"height", 3}}).error().message,
            "the design has no variable \"height\"; it has amplitude, width, n");
  EXPECT_EQ(withVariables(design, {{"width", 900}}).error().message,
            "width is 900 mm but must lie between 300 and 700 mm");
  EXPECT_EQ(withVariables(design, {{"amplitude", 0}}).error().message,
            "design.process.tolerance is 0 (=amplitude/20) but must lie between 0.0001 and 1000");
  EXPECT_EQ(withVariables(design, {{"n", 2.5}}).error().message,
            "design.cuts[0].stations is 2.5 but must be a whole number from 2 to 20000");
  EXPECT_NE(withVariables(Design{}, {{"a", 1}}).error().message.find("no variables"), std::string::npos);
}

TEST(DesignVariables, DirectionsMayBeToldByExpressions) {
  json object = json::parse(kDesign);
  object["cuts"][0]["direction"] = {"=amplitude/100", 1, 0};
  object["process"]["up"] = {0, "=amplitude - 40", 2};
  const Design design = designOf(object.dump());
  EXPECT_EQ(*design.cut().direction, Eigen::Vector3d(0.4, 1, 0)) << "the numbers stay as they were told";
  EXPECT_EQ(design.process.up, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(design.bindings.at("/cuts/0/direction/0").text, "amplitude/100");
  const json written = json::parse(designToJson(design));
  EXPECT_EQ(written["cuts"][0]["direction"], json({"=amplitude/100", 1.0, 0.0}));
  EXPECT_EQ(written["process"]["up"][1], "=amplitude - 40");
  EXPECT_EQ(designOf(written.dump()), design);
  const Design other = withVariables(design, {{"amplitude", 50}}).value();
  EXPECT_EQ(*other.cut().direction, Eigen::Vector3d(0.5, 1, 0));
  EXPECT_EQ(other.process.up, Eigen::Vector3d(0, 10, 2));
  EXPECT_EQ(withVariables(other, {{"amplitude", 40}}).value(), design);
  // Without one its length is one, as ever.
  object["cuts"][0]["direction"] = {3, 4, 0};
  EXPECT_EQ(*designOf(object.dump()).cut().direction, Eigen::Vector3d(0.6, 0.8, 0));
}

TEST(DesignVariables, ExpressionsStandOnlyForNumbersThatStayAsWritten) {
  json object = json::parse(kDesign);
  object["cuts"][0]["direction"] = {0, "n", 1};
  EXPECT_EQ(errorOf(object), "design.cuts[0].direction[1] must be a number, not string");
  object["cuts"][0]["direction"] = {0, "=n - 33", 0};
  EXPECT_EQ(errorOf(object), "design.cuts[0].direction has length zero; give the way the blade travels");
  object = json::parse(kDesign);
  object["process"]["tolerance"] = "2";
  EXPECT_EQ(errorOf(object), "design.process.tolerance must be a number, not string");
  object["process"]["tolerance"] = "=amplitude*";
  EXPECT_EQ(errorOf(object),
            "design.process.tolerance, after its =, character 11: the formula ends where a number, a name or "
            "an opening "
            "bracket is expected");
  EXPECT_NE(parseJob(R"({"tolerance": "=2"})").error().message.find("must be a number"), std::string::npos);
}

TEST(DesignVariables, VariablesAreReadStrictly) {
  const auto with = [](json variable) {
    json object = json::parse(kDesign);
    object["variables"].push_back(std::move(variable));
    return errorOf(object);
  };
  EXPECT_NE(with({{"name", "x"}, {"value", 1}, {"min", 0}, {"max", 2}}).find("not x, y"), std::string::npos);
  EXPECT_NE(with({{"name", "a b"}, {"value", 1}, {"min", 0}, {"max", 2}}).find("a letter"),
            std::string::npos);
  EXPECT_NE(with({{"name", "n"}, {"value", 1}, {"min", 0}, {"max", 2}}).find("\"n\" twice"),
            std::string::npos);
  EXPECT_NE(
      with({{"name", "a"}, {"value", 3}, {"min", 0}, {"max", 2}}).find("is 3 but must lie between 0 and 2"),
      std::string::npos);
  EXPECT_NE(with({{"name", "a"}, {"value", 3}}).find("needs the key min"), std::string::npos);
  EXPECT_NE(with({{"name", "a"}, {"valeu", 3}}).find("did you mean \"value\"?"), std::string::npos);
}

TEST(DesignedSurfaceFiles, EachKindIsReadAndWritten) {
  for (const char* text :
       {R"({"type": "poles", "x": [-10, 600], "y": [0, 700], "degree": [2, 1],
            "poles": [[1, 2, 3], [4, {"height": 5, "moved": [1, -2]}, 6]]})",
        R"-({"type": "formula", "x": [0, 600], "y": [0, 800], "formula": "250 + amplitude*sin(x/100)"})-",
        R"({"type": "sections", "loft": "root", "sections": [
             {"y": 0, "bezier": [[0, 200], [300, 260], [600, 200]]},
             {"y": 800, "spline": [[0, 200], [300, "=amplitude"], [600, 200]]}],
            "frame": {"origin": [1, 2, 3], "rotation_deg": [0, 90, 0]}})",
        R"({"type": "sections", "loft": "chord", "sections": [
             {"y": 0, "bezier": [[0, 200], [100, 220], [200, 240], [300, 260], [400, 280], [500, 230], [600, 200]]},
             {"y": 800, "ducks": [[0, 200], [300, "=amplitude"], [600, 200]]}]})",
        R"({"type": "blades", "blades": [
             {"y": 0, "middle": [300, 200], "angle_deg": 4.1, "length_mm": 610, "bend": -0.7, "force": [3, -1]},
             {"y": 800, "middle": [300, "=amplitude"], "angle_deg": "=amplitude/7", "length_mm": 620, "bend": 0.0,
              "force": [0.0, 0.0]}]})"}) {
    const Design design = designOf(withSurface(text).dump());
    ASSERT_TRUE(design.source().surface);
    const json written = json::parse(designToJson(design))["sources"][0];
    EXPECT_EQ(written["surface"], json::parse(text));
    EXPECT_EQ(written.count("path"), 0u);
    EXPECT_EQ(designOf(designToJson(design)), design);
  }
}

namespace {

/// Two key blades, what the second one has besides.
std::string keyBlades(const std::string& second, const std::string& middle = "[300, 200]") {
  return R"({"type": "blades", "blades": [
             {"y": 0, "middle": [300, 200], "angle_deg": 4.1, "length_mm": 610, "bend": -0.7, "force": [3, -1]},
             {"y": 800, "middle": )" +
         middle + R"(, "length_mm": 620, "bend": -0.5, "force": [2, 1])" + second + "}]}";
}

const KeyBlade& secondOf(const Design& design) {
  return std::get<BladesSurface>(design.source().surface->shape).blades[1];
}

std::array<Eigen::Vector2d, 2> secondEnds(const Design& design) {
  return bladeEnds(secondOf(design)).value();
}

}  // namespace

TEST(DesignedSurfaceFiles, EndsOfKeyBladesStandForExpressions) {
  const Design plain = designOf(withSurface(keyBlades("")).dump());
  const auto before = secondEnds(plain);
  // One end: the blade turns about the other as it is.
  const Design one = designOf(withSurface(keyBlades(R"(, "end_heights": ["=amplitude*6", null])")).dump());
  EXPECT_NEAR(secondEnds(one)[0].y(), 240, 1e-9);
  EXPECT_LT((secondEnds(one)[1] - before[1]).norm(), 1e-9);
  EXPECT_EQ(secondOf(one).length, 620);
  EXPECT_EQ(secondOf(one).bend, -0.5);
  // It is read as it was written, to the last bit.
  const json written = json::parse(designToJson(one))["sources"][0]["surface"]["blades"][1];
  EXPECT_EQ(written["end_heights"], json::parse(R"(["=amplitude*6", null])"));
  EXPECT_EQ(designOf(designToJson(one)), one);
  EXPECT_EQ(resolved(one).value(), one);
  // It follows, and comes back.
  const Design other = withVariables(one, {{"amplitude", 45}}).value();
  EXPECT_NEAR(secondEnds(other)[0].y(), 270, 1e-9);
  EXPECT_LT((secondEnds(other)[1] - before[1]).norm(), 1e-9);
  const Design back = withVariables(other, {{"amplitude", 40}}).value();
  EXPECT_LT((secondEnds(back)[0] - secondEnds(one)[0]).norm(), 1e-9);
  EXPECT_EQ(back.bindings, one.bindings);
  // Nothing, too, is a height.
  const Design zero =
      designOf(withSurface(keyBlades(R"(, "end_heights": [null, "=amplitude - 40"])", "[300, 20]")).dump());
  EXPECT_NEAR(secondEnds(zero)[1].y(), 0, 1e-9);
  EXPECT_EQ(json::parse(designToJson(zero))["sources"][0]["surface"]["blades"][1]["end_heights"][1],
            "=amplitude - 40");
  // Both: the middle of the chord keeps its place along x.
  const Design both =
      designOf(withSurface(keyBlades(R"(, "end_heights": ["=amplitude*6", "=amplitude*5"])")).dump());
  EXPECT_NEAR(secondEnds(both)[0].y(), 240, 1e-9);
  EXPECT_NEAR(secondEnds(both)[1].y(), 200, 1e-9);
  EXPECT_NEAR((secondEnds(both)[0] + secondEnds(both)[1]).x(), (before[0] + before[1]).x(), 1e-9);
  EXPECT_EQ(designOf(designToJson(both)), both);
  // A number turns it once, and is then what the middle tells.
  const Design number = designOf(withSurface(keyBlades(R"(, "end_heights": [240, null])")).dump());
  EXPECT_EQ(secondOf(number), secondOf(one));
  EXPECT_FALSE(
      json::parse(designToJson(number))["sources"][0]["surface"]["blades"][1].contains("end_heights"));
  // Typed over: the blade was moved by hand, and its end is free.
  Design moved = one;
  std::get<BladesSurface>(moved.source().surface->shape).blades[1].middle.y() += 5;
  const Design freed = resolved(moved).value();
  EXPECT_TRUE(freed.bindings.empty());
  EXPECT_NEAR(secondEnds(freed)[0].y(), 245, 1e-9);
}

TEST(DesignedSurfaceFiles, KeyBladesTurn) {
  const auto second = [](const Design& design) {
    return json::parse(designToJson(design))["sources"][0]["surface"]["blades"][1];
  };
  // Files without are written as they were.
  EXPECT_FALSE(second(designOf(withSurface(keyBlades("")).dump())).contains("turn_deg"));
  const Design number = designOf(withSurface(keyBlades(R"(, "turn_deg": -12.3)")).dump());
  EXPECT_NEAR(secondOf(number).turn, -fromDegrees(12.3), 1e-15);
  EXPECT_EQ(second(number)["turn_deg"], -12.3);
  EXPECT_EQ(designOf(designToJson(number)), number);
  const Design bound = designOf(withSurface(keyBlades(R"(, "turn_deg": "=amplitude/4")")).dump());
  EXPECT_NEAR(secondOf(bound).turn, fromDegrees(10), 1e-15);
  EXPECT_EQ(second(bound)["turn_deg"], "=amplitude/4");
  EXPECT_EQ(designOf(designToJson(bound)), bound);
  // Nothing is told by an expression, too.
  const Design zero = designOf(withSurface(keyBlades(R"(, "turn_deg": "=amplitude - 40")")).dump());
  EXPECT_EQ(secondOf(zero).turn, 0);
  EXPECT_EQ(second(zero)["turn_deg"], "=amplitude - 40");
  EXPECT_NEAR(secondOf(withVariables(zero, {{"amplitude", 45}}).value()).turn, fromDegrees(5), 1e-15);
  EXPECT_NE(errorOf(withSurface(keyBlades(R"(, "turn_deg": 85)"))).find("turn_deg"), std::string::npos);
}

TEST(DesignedSurfaceFiles, EndsKeepTheirHeightsWhereTheBladeIsMadeLonger) {
  const Design one = designOf(withSurface(keyBlades(R"(, "end_heights": ["=amplitude*6", null])")).dump());
  Design longer = one;
  std::get<BladesSurface>(longer.source().surface->shape).blades[1].length = 700;
  ASSERT_TRUE(holdEnds(longer, one));
  EXPECT_NEAR(secondEnds(longer)[0].y(), 240, 1e-9);
  EXPECT_EQ(resolved(longer).value().bindings, one.bindings);
  const Design high = designOf(withSurface(keyBlades(R"(, "end_heights": ["=amplitude*8", null])")).dump());
  Design shorter = high;
  std::get<BladesSurface>(shorter.source().surface->shape).blades[1].length = 10;
  EXPECT_FALSE(holdEnds(shorter, high)) << "its ends are nearer to each other than the heights";
  // An expression for the place of the middle takes that of the end away, and the other way round.
  const std::string blade = "/sources/0/surface/blades/1";
  auto bindings = one.bindings;
  bindings[blade + "/middle/1"] = {"amplitude", 40};
  bindings["/sources/0/surface/blades/0/angle_deg"] = {"amplitude/10", 4};
  freeRivals(bindings, blade + "/middle/1");
  EXPECT_FALSE(bindings.contains(blade + "/end_heights/0"));
  bindings[blade + "/end_heights/1"] = {"amplitude", 40};
  freeRivals(bindings, blade + "/end_heights/1");
  EXPECT_FALSE(bindings.contains(blade + "/middle/1"));
  EXPECT_TRUE(bindings.contains("/sources/0/surface/blades/0/angle_deg")) << "of another blade";
}

TEST(DesignedSurfaceFiles, SlipsInEndHeightsAreNamed) {
  const auto message = [](const std::string& second, const std::string& middle = "[300, 200]") {
    return errorOf(withSurface(keyBlades(second, middle)));
  };
  EXPECT_NE(message(R"(, "end_heights": [1])").find("must be two heights in mm"), std::string::npos);
  EXPECT_NE(message(R"(, "end_heights": ["a", 2])").find("end_heights[0] must be a number"),
            std::string::npos);
  EXPECT_NE(message(R"(, "end_heights": ["=amplitde", 2])").find("did you mean"), std::string::npos);
  EXPECT_NE(message(R"(, "end_heights": [1000, 200])").find("that one cannot lie 800 mm higher"),
            std::string::npos)
      << message(R"(, "end_heights": [1000, 200])");
  EXPECT_NE(message(R"(, "end_heights": [100, null])", R"([300, "=amplitude"])").find("cannot be told by"),
            std::string::npos);
  EXPECT_NE(message(R"(, "angle_deg": "=amplitude", "end_heights": [100, null])").find("cannot be told by"),
            std::string::npos);
  EXPECT_EQ(message(R"(, "end_heights": null)"), "accepted");
  EXPECT_EQ(message(R"(, "end_heights": [null, null])", R"([300, "=amplitude"])"), "accepted");
}

namespace {

/// A loft of a line and of two cubics, whose second has that beside its poles.
std::string loftOfCubics(const std::string& more, const std::string& leg = "[400, 250]") {
  return R"({"type": "sections", "sections": [{"y": 0, "bezier": [[0, 200], [600, 200]]},
      {"y": 800, "bezier": [[0, 200], [100, 200], [200, 230], [300, 240], )" +
         leg + R"(, [500, 200], [600, 200]])" + more + "}]}";
}

const SectionCurve& secondSection(const Design& design) {
  return std::get<SectionsSurface>(design.source().surface->shape).sections[1];
}

constexpr const char* kSecondTangent = "/sources/0/surface/sections/1/tangents_deg/1";

}  // namespace

TEST(DesignedSurfaceFiles, TangentsOfSectionsMayBeToldByExpressions) {
  const Design plain = designOf(withSurface(loftOfCubics("")).dump());
  EXPECT_EQ(jointCount(secondSection(plain)), 3u);
  const Design one =
      designOf(withSurface(loftOfCubics(R"(, "tangents_deg": [null, "=amplitude/2", null])")).dump());
  EXPECT_NEAR(*tangentAt(secondSection(one), 1), 20, 1e-9);
  const auto legs = [](const Design& design) {
    const auto& p = secondSection(design).points;
    return std::array{(p[3] - p[2]).norm(), (p[4] - p[3]).norm()};
  };
  for (const std::size_t leg : {0u, 1u}) EXPECT_NEAR(legs(one)[leg], legs(plain)[leg], 1e-9);
  EXPECT_EQ(secondSection(one).points[3], secondSection(plain).points[3]);
  EXPECT_EQ(secondSection(one).points[1], secondSection(plain).points[1]) << "other legs follow the poles";
  const json written = json::parse(designToJson(one))["sources"][0]["surface"]["sections"][1];
  EXPECT_EQ(written["tangents_deg"], json({nullptr, "=amplitude/2", nullptr}));
  EXPECT_EQ(designOf(designToJson(one)), one);
  const Design other = withVariables(one, {{"amplitude", 30}}).value();
  EXPECT_NEAR(*tangentAt(secondSection(other), 1), 15, 1e-9);
  EXPECT_EQ(other.bindings.at(kSecondTangent).value, 15);
  // More than half a turn is the angle that was meant, too.
  const Design back =
      designOf(withSurface(loftOfCubics(R"(, "tangents_deg": [null, "=amplitude*5", null])")).dump());
  EXPECT_NEAR(*tangentAt(secondSection(back), 1, 200), 200, 1e-9);
  EXPECT_EQ(back.bindings.size(), 1u);
  EXPECT_EQ(resolved(back).value(), back);
  // A number turns the legs once, and files without the key are as they were.
  const Design number = designOf(withSurface(loftOfCubics(R"(, "tangents_deg": [null, 20, null])")).dump());
  EXPECT_LT((secondSection(number).points[4] - secondSection(one).points[4]).norm(), 1e-9);
  EXPECT_EQ(designToJson(number).find("tangents_deg"), std::string::npos);
  EXPECT_EQ(designToJson(plain).find("tangents_deg"), std::string::npos);
  // A leg that was pulled frees it.
  Design pulled = one;
  std::get<SectionsSurface>(pulled.source().surface->shape).sections[1].points[4].y() += 5;
  EXPECT_TRUE(resolved(pulled).value().bindings.empty());
}

TEST(DesignedSurfaceFiles, TangentsStayWhereTheJointIsMovedAndGoWithItWhereOthersCome) {
  const Design one =
      designOf(withSurface(loftOfCubics(R"(, "tangents_deg": [null, "=amplitude/2", null])")).dump());
  Design moved = one;
  std::get<SectionsSurface>(moved.source().surface->shape).sections[1].points[3].y() += 10;
  holdTangents(moved, one);
  EXPECT_NEAR(*tangentAt(secondSection(moved), 1), 20, 1e-9);
  EXPECT_EQ(resolved(moved).value().bindings, one.bindings);
  // Another cubic before it, and one less.
  const Design more = withPointAfter(one, 0, 1, 0).value();
  EXPECT_EQ(more.bindings.begin()->first, "/sources/0/surface/sections/1/tangents_deg/2");
  EXPECT_EQ(resolved(more).value().bindings, more.bindings);
  EXPECT_EQ(withoutPoint(more, 0, 1, 3).value().bindings, one.bindings);
  EXPECT_TRUE(withoutPoint(one, 0, 1, 3).value().bindings.empty()) << "it is gone itself";
  EXPECT_EQ(withoutPoint(one, 0, 1, 0).value().bindings.begin()->first,
            "/sources/0/surface/sections/1/tangents_deg/0");
  EXPECT_EQ(withoutPoint(one, 0, 1, 6).value().bindings, one.bindings);
  // An expression for a leg takes that of the tangent away, and the other way round.
  const std::string poles = "/sources/0/surface/sections/1/bezier/";
  auto bindings = one.bindings;
  bindings[poles + "1/0"] = bindings[poles + "3/1"] = {"amplitude", 40};
  freeRivals(bindings, poles + "4/1");
  EXPECT_FALSE(bindings.contains(kSecondTangent));
  bindings[poles + "4/1"] = bindings["/sources/0/surface/sections/0/bezier/4/1"] = {"amplitude", 40};
  freeRivals(bindings, kSecondTangent);
  EXPECT_FALSE(bindings.contains(poles + "4/1"));
  EXPECT_EQ(bindings.size(), 3u) << "of the joint itself, of other legs, and of another section";
}

TEST(DesignedSurfaceFiles, SlipsInTangentsAreNamed) {
  const auto message = [](const std::string& more, const std::string& leg = "[400, 250]") {
    return errorOf(withSurface(loftOfCubics(more, leg)));
  };
  const auto says = [](const std::string& all, const std::string& part) {
    return all.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(message(R"(, "tangents_deg": [1, 2])"), "must be a list of 3 angles"));
  EXPECT_TRUE(says(message(R"(, "tangents_deg": [1, 2, "a"])"), "tangents_deg[2] must be a number"));
  EXPECT_TRUE(says(message(R"(, "tangents_deg": [1, "=amplitde", 2])"), "did you mean"));
  EXPECT_TRUE(says(message(R"(, "tangents_deg": [null, 400, null])"), "must lie between"));
  EXPECT_TRUE(says(message(R"(, "tangents_deg": [null, 4, null])", R"([400, "=amplitude"])"),
                   "turns the poles beside bezier[3], which cannot be told by expressions then; write the "
                   "numbers of bezier[4]"));
  EXPECT_EQ(message(R"(, "tangents_deg": null)"), "accepted");
  EXPECT_EQ(message(R"(, "tangents_deg": [4, null, null])", R"([400, "=amplitude*6.25"])"), "accepted");
  json splines = withSurface(R"({"type": "sections", "sections": [
      {"y": 0, "bezier": [[0, 200], [600, 200]], "tangents_deg": [1]},
      {"y": 9, "bezier": [[0, 200], [600, 200]]}]})");
  EXPECT_TRUE(says(errorOf(splines), "is for cubics alone"));
}

TEST(DesignedSurfaceFiles, AFormulaKeepsTheVariablesThatItUses) {
  const Design design = designOf(withSurface(R"({"type": "formula", "formula": "amplitude + x"})").dump());
  const auto numbers = [](const Design& d) {
    return std::get<FormulaSurface>(d.source().surface->shape).numbers;
  };
  EXPECT_EQ(numbers(design), (std::vector<NamedNumber>{{"amplitude", 40}}));
  EXPECT_EQ(numbers(withVariables(design, {{"amplitude", 12}}).value()),
            (std::vector<NamedNumber>{{"amplitude", 12}}));
  const Design other = designOf(withSurface(R"({"type": "formula", "formula": "200 + x"})").dump());
  EXPECT_EQ(withVariables(other, {{"amplitude", 12}}).value().source(), other.source());
}

TEST(DesignedSurfaceFiles, SlipsAreNamed) {
  const auto message = [](const char* surface) { return errorOf(withSurface(surface)); };
  EXPECT_EQ(message(R"({"type": "pole"})"),
            "design.sources[0].surface.type is \"pole\" but must be one of \"poles\", \"formula\", "
            "\"sections\", \"blades\"; did you "
            "mean \"poles\"?");
  EXPECT_NE(message(R"({})").find("needs the key type"), std::string::npos);
  EXPECT_NE(message(R"({"type": "poles"})").find("needs the key poles"), std::string::npos);
  EXPECT_NE(message(R"({"type": "poles", "poles": [[1, 2, 3]]})")
                .find("has 1 rows of 3; there are 4 to 100 rows of 4"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "poles", "degree": [1, 1], "poles": [[1, 2], [3]]})").find("as many heights"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "poles", "degree": [1, 1], "poles": [[1, 2], [3, "a"]]})")
                .find("surface.poles[1][1] must be a number, not string"),
            std::string::npos);
  EXPECT_NE(
      message(R"({"type": "poles", "degree": [1, 4], "poles": [[1, 2], [3, 4]]})").find("degree must be"),
      std::string::npos);
  EXPECT_NE(message(R"({"type": "formula", "formula": "amplitud"})").find("did you mean “amplitude”?"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "formula", "formula": "1", "x": [5, 5]})").find("surface.x must ascend"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "formula", "fromula": "1"})").find("did you mean \"formula\"?"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "sections", "sections": [{"y": 0, "bezier": [[0, 0], [1, 1]]}]})")
                .find("2 to 200 curves"),
            std::string::npos);
  EXPECT_NE(
      message(
          R"({"type": "sections", "sections": [{"y": 1, "bezier": [[0, 0], [1, 1]]}, {"y": 1, "bezier": [[0, 0], [1, 1]]}]})")
          .find("sections[1].y must lie beyond"),
      std::string::npos);
  EXPECT_NE(
      message(R"({"type": "sections", "sections": [{"y": 1}, {"y": 2}]})").find("one of the keys bezier"),
      std::string::npos);
  EXPECT_NE(message(R"({"type": "sections", "sections": [
      {"y": 1, "bezier": [[0, 0], [1, 1], [2, 1], [3, 1], [4, 1]]}, {"y": 2, "bezier": [[0, 0], [1, 1]]}]})")
                .find("sections[0].bezier has 5 poles but must have 2, 3 or 4, or 3 more"),
            std::string::npos);
  EXPECT_NE(message(R"({"type": "blades", "blades": [{"y": 1, "middle": [0, 0], "length_mm": 5}]})")
                .find("2 to 200 key blades"),
            std::string::npos);
  const auto blade = [&](const std::string& second) {
    return message(
        (R"({"type": "blades", "blades": [{"y": 1, "middle": [0, 0], "length_mm": 5}, )" + second + "]}")
            .c_str());
  };
  EXPECT_NE(blade(R"({"y": 1, "middle": [0, 0], "length_mm": 5})").find("blades[1].y must lie beyond"),
            std::string::npos);
  EXPECT_NE(blade(R"({"y": 2, "middle": [0, 0]})").find("needs the key length_mm"), std::string::npos);
  EXPECT_NE(blade(R"({"y": 2, "middle": [0, 0], "length_mm": 5, "bend": 51})").find("bend"),
            std::string::npos);
  EXPECT_NE(blade(R"({"y": 2, "middle": [0, 0], "length_mm": 5, "force": [1200, 1200]})")
                .find("force is too large"),
            std::string::npos);
  EXPECT_NE(blade(R"({"y": 2, "middle": [0, 0], "length_mm": 5, "angel_deg": 1})")
                .find("did you mean \"angle_deg\"?"),
            std::string::npos);
  json both = withSurface(R"({"type": "formula", "formula": "1"})");
  both["sources"][0]["path"] = "a.step";
  EXPECT_NE(errorOf(both).find("keep one of them"), std::string::npos);
}

}  // namespace bw
