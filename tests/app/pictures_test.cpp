// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Pictures that verbs write: what is marked in them.

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "bw/pipeline/scene_content.h"

namespace bw::pipeline {
namespace {

/// An evaluation of so many cuts, of which this is known.
Evaluation covered(std::initializer_list<Coverage> cuts) {
  Evaluation evaluation;
  evaluation.blocks.front().cuts.clear();
  for (const Coverage& coverage : cuts)
    evaluation.blocks.front().cuts.emplace_back().coverage.value = std::make_shared<const Coverage>(coverage);
  return evaluation;
}

Coverage reaching(double distance, const Eigen::Vector3d& point) {
  Coverage coverage;
  coverage.distance = distance;
  coverage.limit = 2;
  coverage.point = point;
  return coverage;
}

TEST(UncoveredMark, StandsAtTheWorstPlaceThatIsTooFar) {
  EXPECT_FALSE(uncoveredMark(Evaluation()));
  EXPECT_FALSE(uncoveredMark(covered({reaching(1.9, {1, 2, 3})}))) << "the tolerance lets it";
  const std::optional<scene::Marker> mark =
      uncoveredMark(covered({reaching(3, {1, 2, 3}), reaching(108.4, {4, 5, 6}), reaching(50, {7, 8, 9})}));
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->point, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(mark->severity, Severity::error);
  EXPECT_EQ(mark->text, "Not cut: the surface reaches 108 mm beyond the cut here");
}

/// A run that is compared with a flat surface, of which it lies a tenth of a millimetre off.
ProgramRun flatRun() {
  ProgramRun run;
  run.motion.block = {
      Frame{{0, 0, -50}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
      {200, 300, 100}};
  SurfaceGrid& cut = run.compared.cut;
  cut.rows = 31;
  cut.columns = 21;
  cut.fields = {{"deviation", "Deviation", "mm", {}}, {"from_shown", "Off what is shown", "mm", {}}};
  for (int r = 0; r < cut.rows; ++r)
    for (int c = 0; c < cut.columns; ++c) {
      cut.points.emplace_back(10 * c, 10 * r, 0.1);
      cut.fields[0].values.push_back(0.05 * r - 0.8);
      cut.fields[1].values.push_back(0.003 * r);
    }
  run.compared.tolerance = 2;
  run.compared.motionTolerance = 0.1;
  SimulatedSurface surface;
  surface.toDesignMax = 0.09;
  surface.toTargetMax = 0.8;
  surface.toDesignAt = {{100, 300, 0.1}, 20, 3};
  surface.toTargetAt = {{100, 0, 0.1}, 5, 1};
  surface.covered = 1;
  run.surface = surface;
  return run;
}

TEST(SimulationPictures, AreTwoWithASurfaceAndOneWithout) {
  ProgramRun run = flatRun();
  const auto two = simulationPictures(run, {});
  ASSERT_TRUE(two) << two.error().message;
  ASSERT_EQ(two->size(), 2u);
  EXPECT_EQ((*two)[0].name, "cut");
  EXPECT_EQ((*two)[1].name, "cut-from-shown");
  EXPECT_NE((*two)[0].png, (*two)[1].png);
  // What was drawn before leaves no trace, nor does the number of threads.
  const auto ready = simulationPictures(run, {}, readyScene());
  RunContext alone;
  alone.threads = 1;
  const auto byOne = simulationPictures(run, alone);
  ASSERT_TRUE(ready && byOne);
  for (const std::size_t k : {0, 1}) {
    EXPECT_EQ((*ready)[k].png, (*two)[k].png) << k;
    EXPECT_EQ((*byOne)[k].png, (*two)[k].png) << k;
  }
  // Where it is farthest off is seen.
  run.surface->toTargetAt.place.y() = 200;
  const auto elsewhere = simulationPictures(run, {});
  ASSERT_TRUE(elsewhere);
  EXPECT_NE((*elsewhere)[0].png, (*two)[0].png);
  EXPECT_EQ((*elsewhere)[1].png, (*two)[1].png);
  // And how far.
  run.compared.cut.fields[1].values.back() = 0.5;
  const auto farther = simulationPictures(run, {});
  ASSERT_TRUE(farther);
  EXPECT_EQ((*farther)[0].png, (*elsewhere)[0].png);
  EXPECT_NE((*farther)[1].png, (*elsewhere)[1].png);
  run.surface.reset();
  const auto one = simulationPictures(run, {});
  ASSERT_TRUE(one);
  ASSERT_EQ(one->size(), 1u);
  EXPECT_EQ(one->front().name, "cut");
  std::stop_source stop;
  stop.request_stop();
  RunContext stopped;
  stopped.stop = stop.get_token();
  EXPECT_FALSE(simulationPictures(run, stopped));
}

}  // namespace
}  // namespace bw::pipeline
