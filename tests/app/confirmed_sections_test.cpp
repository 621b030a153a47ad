// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is written rests on sections that OpenCASCADE confirmed; what is only looked at does not wait for it.
// Sections that a gap of the target leaves out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/words/findings.h"
#include "step_merge.h"

namespace bw::pipeline {
namespace {

const std::filesystem::path kFolder = "nothing-is-written-there";

Design saddle(SectionRoute route) {
  Design design = exampleDesign("saddle").value();
  design.cut().sections.stations = 12;
  design.cut().sections.route = route;
  return design;
}

std::string surfaceOf(const Product& product) {
  const auto& paths = product.files.paths();
  const auto at = std::ranges::find(paths, std::filesystem::path("surface.step"));
  return at == paths.end() ? std::string() : product.files.bytes()[std::size_t(at - paths.begin())];
}

TEST(ConfirmedSections, AreThoseOfFilesAlone) {
  const Outcome live = evaluate(saddle(SectionRoute::automatic), nullptr, {});
  ASSERT_FALSE(live.error) << live.error->message;
  EXPECT_FALSE(live.evaluation.cut().confirmed.value);
  const Product product = produce(saddle(SectionRoute::automatic), kFolder, {}, {});
  ASSERT_FALSE(product.error) << product.error->message;
  ASSERT_TRUE(product.evaluation.cut().confirmed.value);
  EXPECT_FALSE(product.evaluation.cut().confirmed.value->has_value());
  const Findings findings = product.findings();
  EXPECT_TRUE(std::ranges::none_of(
      findings, [](const Finding& f) { return std::holds_alternative<SectionDiffers>(f.cause); }));
  EXPECT_EQ(findings.size(), live.evaluation.findings().size());
}

TEST(ConfirmedSections, LeaveWhatStandsWhereTheyAgree) {
  const Evaluation seen = evaluate(saddle(SectionRoute::automatic), nullptr, {}).evaluation;
  const Product product = produce(seen, kFolder, {}, {});
  ASSERT_FALSE(product.error) << product.error->message;
  EXPECT_TRUE(product.evaluation.cut().confirmed.value);
  EXPECT_EQ(product.evaluation.cut().sweep.value, seen.cut().sweep.value);
  EXPECT_EQ(product.evaluation.cut().analysis.value, seen.cut().analysis.value);
}

TEST(ConfirmedSections, AreNotAskedForWhereTheRouteIsGiven) {
  const Product traced = produce(saddle(SectionRoute::traced), kFolder, {}, {});
  const Product kernel = produce(saddle(SectionRoute::kernel), kFolder, {}, {});
  ASSERT_FALSE(traced.error || kernel.error);
  EXPECT_FALSE(traced.evaluation.cut().confirmed.value || kernel.evaluation.cut().confirmed.value);
  // Confirmed or not, what was traced is what is written.
  EXPECT_EQ(surfaceOf(traced), surfaceOf(produce(saddle(SectionRoute::automatic), kFolder, {}, {})));
  EXPECT_FALSE(surfaceOf(kernel).empty());
}

/// A panel in parts of one length, across the travel so far apart.
Design parted(double gap, int parts = 2) {
  const auto part = [](double from, double to) {
    SurfaceGrid grid;
    grid.rows = grid.columns = 9;
    std::vector<double> v;
    for (int r = 0; r < grid.rows; ++r) {
      v.push_back(r / 8.0);
      for (int c = 0; c < grid.columns; ++c) {
        const double x = 75.0 * c;
        grid.points.emplace_back(x, std::lerp(from, to, v.back()), 40 * std::sin(x / 200));
      }
    }
    return geometry::stepText(geometry::loft(grid, v).value(), "part").value();
  };
  Design design;
  design.source().path = "parts.step";
  std::vector<std::string> files;
  for (int k = 0; k < parts; ++k)
    files.push_back(part(k == 0 ? 0 : 700.0 * k / parts + gap / 2,
                         k + 1 == parts ? 700 : 700.0 * (k + 1) / parts - gap / 2));
  design.source().bytes = test::mergedStep(files);
  design.cut().face.kind = FaceChoice::Kind::all;
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 41;  // one in the middle of each gap
  return design;
}

TEST(GapOfATarget, IsToldAndCrossed) {
  for (const double gap : {0.5, 20.0}) {
    const Outcome outcome = evaluate(parted(gap), nullptr, {});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    const CutEvaluation& cut = outcome.evaluation.cut();
    EXPECT_EQ(cut.sweep.value->poses.size(), 40u);
    EXPECT_EQ(cut.coverage.value->share(), 1);
    const Findings findings = outcome.evaluation.findings();
    const auto told = std::ranges::find_if(
        findings, [](const Finding& f) { return std::holds_alternative<GapInRow>(f.cause); });
    ASSERT_NE(told, findings.end());
    EXPECT_EQ(told->severity, Severity::info) << gap;
    EXPECT_TRUE(told->remedies.empty());
  }
}

TEST(GapOfATarget, IsNoErrorWhereThereAreMoreThanAreTold) {
  const Outcome outcome = evaluate(parted(20, 5), nullptr, {});
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  EXPECT_EQ(outcome.evaluation.cut().sweep.value->poses.size(), 37u);
  EXPECT_EQ(outcome.evaluation.cut().coverage.value->share(), 1);
  int told = 0;
  for (const Finding& finding : outcome.evaluation.findings()) {
    const auto* gap = std::get_if<GapInRow>(&finding.cause);
    if (!gap) continue;
    ++told;
    EXPECT_EQ(gap->otherPlaces, 3);
    EXPECT_EQ(finding.severity, Severity::info);
    const std::string said = words::sentence(finding, words::Reader::commandLine);
    EXPECT_NE(said.find("others in 3 more places, each in a gap of the target"), std::string::npos) << said;
  }
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace bw::pipeline
