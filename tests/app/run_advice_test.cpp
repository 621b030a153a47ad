// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Between the stations of a row its run decides whether a blade serves, and what is advised.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/sweep/lowest_place.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/sketch.h"
#include "bw/words/findings.h"
#include "finding_of.h"
#include "read_design.h"

namespace bw::pipeline {
namespace {

/// A surface over a block of that size, cut along y with weight.
struct Piece {
  std::string formula;
  int stations;
  std::string blade;  ///< of the file
  double width = 600, depth = 800, height = 500;
  std::string process = {}, direction = R"("y")";
};

Design designOf(const Piece& piece) {
  std::ostringstream text;
  text
      << R"({"bladewright_design": 2, "sources": [{"id": "surface", "surface": {"type": "formula", "x": [0, )"
      << piece.width << R"(], "y": [0, )" << piece.depth << R"(], "formula": ")" << piece.formula
      << R"("}}], "stock": [{"id": "block", "block": {"origin": [0, 0, 0], "size": [)" << piece.width << ", "
      << piece.depth << ", " << piece.height
      << R"(]}}], "cuts": [{"id": "cut", "source": "surface", "block": "block", "direction": )"
      << piece.direction << R"(, "stations": )" << piece.stations << R"(}], "blade": )" << piece.blade
      << R"(, "process": {)" << piece.process << "}}";
  Design design = test::designOf(text.str());
  design.output.programs.clear();
  return design;
}

Evaluation evaluated(const Design& design, Purpose purpose = Purpose::files) {
  Outcome outcome = evaluate(design, nullptr, {}, purpose);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

std::string toldOf(const Evaluation& e) {
  std::string all;
  for (const Finding& finding : e.findings())
    all += words::sentence(finding, words::Reader::commandLine) + "\n";
  return all;
}

/// Its sections turn over within a few mm of travel, between two stations.
Piece turningOver(const std::string& length) {
  return {"250+13.6*((y-539)/sqrt((y-539)^2+10^2))*((x-300)/300)^3+0.7*(1-((x-300)/300)^2)",
          24,
          R"({"preset": "nicr-flat-5x1", "width": 10, "thickness": 0.6, "young_modulus": 200000,
              "yield_stress": 900, "density": 7850, "temperature": 20, "length": )" +
              length + "}",
          600,
          800,
          500,
          R"("clearance": 15, "floor": 0, "margin": 0.05, "motion_tolerance": 2, "tolerance": 10)"};
}

TEST(RunAdvice, AnOpenLengthIsNotToldToServeWhereTheBladeIsLostBetweenTheStations) {
  const Design design = designOf(turningOver(R"("auto")"));
  const Evaluation live = evaluated(design, Purpose::live), files = evaluated(design);
  for (const Evaluation* e : {&live, &files}) {
    const Findings findings = e->findings();
    const ServingLengths* lengths = test::causeOf<ServingLengths>(findings);
    ASSERT_TRUE(lengths) << toldOf(*e);
    EXPECT_EQ(lengths->said, ServingLengths::Said::nearest) << toldOf(*e);
  }
  EXPECT_EQ(live.cut().sweep.value->request.blade.length, files.cut().sweep.value->request.blade.length);
  // At its stations alone it would serve.
  EXPECT_EQ(std::ranges::count(files.cut().rest.value->stations, Rest::lost), 0);
  const OtherShape* other = test::causeOf<OtherShape>(files.cut().barriers.findings);
  ASSERT_TRUE(other) << toldOf(files);
  EXPECT_LT(other->barrier.value(), kLeastBarrier);
}

TEST(RunAdvice, AnOpenLengthServesWhoseRunMissesItsMarginByLittle) {
  const Evaluation e =
      evaluated(designOf({"250+9.8*((y-544)/sqrt((y-544)^2+10^2))*((x-300)/300)^3+0.7*(1-((x-300)/300)^2)",
                          41, R"({"preset": "nicr-flat-5x1", "length": "auto"})", 600, 800, 500,
                          R"("clearance": 15, "margin": 0.3, "motion_tolerance": 2, "floor": 0)"}),
                Purpose::live);
  const LowMargin* low = test::causeOf<LowMargin>(e.cut().barriers.findings);
  ASSERT_TRUE(low);
  EXPECT_GT(low->margin, 0.29);
  EXPECT_TRUE(e.cut().lengths.value->designed) << toldOf(e);
  EXPECT_FALSE(hasErrors(e.findings())) << toldOf(e);
}

TEST(RunAdvice, WhatIsLostBetweenTheStationsIsAdvised) {
  // The same for a length that is asked for: other lengths, clearances and margins were tried.
  const Evaluation e = evaluated(designOf(turningOver("635")));
  ASSERT_TRUE(test::findingOf<OtherShape>(e.cut().barriers.findings));
  EXPECT_TRUE(e.cut().lengths.value && e.cut().clearances.value);
  const Findings findings = e.findings();
  const ServingLengths* lengths = test::causeOf<ServingLengths>(findings);
  ASSERT_TRUE(lengths) << toldOf(e);
  EXPECT_EQ(lengths->said, ServingLengths::Said::none) << toldOf(e);
}

TEST(RunAdvice, SymmetricArchesAreHeldFirmly) {
  // The lowest pass of such an arch is no mirror image of itself.
  const Evaluation e = evaluated(
      designOf({"200-(x-440)^2/21000", 8, R"({"preset": "nicr-flat-5x1", "width": 10, "length": 1000})", 880,
                300, 400, R"("tolerance": 5, "grip_error": {"mm": 0, "deg": 0})"}));
  EXPECT_FALSE(hasErrors(e.findings())) << toldOf(e);
  const std::vector<BarrierLook>& looks = *e.cut().barriers.value;
  const BarrierLook* least = leastBarrier(looks);
  ASSERT_TRUE(least);
  EXPECT_GT(*least->barrier, kLeastBarrier);
  const std::optional<double> row = e.cut().certainty.value->leastBarrier();
  ASSERT_TRUE(row);
  EXPECT_NEAR(*least->barrier, *row, 0.05 * *row);
}

TEST(RunAdvice, CornersThatStationsEndBeforeAreCutByTheirBlades) {
  // Planes that lean meet the ends of the surface from corner to corner, and stations beside each other end
  // at different places.
  const Evaluation e = evaluated(
      designOf({"200 + 50*((x - 250)/250)*(1 - 0.6*(y/800)) - 10*(1 - ((x - 250)/250)^2)*sin(pi*(y/800))", 33,
                R"({"preset": "steel-tube-3-2.5", "length": 650})", 500, 800, 400,
                R"("tolerance": 1, "margin": 0.05, "floor": 0)", "[0, 1, 0.8]"}));
  EXPECT_EQ(e.result()->coverage.uncovered, 0) << toldOf(e);
  EXPECT_FALSE(hasErrors(e.findings())) << toldOf(e);
}

TEST(RunAdvice, ABlockMadeAroundItsSurfaceKeepsTheFloorUnderTheWaysToo) {
  // Half a pipe that is open upwards: on its ways in and out the blade hangs lower than at any station.
  Design design = test::designOf(R"json({"bladewright_design": 2,
    "sources": [{"id": "pipe", "surface": {"type": "formula", "x": [-250, 250], "y": [0, 500],
                 "formula": "262 - sqrt(262^2 - x^2)"}}],
    "stock": [{"id": "block"}], "cuts": [{"id": "cut", "direction": "y", "stations": 9}],
    "blade": {"preset": "nicr-flat-5x1", "length": 900}})json");
  design.output.programs.clear();
  const Evaluation e = evaluated(design);
  EXPECT_EQ(toldOf(e), "");
  const Box& block = e.cut().block();
  const Box forStations =
      standingBelow(e.cut().setup->block, e.cut().sweep.value->poses, e.cut().sweep.request.room.value());
  EXPECT_GT(block.size.z(), forStations.size.z() + 5) << "else nothing is asked";
  for (const BladePose& pose : e.cut().ends.value->entry.poses)
    EXPECT_GE(lowestPlace(block, pose).height, design.process.floor);
  // It stays so for whoever goes on from there, and under a hand.
  Outcome again = evaluate(design, &e, {}, Purpose::files);
  ASSERT_FALSE(again.error);
  EXPECT_EQ(again.evaluation.cut().sweep.value, e.cut().sweep.value);
  const auto from = std::make_shared<const Evaluation>(std::move(again.evaluation));
  Design longer = design;
  longer.blade.length = 902;
  const std::optional<Sketch> sketch = Sketcher(from).draw(longer, {});
  ASSERT_TRUE(sketch);
  EXPECT_NEAR(sketch->find("cut")->setup->block.size.z(), block.size.z(), 3);
  // A length that is left open is not refused for it.
  design.blade.autoLength = true;
  const Evaluation open = evaluated(design);
  const Findings findings = open.findings();
  const ServingLengths* lengths = test::causeOf<ServingLengths>(findings);
  ASSERT_TRUE(lengths);
  EXPECT_EQ(lengths->said, ServingLengths::Said::taken) << toldOf(open);
}

}  // namespace
}  // namespace bw::pipeline
