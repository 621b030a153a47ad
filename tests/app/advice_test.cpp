// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is advised where stations are lost comes about when it is done.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "bw/core/blade/blade.h"
#include "bw/core/design/variables.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/pipeline.h"
#include "bw/words/findings.h"

namespace bw::pipeline {
namespace {

Design panel(const char* preset, double length) {
  Design design = exampleDesign("panel-600x670").value();
  design.output.programs.clear();
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 12;
  design.blade = bladePreset(preset).value();
  design.blade.length = length;
  design.process.clearance = 50;
  return design;
}

/// A blade that no length keeps in its shape, with grips so far from the block.
Design thin() {
  Design design = panel("nicr-flat-5x1", 760);
  design.cut().sections.stations = 16;
  design.blade.thickness = 0.65;
  design.process.clearance = 70;
  return design;
}

Evaluation evaluated(const Design& design, Purpose purpose = Purpose::files) {
  Outcome outcome = evaluate(design, nullptr, {}, purpose);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

std::ptrdiff_t lostOf(const Evaluation& e) {
  return std::ranges::count(e.cut().rest.value->stations, Rest::lost);
}

/// The first error of a cause that a remedy is known for, as it is said; null if there is none.
template <class Cause, class Remedy>
struct Advice {
  std::optional<Remedy> remedy = std::nullopt;
  std::string text = {};

  explicit Advice(const Evaluation& e) {
    for (const Finding& finding : e.findings()) {
      const Remedy* found = remedyOf<Remedy>(finding.remedies);
      if (!std::holds_alternative<Cause>(finding.cause) || !found || remedy) continue;
      remedy = *found;
      text = words::sentence(finding, words::Reader::commandLine);
    }
  }
};

TEST(Advice, AMarginThatIsAdvisedKeepsWhatWasLostForWantOfIt) {
  Design design = panel("steel-rod-1", 800);
  design.process.margin = 0;
  design.process.tolerance = 4;
  const Evaluation before = evaluated(design);
  ASSERT_GT(lostOf(before), 0);
  const Advice<OtherShape, OtherMargin> advice(before);
  ASSERT_TRUE(advice.remedy);
  EXPECT_NE(advice.text.find("which a touch may bring about; "), std::string::npos) << advice.text;
  EXPECT_NE(advice.text.find("this blade serves where a stability margin of 0.1 is asked for"),
            std::string::npos)
      << advice.text;
  design.process.margin = advice.remedy->margin;
  const Evaluation after = evaluated(design);
  EXPECT_EQ(lostOf(after), 0);
  EXPECT_FALSE(hasErrors(after.findings()));
  EXPECT_LE(after.result()->analysis.summary.deviationMax, design.process.tolerance);
}

TEST(Advice, ARoundBladeNeedsNoneToStayInItsPlane) {
  Design design = panel("steel-tube-3-2.5", 1000);
  design.process.margin = 0;
  design.process.gripError = design.process.gripAngle = 0;
  const Evaluation e = evaluated(design);
  EXPECT_EQ(lostOf(e), 0);
  for (const StationCheck& station : e.cut().check.value->stations) EXPECT_GT(station.outOfPlaneMargin, 0);
}

TEST(Advice, AClearanceThatIsAdvisedKeepsWhatNoLengthDoes) {
  Design design = thin();
  const Evaluation before = evaluated(design);
  ASSERT_GT(lostOf(before), 0);
  ASSERT_FALSE(before.cut().lengths.value->best) << "no length serves with the clearance asked for";
  const Advice<OtherShape, OtherClearance> advice(before);
  ASSERT_TRUE(advice.remedy && advice.remedy->length);
  EXPECT_LT(advice.remedy->clearance, design.process.clearance);
  EXPECT_NE(advice.text.find(" mm serves where grips may come within "), std::string::npos) << advice.text;
  EXPECT_EQ(advice.text.find("cut in parts"), std::string::npos) << advice.text;
  EXPECT_TRUE((Advice<ServingLengths, OtherClearance>(before).remedy));
  design.process.clearance = advice.remedy->clearance;
  design.blade.length = *advice.remedy->length;
  const Evaluation after = evaluated(design);
  EXPECT_EQ(lostOf(after), 0);
  EXPECT_FALSE(exceedsLimit(after.findings()));
}

TEST(Advice, TheLengthThatIsToKeepTheClearanceDoes) {
  Design design = exampleDesign("ripple-along").value();
  design.output.programs.clear();
  const auto ask = [&](const char* text, int stations, double clearance, double margin, double tolerance) {
    design.sources[0].surface = DesignedSurface{FormulaSurface{{{0, 0}, {600, 800}}, text}};
    design.cut().sections.stations = stations;
    design.blade.length = 700;
    design.process.clearance = clearance;
    design.process.margin = margin;
    design.process.tolerance = tolerance;
  };
  // By what its stations need, each for itself, it would be 814 mm: grips pass at 79.98 mm then.
  ask("250+100*sin(pi*x/600)*(0.6+0.4*sin(pi*y/800))", 25, 80, 0.2, 1.5);
  const Advice<GripTooNear, OtherLength> advice(evaluated(design));
  ASSERT_TRUE(advice.remedy);
  EXPECT_NE(advice.text.find("; try a blade of "), std::string::npos) << advice.text;
  design.blade.length = advice.remedy->length;
  EXPECT_FALSE(exceedsLimit(evaluated(design).findings()));

  // Here none serves, whatever clearance it keeps.
  ask("250-50*sin(pi*x/600)*sin(2*pi*y/800)+20*sin(2*pi*x/600)", 17, 50, 0.15, 3);
  const Evaluation e = evaluated(design);
  EXPECT_FALSE((Advice<GripTooNear, OtherLength>(e).remedy));
  const Findings findings = e.findings();
  const auto near = std::ranges::find_if(
      findings, [](const Finding& f) { return std::holds_alternative<GripTooNear>(f.cause); });
  ASSERT_NE(near, findings.end());
  EXPECT_NE(words::sentence(*near, words::Reader::commandLine).find(" mm) would not serve; "),
            std::string::npos);
}

/// On sections alone several lengths serve it, at 41 stations none.
Design misleading() {
  Design design = exampleDesign("ripple-along").value();
  design.output.programs.clear();
  design.sources[0].surface = DesignedSurface{FormulaSurface{
      {{0, 0}, {600, 800}}, "250+60*sin(pi*x/600)*cos(2*pi*y/1600)+0.3*(x-300)*sin(2*pi*y/800)"}};
  design.cut().sections.stations = 41;
  return design;
}

TEST(Advice, ALengthThatIsAdvisedServesAsItsDesignIsComputed) {
  Design design = misleading();
  const Evaluation before = evaluated(design);
  ASSERT_TRUE(hasErrors(before.findings()));
  for (const Finding& finding : before.findings())
    if (const OtherLength* advised = remedyOf<OtherLength>(finding.remedies)) {
      design.blade.length = advised->length;
      EXPECT_FALSE(hasErrors(evaluated(design).findings())) << advised->length;
      break;
    }
}

TEST(Advice, AnOpenLengthIsToldToServeOnlyWhereItsDesignDoes) {
  Design design = misleading();
  design.blade.autoLength = true;
  const Evaluation e = evaluated(design, Purpose::live);
  const BladeLengths& lengths = *e.cut().lengths.value;
  const double taken = e.cut().sweep.value->request.blade.length;
  EXPECT_FALSE(lengths.best);
  EXPECT_FALSE(lengths.designed);
  EXPECT_EQ(lengths.nearest, taken);
  EXPECT_TRUE(lengths.bands().empty()) << "nothing is promised";
  // It stays so when it is computed again, and costs nothing.
  Outcome again = evaluate(design, &e, {}, Purpose::live);
  ASSERT_FALSE(again.error);
  EXPECT_EQ(again.evaluation.cut().lengths.value, e.cut().lengths.value);
  EXPECT_EQ(again.evaluation.cut().sweep.value, e.cut().sweep.value);
  // Where its design serves, it is told so.
  Design firm = panel("steel-tube-3-2.5", 800);
  firm.blade.autoLength = true;
  const Evaluation served = evaluated(firm, Purpose::live);
  EXPECT_TRUE(served.cut().lengths.value->designed);
  EXPECT_EQ(served.cut().lengths.value->best, served.cut().sweep.value->request.blade.length);
}

TEST(Advice, AnOpenLengthThatFailsAsADesignGivesPlaceToTheNextBest) {
  Design design = panel("steel-tube-3-2.5", 800);
  design.blade.autoLength = true;
  Evaluation known = evaluated(design, Purpose::live);
  CutEvaluation& cut = known.blocks[0].cuts[0];
  ASSERT_TRUE(cut.lengths.value->best);
  const double second = *cut.lengths.value->best;
  // As if the sections that were tried had spoken for one that its whole row does not keep.
  auto misled = std::make_shared<BladeLengths>(*cut.lengths.value);
  RowTrial& first = misled->trials.back();
  ASSERT_FALSE(first.serves());
  first.rest = Rest::certain;
  first.margin = 10;
  first.reaches = true;
  misled->best = first.length;
  misled->designed = false;
  cut.lengths.value = misled;
  Outcome outcome = evaluate(design, &known, {}, Purpose::live);
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const CutEvaluation& taken = outcome.evaluation.cut();
  EXPECT_EQ(taken.sweep.value->request.blade.length, second);
  EXPECT_EQ(taken.lengths.value->best, second);
  EXPECT_TRUE(taken.lengths.value->designed);
  EXPECT_EQ(taken.lengths.value->nearest, misled->best);
  EXPECT_EQ(taken.lengths.value->trials.back().rest, Rest::lost);
  EXPECT_FALSE(hasErrors(outcome.evaluation.findings()));
  // All that follows is of it, and stays.
  EXPECT_EQ(taken.result()->sweep.poses.front().blade.length(), second);
  const Outcome again = evaluate(design, &outcome.evaluation, {}, Purpose::live);
  ASSERT_FALSE(again.error);
  EXPECT_EQ(again.evaluation.cut().sweep.value, taken.sweep.value);
  EXPECT_EQ(again.evaluation.cut().lengths.value, taken.lengths.value);
}

TEST(Advice, WhatComesNearestDoesSoAsItsDesignIsComputed) {
  // A hill that no blade follows. Longer ones would lie nearer to it, and fall through in their weight.
  Design design = exampleDesign("ripple-along").value();
  design.variables.clear();
  design.bindings.clear();
  design.output.programs.clear();
  std::get<FormulaSurface>(design.source().surface->shape).formula =
      "250+60*exp(-((x-300)^2+(y-400)^2)/30000)";
  design.cut().sections.stations = 41;
  design.blade = bladePreset("steel-tube-3-2.5").value();
  design.blade.autoLength = true;
  const Evaluation e = evaluated(resolved(design).value(), Purpose::live);
  const BladeLengths& lengths = *e.cut().lengths.value;
  EXPECT_FALSE(lengths.best);
  ASSERT_TRUE(lengths.nearest);
  EXPECT_EQ(*lengths.nearest, e.cut().sweep.value->request.blade.length);
  const RowTrial& trial = *lengths.at(*lengths.nearest);
  EXPECT_GT(trial.margin, 0);
  EXPECT_NEAR(e.cut().analysis.value->summary.deviationMax, trial.deviation, 0.1 * trial.deviation);
  for (const StationCheck& station : e.cut().check.value->stations) EXPECT_TRUE(station.stable);
}

TEST(Advice, NoLengthServesWhoseBladesLieTooFarOffBetweenTheStations) {
  Design design = panel("nicr-flat-5x1", 720);  // at its 12 stations a blade of 675 mm would keep near enough
  design.blade.thickness = 0.6;
  design.process.clearance = 35;
  design.blade.autoLength = true;
  const Evaluation e = evaluated(design);
  EXPECT_FALSE(e.cut().lengths.value->best);
}

TEST(Advice, AnOpenLengthIsGivenWithTheClearance) {
  Design design = thin();
  design.blade.autoLength = true;
  const Evaluation before = evaluated(design);
  const Advice<ServingLengths, OtherClearance> advice(before);
  ASSERT_TRUE(advice.remedy && advice.remedy->length) << "the one that was tried";
  EXPECT_NE(advice.text.find("comes nearest, was taken; a blade of "), std::string::npos) << advice.text;
  design.process.clearance = advice.remedy->clearance;
  design.blade.length = *advice.remedy->length;
  design.blade.autoLength = false;
  EXPECT_EQ(lostOf(evaluated(design)), 0);
}

TEST(Advice, TheWindowGetsTheSameAMomentLater) {
  const Design design = thin();
  Evaluation live = evaluated(design, Purpose::live);
  EXPECT_FALSE(live.cut().clearances.value);
  while (addSecondThought(live, {})) continue;
  ASSERT_TRUE(live.cut().clearances.value);
  const Advice<OtherShape, OtherClearance> advice(live), written(evaluated(design));
  ASSERT_TRUE(advice.remedy);
  EXPECT_EQ(advice.text, written.text);
  // Where some length serves nothing is asked of the clearance.
  Evaluation firm = evaluated(panel("steel-tube-3-2.5", 710), Purpose::live);
  while (addSecondThought(firm, {})) continue;
  EXPECT_TRUE(firm.cut().lengths.value && firm.cut().lengths.value->best);
  EXPECT_FALSE(firm.cut().clearances.value);
}

TEST(Advice, IsNotSoughtWhereAProgramIsCompared) {
  const Evaluation e = evaluated(thin(), Purpose::comparison);
  ASSERT_GT(lostOf(e), 0);
  EXPECT_FALSE(e.cut().lengths.value || e.cut().clearances.value || e.cut().margins.value);
  EXPECT_TRUE(e.cut().confirmed.value) << "its sections are those of the files";
}

TEST(Advice, TheWayThatIsToldLeadsToAnotherStation) {
  Design design = exampleDesign("single-block").value();
  design.output.programs.clear();
  design.blade.thickness = 0.2;
  const Evaluation e = evaluated(design);
  const int last = e.cut().sweep.value->poses.back().index;
  bool any = false;
  for (const Finding& finding : e.findings()) {
    if (!std::holds_alternative<OffTheSurfaceShown>(finding.cause)) continue;
    any = true;
    ASSERT_TRUE(finding.where.stations);
    EXPECT_LT(finding.where.stations->last, last) << words::sentence(finding, words::Reader::commandLine);
  }
  EXPECT_TRUE(any);
}

TEST(Advice, OneWayBelowTheFloorIsToldOnce) {
  Design design = exampleDesign("single-block").value();
  design.output.programs.clear();
  Evaluation e = evaluated(design, Purpose::live);
  const StationRange out{32, -1, 32, 0}, in{-1, 0, 0, 0};
  e.cut().motion.findings.push_back({Severity::error, NearBottom{-20, 20}, {out, {}}, {}});
  e.cut().motion.findings.push_back({Severity::error, NearBottom{-30, 20}, {in, {}}, {}});
  e.cell.findings.push_back({Severity::error, NearBottom{-120, 20}, {out, {}}, {}});
  std::vector<double> heights;
  for (const Finding& finding : e.findings())
    if (const auto* low = std::get_if<NearBottom>(&finding.cause)) heights.push_back(low->height);
  EXPECT_EQ(heights, (std::vector<double>{-30, -120})) << "that of the cell, where it is lower";
}

TEST(Advice, MoreStationsAreNotAdvisedWhereTheBladeGoesOverFromTautToSlack) {
  // Straight at the border of the surface, bent in its middle: a blade that hangs is pulled straight there.
  Design design = exampleDesign("graph").value();
  design.output.programs.clear();
  design.blade = bladePreset("nicr-flat-5x1").value();
  design.blade.length = 785;
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 41;
  const Evaluation e = evaluated(design, Purpose::comparison);
  bool any = false;
  for (const Finding& finding : e.findings()) {
    const auto* far = std::get_if<TooFar>(&finding.cause);
    const auto* off = std::get_if<OffTheSurfaceShown>(&finding.cause);
    if (!far && !off) continue;
    any = true;
    EXPECT_TRUE(far ? far->slackens : off->slackens) << words::sentence(finding, words::Reader::commandLine);
    EXPECT_TRUE(finding.remedies.empty());
  }
  EXPECT_TRUE(any);
}

}  // namespace
}  // namespace bw::pipeline
