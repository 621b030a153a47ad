// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What follows a hand: sketches beside evaluations of the same designs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "bw/core/design/variables.h"
#include "bw/core/shape/iso_sections.h"
#include "bw/pipeline/reach.h"
#include "bw/pipeline/sketch.h"
#include "pulled_example.h"
#include "sample_wall.h"

namespace bw::pipeline {
namespace {

using test::designed, test::evaluated, test::pulled;

TEST(Sketch, SaysOfTheStationsWhatTheEvaluationSays) {
  Sketcher sketcher(evaluated(pulled(0)));
  for (const double up : {2.0, 5.0, 9.0, 14.0, 8.0, -3.0}) {
    const std::optional<Sketch> sketch = sketcher.draw(pulled(up), {});
    ASSERT_TRUE(sketch) << up;
    const CutSketch& cut = sketch->blocks[0][0];
    const std::shared_ptr<const Evaluation> anew = evaluated(pulled(up));
    const CutResult result = *anew->result();
    ASSERT_EQ(cut.sweep->poses.size(), result.size());
    EXPECT_LT(cut.look->deviationMax, result.analysis.summary.deviationMax + 0.02) << up;
    EXPECT_NEAR(cut.look->minRadius, result.analysis.summary.minRadius,
                0.05 * result.analysis.summary.minRadius);
    for (std::size_t i = 0; i < result.size(); ++i) {
      EXPECT_NEAR(cut.look->deviation[i], result.station(i).deviation, 0.05) << up << " " << i;
      EXPECT_EQ(cut.look->rest[i], result.rest.stations[i]) << up << " " << i;
      EXPECT_EQ(cut.sweep->poses[i].travel, result.sweep.poses[i].travel);
      EXPECT_NEAR((cut.sweep->poses[i].cutPoints(3)[1] - result.sweep.poses[i].cutPoints(3)[1]).norm(), 0,
                  0.3);
    }
  }
}

TEST(Sketch, StandsWhereTheEvaluationDoesUntilTheHandMoves) {
  for (const char* name : {"single-block", "twist", "three-block-wall"}) {
    const Design design = designed(name);
    const std::shared_ptr<const Evaluation> whole = evaluated(design);
    Sketcher sketcher(whole);
    const std::optional<Sketch> sketch = sketcher.draw(design, {});
    ASSERT_TRUE(sketch) << name;
    for (const BlockEvaluation& block : whole->blocks)
      for (const CutEvaluation& cut : block.cuts) {
        const CutSketch* drawn = sketch->find(cut.id);
        ASSERT_TRUE(drawn && drawn->sweep->poses.size() == cut.sweep.value->poses.size()) << name;
        for (std::size_t i = 0; i < drawn->sweep->poses.size(); ++i) {
          const BladePose &is = drawn->sweep->poses[i], &was = cut.sweep.value->poses[i];
          EXPECT_EQ(is.leftPoint(), was.leftPoint()) << name << " " << i;
          EXPECT_EQ(is.rightPoint(), was.rightPoint()) << name << " " << i;
        }
      }
  }
}

TEST(Sketch, SectionsOfASplineAreThoseThatAreTraced) {
  for (const char* name : {"single-block", "ripple-along", "twist", "bump"}) {
    const Design design = designed(name);
    const SplineSurface spline = splineOf(*design.source().surface).value();
    const geometry::CadModel model = geometry::CadModel::of(spline, name).value();
    const geometry::Target target = geometry::Target::make(model, {}).value();
    Findings findings;
    const geometry::Setup setup =
        geometry::resolveSetup(target, {design.block().placement, design.cut().direction}, findings).value();
    SectionRequest request;
    request.stations = 33;
    const std::vector<Section> traced = geometry::cutSections(target, setup, request, {}, findings).value();
    const auto sections = isoSections(spline, spline, traced, setup.block);
    ASSERT_TRUE(sections) << name;
    ASSERT_EQ(sections->size(), traced.size());
    for (std::size_t i = 0; i < traced.size(); ++i) {
      const std::vector<Eigen::Vector2d> a = (*sections)[i].curve().sample(50),
                                         b = traced[i].curve().sample(50);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_LT((a[k] - b[k]).norm(), 0.005) << name << i << " " << k;
    }
    // Poles moved along the travel are none of it, nor those beyond the block.
    SplineSurface moved = spline;
    moved.poles[std::size_t(moved.polesU) + 1].y() += 5;
    EXPECT_FALSE(isoSections(moved, moved, traced, setup.block));
    moved = spline;
    moved.poles.front().z() += 1000;
    EXPECT_FALSE(isoSections(moved, spline, traced, setup.block));
    moved = spline;
    for (Eigen::Vector3d& pole : moved.poles) pole.y() *= 0.9;
    EXPECT_FALSE(isoSections(moved, spline, traced, setup.block));
  }
}

/// The sections of all blocks of a design, by tracing and as curves of the spline, are the same.
void expectTracedSections(const Design& design, const char* name) {
  const SplineSurface spline = splineOf(*design.source().surface).value();
  const geometry::CadModel model = geometry::CadModel::of(spline, name).value();
  const geometry::Target target = geometry::Target::make(model, {}).value();
  for (const StockBlock& block : design.stock) {
    Findings findings;
    const geometry::Setup setup =
        geometry::resolveSetup(target, {block.placement, design.cut().direction}, findings).value();
    SectionRequest request;
    request.stations = 33;
    const std::vector<Section> traced = geometry::cutSections(target, setup, request, {}, findings).value();
    const auto sections = isoSections(spline, spline, traced, setup.block);
    ASSERT_TRUE(sections) << name << " " << block.id;
    ASSERT_EQ(sections->size(), traced.size());
    for (std::size_t i = 0; i < traced.size(); ++i) {
      const std::vector<Eigen::Vector2d> a = (*sections)[i].curve().sample(50),
                                         b = traced[i].curve().sample(50);
      for (std::size_t k = 0; k < a.size(); ++k)
        EXPECT_LT((a[k] - b[k]).norm(), 0.005) << name << " " << block.id << " " << i << " " << k;
      // Its ends lie on the sides of the block, or on the border of the surface.
      for (const Eigen::Vector2d& end : {a.front(), a.back()}) {
        const Eigen::Vector3d p = setup.block.frame.toLocal(traced[i].frame.toWorld(end));
        EXPECT_LT(std::min(std::abs(p.x()), std::abs(setup.block.size.x() - p.x())), 1e-6);
      }
    }
    // Again, from these: the same curves.
    const auto again = isoSections(spline, spline, *sections, setup.block);
    ASSERT_TRUE(again);
    for (std::size_t i = 0; i < traced.size(); ++i)
      EXPECT_EQ(&(*again)[i].curve().poles(), &(*sections)[i].curve().poles());
  }
}

TEST(Sketch, SectionsOfAWallAreThoseThatAreTraced) {
  expectTracedSections(designed("block-wall"), "block-wall");
  expectTracedSections(designed("three-block-wall"), "three-block-wall");
  expectTracedSections(test::sampleWall(2, 2, 33), "net of poles");
  expectTracedSections(test::sampleWall(2, 2, 33, false), "loft");
  // The other way round, and one that is wider than its blocks.
  Design turned = test::sampleWall(2, 2, 33);
  turned.source().surface->rotation.z() = kPi;
  turned.source().surface->origin = {1200, 1600, 0};
  expectTracedSections(turned, "turned");
  Design wide = test::sampleWall(2, 2, 33);
  PolesSurface& wider = std::get<PolesSurface>(wide.source().surface->shape);
  wider.over = {{-150, -90}, {1290, 1800}};
  for (SurfacePole& pole : wider.poles) pole.moved.setZero();
  expectTracedSections(wide, "wide");
}

TEST(Sketch, SectionsThatLeaveTheBlockOfAWallAreTraced) {
  Design design = test::sampleWall(2, 1, 9);
  const SplineSurface was = splineOf(*design.source().surface).value();
  const auto sections = [&](const Design& from, std::size_t block) {
    const SplineSurface spline = splineOf(*from.source().surface).value();
    const geometry::CadModel model = geometry::CadModel::of(was, "wall").value();
    const geometry::Target target = geometry::Target::make(model, {}).value();
    Findings findings;
    const geometry::Setup setup =
        geometry::resolveSetup(target, {design.stock[block].placement, design.cut().direction}, findings)
            .value();
    SectionRequest request;
    request.stations = 9;
    const std::vector<Section> traced = geometry::cutSections(target, setup, request, {}, findings).value();
    return isoSections(spline, was, traced, setup.block);
  };
  EXPECT_TRUE(sections(design, 0));
  EXPECT_TRUE(sections(design, 1));
  // Through the top of the first block alone.
  PolesSurface& poles = std::get<PolesSurface>(design.source().surface->shape);
  poles.at(2, 1).height += 1500;
  EXPECT_FALSE(sections(design, 0));
  EXPECT_TRUE(sections(design, 1));
  // A surface that turns back at the side of the block has two sections there.
  poles.at(2, 1).height -= 1500;
  poles.at(2, 4).moved.x() += 500;
  EXPECT_FALSE(sections(design, 0));
}

/// All that a sketch says is the same, to the last bit.
void expectSame(const Sketch& a, const Sketch& b, const std::string& where) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t k = 0; k < a.blocks.size(); ++k) {
    const CutSketch &one = a.blocks[k].at(0), &other = b.blocks[k].at(0);
    ASSERT_EQ(one.sweep->poses.size(), other.sweep->poses.size());
    for (std::size_t i = 0; i < one.sweep->poses.size(); ++i) {
      const BladePose &pose = one.sweep->poses[i], &same = other.sweep->poses[i];
      EXPECT_EQ(pose.leftPoint(), same.leftPoint()) << where << " " << one.id << " " << i;
      EXPECT_EQ(pose.rightPoint(), same.rightPoint()) << where << " " << one.id << " " << i;
      EXPECT_EQ(pose.before, same.before) << where << " " << one.id << " " << i;
    }
    EXPECT_EQ(one.look->cut.points, other.look->cut.points) << where << " " << one.id;
    for (std::size_t f = 0; f < one.look->cut.fields.size(); ++f)
      EXPECT_EQ(one.look->cut.fields[f].values, other.look->cut.fields[f].values)
          << where << " " << one.id << " " << one.look->cut.fields[f].name;
    EXPECT_EQ(one.look->rest, other.look->rest) << where << " " << one.id;
    EXPECT_EQ(one.look->crosses, other.look->crosses) << where << " " << one.id;
    EXPECT_EQ(one.look->minRadius, other.look->minRadius) << where << " " << one.id;
    EXPECT_EQ(one.target->points, other.target->points) << where << " " << one.id;
  }
}

