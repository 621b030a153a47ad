// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the program of a cut cuts is known for files at once, and in the window a moment later.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/overall.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {
namespace {

Evaluation evaluated(const Design& design, Purpose purpose, const Evaluation* before = nullptr) {
  Outcome outcome = evaluate(design, before, {}, purpose);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

TEST(ProgramCut, IsTheSameForFilesAndInTheWindow) {
  const Design design = exampleDesign("single-block").value();
  Evaluation live = evaluated(design, Purpose::live);
  EXPECT_FALSE(live.cut().programCut()) << "a picture does not wait for it";
  EXPECT_FALSE(overallOf(live).fromShown);
  while (!live.cut().programCut()) ASSERT_TRUE(addSecondThought(live, {}));
  const Evaluation files = evaluated(design, Purpose::files);
  const SimulatedSurface* written = files.cut().programCut();
  ASSERT_TRUE(written);
  EXPECT_NEAR(live.cut().programCut()->toDesignMax, written->toDesignMax, 1e-9);
  EXPECT_NEAR(live.cut().programCut()->toTargetMax, written->toTargetMax, 1e-9);
  const Overall all = overallOf(files);
  EXPECT_EQ(all.fromShown, written->toDesignMax);
  EXPECT_EQ(all.programMax, written->toTargetMax);
  EXPECT_EQ(all.programMean, written->toTargetMean);
  // With the corners that the controller cuts, which the way from station to station has not.
  EXPECT_NE(written->toDesignMax, files.result()->between.fromShown);
  EXPECT_NEAR(written->toDesignMax, files.result()->between.fromShown, 0.03);

  // What does not hang on the motion leaves it as it is; a tolerance is another question to the same run.
  Design named = design;
  named.name = "another";
  EXPECT_EQ(evaluated(named, Purpose::live, &live).cut().programCut(), live.cut().programCut());
  Design strict = design;
  strict.process.tolerance = 0.5 * written->toTargetMax;
  const Evaluation judged = evaluated(strict, Purpose::files, &files);
  EXPECT_EQ(judged.cut().programCut() != nullptr, true);
  Design faster = design;
  faster.process.cuttingSpeed *= 2;
  EXPECT_FALSE(evaluated(faster, Purpose::live, &live).cut().programCut()) << "it is another motion";
}

TEST(ProgramCut, OfARunThatIsHaltedNothingIsTold) {
  Evaluation e = evaluated(exampleDesign("single-block").value(), Purpose::files);
  ASSERT_TRUE(e.cut().programCut());
  Simulation halted = *e.cut().run.value;
  halted.halt = Halt{};
  e.cut().run.value = std::make_shared<const Simulation>(std::move(halted));
  EXPECT_FALSE(e.cut().programCut());
  EXPECT_FALSE(overallOf(e).programMax || overallOf(e).programMean || overallOf(e).fromShown);
}

TEST(ProgramCut, OfSeveralCutsIsThatOfTheWorst) {
  const Evaluation e = evaluated(exampleDesign("three-block-wall").value(), Purpose::files);
  double fromShown = 0, fromTarget = 0;
  for (const BlockEvaluation& block : e.blocks) {
    const SimulatedSurface* own = block.cuts.front().programCut();
    ASSERT_TRUE(own) << block.id;
    fromShown = std::max(fromShown, own->toDesignMax);
    fromTarget = std::max(fromTarget, own->toTargetMax);
  }
  const Overall all = overallOf(e);
  EXPECT_EQ(all.fromShown, fromShown);
  EXPECT_EQ(all.programMax, fromTarget);
  ASSERT_TRUE(all.programMean);
  EXPECT_GT(*all.programMean, 0);
  EXPECT_LT(*all.programMean, fromTarget);
}

}  // namespace
}  // namespace bw::pipeline
