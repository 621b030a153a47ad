// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Key blades that turn, from the design to its files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/shape/surface_blades.h"
#include "bw/core/shape/turning_planes.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/key_blades.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/sketch.h"

namespace bw::pipeline {
namespace {

Evaluation evaluated(const Design& design) {
  Outcome outcome = evaluate(design, nullptr, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

Design turning() {
  Design design = exampleDesign("turning-blades").value();
  design.output.programs.clear();
  return design;
}

template <class Cause>
const Cause* told(const Findings& findings) {
  for (const Finding& finding : findings)
    if (const auto* cause = std::get_if<Cause>(&finding.cause)) return cause;
  return nullptr;
}

TEST(TurningDesign, BladesStandInThePlanesOfTheirKeysAndFilesTellHowFarTheseTurn) {
  const Design design = turning();
  const Evaluation e = evaluated(design);
  ASSERT_TRUE(e.result());
  const CutResult result = *e.result();
  const PlaneFamily& planes = result.sweep.planes;
  const PlaneTurn own = planesOf(*design.source().surface)->turn;
  ASSERT_TRUE(planes.turns());
  double before = -1;
  for (const BladePose& pose : result.sweep.poses) {
    EXPECT_GT(pose.travel, before);
    before = pose.travel;
    const double angle = own.at(planes.level(pose.bladePoints(3)[1])).angle[0];
    EXPECT_NEAR((pose.frame.normal - Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0)).norm(), 0, 1e-6);
  }
  // What is told by blades is cut by them, but for their weight.
  EXPECT_LT(result.analysis.summary.deviationMax, 0.2);
  EXPECT_LT(result.between.deviationMax, 0.3);

  const nlohmann::json report = nlohmann::json::parse(reportJson(e, "run", {}, words::Reader::commandLine));
  EXPECT_EQ(report["method"]["planes"], "turning");
  // As its keys do: not at all at the faces of the block, and to either side between them.
  const nlohmann::json& turned = report["method"]["planes_turned_deg"];
  EXPECT_EQ(turned["first"], 0);
  EXPECT_EQ(turned["last"], 0);
  EXPECT_NEAR(turned["most"].get<double>(), 5, 0.5);
  EXPECT_NEAR(turned["least"].get<double>(), -5, 0.5);
}

TEST(TurningDesign, ACutWithADirectionOfItsOwnHasParallelPlanesAndSaysSo) {
  Design design = turning();
  design.cut().direction = Eigen::Vector3d::UnitY();
  design.cut().sections.stations = 9;
  const Evaluation e = evaluate(design, nullptr, {}).evaluation;
  ASSERT_TRUE(e.cut().setup);
  EXPECT_FALSE(e.cut().setup->planes.turns());
  const PlanesNotTurned* cause = told<PlanesNotTurned>(e.findings());
  ASSERT_TRUE(cause);
  EXPECT_NEAR(cause->most, fromDegrees(5), 1e-9);
  design.cut().direction.reset();
  EXPECT_FALSE(told<PlanesNotTurned>(evaluate(design, &e, {}).evaluation.findings()));
}

TEST(TurningDesign, AHandThatTurnsAKeyTakesThePlanesWithIt) {
  Design design = turning();
  design.cut().sections.stations = 9;
  const auto before = std::make_shared<const Evaluation>(evaluated(design));
  Sketcher sketcher(before);
  std::get<BladesSurface>(design.source().surface->shape).blades.back().turn += fromDegrees(2);
  const std::optional<Sketch> sketch = sketcher.draw(design, {});
  ASSERT_TRUE(sketch);
  const CutSketch& cut = sketch->blocks[0][0];
  const PlaneFamily wanted = evaluated(design).cut().setup->planes;
  EXPECT_EQ(cut.setup->planes, wanted);
  EXPECT_NE(cut.setup->planes, before->cut().setup->planes);
  for (const BladePose& pose : cut.sweep->poses)
    EXPECT_NEAR((pose.frame.normal - wanted.at(wanted.level(pose.bladePoints(3)[1])).normal).norm(), 0, 1e-6);
}

/// A wall of three blocks whose blades lie at the faces and are turned between them.
Design turningWall() {
  Design design = exampleDesign("block-wall").value();
  design.output.programs.clear();
  BladesSurface shape;
  for (const double y : {0.0, 400.0, 800.0})
    shape.blades.push_back({y, {900, 250}, 0, 2000, -0.3, {0, 0}, y == 400 ? fromDegrees(3) : 0});
  design.source().surface = DesignedSurface{shape};
  for (Cut& cut : design.cuts) {
    cut.direction.reset();
    cut.sections.stations = 17;
  }
  return design;
}

TEST(TurningDesign, AllBlocksOfAWallHaveItsPlanesAndMeet) {
  const Design design = turningWall();
  const Evaluation e = evaluate(design, nullptr, {}).evaluation;
  ASSERT_EQ(e.blocks.size(), 3u);
  for (const BlockEvaluation& block : e.blocks) {
    ASSERT_TRUE(block.cuts[0].setup);
    EXPECT_EQ(block.cuts[0].setup->planes.turn, planesOf(*design.source().surface)->turn);
  }
  ASSERT_TRUE(e.joints.value);
  EXPECT_EQ(e.joints.value->joints.size(), 2u);
  EXPECT_FALSE(told<JointUnknown>(e.findings()));
  EXPECT_FALSE(told<JointOpen>(e.findings()));
  EXPECT_LT(e.joints.value->gapMax(), 0.1);
  EXPECT_LT(e.joints.value->kinkMax(), fromDegrees(1));
}

/// The height over x of a surface where it comes through a plane across y, or ends there.
using Through = std::map<double, double>;
Through across(const SurfaceGrid& grid, double y) {
  Through heights;
  for (int c = 0; c < grid.columns; ++c)
    for (int r = 0; r + 1 < grid.rows; ++r) {
      const Eigen::Vector3d &a = grid.at(r, c), &b = grid.at(r + 1, c);
      const double share = (y - a.y()) / (b.y() - a.y());
      if (share < -0.01 || share > 1.01) continue;
      const Eigen::Vector3d p = a + share * (b - a);
      heights[p.x()] = p.z();
    }
  return heights;
}

TEST(TurningDesign, RowsOneBehindTheOtherAreCompared) {
  // In the face between the blocks their planes are turned, or lie in it; or all are turned alike, so that
  // the boundary begins and ends at corners that the outer planes touch.
  using Turns = std::array<double, 5>;
  for (const Turns& turns : {Turns{0, 5, 6, 5, 0}, Turns{0, 2, 0, 2, 0}, Turns{-10, -10, -10, -10, -10}}) {
    Design design = turning();
    design.grid.emplace();
    design.grid->sizes = {{{600}, {400, 400}, {500}}};
    design.stock = stockOf(*design.grid);
    Cut cut = design.cuts.front();
    cut.sections.stations = 17;
    design.cuts = cutsOf(design.stock, {cut}, {});
    auto& blades = std::get<BladesSurface>(design.source().surface->shape).blades;
    for (std::size_t k = 0; k < turns.size(); ++k) blades[k].turn = fromDegrees(turns[k]);
    const Evaluation e = evaluated(design);
    ASSERT_EQ(e.blocks.size(), 2u);
    EXPECT_FALSE(told<JointUnknown>(e.findings()));
    EXPECT_FALSE(told<JointOpen>(e.findings()));
    ASSERT_TRUE(e.joints.value);
    ASSERT_EQ(e.joints.value->joints.size(), 1u);
    const Joint& joint = e.joints.value->joints[0];
    EXPECT_GT(joint.places, 40);
    EXPECT_LT(joint.gapMax, 0.1);
    EXPECT_LT(toDegrees(joint.kinkMax), 1);
    // By another route: where the meshes of both cuts come through the boundary.
    const Through one = across(e.blocks[0].cuts[0].analysis.value->cut, 400),
                  other = across(e.blocks[1].cuts[0].analysis.value->cut, 400);
    double most = 0;
    int places = 0;
    for (const auto& [x, z] : one) {
      const auto after = other.lower_bound(x);
      if (after == other.begin() || after == other.end()) continue;
      const auto [x0, z0] = *std::prev(after);
      most = std::max(most, std::abs(std::lerp(z0, after->second, (x - x0) / (after->first - x0)) - z));
      ++places;
    }
    EXPECT_GT(places, 40);
    EXPECT_NEAR(most, joint.gapMax, 0.005);
  }
}

/// What is true of a block through whose corners planes pass as of any other one.
void expectWholeCut(const Design& design, double mostAngle) {
  const Outcome outcome = evaluate(design, nullptr, {}, Purpose::files);
  ASSERT_FALSE(outcome.error) << outcome.error->message;
  const Evaluation& e = outcome.evaluation;
  for (const Finding& finding : e.findings())
    EXPECT_NE(finding.severity, Severity::error) << finding.cause.index();
  EXPECT_EQ(e.cut().sweep.value->poses.size(), std::size_t(*e.design.cut().sections.stations));
  EXPECT_LT(e.cut().coverage.value->distance, 0.5);
  EXPECT_EQ(e.cut().coverage.value->uncovered, 0);
  EXPECT_LT(e.result()->analysis.summary.angleMax, mostAngle);
  EXPECT_FALSE(told<PartUnknown>(e.findings()));
  ASSERT_TRUE(e.blocks[0].part.value);
  ASSERT_TRUE(e.blocks[0].part.value->solid);
  EXPECT_EQ(e.blocks[0].part.value->solid->pieces(), 1);
}

TEST(TurningDesign, PlanesMayLeaveTheBlockAcrossItsCorners) {
  // Turned alike, so that the surface ends in the block at two of its corners; and one that goes on past it.
  for (const double reach : {0.0, 200.0}) {
    Design design = turning();
    auto& blades = std::get<BladesSurface>(design.source().surface->shape).blades;
    for (KeyBlade& blade : blades) {
      blade.turn = fromDegrees(reach > 0 ? 12 : 20);
      blade.y += reach * (blade.y / 400 - 1);
      blade.length = 700;
    }
    design.blade.length = 860;
    // No blade goes along itself to keep its middle in the foam.
    expectWholeCut(design, fromDegrees(30));
  }
}

TEST(TurningDesign, ParallelPlanesMayLeaveTheBlockAcrossItsCorners) {
  Design design = exampleDesign("bump").value();
  design.output.programs.clear();
  auto& poles = std::get<PolesSurface>(design.source().surface->shape);
  poles.over = {{-300, -300}, {900, 1100}};
  design.blade.length = 900;
  for (const double aside : {0.03, 0.3}) {
    design.cut().direction = Eigen::Vector3d(aside, 1, 0);
    expectWholeCut(design, fromDegrees(35));
  }
}

TEST(TurningDesign, PlanesThatMeetInTheBlockAreRefusedWithTheirPlace) {
  Design design = turning();
  auto& blades = std::get<BladesSurface>(design.source().surface->shape).blades;
  for (KeyBlade& blade : blades) blade.turn *= 6;
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_NE(outcome.error->message.find("meet in the block, near x = "), std::string::npos)
      << outcome.error->message;
}

/// How high one surface lies over or below places of the other, at most, as seen from above: by triangles
/// that are under them, where both are `inside` (mm) the faces of the block.
double apart(const SurfaceGrid& of, const SurfaceGrid& over, double inside) {
  const TriangleMesh mesh = over.triangles();
  double most = 0;
  int places = 0;
  for (int r = 0; r < of.rows; r += 3)
    for (int c = 0; c < of.columns; c += 5) {
      const Eigen::Vector3d& p = of.at(r, c);
      if (p.x() < inside || p.x() > 600 - inside || p.y() < inside || p.y() > 800 - inside) continue;
      for (const auto& [i, j, k] : mesh.triangles) {
        const Eigen::Vector3d &a = mesh.points[std::size_t(i)], &b = mesh.points[std::size_t(j)],
                              &d = mesh.points[std::size_t(k)];
        Eigen::Matrix2d sides;
        sides << (b - a).head<2>(), (d - a).head<2>();
        const Eigen::Vector2d share = sides.inverse() * (p - a).head<2>();
        if (!(share.minCoeff() >= -1e-9) || share.sum() > 1 + 1e-9) continue;
        most = std::max(most, std::abs(a.z() + share.x() * (b - a).z() + share.y() * (d - a).z() - p.z()));
        ++places;
        break;
      }
    }
  EXPECT_GT(places, 200);
  return most;
}

constexpr double kInside = 1;       // mm
constexpr double kCutAgain = 0.05;  // mm by which the surface of a converted design may be farther off

TEST(TurningDesign, KeyBladesThatTurnComeBackAsTheFewest) {
  const Design design = turning();
  Evaluation e = evaluated(design);
  const BladeSweep own =
      BladeSweep::through(std::get<BladesSurface>(design.source().surface->shape).blades).value();
  for (const double tolerance : {0.5, 0.01}) {
    const Result<CutKeyBlades> keys = keyBladesOf(e.cut(), Told::target, tolerance, {});
    ASSERT_TRUE(keys) << keys.error().message;
    EXPECT_LE(keys->deviation, tolerance);
    EXPECT_LT(toDegrees(keys->turnedOff), 0.05);
    const auto& blades = std::get<BladesSurface>(keys->surface.shape).blades;
    EXPECT_LE(blades.size(), 5u);
    for (const KeyBlade& blade : blades)
      EXPECT_NEAR(toDegrees(blade.turn), toDegrees(own.at(std::clamp(blade.y, 0.0, 800.0)).turn), 0.01);
    const Result<Design> changed = withSurface(e, "cut", keys->surface);
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_FALSE(changed->cut().direction);
    const Evaluation now = evaluated(*changed);
    EXPECT_TRUE(now.cut().setup->planes.turns());
    for (const Finding& finding : now.findings()) EXPECT_NE(finding.severity, Severity::error);
    EXPECT_EQ(now.cut().coverage.value->uncovered, 0);
    const SurfaceGrid &before = e.result()->analysis.cut, &after = now.result()->analysis.cut;
    EXPECT_LT(apart(after, before, kInside), keys->deviation + kCutAgain);
    EXPECT_LT(apart(before, after, kInside), keys->deviation + kCutAgain);
  }
}

TEST(TurningDesign, WhatItsBladesCutBecomesTheDesign) {
  Design design = turning();
  design.blade.length = 700;  // so long that its weight tells
  Evaluation e = evaluated(design);
  const Result<CutKeyBlades> keys = keyBladesOf(e.cut(), Told::cut, 0.2, {});
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_LE(keys->deviation, 0.2);
  const Evaluation now = evaluated(withSurface(e, "cut", keys->surface).value());
  EXPECT_TRUE(now.cut().setup->planes.turns());
  EXPECT_EQ(now.cut().coverage.value->uncovered, 0);
  const SurfaceGrid &before = e.result()->analysis.cut, &after = now.result()->analysis.cut;
  EXPECT_LT(apart(after, before, kInside), keys->deviation + kCutAgain);
  EXPECT_LT(apart(before, after, kInside), keys->deviation + kCutAgain);
  e.cut().analysis.value.reset();
  EXPECT_FALSE(keyBladesOf(e.cut(), Told::cut, 0.2, {}));
}

TEST(TurningDesign, ASurfaceOfAnotherKindCutInPlanesThatTurnIsToldByKeyBladesThatTurn) {
  const TurningPlanes turned = planesOf(*turning().source().surface).value();
  Design design = exampleDesign("bump").value();
  design.output.programs.clear();
  Evaluation e = evaluated(design);
  e.design.cut().direction.reset();
  CutEvaluation& cut = e.cut();
  const Box block = cut.setup->block;
  cut.setup = std::make_shared<const geometry::Setup>(
      geometry::Setup{block, PlaneFamily::turning(block, turned).value()});
  Findings findings;
  cut.sections.value = std::make_shared<const std::vector<Section>>(
      geometry::cutSections(*cut.target.value, *cut.setup, {.stations = 13}, {}, findings).value());
  const Result<CutKeyBlades> keys = keyBladesOf(cut, Told::target, 0.6, {});
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_LE(keys->deviation, 0.6);
  EXPECT_LT(toDegrees(keys->turnedOff), 0.01);
  EXPECT_LT(std::get<BladesSurface>(keys->surface.shape).blades.size(), 20u);
  // All of the one lies so near to the other, by the nearest points.
  const std::unique_ptr<SurfaceSampler> sampler = cut.target.value->sampler();
  const SplineSurface spline = splineOf(keys->surface).value();
  double most = 0;
  for (int i = 0; i <= 40; ++i)
    for (int k = 0; k <= 60; ++k) {
      const auto between = [](const std::vector<double>& knots, double share) {
        return knots.front() + share * (knots.back() - knots.front());
      };
      const Eigen::Vector3d p =
          spline.value(between(spline.knotsU, i / 40.0), between(spline.knotsV, k / 60.0));
      if (p.y() < 0 || p.y() > 800) continue;  // it goes on a little beyond
      most = std::max(most, sampler->closest(p, nullptr).value().distance);
    }
  EXPECT_LT(most, keys->deviation + BladesSurface::kTolerance);
  EXPECT_GT(most, 0.3 * keys->deviation) << "what is told is not much more than what is";
  const Evaluation now = evaluated(withSurface(e, "cut", keys->surface).value());
  EXPECT_TRUE(now.cut().setup->planes.turns());
  EXPECT_EQ(now.cut().coverage.value->uncovered, 0);
}

TEST(TurningDesign, KeyBladesOfATurnedOverBlockAndOfASurfaceOutOfTheAxesLieWhereTheyDid) {
  for (const bool over : {false, true}) {
    Design design = turning();
    design.cut().sections.stations = 17;
    if (over) {
      design.cut().pose.up = BlockFace::bottom;
    } else {
      DesignedSurface& surface = *design.source().surface;
      surface.rotation.z() = 0.3;
      const Eigen::Matrix3d axes = rotationFromAngles(surface.rotation);
      surface.origin = {40, -30, 25};
      BlockPlacement& block = *design.stock[0].placement;
      block.rotation = surface.rotation;
      block.origin = surface.origin + axes * block.origin;
    }
    const Evaluation e = evaluated(design);
    for (const Told which : {Told::target, Told::cut}) {
      const Result<CutKeyBlades> keys = keyBladesOf(e.cut(), which, 0.3, {});
      ASSERT_TRUE(keys) << keys.error().message;
      EXPECT_LE(keys->deviation, 0.3);
      const Evaluation now = evaluated(withSurface(e, "cut", keys->surface).value());
      EXPECT_TRUE(now.cut().setup->planes.turns());
      EXPECT_EQ(now.cut().coverage.value->uncovered, 0);
      // What is to be cut now is no farther from what was, or was cut.
      const std::unique_ptr<SurfaceSampler> sampler = now.cut().target.value->sampler();
      double most = 0;
      const SurfaceGrid& before = e.result()->analysis.cut;
      for (int r = 0; r < before.rows; r += 4)
        for (int c = 0; c < before.columns; c += 10)
          most = std::max(most, sampler->closest(before.at(r, c), nullptr).value().distance);
      const double own = which == Told::cut ? 0 : e.result()->analysis.summary.deviationMax;
      EXPECT_LT(most, keys->deviation + own + 2 * BladesSurface::kTolerance) << over;
    }
  }
}

TEST(TurningDesign, KeyBladesOfTheBlocksOfAWallMeet) {
  const Design design = turningWall();
  Evaluation e = evaluate(design, nullptr, {}).evaluation;
  ASSERT_EQ(e.blocks.size(), 3u);
  for (const BlockEvaluation& block : std::vector<BlockEvaluation>(e.blocks)) {
    const Result<CutKeyBlades> keys = keyBladesOf(block.cuts[0], Told::target, 0.1, {});
    ASSERT_TRUE(keys) << keys.error().message;
    EXPECT_LE(std::get<BladesSurface>(keys->surface.shape).blades.size(), 3u);
    e.design = withSurface(e, block.cuts[0].id, keys->surface).value();
  }
  Design own = e.design;
  own.grid.reset();
  const Evaluation now = evaluate(own, nullptr, {}).evaluation;
  ASSERT_EQ(now.blocks.size(), 3u);
  for (const BlockEvaluation& block : now.blocks) EXPECT_TRUE(block.cuts[0].setup->planes.turns());
  ASSERT_TRUE(now.joints.value);
  EXPECT_EQ(now.joints.value->joints.size(), 2u);
  EXPECT_FALSE(told<JointOpen>(now.findings()));
  EXPECT_LT(now.joints.value->gapMax(), 0.2);
}

TEST(TurningDesign, KeyBladesThatDoNotTurnAnyMoreAreCutInParallelPlanes) {
  // Turned in the middle of the block, and beside it.
  Design design = turning();
  auto& blades = std::get<BladesSurface>(design.source().surface->shape).blades;
  const std::array<double, 5> places = {-200, 0, 400, 800, 1000}, turns = {-2, 0, 5, 0, -2};
  for (std::size_t k = 0; k < places.size(); ++k) {
    blades[k].y = places[k];
    blades[k].turn = fromDegrees(turns[k]);
  }
  const Evaluation e = evaluated(design);
  const Result<CutKeyBlades> keys = keyBladesOf(e.cut(), Told::target, 100, {});
  ASSERT_TRUE(keys) << keys.error().message;
  EXPECT_EQ(std::get<BladesSurface>(keys->surface.shape).blades.size(), 2u);
  EXPECT_NEAR(toDegrees(keys->turnedOff), 5, 0.2);
  const Design changed = withSurface(e, "cut", keys->surface).value();
  ASSERT_TRUE(changed.cut().direction);
  EXPECT_NEAR((*changed.cut().direction - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
  EXPECT_FALSE(evaluated(changed).cut().setup->planes.turns());
}

}  // namespace
}  // namespace bw::pipeline