TEST(Sketch, OfAWallMakesWhatAChangeReachesAndNothingElse) {
  const Design wall = test::sampleWall(3, 3, 9);
  const std::shared_ptr<const Evaluation> first = evaluated(wall);
  ASSERT_EQ(first->blocks.size(), 9u);
  Sketcher some(first), all(first), one(first);
  RunContext alone;
  alone.threads = 1;
  std::mt19937 random(7);
  Design design = wall;
  std::optional<Sketch> before;
  int stayed = 0, most = 0;
  for (int step = 0; step < 24; ++step) {
    PolesSurface& poles = std::get<PolesSurface>(design.source().surface->shape);
    const int row = int(random() % unsigned(poles.rows)), column = int(random() % unsigned(poles.columns));
    if (step > 0) poles.at(row, column).height += double(random() % 1000) / 100 - 5;
    const std::optional<Sketch> sketch = some.draw(design, {}), serial = one.draw(design, alone);
    all.forget();
    const std::optional<Sketch> whole = all.draw(design, {});
    ASSERT_TRUE(sketch && serial && whole) << step;
    EXPECT_EQ(whole->made, 9);
    const std::string where =
        "step " + std::to_string(step) + ", pole " + std::to_string(row) + " " + std::to_string(column);
    expectSame(*sketch, *whole, where);
    expectSame(*sketch, *serial, where + ", threads");
    if (before) {
      int kept = 0;
      for (std::size_t b = 0; b < 9; ++b)
        kept += sketch->blocks[b][0].look == before->blocks[b][0].look ? 1 : 0;
      EXPECT_EQ(sketch->made, 9 - kept) << where;
      stayed += kept;
      most = std::max(most, sketch->made);
    } else {
      EXPECT_EQ(sketch->made, 9) << "nothing was seen yet";
    }
    before = sketch;
  }
  EXPECT_GT(stayed, 23 * 9 / 3) << "a pole reaches but some of the blocks";
  EXPECT_GE(most, 4) << "and more than one of them";
  // As near to the surface as what is found of the same design from nothing.
  const std::shared_ptr<const Evaluation> anew = evaluated(design);
  for (std::size_t b = 0; b < 9; ++b) {
    const CutResult result = *anew->blocks[b].cuts[0].result();
    EXPECT_LT(before->blocks[b][0].look->deviationMax, result.analysis.summary.deviationMax + 0.05) << b;
  }
  // What all cuts hang on makes them all again.
  design.process.margin += 0.01;
  EXPECT_EQ(some.draw(design, {})->made, 9);
  EXPECT_EQ(some.draw(design, {})->made, 0);
}

