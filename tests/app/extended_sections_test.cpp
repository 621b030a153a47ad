// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Blades whose grips are held by their sections, extended beyond the block.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/sketch.h"

namespace bw::pipeline {
namespace {

/// A block that is narrower than its surface by 100 mm at both sides of the blade.
Design narrow(Extension extend, double length) {
  Design design = exampleDesign("bump").value();
  design.bindings.clear();
  design.output.programs.clear();
  BlockPlacement& block = *design.block().placement;
  block.origin.x() += 100;
  block.size.x() -= 200;
  design.blade.length = length;
  design.process.clearance = 50;
  design.process.extend = extend;
  for (Cut& cut : design.cuts) cut.sections.stations = 17;
  return design;
}

std::shared_ptr<const Evaluation> evaluated(const Design& design) {
  Outcome outcome = evaluate(design, nullptr, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::make_shared<const Evaluation>(std::move(outcome.evaluation));
}

TEST(ExtendedSections, GripsLieOnTheSurfaceBeyondTheBlock) {
  const auto e = evaluated(narrow(Extension::surface, 560));
  ASSERT_TRUE(e->result());
  const CutResult result = *e->result();
  const std::unique_ptr<SurfaceSampler> surface = e->cut().target.value->sampler();
  for (std::size_t i = 0; i < result.size(); ++i) {
    const BladePose& pose = result.station(i).pose;
    EXPECT_NEAR(pose.blade.length(), 560, 1e-6);
    for (const Eigen::Vector3d& grip : {pose.leftPoint(), pose.rightPoint()}) {
      const Result<SurfaceSampler::Foot> foot = surface->closest(grip, nullptr);
      ASSERT_TRUE(foot);
      EXPECT_LT(foot->distance, 2e-3) << i;
      EXPECT_FALSE(foot->onBoundary) << "the surface goes on beyond the grip";
    }
  }
  // Where the surface ends before the grips, they lie on its tangents there.
  const auto longer = evaluated(narrow(Extension::surface, 760));
  for (std::size_t i = 0; i < longer->result()->size(); ++i) {
    const BladePose& pose = longer->result()->station(i).pose;
    EXPECT_GT(std::max(pose.rightPoint().x(), pose.leftPoint().x()), 600);
    EXPECT_LT(std::min(pose.rightPoint().x(), pose.leftPoint().x()), 0);
  }
}

TEST(ExtendedSections, ThatAreHeldOtherwiseGiveOtherBlades) {
  const auto surface = evaluated(narrow(Extension::surface, 700));
  for (const Extension other : {Extension::none, Extension::straight, Extension::curvature}) {
    const auto e = evaluated(narrow(other, 700));
    ASSERT_TRUE(e->result());
    double apart = 0;
    for (std::size_t i = 0; i < e->result()->size(); ++i)
      apart = std::max(
          apart, (e->result()->station(i).pose.rightPoint() - surface->result()->station(i).pose.rightPoint())
                     .norm());
    EXPECT_GT(apart, 0.5) << int(other);
  }
}

TEST(ExtendedSections, AreTheSameForAnyNumberOfThreads) {
  const Design design = narrow(Extension::surface, 700);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const Outcome a = evaluate(design, nullptr, one), b = evaluate(design, nullptr, four);
  ASSERT_TRUE(a.evaluation.result() && b.evaluation.result());
  for (std::size_t i = 0; i < a.evaluation.result()->size(); ++i)
    EXPECT_EQ(a.evaluation.result()->station(i).pose.rightPoint(),
              b.evaluation.result()->station(i).pose.rightPoint());
}

TEST(ExtendedSections, AreSketchedAsTheyAreEvaluated) {
  const Design design = narrow(Extension::surface, 700);
  const auto pulled = [&](double up) {
    Design moved = design;
    std::get<PolesSurface>(moved.source().surface->shape).at(2, 1).height += up;
    return moved;
  };
  Sketcher sketcher(evaluated(design));
  for (const double up : {3.0, 8.0, -2.0}) {
    const std::optional<Sketch> sketch = sketcher.draw(pulled(up), {});
    ASSERT_TRUE(sketch) << up;
    const CutSketch& cut = sketch->blocks[0][0];
    const auto anew = evaluated(pulled(up));
    const CutResult result = *anew->result();
    ASSERT_EQ(cut.sweep->poses.size(), result.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      EXPECT_LT((cut.sweep->poses[i].rightPoint() - result.station(i).pose.rightPoint()).norm(), 1e-6);
      EXPECT_EQ(cut.look->rest[i], result.rest.stations[i]) << up << " " << i;
    }
  }
}

}  // namespace
}  // namespace bw::pipeline
