// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is written rests on sections that OpenCASCADE confirmed; what is only looked at does not wait for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"

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

}  // namespace
}  // namespace bw::pipeline