TEST(Sketch, OfAWallTellsTheBorderOfWhatChanged) {
  // Its knots lie on the boundaries of the blocks.
  const Design wall = test::sampleWall(3, 2, 9);
  const std::shared_ptr<const Evaluation> first = evaluated(wall);
  Sketcher some(first), all(first);
  ASSERT_TRUE(some.draw(wall, {}) && all.draw(wall, {}));
  const int columns = std::get<PolesSurface>(wall.source().surface->shape).columns;
  for (int column = 0; column < columns; ++column) {
    Design design = wall;
    std::get<PolesSurface>(design.source().surface->shape).at(2, column).height += 4;
    const std::optional<Sketch> sketch = some.draw(design, {});
    all.forget();
    const std::optional<Sketch> whole = all.draw(design, {});
    ASSERT_TRUE(sketch && whole) << column;
    expectSame(*sketch, *whole, "column " + std::to_string(column));
  }
}

TEST(Sketch, GoesOnWhereMoreThanTheSurfaceChanges) {
  const Design design = designed("bump");
  Sketcher sketcher(evaluated(design));
  Design other = design;
  other.blade.length += 20;
  std::optional<Sketch> sketch = sketcher.draw(other, {});
  ASSERT_TRUE(sketch);
  EXPECT_EQ(sketch->blocks[0][0].sweep->request.blade.length, design.blade.length + 20);
  other.cut().sections.stations = 21;
  sketch = sketcher.draw(other, {});
  ASSERT_TRUE(sketch);
  EXPECT_EQ(sketch->blocks[0][0].look->rest.size(), 21u);
  EXPECT_EQ(sketch->blocks[0][0].look->rest[10], Rest::unknown) << "nobody sought other shapes of this blade";
  // The same again, from what was there.
  sketch = sketcher.draw(other, {});
  ASSERT_TRUE(sketch);
  // No blade reaches this surface.
  other.blade.length = 200;
  EXPECT_FALSE(sketcher.draw(other, {}));
  // And what it comes back to is known.
  sketch = sketcher.draw(design, {});
  ASSERT_TRUE(sketch);
  EXPECT_LT(sketch->blocks[0][0].look->deviationMax, 0.2);
  Design many = design;
  many.cuts.clear();
  EXPECT_FALSE(sketcher.draw(many, {}));
}

