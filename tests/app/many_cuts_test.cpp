// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Evaluations of several blocks and cuts, and their files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bw/core/base/units.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/key_blades.h"
#include "bw/pipeline/moulds.h"
#include "bw/pipeline/overall.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/report_page.h"

namespace bw::pipeline {
namespace {

/// Two surfaces in one block, and a part of the first in another block.
Design three() {
  Design design = exampleDesign("two-crossing-cuts").value();
  design.output.programs.clear();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  design.block().id = design.cuts[0].block = design.cuts[1].block = "block-1";
  design.cuts[0].order = 1;
  design.cuts[1].order = 2;
  design.cuts[1].id = "across";
  design.cuts[1].pose = {};
  Cut part = design.cut();
  part.id = "part";
  part.block = "small";
  BlockPlacement half = *design.block().placement;
  half.size.y() *= 0.5;
  design.stock.push_back({"small", half});
  design.cuts.push_back(part);
  return design;
}

TEST(ManyCuts, AreEvaluatedEachInItsBlock) {
  const Design design = three();
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_EQ(e.blocks.size(), 2u);
  ASSERT_EQ(e.blocks[0].cuts.size(), 2u);
  ASSERT_EQ(e.blocks[1].cuts.size(), 1u);
  const CutEvaluation &along = e.blocks[0].cuts[0], &across = e.blocks[0].cuts[1],
                      &part = e.blocks[1].cuts[0];
  EXPECT_EQ(across.id, "across");
  EXPECT_EQ(e.blocks[1].id, "small");
  ASSERT_TRUE(along.result() && across.result() && part.result());
  EXPECT_EQ(along.result()->sweep.planes.direction(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(across.result()->sweep.planes.direction(), Eigen::Vector3d::UnitX());
  EXPECT_LT((across.setup->block.frame.origin - along.setup->block.frame.origin).norm(), 1e-9) << "one block";
  EXPECT_LT(part.result()->motion.duration(), 0.7 * along.result()->motion.duration());
  EXPECT_EQ(e.findings().size(), e.source.findings.size() + e.sourceFindings.size() +
                                     along.findings().size() + across.findings().size() +
                                     part.findings().size());
  // Each is what it is alone.
  Design alone = design;
  alone.stock = {design.stock[1]};
  alone.cuts = {design.cuts[2]};
  const Outcome single = evaluate(alone, nullptr, {});
  ASSERT_FALSE(single.error) << single.error->message;
  EXPECT_EQ(single.evaluation.result()->analysis.summary.deviationMax,
            part.result()->analysis.summary.deviationMax);
}

TEST(ManyCuts, AreKeptWhereAnotherChanges) {
  Design design = three();
  const Evaluation before = evaluate(design, nullptr, {}).evaluation;
  design.cuts[1].sections.stations = 9;
  const Evaluation after = evaluate(design, &before, {}).evaluation;
  EXPECT_EQ(after.blocks[0].cuts[0].analysis.value, before.blocks[0].cuts[0].analysis.value);
  EXPECT_EQ(after.blocks[1].cuts[0].analysis.value, before.blocks[1].cuts[0].analysis.value);
  EXPECT_NE(after.blocks[0].cuts[1].sections.value, before.blocks[0].cuts[1].sections.value);
  ASSERT_TRUE(after.blocks[0].cuts[1].result());
  EXPECT_EQ(after.blocks[0].cuts[1].result()->size(), 9u);
}

TEST(ManyCuts, AreToldByTheirIdsInTheReport) {
  const Evaluation e = evaluate(three(), nullptr, {}).evaluation;
  const std::string report = reportJson(e, "0123456789abcdef", {}, words::Reader::commandLine);
  for (const char* part : {"\"id\": \"small\"", "\"cut\": \"across\"", "\"cut\": \"part\"", "\"index\": 2"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
}

TEST(ManyCuts, HaveFilesInTheFoldersOfTheirBlocks) {
  Design design = three();
  design.output.programs = {"csv"};
  const Product product = produce(design, "nothing-is-written-there", {}, {});
  ASSERT_FALSE(product.error) << product.error->message;
  std::vector<std::string> paths;
  for (const auto& path : product.files.paths()) paths.push_back(path.generic_string());
  for (const char* path : {"programs/block-1/strip-0/motion.csv", "programs/block-1/strip-1/motion.csv",
                           "programs/small/strip-2/motion.csv"})
    EXPECT_NE(std::ranges::find(paths, path), paths.end()) << path;
}

/// The example of three blocks side by side.
Design wall() {
  Design design = exampleDesign("three-block-wall").value();
  design.output.programs.clear();
  return design;
}

Design with(Design design, int stations) {
  for (Cut& cut : design.cuts) cut.sections.stations = stations;
  return design;
}

TEST(Wall, MeetsSmoothlyAndIsCertainOrHeld) {
  const Evaluation e = evaluate(wall(), nullptr, {}, Purpose::files).evaluation;
  ASSERT_EQ(e.blocks.size(), 3u);
  ASSERT_TRUE(e.complete());
  ASSERT_TRUE(e.joints.value);
  ASSERT_EQ(e.joints.value->joints.size(), 2u);
  EXPECT_LT(e.joints.value->gapMax(), 0.1);
  EXPECT_LT(toDegrees(e.joints.value->kinkMax()), 1);
  EXPECT_FALSE(exceedsLimit(e.findings()));
  for (const BlockEvaluation& block : e.blocks) {
    const CutResult result = *block.cuts.front().result();
    EXPECT_EQ(result.size(), 33u);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const StationView station = result.station(i);
      EXPECT_TRUE(station.rest == Rest::certain || station.rest == Rest::held) << block.id << " " << i;
      EXPECT_TRUE(station.pose.heavy);
      // The part in the block has the length of its section, and goes on at both ends.
      EXPECT_NEAR(station.pose.cut.length(), station.fit.target.length(), 0.02);
      EXPECT_GT(station.pose.before, 10);
      EXPECT_GT(station.pose.after(), 10);
    }
    // On common planes.
    for (std::size_t i = 0; i < result.size(); ++i)
      EXPECT_NEAR(result.sweep.poses[i].frame.origin.y(), e.cut().result()->sweep.poses[i].frame.origin.y(),
                  1e-6);
  }
}

TEST(Wall, WithoutJoinsHasGapsThatAreTold) {
  Design design = wall();
  design.process.join = Join::none;
  design.process.fitLength = FitOptions::Length::free;
  design.blade = bladePreset("nicr-flat-5x1").value();
  const Evaluation e = evaluate(design, nullptr, {}).evaluation;
  ASSERT_TRUE(e.joints.value);
  EXPECT_GT(e.joints.value->gapMax(), 0.1);
  const Findings findings = e.findings();
  const auto gap = std::ranges::find(findings, FindingKind::joint, &Finding::kind);
  ASSERT_NE(gap, findings.end());
  EXPECT_TRUE(exceedsLimit(findings));
  EXPECT_NE(words::sentence(*gap, words::Reader::commandLine).find("column-1 and column-2 meet with a gap"),
            std::string::npos);
  // The limits are the process's.
  design.process.jointGap = 5;
  EXPECT_EQ(
      std::ranges::count(evaluate(design, &e, {}).evaluation.findings(), FindingKind::joint, &Finding::kind),
      0);
}

TEST(Wall, TakesStationsUntilItsJointsHold) {
  // A surface that turns quickly along the travel: what 41 stations say of it is not enough at the joints.
  Design design = wall();
  auto& sections = std::get<SectionsSurface>(design.source().surface->shape).sections;
  const SectionCurve first = sections.front();
  sections.clear();
  for (int k = 0; k < 9; ++k) {
    sections.push_back(first);
    sections.back().y = 100.0 * k;
    for (std::size_t i = 0; i < first.points.size(); ++i)
      if (k % 2 == 1) sections.back().points[i].y() += i % 2 == 0 ? 20 : 10;
  }
  for (Cut& cut : design.cuts) cut.sections.stations.reset();
  const Evaluation before = evaluate(design, nullptr, {}).evaluation;
  const std::size_t count = before.result()->size();
  for (const BlockEvaluation& block : before.blocks)
    EXPECT_EQ(block.cuts.front().result()->size(), count) << "as many in each block";
  ASSERT_GT(before.joints.value->gapMax(), 0);
  // Less than is there between the stations asks for more of them. Twice as many have some 0.4 of it.
  design.process.jointGap = 0.7 * before.joints.value->gapMax();
  const Evaluation after = evaluate(design, nullptr, {}).evaluation;
  EXPECT_EQ(after.result()->size(), 2 * count - 1);
  EXPECT_LE(after.joints.value->gapMax(), design.process.jointGap);
  // A stated number is kept.
  const Evaluation stated = evaluate(with(design, int(count)), nullptr, {}).evaluation;
  EXPECT_EQ(stated.result()->size(), count);
  EXPECT_TRUE(exceedsLimit(stated.findings()));
}

TEST(Wall, IsUsedAgainWhereItDidNotChange) {
  const Evaluation before = evaluate(wall(), nullptr, {}).evaluation;
  Design design = wall();
  design.cuts[2].sections.stations = 17;
  const Evaluation after = evaluate(design, &before, {}).evaluation;
  EXPECT_EQ(after.blocks[0].cuts[0].rest.value, before.blocks[0].cuts[0].rest.value);
  EXPECT_NE(after.blocks[2].cuts[0].sweep.value, before.blocks[2].cuts[0].sweep.value);
  EXPECT_NE(after.joints.value, before.joints.value);
  EXPECT_EQ(evaluate(design, &after, {}).evaluation.joints.value, after.joints.value);
  // At planes that are not common the smooth way of the blade is compared.
  EXPECT_LT(after.joints.value->gapMax(), 0.1);
}

TEST(Wall, OfRowsAndWithGapsMeetsToo) {
  Design design = wall();
  design.grid->sizes[1] = {400, 396};
  design.grid->gaps = {{{0, 4}, {4}, {}}};
  design.grid->sizes[0] = {600, 600, 596};
  design.stock = stockOf(*design.grid);
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.sections.stations = 17;
  design.cuts = cutsOf(design.stock, {cut}, {});
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_EQ(e.blocks.size(), 6u);
  EXPECT_EQ(e.joints.value->joints.size(), 7u) << "four between columns, three between rows";
  EXPECT_LT(e.joints.value->gapMax(), 0.1);
  EXPECT_LT(toDegrees(e.joints.value->kinkMax()), 1);
}

/// The wall with 5 mm between its blocks.
Design gappedWall() {
  Design design = wall();
  design.grid->sizes[0] = {600, 595, 595};
  design.grid->gaps[0] = {5, 5};
  design.stock = stockOf(*design.grid);
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.sections.stations = 17;
  design.cuts = cutsOf(design.stock, {cut}, {});
  return design;
}

TEST(Wall, OfTwoMouldsMeetsOnEachSide) {
  for (const bool gaps : {false, true}) {
    Evaluation made = evaluate(gaps ? gappedWall() : with(wall(), 17), nullptr, {}).evaluation;
    const Result<Design> moulds = withUpperMoulds(made, 30);
    ASSERT_TRUE(moulds) << moulds.error().message;
    ASSERT_FALSE(moulds->grid);
    const Evaluation e = evaluate(*moulds, &made, {}).evaluation;
    ASSERT_EQ(e.blocks.size(), 6u);
    ASSERT_TRUE(e.joints.value);
    ASSERT_EQ(e.joints.value->joints.size(), 4u) << gaps << ": no lower one with an upper one";
    for (const Joint& joint : e.joints.value->joints) {
      EXPECT_EQ(e.blocks[joint.first].id.ends_with("-upper"), e.blocks[joint.second].id.ends_with("-upper"));
      EXPECT_EQ(joint.open, 0) << gaps;
      EXPECT_GT(joint.places, 60) << gaps;
    }
    EXPECT_LT(e.joints.value->gapMax(), 0.1) << gaps;
    EXPECT_LT(toDegrees(e.joints.value->kinkMax()), 1) << gaps;
  }
}

TEST(Wall, OfKeyBladesMeetsWhereTheirSurfacesDo) {
  for (const bool gaps : {false, true}) {
    Evaluation e = evaluate(gaps ? gappedWall() : with(wall(), 17), nullptr, {}).evaluation;
    for (const BlockEvaluation& block : std::vector<BlockEvaluation>(e.blocks)) {
      const Result<CutKeyBlades> keys = keyBladesOf(block.cuts[0], Told::target, 0.5, {});
      ASSERT_TRUE(keys) << keys.error().message;
      e.design = withSurface(e, block.cuts[0].id, keys->surface).value();
    }
    Design design = e.design;
    design.grid.reset();  // as files tell it
    ASSERT_EQ(design.sources.size(), 3u) << "a surface of its own each";
    const Evaluation own = evaluate(design, nullptr, {}).evaluation;
    ASSERT_TRUE(own.joints.value);
    ASSERT_EQ(own.joints.value->joints.size(), 2u) << gaps;
    for (const Joint& joint : own.joints.value->joints) EXPECT_GT(joint.places, 60) << gaps;
    EXPECT_LT(own.joints.value->gapMax(), 0.1) << gaps << ": fitted to meet";
    // A step is no gap.
    const Cut& last = design.cuts.back();
    std::ranges::find(design.sources, last.source, &Source::id)->surface->origin.z() += 40;
    const Evaluation stepped = evaluate(design, nullptr, {}).evaluation;
    ASSERT_TRUE(stepped.joints.value);
    EXPECT_EQ(stepped.joints.value->joints.size(), 1u) << gaps;
    EXPECT_TRUE(stepped.joints.findings.empty());
  }
}

TEST(Wall, OfLayersOverAGapMeetsAndHasItsParts) {
  Design design = wall();
  design.sources[0].surface =
      DesignedSurface{FormulaSurface{{{0, 0}, {600, 800}}, "350+0.4*(y-400)+10*sin(pi*y/400)"}};
  design.grid->sizes = {{{600}, {800}, {350, 300}}};
  design.grid->gaps = {{{}, {}, {6}}};
  design.stock = stockOf(*design.grid);
  design.process.floor = 0;
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.sections.stations.reset();
  design.cuts = cutsOf(design.stock, {cut}, {});
  const Evaluation e = evaluate(design, nullptr, {}, Purpose::files).evaluation;
  ASSERT_EQ(e.blocks.size(), 2u);
  ASSERT_TRUE(e.joints.value);
  ASSERT_EQ(e.joints.value->joints.size(), 1u);
  EXPECT_GT(e.joints.value->joints[0].places, 40);
  EXPECT_EQ(e.joints.value->joints[0].open, 0);
  EXPECT_LT(e.joints.value->gapMax(), 0.1);
  // The blade comes into the upper block along its bottom, less than a micron above it.
  ASSERT_TRUE(e.blocks[1].part.value && e.blocks[1].part.value->solid);
  const geometry::Part& part = *e.blocks[1].part.value->solid;
  EXPECT_EQ(part.pieces(), 1);
  double below = 0;  // the surface over the bottom of that block, at z = 356
  constexpr int kSteps = 8000;
  for (int i = 0; i < kSteps; ++i) {
    const double y = 800 * (i + 0.5) / kSteps;
    below += 600 * 800.0 / kSteps * std::max(0.0, 0.4 * (y - 400) + 10 * std::sin(kPi * y / 400) - 6);
  }
  EXPECT_NEAR(part.volume(), below, 1e-3 * below);
}

TEST(Wall, RowsGoOnWithOneSlopeInTheirSolids) {
  // Where a surface that bends along the travel passes from one row of blocks to the next, the blades go on
  // straight out of either, which must not bend what is made of them before the boundary.
  Design design = wall();
  design.variables.clear();
  design.grid = BlockGrid{};
  design.grid->sizes = {{std::vector<double>{600}, {550, 450}, {500}}};
  design.grid->gaps = {{std::vector<double>{}, {0}, {}}};
  design.stock = stockOf(*design.grid);
  design.sources.front().surface =
      DesignedSurface{FormulaSurface{{{0, 0}, {600, 1000}}, "250+40*sin(pi*x/600)+60*sin(pi*y/300)"}};
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.sections.stations = 20;
  design.cuts = cutsOf(design.stock, {cut}, {});
  const Outcome outcome = evaluate(design, nullptr, {}, Purpose::files);
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  ASSERT_EQ(outcome.evaluation.blocks.size(), 2u);
  // At a y, in the middle of the blade.
  const auto height = [&](std::size_t block, double y) {
    const SplineSurface& surface = outcome.evaluation.blocks[block].cuts.front().swept.value->surface;
    double low = surface.knotsV.front(), high = surface.knotsV.back();
    const bool rising = surface.value(0.5, high).y() > surface.value(0.5, low).y();
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((surface.value(0.5, middle).y() < y) == rising ? low : high) = middle;
    }
    return surface.value(0.5, low).z();
  };
  constexpr double kStep = 0.02;
  double slopes[2];
  for (std::size_t k = 0; k < 2; ++k)
    slopes[k] = (height(k, 550 + kStep) - height(k, 550 - kStep)) / (2 * kStep);
  EXPECT_LT(toDegrees(std::abs(slopes[0] - slopes[1])), 0.15) << slopes[0] << " " << slopes[1];
}

TEST(Wall, LeavesOutBlocksThatTheSurfaceMisses) {
  Design design = wall();
  design.grid->sizes[2] = {100, 400, 300};
  design.grid->gaps[2] = {0, 0};
  design.stock = stockOf(*design.grid);
  Cut cut = design.cuts.front();
  cut.id = "cut";
  design.cuts = cutsOf(design.stock, {cut}, {});
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_EQ(e.blocks.size(), 3u);
  for (const BlockEvaluation& block : e.blocks)
    EXPECT_NE(block.id.find("layer-2"), std::string::npos) << block.id;
  ASSERT_EQ(e.missed.size(), 1u);
  EXPECT_EQ(std::get<BlocksMissed>(e.missed[0].cause).blocks.size(), 6u);
  EXPECT_EQ(e.missed[0].severity, Severity::info);
  // None at all is an error.
  design.grid->origin.z() = 5000;
  design.stock = stockOf(*design.grid);
  const Outcome none = evaluate(design, nullptr, {});
  ASSERT_TRUE(none.error);
  EXPECT_NE(none.error->message.find("none of the 9 blocks"), std::string::npos) << none.error->message;
  EXPECT_FALSE(none.evaluation.result());
}

TEST(Wall, ABlockThatCannotBeCutLeavesTheOthers) {
  // Two layers: in one of each column lie two islands of the surface, which no one blade cuts.
  Design design = wall();
  design.variables.clear();
  design.grid = BlockGrid{};
  design.grid->sizes = {{std::vector<double>{600, 600}, {800}, {500, 500}}};
  design.grid->gaps = {{std::vector<double>{0}, {}, {0}}};
  design.stock = stockOf(*design.grid);
  design.sources.front().surface =
      DesignedSurface{FormulaSurface{{{0, 0}, {1200, 800}}, "500+120*sin(2*pi*x/1200)+15*sin(2*pi*y/800)"}};
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.sections.stations = 9;
  design.cuts = cutsOf(design.stock, {cut}, {});
  design.blade.youngModulus = 200000;  // bends to 360 mm
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  std::vector<std::string> uncut;
  for (const Finding& finding : e.findings())
    if (const auto* cause = std::get_if<BlockUncut>(&finding.cause)) {
      EXPECT_EQ(finding.severity, Severity::error);
      EXPECT_NE(cause->reason.find("none of the 9 planes"), std::string::npos) << cause->reason;
      uncut.push_back(finding.where.block);
    }
  EXPECT_EQ(uncut, (std::vector<std::string>{"column-1-layer-1", "column-2-layer-2"}));
  ASSERT_EQ(e.blocks.size() + uncut.size(), 4u);
  EXPECT_EQ(e.uncut, uncut);
  // What lies in them counts as not covered.
  const Overall all = overallOf(e);
  double area = e.uncutArea, uncovered = e.uncutArea;
  for (const BlockEvaluation& block : e.blocks) {
    area += block.cuts.front().coverage.value->area;
    uncovered += block.cuts.front().coverage.value->uncovered;
  }
  EXPECT_GT(e.uncutArea, 0.02 * area);
  EXPECT_NEAR(all.covered, 1 - uncovered / area, 1e-12);
  const std::string page = reportHtml(reportOf(e, {}, {}));
  EXPECT_NE(page.find("Blocks that the surface meets and no blade can cut"), std::string::npos);
  EXPECT_NE(page.find("<td>Shape of the blade at the stations</td>"), std::string::npos);
  for (const BlockEvaluation& block : e.blocks) EXPECT_TRUE(block.cuts.front().result()) << block.id;
  // Held at the boundary the blades of the others are 2.7 mm off, and would not be without that.
  int held = 0;
  for (const Finding& finding : e.findings())
    if (const auto* cause = std::get_if<TooFar>(&finding.cause)) {
      ASSERT_TRUE(cause->unheld) << finding.where.block;
      EXPECT_LT(*cause->unheld, 0.5 * cause->deviation);
      ++held;
    }
  EXPECT_EQ(held, 2);
  // Of a block alone it is the answer.
  design.stock = {design.stock.front()};
  std::erase_if(design.cuts, [&](const Cut& one) { return one.block != design.stock.front().id; });
  design.grid.reset();
  const Outcome alone = evaluate(design, nullptr, {});
  ASSERT_TRUE(alone.error);
  EXPECT_NE(alone.error->message.find("none of the 9 planes"), std::string::npos) << alone.error->message;
}

TEST(Wall, ABlockWhoseBladeIsTooShortLeavesTheOthers) {
  Design design = wall();
  design.grid->sizes[0] = {500, 800, 500};
  design.stock = stockOf(*design.grid);
  for (Cut& cut : design.cuts) cut.sections.stations = 9;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_EQ(e.uncut.size(), 1u);
  ASSERT_EQ(e.blocks.size(), 2u);
  bool told = false;
  for (const Finding& finding : e.findings())
    if (const auto* cause = std::get_if<BlockUncut>(&finding.cause)) {
      told = finding.severity == Severity::error && finding.where.block == e.uncut.front() &&
             cause->reason.find("is shorter than the section") != std::string::npos;
      EXPECT_TRUE(told) << cause->reason;
    }
  EXPECT_TRUE(told);
  for (const BlockEvaluation& block : e.blocks) EXPECT_TRUE(block.cuts.front().result()) << block.id;
  EXPECT_GT(e.uncutArea, 0.4 * 800 * 800);
  EXPECT_LT(overallOf(e).covered, 0.7);
}

TEST(Wall, IsCutObliquelyWithJointsThatAreMeasured) {
  Design design = wall();
  design.variables.clear();
  design.grid = BlockGrid{};
  design.grid->sizes = {{std::vector<double>{600, 500}, {800}, {500}}};
  design.grid->gaps = {{std::vector<double>{0}, {}, {}}};
  design.stock = stockOf(*design.grid);
  design.sources.front().surface =
      DesignedSurface{FormulaSurface{{{-20, -20}, {1120, 820}}, "250+30*sin(pi*x/1200)+15*cos(2*pi*y/1400)"}};
  Cut cut = design.cuts.front();
  cut.id = "cut";
  cut.direction = Eigen::Vector3d(0.3, 1, 0);
  cut.sections.stations = 21;
  design.cuts = cutsOf(design.stock, {cut}, {});
  design.blade.length = 1000;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Joints& joints = *outcome.evaluation.joints.value;
  ASSERT_EQ(joints.joints.size(), 1u);
  EXPECT_GT(joints.joints.front().places, 40);
  EXPECT_EQ(joints.joints.front().open, 0);
  EXPECT_LT(joints.gapMax(), 0.1);
}

TEST(Wall, OfMoreBlocksThanAreEvaluatedIsRefusedAtOnce) {
  Design design = wall();
  design.grid->sizes = {{std::vector<double>(50, 36), std::vector<double>(50, 16), {500}}};
  design.grid->gaps = {{std::vector<double>(49, 0), std::vector<double>(49, 0), {}}};
  design.stock = stockOf(*design.grid);
  Cut cut = design.cuts.front();
  cut.id = "cut";
  design.cuts = cutsOf(design.stock, {cut}, {});
  ASSERT_EQ(design.stock.size(), 2500u);
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->code, ErrorCode::badInput);
  EXPECT_NE(outcome.error->message.find("2500 blocks; at most 256"), std::string::npos)
      << outcome.error->message;
  EXPECT_LT(outcome.evaluation.seconds.total, 5);
}

TEST(Wall, NamesTheBlockOfAnError) {
  Design design = wall();
  design.blade.length = 610;
  design.process.clearance = 0;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->message.rfind("column-", 0), 0u) << outcome.error->message;
}

TEST(ManyCuts, ThatNameNothingAreRefused) {
  const auto told = [](const auto& change, const char* words) {
    Design design = three();
    change(design);
    const Outcome outcome = evaluate(design, nullptr, {});
    ASSERT_TRUE(outcome.error);
    EXPECT_NE(outcome.error->message.find(words), std::string::npos) << outcome.error->message;
    EXPECT_FALSE(outcome.evaluation.result());
  };
  told([](Design& d) { d.cuts[1].source = "wall"; }, "is of the source \"wall\"");
  told([](Design& d) { d.cuts[1].block = "none"; }, "names the block \"none\"");
  told([](Design& d) { d.cuts.pop_back(); }, "block \"small\" has no cut");
}

}  // namespace
}  // namespace bw::pipeline
