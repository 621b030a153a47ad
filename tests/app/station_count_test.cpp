// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The number of stations that follows from the tolerance, in an evaluation and its report.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {
namespace {

Evaluation evaluated(const Design& design, const Evaluation* previous = nullptr) {
  Outcome outcome = evaluate(design, previous, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

Design panel() {
  Design design = *exampleDesign("panel-600x670");
  design.cut().direction = Eigen::Vector3d::UnitY();
  return design;
}

TEST(StationCount, FollowsFromTheTolerance) {
  Design design = panel();
  ASSERT_TRUE(design.cut().sections.byTolerance()) << "unless it is given";
  const Evaluation first = evaluated(design);
  ASSERT_TRUE(first.cut().count.value);
  EXPECT_EQ(int(first.cut().sweep.value->poses.size()), first.cut().count.value->stations);

  design.process.tolerance = 0.01;
  const Evaluation finer = evaluated(design, &first);
  EXPECT_GT(finer.cut().count.value->stations, first.cut().count.value->stations);
  EXPECT_EQ(finer.cut().sweep.value->poses.size(), std::size_t(finer.cut().count.value->stations));

  // Sections stay where their number does.
  design.process.tolerance = 2.1;
  const Evaluation same = evaluated(design, &first);
  EXPECT_EQ(same.cut().sections.value, first.cut().sections.value);

  design.cut().sections.stations = 24;
  const Evaluation given = evaluated(design, &first);
  EXPECT_FALSE(given.cut().count.value);
  EXPECT_EQ(given.cut().sweep.value->poses.size(), 24u);
}

TEST(StationCount, CutsAsWellAsSixty) {
  for (const char* name : {"panel-600x670", "graph", "torus-patch", "wavy-wall"}) {
    Design design = *exampleDesign(name);
    const Evaluation found = evaluated(design);
    design.cut().sections.stations = 60;
    const Evaluation sixty = evaluated(design);
    ASSERT_TRUE(found.result() && sixty.result()) << name;
    EXPECT_LE(found.result()->analysis.summary.deviationMax,
              sixty.result()->analysis.summary.deviationMax + 0.05 * design.process.tolerance)
        << name;
    EXPECT_LE(found.result()->between.deviationMax,
              sixty.result()->between.deviationMax + 0.05 * design.process.tolerance)
        << name;
  }
}

TEST(StationCount, IsInTheReport) {
  const auto stationsIn = [](const Design& design) {
    return nlohmann::json::parse(
        reportJson(evaluated(design), "run", {}, words::Reader::commandLine))["method"]["stations"];
  };
  Design design = panel();
  const nlohmann::json found = stationsIn(design);
  EXPECT_EQ(found["asked"], "auto");
  EXPECT_EQ(found["found"], evaluated(design).cut().count.value->stations);
  EXPECT_LE(found["between_mm"], 0.1);
  design.cut().sections.stations = 20;
  EXPECT_EQ(stationsIn(design), nlohmann::json({{"asked", 20}}));
  design.cut().sections.spacing = 40;
  EXPECT_EQ(stationsIn(design), nlohmann::json({{"asked", {{"spacing", 40.0}}}}));
}

}  // namespace
}  // namespace bw::pipeline