TEST(Sketch, OfSeveralBlocksHasTheCutsOfAllAndTheirEnds) {
  const Design design = designed("three-block-wall");
  const std::shared_ptr<const Evaluation> first = evaluated(design);
  ASSERT_EQ(first->blocks.size(), 3u);
  Sketcher sketcher(first);
  Design raised = design;
  ASSERT_FALSE(raised.variables.empty());
  const Variable& variable = raised.variables.front();
  raised =
      withVariables(raised, {{variable.name, variable.value + 0.02 * (variable.max - variable.min)}}).value();
  const std::optional<Sketch> sketch = sketcher.draw(raised, {});
  ASSERT_TRUE(sketch);
  ASSERT_EQ(sketch->blocks.size(), 3u);
  const std::shared_ptr<const Evaluation> anew = evaluated(raised);
  for (std::size_t b = 0; b < 3; ++b) {
    const CutSketch& cut = sketch->blocks[b].at(0);
    const CutEvaluation& full = anew->blocks[b].cuts[0];
    EXPECT_EQ(cut.id, full.id);
    EXPECT_EQ(cut.sweep->request, full.sweep.value->request)
        << "with the ends and tangents of its neighbours";
    ASSERT_EQ(cut.sweep->poses.size(), full.sweep.value->poses.size());
    for (std::size_t i = 0; i < cut.sweep->poses.size(); ++i)
      EXPECT_NEAR(cut.look->deviation[i], full.result()->station(i).deviation, 0.05) << b << " " << i;
  }
}

