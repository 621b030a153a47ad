// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is told to help where one end of a blade nearly stands still is what designs with it come to.
#include "bw/pipeline/speed_remedies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/grid_change.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/words/findings.h"
#include "finding_of.h"
#include "read_design.h"
#include "revolved.h"
#include "swinging.h"

namespace bw::pipeline {
namespace {

using test::causeOf;

Design revolved(double before, double half, const std::string& more = {}) {
  Design design = test::designOf(test::revolved(before, half, more));
  design.output.programs.clear();
  return design;
}

Evaluation evaluated(const Design& design, Purpose purpose) {
  Outcome outcome = evaluate(design, nullptr, {}, purpose);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

double leastRatio(const CutEvaluation& cut) {
  return std::ranges::min(cut.check.value->stations, {}, &StationCheck::speedRatio).speedRatio;
}

TEST(SplitBlock, IsSeenOnTheSpeedsOfTheRow) {
  const Evaluation e = evaluated(test::swinging(), Purpose::live);
  const CutEvaluation& cut = e.cut();
  ASSERT_TRUE(cut.sweep.value && cut.check.value);
  const BlockGrid before = gridOf(e.design, *e.design.block().placement).value();
  const std::string& block = e.design.block().id;
  const auto splits = splitsForSpeed(before, block, *cut.sweep.value, *cut.check.value);
  ASSERT_FALSE(splits.empty());
  EXPECT_EQ(splits[0].grid.sizes[0], (std::vector<double>{300, 300})) << "across the blade, in equal parts";
  EXPECT_EQ(splits[0].grid.gaps[0], std::vector<double>{0});
  EXPECT_EQ(splits[0].grid.sizes[1], before.sizes[1]);
  EXPECT_EQ(splits[0].parts(), 2u);
  for (const BlockSplit& split : splits) EXPECT_GE(split.parts(), 2u);
  const std::optional<Design> parted = withSplit(e.design, before, splits[0].grid, block);
  ASSERT_TRUE(parted);
  EXPECT_EQ(parted->sources, e.design.sources) << "the surface stays where it is";
  ASSERT_EQ(parted->cuts.size(), 2u);
  EXPECT_EQ(splits[0].partOf(*parted->stock[1].placement), 1u);
  // Where one end stands still no part is narrow enough.
  SweepCheck still = *cut.check.value;
  for (StationVelocity& station : still.velocities)
    for (std::size_t k = 0; k < station.relative.size(); ++k)
      station.relative[k] = 1e-4 + double(k) / double(station.relative.size());
  EXPECT_TRUE(splitsForSpeed(before, block, *cut.sweep.value, still).empty());
  // In unequal parts, narrow where the blade is slow: here at its right end.
  for (StationVelocity& station : still.velocities)
    for (std::size_t k = 0; k < station.relative.size(); ++k) {
      const double share = double(k) / double(station.relative.size() - 1);
      station.relative[k] = share < 0.2 ? 0.12 + 0.9 * share : 0.3 + 0.7 * (share - 0.2) / 0.8;
    }
  const auto unequal = splitsForSpeed(before, block, *cut.sweep.value, still);
  ASSERT_FALSE(unequal.empty());
  EXPECT_GT(unequal[0].grid.sizes[0].front(), unequal[0].grid.sizes[0].back()) << "curves begin at the right";
  // A block that lies askew to the blade.
  BlockGrid askew = before;
  askew.rotation.z() = 0.7;
  EXPECT_TRUE(splitsForSpeed(askew, block, *cut.sweep.value, *cut.check.value).empty());
}

/// What is told of a design, which is of the worst of its stations and was tried.
UnevenSpeed toldOf(const Evaluation& e) {
  const Findings findings = e.findings();
  const UnevenSpeed* cause = causeOf<UnevenSpeed>(findings);
  EXPECT_TRUE(cause && cause->tried);
  return cause ? *cause : UnevenSpeed{};
}

/// The parts that are told have the ratios of the design that is split so.
void expectPartsAsDesigned(const Evaluation& e, const UnevenSpeed& cause) {
  ASSERT_GE(cause.parts.size(), 2u);
  BlockGrid split = gridOf(e.design, *e.design.block().placement).value();
  EXPECT_EQ(cause.parts.front().from, 0);
  EXPECT_EQ(cause.parts.back().to, split.sizes[cause.edge].front());
  split.sizes[cause.edge].clear();
  for (const UnevenSpeed::Part& part : cause.parts) split.sizes[cause.edge].push_back(part.to - part.from);
  split.gaps[cause.edge].assign(cause.parts.size() - 1, 0);
  const BlockGrid before = gridOf(e.design, *e.design.block().placement).value();
  const std::optional<Design> parted = withSplit(e.design, before, split, e.design.block().id);
  ASSERT_TRUE(parted);
  const Evaluation after = evaluated(*parted, Purpose::live);
  ASSERT_EQ(after.blocks.size(), cause.parts.size());
  for (std::size_t i = 0; i < cause.parts.size(); ++i) {
    EXPECT_NEAR(leastRatio(after.blocks[i].cuts[0]), cause.parts[i].ratio, 1e-9) << i;
    EXPECT_GE(cause.parts[i].ratio, kSpeedRatioLimit);
  }
  EXPECT_FALSE(causeOf<UnevenSpeed>(after.findings()));
  EXPECT_FALSE(hasErrors(after.findings()));
}

TEST(SpeedRemedies, ASweepOfRevolutionIsSplitAcrossTheBlade) {
  const Evaluation e = evaluated(revolved(100, 25), Purpose::files);
  const UnevenSpeed cause = toldOf(e);
  EXPECT_LT(cause.ratio, 0.16) << "100 mm from the line about which it turns, to 700 mm";
  EXPECT_EQ(cause.edge, 0u);
  ASSERT_EQ(cause.parts.size(), 2u) << words::sentence(*test::findingOf<UnevenSpeed>(e.findings()),
                                                       words::Reader::commandLine);
  EXPECT_LT(cause.parts[0].to, 200) << "narrow where it is slow";
  expectPartsAsDesigned(e, cause);
  // The second thought of the window finds the same.
  Evaluation live = evaluated(revolved(100, 25), Purpose::live);
  EXPECT_FALSE(causeOf<UnevenSpeed>(live.findings())->tried);
  while (!live.cut().speeds.value) ASSERT_TRUE(addSecondThought(live, {}));
  EXPECT_EQ(toldOf(live).parts, cause.parts);
  EXPECT_EQ(toldOf(live).planes, cause.planes);
}

/// The example whose key blades turn, as far as its slider goes.
Design turnedFarthest() {
  Design design = exampleDesign("turning-blades").value();
  for (Variable& variable : design.variables)
    if (variable.name == "turn") variable.value = 8;
  design.output.programs.clear();
  return resolved(design).value();
}

TEST(SpeedRemedies, ParallelPlanesTakeThePlaceOfTurningOnes) {
  const Evaluation e = evaluated(turnedFarthest(), Purpose::files);
  const UnevenSpeed cause = toldOf(e);
  EXPECT_LT(cause.ratio, kSpeedRatioLimit);
  ASSERT_TRUE(cause.planes) << words::sentence(*test::findingOf<UnevenSpeed>(e.findings()),
                                               words::Reader::commandLine);
  EXPECT_FALSE(cause.planes->turning);
  EXPECT_NEAR(cause.planes->direction.y(), 1, 1e-12);
  EXPECT_GT(cause.planes->ratio, 0.9);
  const Evaluation after = evaluated(withPlanes(e.design, e.cut().id, *cause.planes), Purpose::live);
  EXPECT_FALSE(after.cut().setup->planes.turns());
  EXPECT_NEAR(leastRatio(after.cut()), cause.planes->ratio, 1e-9);
  EXPECT_FALSE(causeOf<UnevenSpeed>(after.findings()));
  EXPECT_FALSE(exceedsLimit(after.findings()));
  expectPartsAsDesigned(e, cause);
}

TEST(SpeedRemedies, PlanesThatDragTheBladeAreNoHelp) {
  // Planes along the travel keep the ratio here, but bring warnings of the cutting angle.
  const Design design = revolved(150, 12);
  const Evaluation e = evaluated(design, Purpose::files);
  const UnevenSpeed cause = toldOf(e);
  EXPECT_FALSE(cause.planes);
  EXPECT_FALSE(causeOf<SteepAngle>(e.findings()));
  const Evaluation along =
      evaluated(withPlanes(design, design.cut().id, {false, Eigen::Vector3d::UnitY(), 1}), Purpose::live);
  EXPECT_GT(leastRatio(along.cut()), kSpeedRatioLimit);
  EXPECT_TRUE(causeOf<SteepAngle>(along.findings()));
  expectPartsAsDesigned(e, cause);
}

TEST(SpeedRemedies, ASurfaceThatSwingsIsCutInParts) {
  Evaluation e = evaluated(test::swinging(), Purpose::live);
  while (!e.cut().speeds.value) ASSERT_TRUE(addSecondThought(e, {}));
  expectPartsAsDesigned(e, toldOf(e));
}

TEST(SpeedRemedies, NothingIsToldWhereNothingHelps) {
  // So near to the line about which it turns no part that may be made is narrow enough.
  const Evaluation e = evaluated(revolved(20, 30), Purpose::files);
  const UnevenSpeed cause = toldOf(e);
  EXPECT_TRUE(cause.parts.empty());
  EXPECT_FALSE(cause.planes);
  const Findings findings = e.findings();
  EXPECT_TRUE(test::findingOf<UnevenSpeed>(findings)->remedies.empty());
  const auto report = nlohmann::json::parse(reportJson(e, "run", {}, words::Reader::commandLine));
  for (const auto& issue : report["issues"]) {
    if (issue["kind"] != "speed") continue;
    EXPECT_TRUE(issue["split"].is_null());
    EXPECT_EQ(issue["speed_ratio"], cause.ratio);
  }
}

}  // namespace
}  // namespace bw::pipeline
