// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Designs whose blade melts a kerf: the surface asked for stands, and programs carry the middle of the blade.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "bw/core/base/units.h"
#include "bw/core/simulation/simulation.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/moulds.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/sketch.h"

namespace bw::pipeline {
namespace {

constexpr double kKerf = 3;

Design designed(const char* name, double kerf, KeptSide keep = KeptSide::below) {
  Design design = exampleDesign(name).value();
  design.output.programs.clear();
  design.process.kerf = kerf;
  for (Cut& cut : design.cuts) cut.keep = keep;
  return design;
}

Evaluation evaluated(const Design& design, const Evaluation* previous = nullptr) {
  Outcome outcome = evaluate(design, previous, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

/// How far above the target points lie, least and most.
std::pair<double, double> heights(const CutEvaluation& cut, const std::vector<Eigen::Vector3d>& points) {
  const std::unique_ptr<SurfaceSampler> sampler = cut.target.value->sampler();
  std::pair<double, double> range(1e300, -1e300);
  for (const Eigen::Vector3d& p : points) {
    const auto foot = sampler->closest(p, nullptr);
    EXPECT_TRUE(foot);
    const double up = (foot->normal.z() > 0 ? 1 : -1) * sampler->offset(p, *foot);
    range.first = std::min(range.first, up);
    range.second = std::max(range.second, up);
  }
  return range;
}

std::vector<Eigen::Vector3d> blades(const CutEvaluation& cut) {
  std::vector<Eigen::Vector3d> points;
  for (const BladePose& pose : cut.sweep.value->poses)
    for (const Eigen::Vector3d& p : pose.cutPoints(41)) points.push_back(p);
  return points;
}

TEST(KerfOfADesign, TheMiddleOfTheBladeIsOffTheSurfaceAndWhatStandsIsNot) {
  const Evaluation none = evaluated(designed("bump", 0));
  const double without = none.result()->analysis.summary.deviationMax;
  for (const KeptSide keep : {KeptSide::below, KeptSide::above}) {
    const Evaluation e = evaluated(designed("bump", kKerf, keep));
    const CutEvaluation& cut = e.cut();
    const CutResult result = *cut.result();
    const double side = keep == KeptSide::below ? 1 : -1, off = result.analysis.summary.deviationMax;
    EXPECT_LT(off, without + 0.05) << "as near as without a kerf";
    const auto middle = heights(cut, blades(cut));
    EXPECT_NEAR(middle.first, side * kKerf / 2, off + 1e-3);
    EXPECT_NEAR(middle.second, side * kKerf / 2, off + 1e-3);
    const auto standing = heights(cut, result.analysis.cut.points);
    EXPECT_GT(standing.first, -off - 2e-3);
    EXPECT_LT(standing.second, off + 2e-3);
    // The map tells of each point what lies between it and the target.
    const std::unique_ptr<SurfaceSampler> sampler = cut.target.value->sampler();
    const std::vector<double>& told = result.analysis.cut.field("deviation")->values;
    for (std::size_t k = 0; k < told.size(); k += 97) {
      const Eigen::Vector3d& p = result.analysis.cut.points[k];
      EXPECT_NEAR(told[k], sampler->offset(p, *sampler->closest(p, nullptr)), 2e-3) << k;
    }
    EXPECT_LT(result.coverage.distance, result.coverage.limit);
    EXPECT_LT(result.between.fromShown, 0.1) << "what robots move is held against the middle";
  }
}

TEST(KerfOfADesign, AFoamThatStandsBackIsHeldAgainstTheSurfaceBesideTheOneAskedFor) {
  for (const double kerf : {0.0, kKerf}) {
    Design design = designed("bump", kerf);
    design.cut().offset = 15;
    const Evaluation e = evaluated(design);
    const CutResult result = *e.cut().result();
    const double off = result.analysis.summary.deviationMax;
    EXPECT_LT(off, 1);
    const auto standing = heights(e.cut(), result.analysis.cut.points);
    EXPECT_NEAR(standing.first, -15, off + 5e-3);
    EXPECT_NEAR(standing.second, -15, off + 5e-3);
    const auto middle = heights(e.cut(), blades(e.cut()));
    EXPECT_NEAR(middle.first, -15 + kerf / 2, off + 5e-3);
    EXPECT_LT(result.coverage.distance, result.coverage.limit);
    EXPECT_LT(result.between.fromShown, 0.1);
    for (const Finding& finding : e.findings()) EXPECT_NE(finding.severity, Severity::error);
  }
  Design two = designed("two-crossing-cuts", 0);
  two.cut().offset = 5;
  const Outcome refused = evaluate(two, nullptr, {});
  ASSERT_TRUE(refused.error);
  EXPECT_NE(refused.error->message.find("only the one cut of a block may"), std::string::npos)
      << refused.error->message;
}

TEST(KerfOfADesign, AMouldOfAPanelThatLeansAtItsEndsCoversAllOfIt) {
  // The example panel rises by 22° where the blade comes in: beside it the surface lies 4 mm farther along.
  const Evaluation single = evaluated(designed("panel-600x670", 0));
  const Evaluation e = evaluated(withUpperMoulds(single, 20).value());
  ASSERT_EQ(e.blocks.size(), 2u);
  for (const BlockEvaluation& block : e.blocks) {
    EXPECT_LT(block.cuts[0].coverage.value->distance, block.cuts[0].coverage.value->limit) << block.id;
    for (const Finding& finding : block.cuts[0].findings())
      EXPECT_NE(finding.severity, Severity::error) << block.id;
  }
}

TEST(KerfOfADesign, TwoMouldsLeaveAPanelBetweenThem) {
  for (const char* name : {"bump", "three-block-wall"}) {
    const Evaluation single = evaluated(designed(name, 2));
    const Design pair = withUpperMoulds(single, 30).value();
    EXPECT_EQ(pair.stock.size(), 2 * single.design.stock.size());
    const Evaluation e = evaluated(pair);
    ASSERT_EQ(e.blocks.size(), pair.stock.size());
    const std::size_t half = single.design.stock.size();
    for (std::size_t i = 0; i < half; ++i) {
      const CutEvaluation &lower = e.blocks[i].cuts[0], &upper = e.blocks[i + half].cuts[0];
      EXPECT_EQ(e.blocks[i + half].id, e.blocks[i].id + "-upper");
      const auto low = heights(lower, lower.result()->analysis.cut.points),
                 high = heights(upper, upper.result()->analysis.cut.points);
      const double off = std::max(lower.result()->analysis.summary.deviationMax,
                                  upper.result()->analysis.summary.deviationMax);
      EXPECT_LT(off, 2) << name;
      EXPECT_NEAR(low.second, -15, off + 0.01) << name;
      EXPECT_NEAR(high.first, 15, off + 0.01) << name;
      // As much foam behind the one as behind the other.
      const Box &under = lower.setup->block, &over = upper.setup->block;
      EXPECT_EQ(under.size, over.size);
      std::pair<double, double> low2(1e9, -1e9);
      for (const Eigen::Vector3d& p : lower.targetMesh.value->points) {
        const double below = under.frame.toLocal(p).z(), above = over.size.z() - over.frame.toLocal(p).z();
        low2 = {std::min(low2.first, below + above), std::max(low2.second, below + above)};
      }
      EXPECT_NEAR(low2.first, low2.second, 1e-6) << "the blocks are shifted along their height alone";
    }
    EXPECT_EQ(withUpperMoulds(e, 30).error().code, ErrorCode::badInput) << "once is enough";
    EXPECT_EQ(withUpperMoulds(single, 0).error().code, ErrorCode::badInput);
  }
  const Evaluation crossing = evaluated(designed("two-crossing-cuts", 0));
  EXPECT_NE(withUpperMoulds(crossing, 30).error().message.find("has 2 cuts"), std::string::npos);
}

TEST(KerfOfADesign, MouldsHangOnTheExpressionsOfTheirBlocks) {
  Design design = designed("bump", 2);
  design.bindings["/stock/0/block/size/0"] = {"600", design.block().placement->size.x()};
  design.bindings["/cuts/0/stations"] = {"33", double(*design.cut().sections.stations)};
  const Design pair = withUpperMoulds(evaluated(design), 30).value();
  for (const char* place :
       {"/stock/0/block/size/0", "/stock/1/block/size/0", "/cuts/0/stations", "/cuts/1/stations"})
    EXPECT_TRUE(pair.bindings.contains(place)) << place;
  EXPECT_EQ(gridExpressions(pair), 0);
  // Blocks of a grid are listed, and their sizes are numbers.
  design = designed("three-block-wall", 2);
  const std::size_t known = design.bindings.size();
  design.bindings["/grid/sizes/columns"] = {"600", design.grid.value().sizes[0][0]};
  EXPECT_EQ(gridExpressions(design), 1);
  EXPECT_LE(withUpperMoulds(evaluated(design), 30).value().bindings.size(), known);
}

TEST(KerfOfADesign, LeavesThePartThatIsAskedFor) {
  std::vector<double> volumes;
  for (const double kerf : {0.0, kKerf}) {
    Evaluation e = evaluated(designed("two-crossing-cuts", kerf));
    ASSERT_TRUE(addParts(e, {}));
    ASSERT_TRUE(e.blocks[0].part.value->solid);
    volumes.push_back(e.blocks[0].part.value->solid->volume());
    ASSERT_TRUE(e.blocks[0].together.value);
    for (const Crease& crease : e.blocks[0].together.value->creases) EXPECT_LT(crease.offMax, 1);
    for (const Finding& finding : e.findings()) EXPECT_NE(finding.severity, Severity::error);
  }
  // A layer of half the kerf all over would be 0.54 litres.
  EXPECT_NEAR(volumes[1], volumes[0], 0.03 * 360000);
}

TEST(KerfOfADesign, ChangesNothingOfWhatLiesBeforeTheBlades) {
  const Evaluation none = evaluated(designed("bump", 0));
  EXPECT_FALSE(none.cut().middle.value);
  const Evaluation e = evaluated(designed("bump", kKerf), &none);
  EXPECT_EQ(e.cut().sections.value, none.cut().sections.value);
  EXPECT_NE(e.cut().sweep.value, none.cut().sweep.value);
  const Evaluation again = evaluated(designed("bump", kKerf), &e);
  EXPECT_EQ(again.cut().sweep.value, e.cut().sweep.value);
  EXPECT_EQ(again.cut().analysis.value, e.cut().analysis.value);
  const Evaluation back = evaluated(designed("bump", 0), &e);
  EXPECT_FALSE(back.cut().middle.value);
  EXPECT_LT(
      (back.cut().sweep.value->poses[5].cutPoints(3)[1] - none.cut().sweep.value->poses[5].cutPoints(3)[1])
          .norm(),
      1e-9);
}

TEST(KerfOfADesign, IsThatOfTheSketchToo) {
  const auto pulled = [](double up) {
    Design design = designed("bump", kKerf);
    design.bindings.clear();
    std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height += up;
    return design;
  };
  Sketcher sketcher(std::make_shared<const Evaluation>(evaluated(pulled(0))));
  for (const double up : {3.0, 8.0}) {
    const std::optional<Sketch> sketch = sketcher.draw(pulled(up), {});
    ASSERT_TRUE(sketch) << up;
    const CutSketch& cut = sketch->blocks[0][0];
    const Evaluation anew = evaluated(pulled(up));
    EXPECT_LT(cut.look->deviationMax, anew.result()->analysis.summary.deviationMax + 0.02) << up;
    const double off = cut.look->deviationMax + 0.01;
    const auto standing = heights(anew.cut(), cut.look->cut.points);
    EXPECT_GT(standing.first, -off);
    EXPECT_LT(standing.second, off);
  }
}

TEST(KerfOfADesign, KeepsToTheSideOfWhatIsCut) {
  // A parabola, turned so that most of it looks up, while its end, where the block is, hangs over.
  Design design = designed("single-block", kKerf);
  design.bindings.clear();
  design.variables.clear();
  design.source().surface = DesignedSurface{
      FormulaSurface{{{0, 0}, {500, 1600}}, "0.0005 * y^2"}, {0, 0, 0}, {fromDegrees(50), 0, 0}};
  design.block().placement = BlockPlacement{{0, -50, 1550}, {500, 300, 480}, {0, 0, 0}};
  design.cut().direction = Eigen::Vector3d::UnitX();
  design.cut().sections.stations = 9;
  design.blade.length = 900;
  const Evaluation e = evaluated(design);
  const CutEvaluation& cut = e.cut();
  const double off = cut.result()->analysis.summary.deviationMax;
  ASSERT_LT(off, 0.5);
  const std::unique_ptr<SurfaceSampler> sampler = cut.target.value->sampler();
  for (const Eigen::Vector3d& p : blades(cut)) {
    const auto foot = *sampler->closest(p, nullptr);
    ASSERT_NEAR(std::abs(sampler->offset(p, foot)), kKerf / 2, off + 1e-3);
    EXPECT_GT((p - foot.point).z(), 0) << "the foam below stays";
  }
  for (const Eigen::Vector3d& p : cut.result()->analysis.cut.points)
    ASSERT_LT(std::abs(sampler->offset(p, *sampler->closest(p, nullptr))), off + 2e-3);
}

/// A surface that rises by `slope` where the blade comes in, whose edge half a kerf of 6 mm moves into the
/// block.
Design rippled(double slope) {
  Design design = designed("single-block", 6);
  design.bindings.clear();
  design.variables.clear();
  design.grid.reset();
  design.source().surface = DesignedSurface{
      FormulaSurface{{{0, 0}, {400, 320}},
                     "20 * sin(pi * x / 400) + " + std::to_string(slope * 60) + " * sin(y / 60)"},
      {0, 0, 0},
      {0, 0, 0}};
  design.stock = {{}};
  design.cuts = {design.cut()};
  design.cut().block = design.block().id;
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 49;
  design.blade.length = 700;
  design.process.tolerance = 0.5;
  return design;
}

double fromTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  const auto within = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return (to - from).cross(p - from).dot(n) >= 0;
  };
  if (n.norm() > 0 && within(a, b) && within(b, c) && within(c, a))
    return std::abs((p - a).dot(n)) / n.norm();
  const auto fromSide = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d way = to - from;
    const double length = way.squaredNorm();
    return (p - from - (length > 0 ? std::clamp(way.dot(p - from) / length, 0.0, 1.0) : 0.0) * way).norm();
  };
  return std::min({fromSide(a, b), fromSide(b, c), fromSide(c, a)});
}

TEST(KerfOfADesign, BeginsSoFarBeforeTheBlockThatTheEdgeOfWhatStandsComesToItsFace) {
  for (const double slope : {0.3, 0.8, 1.2}) {
    const Evaluation e = evaluated(rippled(slope));
    const CutEvaluation& cut = e.cut();
    const CutResult result = *cut.result();
    const double half = 3, edge = half * slope / std::hypot(1, slope);
    EXPECT_NEAR(result.sweep.poses.front().travel, -edge, 0.1) << slope;
    EXPECT_EQ(result.sweep.poses.size(), 49u);
    // The other route: the motion is run, and the foam is gone within half a kerf of all that the blade
    // sweeps.
    const FitRequest& fit = result.sweep.request;
    const Result<Simulation> run = simulate(result.motion, fit.blade, fit.weight, {});
    ASSERT_TRUE(run);
    ASSERT_FALSE(run->halt);
    const SurfaceGrid swept = run->swept();
    const std::unique_ptr<SurfaceSampler> target = cut.target.value->sampler();
    double off = 0;
    for (const double x : {80.0, 200.0, 330.0})
      for (double y = 0.1; y < 2 * edge; y += 0.2) {
        const auto foot =
            target->closest({x, y, 20 * std::sin(kPi * x / 400) + slope * 60 * std::sin(y / 60)}, nullptr);
        ASSERT_TRUE(foot);
        double nearest = 1e300;
        for (int r = 0; r + 1 < swept.rows; ++r)
          for (int c = 0; c + 1 < swept.columns; ++c) {
            const Eigen::Vector3d &a = swept.at(r, c), &b = swept.at(r, c + 1), &d = swept.at(r + 1, c),
                                  &f = swept.at(r + 1, c + 1);
            if (std::min((foot->point - a).norm(), (foot->point - f).norm()) > 60) continue;
            nearest =
                std::min({nearest, fromTriangle(foot->point, a, b, f), fromTriangle(foot->point, a, f, d)});
          }
        off = std::max(off, std::abs(nearest - half));
      }
    // What the robots add between two targets, and the triangles between two blades.
    EXPECT_LT(off, 0.2 + result.analysis.summary.deviationMax) << slope;
    EXPECT_LT(result.coverage.distance, 0.15) << slope;
    for (const Finding& finding : cut.findings()) EXPECT_NE(finding.severity, Severity::error) << slope;
  }
}

TEST(KerfOfADesign, RowsThatBeginSoFarBeforeTheirBlocksMeetAsWell) {
  // The rows of neighbours begin in planes of their own, by how much each leans there.
  const Evaluation e = evaluated(designed("three-block-wall", 20));
  double least = 1e300, most = -1e300;
  for (const BlockEvaluation& block : e.blocks) {
    const double travel = block.cuts[0].sweep.value->poses.front().travel;
    least = std::min(least, travel);
    most = std::max(most, travel);
  }
  EXPECT_LT(most, -1);
  EXPECT_GT(most - least, 0.05);
  ASSERT_TRUE(e.joints.value);
  ASSERT_EQ(e.joints.value->joints.size(), 2u);
  EXPECT_LT(e.joints.value->gapMax(), 0.01);
  for (const Joint& joint : e.joints.value->joints) EXPECT_EQ(joint.open, 0);
}

TEST(KerfOfADesign, NeedsToKnowWhichSideStays) {
  Design design = designed("bump", kKerf);
  design.bindings.clear();
  // Turned so that it stands upright.
  design.source().surface = DesignedSurface{
      FormulaSurface{{{0, 0}, {500, 600}}, "20 * sin(x / 100)"}, {300, 100, 0}, {0, -M_PI / 2, 0}};
  design.cut().direction = Eigen::Vector3d::UnitY();
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_EQ(outcome.error->code, ErrorCode::badInput) << outcome.error->message;
  EXPECT_NE(outcome.error->message.find("keep"), std::string::npos) << outcome.error->message;
}

}  // namespace
}  // namespace bw::pipeline