/// mm, how far the part that cuts of one blade is from that of another, at the most.
double apart(const BladePose& pose, const BladePose& other) {
  constexpr int kPlaces = 33, kOn = 201;
  const std::vector<Eigen::Vector3d> line = other.cutPoints(kOn);
  double farthest = 0;
  for (const Eigen::Vector3d& p : pose.cutPoints(kPlaces)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Eigen::Vector3d way = line[k + 1] - line[k];
      const double share = std::clamp((p - line[k]).dot(way) / way.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - line[k] - share * way).norm());
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(Sketch, OfANearlyStraightWallLiesWhereItsEvaluationDoes) {
  // Its rows have ends, tangents and lengths held, and a little less length bends a straight blade much.
  std::mt19937 random(2);
  const auto within = [&](double most) { return most * (double(random() % 2001) / 1000 - 1); };
  Design design = test::sampleWall(2, 1, 17, false);
  auto& sections = std::get<SectionsSurface>(design.source().surface->shape).sections;
  for (SectionCurve& section : sections)
    for (Eigen::Vector2d& point : section.points) point.y() = 250 + within(3);
  const std::shared_ptr<const Evaluation> first = evaluated(design);
  Sketcher sketcher(first);
  int looked = 0, off = 0, outdone = 0;
  for (int step = 0; step < 4; ++step) {
    const double up = within(3);
    std::vector<Eigen::Vector2d>& points = sections[random() % sections.size()].points;
    points[random() % points.size()].y() += up;
    const std::optional<Sketch> sketch = sketcher.draw(design, {});
    ASSERT_TRUE(sketch) << step;
    const Outcome anew = evaluate(design, first.get(), {});
    ASSERT_FALSE(anew.error);
    for (std::size_t b = 0; b < sketch->blocks.size(); ++b) {
      const Sweep& found = *anew.evaluation.blocks[b].cuts[0].sweep.value;
      const Sweep& drawn = *sketch->blocks[b][0].sweep;
      ASSERT_EQ(drawn.poses.size(), found.poses.size());
      for (std::size_t i = 0; i < found.poses.size(); ++i) {
        const double distance = apart(found.poses[i], drawn.poses[i]);
        EXPECT_LT(distance, 0.5) << step << " " << b << " " << i;
        ++looked;
        if (distance < 0.1) continue;
        // A blade that is found anew may lie on its section, where one that follows cannot.
        const double nearer = found.fits[i].fit.hausdorff, followed = drawn.fits[i].fit.hausdorff;
        ++(nearer < 0.1 * followed ? outdone : off);
      }
    }
  }
  // Without damped steps most of them are off, by up to 0.9 mm.
  EXPECT_LE(off, looked / 100);
  EXPECT_LE(outdone, looked / 10);
}

TEST(Sketch, KeepsWhatIsKnownOfAWallThatIsPulledFar) {
  // Its rows are nearly straight on the way, and have ends, tangents and lengths held. One that cannot be
  // followed is found anew, in many times the time, and nobody knows then what else its blades could rest in.
  const Design wall = test::sampleWall(3, 1, 17);
  Sketcher sketcher(evaluated(wall));
  for (int step = 1; step <= 24; ++step) {
    const double up = -10 * std::sin(0.13 * step);
    const std::optional<Sketch> sketch = sketcher.draw(test::pulledWall(wall, up), {});
    ASSERT_TRUE(sketch) << up;
    for (const std::vector<CutSketch>& block : sketch->blocks)
      EXPECT_EQ(std::ranges::count(block[0].look->rest, Rest::unknown), 0) << up << " " << block[0].id;
  }
}

TEST(Sketch, AHandThatComesBackFromFarGoesOnFromWhereItBegan) {
  // So far down no row is followed; back again all is known that was, and not only the blades.
  const Design wall = designed("three-block-wall");
  const auto pulledBy = [&](double up, std::size_t section = 0, std::size_t point = 3) {
    Design design = wall;
    design.bindings.clear();
    std::get<SectionsSurface>(design.source().surface->shape).sections[section].points[point].y() += up;
    return design;
  };
  const auto began = evaluated(pulledBy(0));
  Sketcher sketcher(began);
  const auto unknown = [&](double up, std::size_t section = 0, std::size_t point = 3) {
    const std::optional<Sketch> sketch = sketcher.draw(pulledBy(up, section, point), {});
    EXPECT_TRUE(sketch) << up;
    std::ptrdiff_t count = 0;
    for (const std::vector<CutSketch>& block : sketch->blocks)
      count += std::ranges::count(block[0].look->rest, Rest::unknown);
    return count;
  };
  EXPECT_EQ(unknown(4), 0);
  EXPECT_EQ(unknown(400), 0) << "it goes there in parts";
  EXPECT_EQ(unknown(5), 0);
  EXPECT_GT(unknown(-400), 0);
  EXPECT_EQ(unknown(-5), 0);
  // Where blades go through a straight line they follow a little at a time.
  sketcher = Sketcher(began);
  EXPECT_EQ(unknown(16, 1, 2), 0);
  EXPECT_EQ(unknown(44, 1, 2), 0);
}

TEST(Sketch, TellsWhatIsLost) {
  const Design design = designed("bump");
  Sketcher sketcher(evaluated(design));
  Design strict = design;
  bool lost = false;
  for (double up = 0; up <= 240 && !lost; up += 20) {
    std::get<PolesSurface>(strict.source().surface->shape).at(2, 1).height += 20;
    std::get<PolesSurface>(strict.source().surface->shape).at(3, 2).height -= 20;
    const std::optional<Sketch> sketch = sketcher.draw(strict, {});
    if (!sketch) break;
    const RowSketch& look = *sketch->blocks[0][0].look;
    const double limit = design.blade.minRadius();
    lost = std::ranges::any_of(look.rest,
                               [](Rest rest) { return rest != Rest::certain && rest != Rest::held; }) ||
           look.minRadius < limit || look.deviationMax > design.process.tolerance;
  }
  EXPECT_TRUE(lost) << "a surface that folds by 240 mm is shown as one that can be cut";
}

TEST(Sketch, TellsWhereABladeComesNearTheFaceThatTheBlockLiesOn) {
  const auto lowered = [](double down) {
    Design design = pulled(0);
    for (SurfacePole& pole : std::get<PolesSurface>(design.source().surface->shape).poles)
      pole.height -= down;
    return design;
  };
  const std::shared_ptr<const Evaluation> first = evaluated(lowered(0));
  double above = std::numeric_limits<double>::infinity();
  for (const StationCheck& station : first->result()->check.stations)
    above = std::min(above, station.aboveBottom);
  const double room = above - first->design.process.floor;
  ASSERT_GT(room, 10);
  Sketcher sketcher(first);
  for (const auto& [down, bar] :
       {std::pair(0.5 * room, Bar::none), {room - 0.1, Bar::none}, {room + 0.1, Bar::low}}) {
    const std::optional<Sketch> sketch = sketcher.draw(lowered(down), {});
    ASSERT_TRUE(sketch) << down;
    EXPECT_NEAR(sketch->blocks[0][0].look->aboveBottom, above - down, 0.01);
    EXPECT_EQ(barOf(*sketch), bar) << down;
  }
}

TEST(Sketch, TellsWhereTheSurfaceLeavesItsBlock) {
  // A block that ends little above its surface, which is pulled up as a whole.
  const double crest = evaluated(pulled(0))->cut().target.value->bounds().max.z();
  const auto raised = [crest](double up) {
    Design design = pulled(0);
    BlockPlacement& block = *design.stock.front().placement;
    block.size.z() = crest - block.origin.z() + 5;
    for (SurfacePole& pole : std::get<PolesSurface>(design.source().surface->shape).poles) pole.height += up;
    return design;
  };
  const std::shared_ptr<const Evaluation> first = evaluated(raised(0));
  Sketcher sketcher(first);
  const std::optional<Sketch> within = sketcher.draw(raised(1), {});
  ASSERT_TRUE(within);
  EXPECT_EQ(within->blocks[0][0].left, 0);
  EXPECT_EQ(barOf(*within), Bar::none);
  // The crest comes out through the top: two parts are left of some sections.
  const std::optional<Sketch> out = sketcher.draw(raised(25), {});
  ASSERT_TRUE(out);
  EXPECT_GT(out->blocks[0][0].left, 0);
  EXPECT_EQ(barOf(*out), Bar::outside);
  // An evaluation finds no more of the way than that.
  ReachSearch search(first, raised, 60);
  while (search.look({}) || search.confirm({})) {
  }
  EXPECT_EQ(search.reach().ends[1].bar, Bar::outside);
  EXPECT_TRUE(search.reach().ends[1].known);
  EXPECT_LT(search.reach().ends[1].free, 25);
  EXPECT_GT(search.reach().ends[1].free, 3);
}

}  // namespace
}  // namespace bw::pipeline
