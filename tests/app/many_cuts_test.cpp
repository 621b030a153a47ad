// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Evaluations of several blocks and cuts. Files of such designs come later; what they rest on holds already.
#include <gtest/gtest.h>

#include <string>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {
namespace {

/// The saddle from two sides in one block, and a part of it in another block.
Design three() {
  Design design = exampleDesign("saddle").value();
  design.output.programs.clear();
  design.cut().sections.stations = 6;
  design.blade.length = 1000;  // the way across is longer
  Cut across = design.cut();
  across.id = "across";
  design.cut().direction = Eigen::Vector3d::UnitY();
  across.direction = Eigen::Vector3d::UnitX();
  Cut part = design.cut();
  part.id = "part";
  part.block = "small";
  const Outcome one = evaluate(design, nullptr, {});
  EXPECT_FALSE(one.error);
  BlockPlacement half = placementOf(one.evaluation.cut().setup->block);
  half.size.y() *= 0.5;
  design.stock.push_back({"small", half});
  design.cuts.push_back(across);
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
  EXPECT_LT((across.setup->block.frame.origin - along.setup->block.frame.origin).norm(), 1e-9)
      << "one block, where the first cut put it";
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

TEST(ManyCuts, AreNoFilesYetAndThatIsSaid) {
  const Product product = produce(three(), "nothing-is-written-there", {}, {});
  ASSERT_TRUE(product.error);
  EXPECT_EQ(product.error->code, ErrorCode::badInput);
  EXPECT_NE(product.error->message.find("one block and one cut"), std::string::npos)
      << product.error->message;
  EXPECT_TRUE(product.files.paths().empty());
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
