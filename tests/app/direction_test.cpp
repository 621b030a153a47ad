// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The cutting direction of a job that leaves it open.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {
namespace {

Design designOf(const std::function<Eigen::Vector3d(double, double)>& f) {
  SurfaceGrid grid;
  grid.rows = grid.columns = 25;
  std::vector<double> v;
  for (int r = 0; r < grid.rows; ++r) {
    v.push_back(double(r) / (grid.rows - 1));
    for (int c = 0; c < grid.columns; ++c) grid.points.push_back(f(double(c) / (grid.columns - 1), v.back()));
  }
  Design design;
  design.source().path = "test.step";
  design.source().bytes = geometry::stepText(*geometry::loft(grid, v), "test").value();
  design.blade = *bladePreset("nicr-flat-5x1");
  design.cut().sections.stations = 20;
  return design;
}

/// Part of a cylinder of radius 400 mm about y, from 20° to 75° of slope and 300 mm wide: along its slope the
/// longer way, along y a straight cut with one shape.
Design chute() {
  return designOf([](double u, double v) {
    const double a = fromDegrees(20 + 55 * u);
    return Eigen::Vector3d(400 * std::sin(a), 300 * v, 400 * (1 - std::cos(a)));
  });
}

Evaluation evaluated(const Design& design, const Evaluation* previous = nullptr, int threads = 0) {
  RunContext context;
  context.threads = threads;
  Outcome outcome = evaluate(design, previous, context);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

TEST(DirectionSearch, TakesTheWayAlongWhichTheBladeKeepsItsShape) {
  Design design = chute();
  const Evaluation found = evaluated(design);
  ASSERT_TRUE(found.cut().directions.value);
  const DirectionSearch& search = *found.cut().directions.value;
  EXPECT_GT(search.chosen, 0u);
  EXPECT_NEAR(std::abs(found.cut().setup->planes.direction().y()), 1, 1e-9);
  EXPECT_EQ(found.cut().sweep.value->planes.direction(), search.trials[search.chosen].direction);
  const double angle = found.cut().analysis.value->summary.angleMax;
  EXPECT_LT(angle, fromDegrees(1));
  // The longer side, which was taken before, is worse as it was told to be.
  design.cut().direction = search.trials.front().direction;
  const Evaluation usual = evaluated(design);
  EXPECT_GT(usual.cut().analysis.value->summary.angleMax, angle + fromDegrees(10));
  EXPECT_NEAR(usual.cut().analysis.value->summary.angleMax, search.trials.front().angleMax, fromDegrees(5));
  EXPECT_FALSE(usual.cut().directions.value);
  // It is said.
  const Findings findings = found.findings();
  EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& f) {
    return std::holds_alternative<ChosenDirection>(f.cause) &&
           words::sentence(f, words::Reader::window).find("rather than the longer side of the block") !=
               std::string::npos;
  }));
}

TEST(DirectionSearch, TakesNoWayAlongWhichTheBladeSnaps) {
  // A wave along y, an arch along x: a blade over the wave has two bows, and snaps into one.
  Design design = designOf([](double u, double v) {
    const double a = 2 * std::acos(-1.0);
    return Eigen::Vector3d(600 * u, 600 * v, 25 * std::sin(a * v) + 20 * std::cos(a * (u - 0.5) / 2));
  });
  design.blade.length = 800;
  const Evaluation found = evaluated(design);
  ASSERT_TRUE(found.cut().directions.value);
  EXPECT_NEAR(std::abs(found.cut().setup->planes.direction().y()), 1, 1e-9);
  const auto along = [&](int axis) {
    const std::vector<DirectionTrial>& trials = found.cut().directions.value->trials;
    return *std::ranges::find_if(
        trials, [&](const DirectionTrial& trial) { return std::abs(trial.direction[axis]) > 0.99; });
  };
  EXPECT_EQ(along(0).unrested, along(0).stations);
  EXPECT_EQ(along(1).unrested, 0);
  const std::vector<Rest>& rests = found.cut().rest.value->stations;
  EXPECT_EQ(std::ranges::count(rests, Rest::lost), 0);
  // So it is told of the way that was not taken.
  design.cut().direction = Eigen::Vector3d::UnitX();
  const Evaluation other = evaluated(design);
  const std::vector<Rest>& lost = other.cut().rest.value->stations;
  EXPECT_EQ(std::ranges::count(lost, Rest::lost), int(lost.size()));
}

