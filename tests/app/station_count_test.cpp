// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The number of stations that follows from the tolerance, in an evaluation and its report.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/geometry/export.h"
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

/// A sheet of 400 by 600 mm in six waves along the travel.
Design waves() {
  SurfaceGrid grid;
  grid.rows = 121;
  grid.columns = 9;
  std::vector<double> v;
  for (int r = 0; r < grid.rows; ++r) {
    v.push_back(double(r) / (grid.rows - 1));
    for (int c = 0; c < grid.columns; ++c) {
      const double u = double(c) / (grid.columns - 1);
      grid.points.emplace_back(400 * u, 600 * v.back(),
                               30 * std::cos(2 * kPi * 6 * v.back()) + 30 * u * (1 - u));
    }
  }
  Design design = panel();
  design.source().path = "waves.step";
  design.source().bytes = geometry::stepText(*geometry::loft(grid, v), "waves").value();
  return design;
}

TEST(StationCount, FollowsFromTheTolerance) {
  Design design = waves();
  design.process.tolerance = 20;
  ASSERT_TRUE(design.cut().sections.byTolerance()) << "unless it is given";
  const Evaluation first = evaluated(design);
  ASSERT_TRUE(first.cut().count.value);
  EXPECT_EQ(int(first.cut().sweep.value->poses.size()), first.cut().count.value->stations);

  design.process.tolerance = 0.5;
  const Evaluation finer = evaluated(design, &first);
  EXPECT_GT(finer.cut().count.value->stations, first.cut().count.value->stations);
  EXPECT_EQ(finer.cut().sweep.value->poses.size(), std::size_t(finer.cut().count.value->stations));

  // Sections stay where their number does.
  design.process.tolerance = 20.5;
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
