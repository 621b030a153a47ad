// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Several cuts of one block: their order, how the block lies for each, the crease that they leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/base/units.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/report_page.h"

namespace bw::pipeline {
namespace {

Design crossing() {
  Design design = exampleDesign("two-crossing-cuts").value();
  design.output.programs.clear();
  return design;
}

std::vector<std::string> idsOf(const BlockEvaluation& block) {
  std::vector<std::string> ids;
  for (const CutEvaluation& cut : block.cuts) ids.push_back(cut.id);
  return ids;
}

/// A flat source with its cut, in front of the others.
void addFlat(Design& design, const std::string& id, double height) {
  Source source;
  source.id = id;
  source.surface = DesignedSurface{FormulaSurface{{{0, 0}, {600, 600}}, std::to_string(height)}};
  design.sources.push_back(source);
  Cut cut = design.cut();
  cut.id = cut.source = id;
  cut.pose = {};
  design.cuts.insert(design.cuts.begin(), cut);
}

TEST(BlockCuts, TwoThatCrossLeaveTheCreaseDesigned) {
  const Design design = crossing();
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_TRUE(e.complete());
  EXPECT_FALSE(hasErrors(e.findings()));
  const BlockEvaluation& block = e.blocks.front();
  ASSERT_TRUE(block.together.value);
  ASSERT_EQ(block.together.value->creases.size(), 1u);
  const Crease& crease = block.together.value->creases.front();
  // The report tells it beside the limits, and both surfaces.
  const std::string page = reportHtml(reportOf(outcome.evaluation, {}, {}));
  for (const char* told : {"<td>east: Surface</td>", "<td>north: Surface</td>",
                           "<td>Edge of north and east, off where the surfaces designed meet</td>",
                           " certain</td><td>certain or held</td><td class=\"good\">"})
    EXPECT_NE(page.find(told), std::string::npos) << told;
  // Where base, slope x + bow sin(πx/600) + ripple sin(2πy/600) is the same with x and y exchanged.
  const auto apart = [](const Eigen::Vector3d& p) {
    const double x = p.x() / 600, y = p.y() / 600, pi = M_PI;
    return 0.35 * (p.x() - p.y()) + 40 * (std::sin(pi * x) - std::sin(pi * y)) +
           12 * (std::sin(2 * pi * y) - std::cos(2 * pi * x));
  };
  double most = 0;
  for (const Polyline& curve : crease.curves)
    for (const Eigen::Vector3d& p : curve) most = std::max(most, std::abs(apart(p)) / 0.35);
  EXPECT_GT(crease.length, 750) << "across the block";
  EXPECT_LT(crease.offMax, 2);
  EXPECT_GT(crease.offMax, 0) << "elastica are no sines";
  EXPECT_LT(most, 8) << "the same by the formula, to first order";
  EXPECT_EQ(crease.lacking, 0);
  EXPECT_EQ(crease.alone, 0);
}

TEST(BlockCuts, TheLowestIsMadeFirstUnlessTheDesignTells) {
  Design design = crossing();
  design.variables.clear();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  addFlat(design, "high", 250);
  addFlat(design, "low", 40);
  const Outcome byHeight = evaluate(design, nullptr, {});
  ASSERT_FALSE(byHeight.error) << byHeight.error->message;
  EXPECT_EQ(idsOf(byHeight.evaluation.blocks.front()).front(), "low");
  EXPECT_EQ(byHeight.evaluation.blocks.front().cuts.size(), 1u) << "nothing else is left above it";

  for (Cut& cut : design.cuts)
    cut.order = cut.id == "low" ? 4 : cut.id == "north" ? 1 : cut.id == "east" ? 2 : 3;
  const Outcome told = evaluate(design, &byHeight.evaluation, {});
  ASSERT_FALSE(told.error) << told.error->message;
  EXPECT_EQ(idsOf(told.evaluation.blocks.front()),
            (std::vector<std::string>{"north", "east", "high", "low"}));
  EXPECT_TRUE(std::ranges::none_of(told.evaluation.missed, [](const Finding& finding) {
    return std::holds_alternative<CutDropped>(finding.cause);
  }));
}

TEST(BlockCuts, ErrorsNameTheCutThatTheyAreOf) {
  Design design = crossing();
  design.variables.clear();
  design.cuts.back().length = 610;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->message.find(design.cuts.back().id + ": the blade of 610 mm is shorter"), 0u)
      << outcome.error->message;
}

TEST(BlockCuts, AFaceThatIsNotThereIsToldOfItsCut) {
  Design design = crossing();
  design.cuts.back().face = {FaceChoice::Kind::indices, {7}};
  const Outcome one = evaluate(design, nullptr, {});
  ASSERT_TRUE(one.error);
  EXPECT_EQ(one.error->message.find(design.cuts.back().id + ": "), 0u) << one.error->message;
}

TEST(BlockCuts, WhatTheCellCannotDoIsToldOfItsCut) {
  // Turned by a half more, its left end lies on the side of the right robot.
  Design design = crossing();
  design.variables.clear();
  design.cuts.back().pose.quarters = 3;
  design.output.programs = {"rapid"};
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  int seen = 0;
  for (const Finding& finding : outcome.evaluation.cell.findings) {
    EXPECT_FALSE(finding.where.cut.empty()) << words::sentence(finding, words::Reader::window);
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

TEST(BlockCuts, WhatMeetsNothingIsDroppedWithAMessage) {
  Design design = crossing();
  addFlat(design, "lid", 480);
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  EXPECT_EQ(idsOf(e.blocks.front()), (std::vector<std::string>{"north", "east"}));
  ASSERT_EQ(e.missed.size(), 1u);
  ASSERT_TRUE(std::holds_alternative<CutDropped>(e.missed.front().cause));
  const CutDropped& dropped = std::get<CutDropped>(e.missed.front().cause);
  EXPECT_EQ(dropped.cut, "lid");
  EXPECT_EQ(dropped.met, 0);
  EXPECT_EQ(e.missed.front().severity, Severity::warning);
  EXPECT_TRUE(e.complete());
  // Within the tolerance it is dropped, above it is made: east goes through z = 120 + … + 210 at its end.
  EXPECT_FALSE(words::sentence(e.missed.front(), words::Reader::window).empty());
}

TEST(BlockCuts, WhatLeavesASheetIsMade) {
  // The second comes a millimetre under what the first leaves, and takes all but that.
  Design design = crossing();
  design.variables.clear();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  addFlat(design, "over", 201);
  addFlat(design, "under", 200);
  design.cuts.erase(design.cuts.begin() + 2, design.cuts.end());
  design.cuts.front().keep = KeptSide::above;
  const Outcome sheet = evaluate(design, nullptr, {});
  ASSERT_FALSE(sheet.error) << sheet.error->message;
  EXPECT_EQ(idsOf(sheet.evaluation.blocks.front()).size(), 2u);
  EXPECT_TRUE(sheet.evaluation.missed.empty());
}

TEST(BlockCuts, ASurfaceThatLeavesTheBlockOnTheWayIsShownWithoutFolds) {
  // Through the top, obliquely: its sections grow short, are none, and grow again.
  Design design = crossing();
  design.variables.clear();
  design.cuts.resize(1);
  design.cuts.front().pose = {};
  design.cuts.front().sections.stations = 101;
  design.sources = {design.source()};
  design.sources.front().id = design.cuts.front().source;
  const Box block = design.stock.front().placement->box();
  ASSERT_EQ(block.size.x(), 600);
  const double top = block.size.z(), deep = block.size.y();
  design.sources.front().surface = DesignedSurface{
      FormulaSurface{{{0, 0}, {600, deep}},
                     std::to_string(top - 60) + "+100*sin(pi*y/" + std::to_string(deep) + ")-0.05*x"}};
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const CutEvaluation& cut = outcome.evaluation.cut();
  const std::vector<BladePose>& poses = cut.sweep.value->poses;
  EXPECT_TRUE(std::ranges::adjacent_find(
                  poses, [](const BladePose& a, const BladePose& b) { return b.index > a.index + 1; }) !=
              poses.end())
      << "no station is left out";
  const SweepAnalysis& analysis = *cut.analysis.value;
  const Eigen::Vector3d way = cut.setup->planes.direction();
  for (int r = 1; r < analysis.cut.rows; ++r)
    for (int c = 0; c < analysis.cut.columns; ++c)
      ASSERT_GT((analysis.cut.at(r, c) - analysis.cut.at(r - 1, c)).dot(way), 0) << r << " " << c;
  EXPECT_LT(analysis.summary.deviationMax, 0.2);
}

/// A source over a part of the block, with its cut at the end of the list.
void addPart(Design& design, const std::string& id, double from, double to, const std::string& formula) {
  Source source;
  source.id = id;
  source.surface = DesignedSurface{FormulaSurface{{{from, 0}, {to, 600}}, formula}};
  design.sources.push_back(source);
  Cut cut = design.cut();
  cut.id = cut.source = id;
  cut.sections.stations = 9;
  design.cuts.push_back(cut);
}

TEST(BlockCuts, ACutThatIsLostToAnotherOnesBladeIsNoDroppedOneAlone) {
  // A terrace: the blade of the lower step goes on through the higher one.
  Design design = crossing();
  design.process.clearance = 30;
  addPart(design, "high", 0, 300, "350+0*x");
  addPart(design, "low", 300, 600, "200+0*x");
  design.cuts.erase(design.cuts.begin(), design.cuts.begin() + 2);
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  ASSERT_EQ(e.missed.size(), 1u) << "the high one meets nothing of what is left";
  const Findings found = e.findings();
  const auto taken = std::ranges::find_if(
      found, [](const Finding& finding) { return std::holds_alternative<TakesSurface>(finding.cause); });
  ASSERT_NE(taken, found.end());
  EXPECT_EQ(taken->severity, Severity::error);
  EXPECT_EQ(std::get<TakesSurface>(taken->cause).of, "high");
  EXPECT_NEAR(std::get<TakesSurface>(taken->cause).depth, 150, 1);
}

TEST(BlockCuts, FewStationsLeaveTheCreaseOfPlanesWhereItIs) {
  // Slanted travels end in the block's faces: the straight way beyond must not bend what is in it.
  Design design = crossing();
  design.process.clearance = 30;
  addPart(design, "falls", 0, 600, "423.5-0.25*(y-300)+0.25*(x-300)");
  addPart(design, "rises", 0, 600, "415+0.35*(x-300)");
  design.cuts.erase(design.cuts.begin(), design.cuts.begin() + 2);
  design.cuts[0].direction = Eigen::Vector3d::UnitX();
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const CutsTogether& together = *outcome.evaluation.blocks[0].together.value;
  ASSERT_EQ(together.creases.size(), 1u);
  EXPECT_LT(together.creases[0].offMax, 0.1);
  EXPECT_GT(together.creases[0].length, 300);
}

TEST(BlockCuts, GravityTurnsWithTheBlock) {
  Design design = crossing();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  design.cuts[1].pose = {BlockFace::bottom, 0};
  design.cuts[1].keep = KeptSide::above;  // what lies above while it lies upside down
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  const CutEvaluation &east = *e.find("east"), &north = *e.find("north");
  const Eigen::Vector3d down = east.sweep.value->request.weight, turned = north.sweep.value->request.weight;
  EXPECT_LT(down.z(), 0);
  EXPECT_TRUE(turned.isApprox(-down));
  EXPECT_TRUE(north.setup->block.frame.normal.isApprox(-Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(e.blocks.front().together.value->creases.size(), 1u) << "the same part";
}

TEST(BlockCuts, ATurnAboutTheVerticalLeavesTheBladesAsTheyAre) {
  Design design = crossing();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  const Outcome turned = evaluate(design, nullptr, {});
  design.cuts[1].pose = {};
  const Outcome placed = evaluate(design, nullptr, {});
  ASSERT_FALSE(turned.error || placed.error);
  const Sweep &a = *turned.evaluation.find("north")->sweep.value,
              &b = *placed.evaluation.find("north")->sweep.value;
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_LT((a.poses[i].leftPoint() - b.poses[i].leftPoint()).norm(), 0.05);
    EXPECT_LT((a.poses[i].rightPoint() - b.poses[i].rightPoint()).norm(), 0.05);
  }
  // In the frame of the work object the blade travels along y in the one and along x in the other.
  const auto travel = [](const Evaluation& e) {
    const Motion& motion = *e.find("north")->motion.value;
    return Eigen::Vector3d(motion.instants.back().poses[0].position -
                           motion.instants.front().poses[0].position);
  };
  EXPECT_GT(travel(turned.evaluation).y(), 600);
  EXPECT_LT(std::abs(travel(turned.evaluation).x()), 100);
  EXPECT_GT(travel(placed.evaluation).x(), 600);
}

TEST(BlockCuts, ACutMayHaveABladeOfItsOwnLength) {
  Design design = crossing();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  design.cuts[1].length = 850;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  EXPECT_EQ(outcome.evaluation.find("east")->motion.value->bladeLength, 800);
  EXPECT_EQ(outcome.evaluation.find("north")->motion.value->bladeLength, 850);
}

TEST(BlockCuts, AnUprightCutNeedsItsSideTold) {
  Design design = crossing();
  Source source;
  source.id = "wall";
  // Turned so that it stands at x = 200.
  source.surface = DesignedSurface{FormulaSurface{{{0, 0}, {500, 600}}, "0"}, {200, 0, 0}, {0, -M_PI / 2, 0}};
  design.sources.push_back(source);
  Cut cut = design.cut();
  cut.id = cut.source = "wall";
  cut.sections.stations = 6;
  cut.order = 1;
  design.cuts.push_back(cut);
  const Outcome unsaid = evaluate(design, nullptr, {});
  ASSERT_TRUE(unsaid.error);
  EXPECT_EQ(unsaid.error->code, ErrorCode::badInput);
  EXPECT_NE(unsaid.error->message.find("wall: "), std::string::npos) << unsaid.error->message;
  EXPECT_NE(unsaid.error->message.find("keep"), std::string::npos) << unsaid.error->message;
}

TEST(BlockCuts, NothingIsMadeAnewWhereNothingChanged) {
  Design design = crossing();
  for (Cut& cut : design.cuts) cut.sections.stations = 6;
  const Outcome first = evaluate(design, nullptr, {});
  ASSERT_FALSE(first.error);
  design.name = "Other";
  const Outcome second = evaluate(design, &first.evaluation, {});
  ASSERT_FALSE(second.error);
  EXPECT_EQ(second.evaluation.blocks[0].together.value, first.evaluation.blocks[0].together.value);
  EXPECT_EQ(second.evaluation.blocks[0].met.value, first.evaluation.blocks[0].met.value);
  EXPECT_EQ(second.evaluation.find("north")->swept.value, first.evaluation.find("north")->swept.value);
  design.cuts[0].keep = KeptSide::above;
  const Outcome third = evaluate(design, &first.evaluation, {});
  ASSERT_FALSE(third.error);
  EXPECT_NE(third.evaluation.blocks[0].met.value, first.evaluation.blocks[0].met.value);
}

TEST(BlockCuts, WhatIsLeftIsASolid) {
  const Design design = crossing();
  Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  EXPECT_FALSE(outcome.evaluation.blocks[0].part.value) << "not while it is dragged";
  ASSERT_TRUE(addParts(outcome.evaluation, {}));
  const BlockPart& part = *outcome.evaluation.blocks[0].part.value;
  ASSERT_TRUE(part.solid);
  // The lower of both formulas, by the midpoint rule.
  constexpr int kSteps = 600;
  double volume = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = (i + 0.5) / kSteps, y = (j + 0.5) / kSteps, pi = M_PI;
      const double east = 120 + 210 * x + 40 * std::sin(pi * x) + 12 * std::sin(2 * pi * y);
      const double north = 120 + 210 * y + 40 * std::sin(pi * y) + 12 * std::cos(2 * pi * x);
      volume += std::min(east, north);
    }
  volume *= 360000.0 / (kSteps * kSteps);
  EXPECT_NEAR(part.solid->volume(), volume, 0.1 * 360000) << "within the mean deviation of the cuts";
  EXPECT_EQ(part.solid->blockVolume(), 600.0 * 600 * 500);
  EXPECT_EQ(part.solid->pieces(), 1);
  EXPECT_NEAR(part.solid->steps()[0].removed + part.solid->steps()[1].removed + part.solid->volume(),
              part.solid->blockVolume(), 200);
  EXPECT_FALSE(part.mesh.triangles.empty());
  // It is kept where nothing of it changes.
  Design renamed = design;
  renamed.name = "Other";
  const Outcome again = evaluate(renamed, &outcome.evaluation, {});
  EXPECT_EQ(again.evaluation.blocks[0].part.value, outcome.evaluation.blocks[0].part.value);
  renamed.cuts[0].sections.stations = 20;
  EXPECT_FALSE(evaluate(renamed, &outcome.evaluation, {}).evaluation.blocks[0].part.value);
}

TEST(BlockCuts, ABlockThatFallsIntoPiecesIsTold) {
  Design design = crossing();
  design.variables.clear();
  addFlat(design, "lid", 400);
  addFlat(design, "valley", 0);
  design.cuts.resize(2);
  std::get<FormulaSurface>(design.sources.back().surface->shape).formula = "100*cos(2*pi*x/600)";
  design.cuts[0].direction = Eigen::Vector3d::UnitX();  // straight blades
  design.cuts[0].order = 2;
  design.cuts[1].order = 1;
  for (Cut& cut : design.cuts) cut.sections.stations = 25;
  Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  ASSERT_TRUE(addParts(outcome.evaluation, {}));
  const std::optional<geometry::Part>& solid = outcome.evaluation.blocks[0].part.value->solid;
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->pieces(), 2);
  EXPECT_NEAR(solid->volume(), 600 * 600 * 100 / M_PI, 0.02 * 600 * 600 * 100 / M_PI);
  const Findings found = outcome.evaluation.findings();
  EXPECT_TRUE(std::ranges::any_of(found, [](const Finding& finding) {
    const auto* left = std::get_if<PiecesLeft>(&finding.cause);
    return left && left->pieces == 2 && finding.severity == Severity::warning;
  }));
}

TEST(BlockCuts, TheReportAndTheProgramsTellAllOfThem) {
  Design design = exampleDesign("two-crossing-cuts").value();
  const Product product = produce(design, {}, {}, {});
  ASSERT_FALSE(product.error) << product.error->message;
  EXPECT_EQ(product.status(), kDone);
  nlohmann::json report;
  std::string step, whole;
  int modules = 0;
  bool told = false;
  for (std::size_t i = 0; i < product.files.paths().size(); ++i) {
    const std::string name = product.files.paths()[i].generic_string(), &text = product.files.bytes()[i];
    if (name == "report.json") report = nlohmann::json::parse(text);
    if (name == "parts.step") step = text;
    if (name == "blocks.step") whole = text;
    if (!name.ends_with(".mod")) continue;
    ++modules;
    const bool first = name.find("strip-0") != std::string::npos;
    told = told || (text.find("cut 1 of 2 of block") != std::string::npos &&
                    text.find("turned by 90 degrees") != std::string::npos);
    EXPECT_NE(text.find("see that what stays is the foam below the cut"), std::string::npos) << name;
    EXPECT_EQ(text.find("make north before it") == std::string::npos, first) << name;
    // Whoever laid it otherwise before lays it back.
    EXPECT_EQ(text.find("its top face up, not turned") == std::string::npos, first) << name;
  }
  EXPECT_EQ(modules, 4) << "two robots, two cuts";
  EXPECT_TRUE(told);
  const auto& block = report["blocks"][0];
  ASSERT_EQ(block["creases"].size(), 1u);
  EXPECT_EQ(block["creases"][0]["cuts"], (nlohmann::json{"north", "east"}));
  EXPECT_LT(block["creases"][0]["off_max_mm"], 2.0);
  ASSERT_FALSE(block["creases"][0]["curves"].empty());
  for (const auto& curve : block["creases"][0]["curves"]) {
    ASSERT_EQ(curve["points"].size(), curve["off_mm"].size());
    ASSERT_GE(curve["points"].size(), 2u);
    EXPECT_EQ(curve["points"][0].size(), 3u);
    for (const auto& off : curve["off_mm"]) EXPECT_LE(off.get<double>(), block["creases"][0]["off_max_mm"]);
  }
  EXPECT_EQ(block["cuts"][0]["turn_deg"], 90);
  EXPECT_EQ(report["strips"].size(), 2u);
  EXPECT_EQ(block["part"]["pieces"], 1);
  EXPECT_EQ(block["part"]["cuts"][0]["cut"], "north");
  const Result<geometry::CadModel> part = geometry::CadModel::readBytes(step, "parts.step");
  ASSERT_TRUE(part) << part.error().message;
  EXPECT_EQ(part->info().solids, 1);
  EXPECT_NEAR(part->info().bounds.max.x() - part->info().bounds.min.x(), 600, 0.01);
  const Result<geometry::CadModel> uncut = geometry::CadModel::readBytes(whole, "blocks.step");
  ASSERT_TRUE(uncut) << uncut.error().message;
  EXPECT_EQ(uncut->info().solids, 1);
  EXPECT_EQ(uncut->info().faces, 6);
  EXPECT_GT(uncut->info().bounds.max.z(), part->info().bounds.max.z()) << "what the cuts take is still there";
}

}  // namespace
}  // namespace bw::pipeline