TEST(DirectionSearch, AGapWithNothingInItCountsForNoWay) {
  // Two ramps that fall towards a gap of 200 mm, across which the sections go on: of 17 planes across x five
  // meet neither of them.
  const auto ramp = [](double from) {
    SurfaceGrid grid;
    grid.rows = grid.columns = 25;
    std::vector<double> v;
    for (int r = 0; r < grid.rows; ++r) {
      v.push_back(double(r) / (grid.rows - 1));
      for (int c = 0; c < grid.columns; ++c) {
        const double x = from + 200.0 * c / (grid.columns - 1), y = 400 * v.back(), u = std::abs(x - 300);
        grid.points.emplace_back(x, y, 0.8 * u * (u / 1200 - 1) + 10 * std::sin(y / 100));
      }
    }
    return *geometry::loft(grid, v);
  };
  const SplineSurface left = ramp(0), right = ramp(400);
  const std::vector<geometry::NamedSurface> both = {{"left", &left}, {"right", &right}};
  Design design;
  design.source().path = "test.step";
  design.source().bytes = geometry::stepText(both, "ramps").value();
  design.cut().face.kind = FaceChoice::Kind::all;
  design.cut().sections.stations = 20;
  const Evaluation found = evaluated(design);
  EXPECT_NEAR(std::abs(found.cut().setup->planes.direction().x()), 1, 1e-9);
  ASSERT_TRUE(found.cut().directions.value);
  const DirectionSearch& search = *found.cut().directions.value;
  EXPECT_EQ(search.trials[search.chosen].unusable, 0);
}

TEST(DirectionSearch, LeavesTheExamplesAsTheyAreButForTheTorus) {
  for (const geometry::Example& example : geometry::exampleList()) {
    Design design = exampleDesign(example.name).value();
    if (design.cut().direction) continue;
    const Evaluation found = evaluated(design);
    ASSERT_TRUE(found.cut().directions.value) << example.name;
    const bool turned = example.name == "torus-patch";  // 0.03 mm and 14° in place of 0.4 mm and 47°
    EXPECT_EQ(found.cut().directions.value->chosen, turned ? 1u : 0u) << example.name;
    if (turned) {
      EXPECT_LT(found.cut().analysis.value->summary.angleMax, fromDegrees(15));
    }
  }
}

TEST(DirectionSearch, DoesNotHangOnTheNumberOfThreads) {
  const Evaluation one = evaluated(chute(), nullptr, 1), four = evaluated(chute(), nullptr, 4);
  const std::vector<DirectionTrial>&a = one.cut().directions.value->trials,
        &b = four.cut().directions.value->trials;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(one.cut().directions.value->chosen, four.cut().directions.value->chosen);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].direction, b[i].direction);
    EXPECT_EQ(a[i].unusable, b[i].unusable);
    EXPECT_EQ(a[i].deviationMax, b[i].deviationMax);
    EXPECT_EQ(a[i].angleMax, b[i].angleMax);
  }
}

TEST(DirectionSearch, IsNotDoneAgainForOtherStations) {
  Design design = chute();
  const Evaluation first = evaluated(design);
  design.cut().sections.stations = 31;
  design.process.cuttingSpeed = 12;
  const Evaluation second = evaluated(design, &first);
  EXPECT_EQ(second.cut().directions.value, first.cut().directions.value);
  EXPECT_EQ(second.cut().sections.value->size(), 31u);
  // A given direction needs none, and comes into effect at once; so does leaving it open again.
  design.cut().direction = Eigen::Vector3d::UnitX();
  const Evaluation given = evaluated(design, &second);
  EXPECT_FALSE(given.cut().directions.value);
  EXPECT_EQ(given.cut().sweep.value->planes.direction(), Eigen::Vector3d::UnitX());
  design.cut().direction.reset();
  EXPECT_EQ(evaluated(design, &given).cut().sweep.value->planes.direction(),
            first.cut().sweep.value->planes.direction());
}

TEST(DirectionSearch, ReportListsWhatWasTried) {
  const Evaluation found = evaluated(chute());
  const nlohmann::json report = nlohmann::json::parse(reportJson(found, "run", {}, words::Reader::window));
  const nlohmann::json& list = report.at("directions");
  ASSERT_EQ(list.size(), found.cut().directions.value->trials.size());
  int chosen = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const DirectionTrial& trial = found.cut().directions.value->trials[i];
    EXPECT_EQ(list[i].at("name"), trial.name);
    EXPECT_EQ(list[i].at("stations"), trial.stations);
    EXPECT_EQ(list[i].at("unusable"), trial.unusable);
    EXPECT_EQ(list[i].at("angle_max_deg").is_null(), !trial.failure.empty());
    if (list[i].at("chosen").get<bool>()) {
      ++chosen;
      EXPECT_EQ(list[i].at("direction"), report.at("method").at("direction"));
    }
  }
  EXPECT_EQ(chosen, 1);
}

TEST(DirectionSearch, CountsErrorsFirstThenDeviationThenAngle) {
  const auto trial = [](int unusable, double deviation, double angle_deg) {
    return DirectionTrial{"", Eigen::Vector3d::UnitX(), 9, unusable, deviation, fromDegrees(angle_deg)};
  };
  const auto better = [](const DirectionTrial& a, const DirectionTrial& b) {
    return clearlyBetter(a, b, 2.0);
  };
  EXPECT_TRUE(better(trial(0, 9, 80), trial(1, 1, 0)));
  EXPECT_FALSE(better(trial(1, 1, 0), trial(0, 9, 80)));
  EXPECT_TRUE(better(trial(0, 3, 80), trial(0, 9, 0)));
  EXPECT_FALSE(better(trial(0, 8, 0), trial(0, 9, 5)));  // as far off, and as straight, within the margins
  EXPECT_FALSE(better(trial(0, 0.1, 5), trial(0, 1.9, 5)));  // within the tolerance nothing is nearer
  EXPECT_TRUE(better(trial(0, 1.9, 5), trial(0, 0.1, 30)));
  EXPECT_FALSE(better(trial(0, 1, 21), trial(0, 1, 30)));
  DirectionTrial snaps = trial(0, 1, 5);
  snaps.unrested = 2;
  EXPECT_TRUE(better(trial(0, 1.9, 80), snaps)) << "it rests, within the tolerance, too";
  EXPECT_FALSE(better(trial(0, 9, 5), snaps));
  // Of an open length a gentler angle is not worth a blade that is longer by a fifth.
  DirectionTrial gentle = trial(0, 1, 5), steep = trial(0, 1, 30);
  gentle.longest = 856;
  steep.longest = 625;
  EXPECT_FALSE(better(gentle, steep));
  gentle.longest = 700;
  EXPECT_TRUE(better(gentle, steep));
  DirectionTrial failed = trial(9, 0, 0);
  failed.failure = "no section";
  EXPECT_TRUE(better(trial(9, 5, 80), failed));
  EXPECT_FALSE(better(failed, trial(9, 5, 80)));
}

TEST(DirectionSearch, AnOpenLengthTakesNoWayThatAsksForAMuchLongerBlade) {
  Design saddle = exampleDesign("saddle").value();
  saddle.output.programs.clear();
  saddle.blade.autoLength = true;
  const Evaluation found = evaluated(saddle);
  const DirectionSearch& search = *found.cut().directions.value;
  EXPECT_EQ(search.chosen, 0u);
  for (const DirectionTrial& trial : search.trials) {
    EXPECT_EQ(trial.unrested, 0) << "of no length of its own nothing rests or not: " << trial.name;
    EXPECT_TRUE(trial.longest > 0 || !trial.failure.empty()) << trial.name;
  }
  EXPECT_LT(found.cut().sweep.value->request.blade.length, 800);
}

TEST(DirectionSearch, StopsOnRequest) {
  const Evaluation found = evaluated(chute());
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto stopped = searchDirection(*found.cut().target.value, found.cut().directions.request, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace bw::pipeline
