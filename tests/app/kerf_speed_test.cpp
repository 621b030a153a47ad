// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Designs whose blade melts the more the slower it passes: each point of it keeps half of its own kerf.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/simulate.h"
#include "bw/pipeline/sketch.h"

namespace bw::pipeline {
namespace {

using Eigen::Vector3d;

const KerfTable kTable = {{5, 4.4}, {10, 3.4}, {20, 2.4}};

/// A surface that turns as the blade travels: its one end stays behind and goes about half as fast.
Design turning(KerfTable table, double width = 0) {
  Design design = exampleDesign("single-block").value();
  design.bindings.clear();
  design.variables.clear();
  design.grid.reset();
  design.output.programs.clear();
  design.source().surface =
      DesignedSurface{FormulaSurface{{{0, 0}, {400, 200}}, "60 * sin(x / 250) + 0.0045 * x * (y - 100)"},
                      {0, 0, 0},
                      {0, 0, 0}};
  design.stock = {{}};
  design.cuts = {design.cut()};
  design.cut().block = design.block().id;
  design.cut().direction = Vector3d::UnitY();
  design.cut().sections.stations = 33;
  design.blade.length = 700;
  design.process.kerf = width;
  design.process.kerfTable = std::move(table);
  return design;
}

Evaluation evaluated(const Design& design, const Evaluation* previous = nullptr, int threads = 0) {
  RunContext context;
  context.threads = threads;
  Outcome outcome = evaluate(design, previous, context);
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

/// Points of the blades at the stations and their speeds, of what the blades are alone: those of the same
/// place of the blade at the stations before and after, over the travel; the fastest of all goes as asked.
struct BladePoint {
  Vector3d place;
  double speed = 0;
};
std::vector<BladePoint> bladePoints(const CutEvaluation& cut, double cuttingSpeed) {
  constexpr int kPlaces = 401;
  const std::vector<BladePose>& poses = cut.sweep.value->poses;
  std::vector<BladePoint> points;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const std::vector<Vector3d> before = poses[i - 1].bladePoints(kPlaces),
                                at = poses[i].bladePoints(kPlaces), after = poses[i + 1].bladePoints(kPlaces);
    double fastest = 0;
    std::vector<double> speeds;
    for (int k = 0; k < kPlaces; ++k) {
      speeds.push_back((after[std::size_t(k)] - before[std::size_t(k)]).norm());
      fastest = std::max(fastest, speeds.back());
    }
    const double step = poses[i].blade.length() / (kPlaces - 1);
    for (int k = 0; k < kPlaces; ++k)
      if (k * step >= poses[i].before && k * step <= poses[i].before + poses[i].cut.length())
        points.push_back({at[std::size_t(k)], cuttingSpeed * speeds[std::size_t(k)] / fastest});
  }
  return points;
}

/// mm, signed, from the target to what stands beside points of the blade where they melt by the table.
std::vector<double> standingOff(const CutEvaluation& cut, const std::vector<BladePoint>& points,
                                const KerfTable& table) {
  const std::unique_ptr<SurfaceSampler> sampler = cut.target.value->sampler();
  std::vector<double> off;
  for (const BladePoint& point : points) {
    const auto foot = *sampler->closest(point.place, nullptr);
    // The foam below stays: what stands lies below the blade.
    const double up = foot.normal.z() > 0 ? 1 : -1;
    const Vector3d stands = point.place - 0.5 * kerfAt(table, point.speed) * up * foot.normal;
    off.push_back(up * sampler->offset(stands, *sampler->closest(stands, nullptr)));
  }
  return off;
}

double farthest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST(KerfOverSpeed, WhatStandsBesideEachPointOfTheBladeIsTheTarget) {
  const Evaluation none = evaluated(turning({}));
  const double without = none.result()->analysis.summary.deviationMax;
  const Evaluation e = evaluated(turning(kTable));
  const CutEvaluation& cut = e.cut();
  const CutResult result = *cut.result();
  EXPECT_LT(result.analysis.summary.speedRatioMin, 0.65) << "a case of its own";
  EXPECT_LT(result.analysis.summary.deviationMax, without + 0.05) << "as near as without a kerf";
  const std::vector<BladePoint> points = bladePoints(cut, 20);
  const double off = farthest(standingOff(cut, points, kTable));
  EXPECT_LT(off, result.analysis.summary.deviationMax + 0.01);
  EXPECT_LT(off, 0.3);

  // One width, that of the fastest point, misses by half of what the slower ones melt more.
  const Evaluation constant = evaluated(turning({}, 2.4));
  const std::vector<BladePoint> plain = bladePoints(constant.cut(), 20);
  const std::vector<double> missed = standingOff(constant.cut(), plain, kTable);
  const double fit = constant.result()->analysis.summary.deviationMax + 0.01;
  double most = 0;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const double more = 0.5 * (kerfAt(kTable, plain[k].speed) - 2.4);
    EXPECT_NEAR(missed[k], -more, fit);
    most = std::max(most, more);
  }
  EXPECT_GT(most, 0.3) << "which is more than the blades miss";
  EXPECT_GT(farthest(missed), off + 0.2);
}

TEST(KerfOverSpeed, MapAndSkinAreOfWhatStands) {
  const Evaluation e = evaluated(turning(kTable));
  const CutResult result = *e.cut().result();
  const std::unique_ptr<SurfaceSampler> sampler = e.cut().target.value->sampler();
  const std::vector<double>& told = result.analysis.cut.field("deviation")->values;
  for (std::size_t k = 0; k < told.size(); k += 53) {
    const Vector3d& p = result.analysis.cut.points[k];
    if (std::isnan(told[k])) continue;  // beside the block
    EXPECT_NEAR(told[k], sampler->offset(p, *sampler->closest(p, nullptr)), 3e-3) << k;
  }
  // The skin that is written goes through them.
  const SplineSurface& skin = result.analysis.surface;
  for (const double u : {0.0, 0.31, 0.5, 0.77, 1.0})
    for (const double v : {0.02, 0.4, 0.5, 0.93}) {
      const Vector3d p = skin.value(u, v);
      EXPECT_LT(std::abs(sampler->offset(p, *sampler->closest(p, nullptr))),
                result.analysis.summary.deviationMax + 5e-3);
    }
  EXPECT_LT(result.coverage.distance, result.coverage.limit);
  EXPECT_LT(result.between.fromShown, 0.1);
  for (const Finding& finding : e.findings()) {
    EXPECT_NE(finding.severity, Severity::error);
    EXPECT_FALSE(std::holds_alternative<UnevenSpeed>(finding.cause)) << "slower points are in the table";
  }
}

/// Whether both came to the same, to the last bit.
void expectSame(const Evaluation& a, const Evaluation& b) {
  const CutResult one = *a.cut().result(), other = *b.cut().result();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_EQ(one.sweep.poses[i].cutPoints(41), other.sweep.poses[i].cutPoints(41)) << i;
  EXPECT_EQ(one.analysis.cut.points, other.analysis.cut.points);
  for (std::size_t k = 0; k < one.analysis.cut.fields.size(); ++k)
    EXPECT_TRUE(std::ranges::equal(
        one.analysis.cut.fields[k].values, other.analysis.cut.fields[k].values,
        [](double own, double its) { return own == its || (std::isnan(own) && std::isnan(its)); }))
        << one.analysis.cut.fields[k].name;
  EXPECT_EQ(one.analysis.surface.poles, other.analysis.surface.poles);
  ASSERT_EQ(one.motion.instants.size(), other.motion.instants.size());
  for (std::size_t i = 0; i < one.motion.instants.size(); ++i) {
    EXPECT_EQ(one.motion.instants[i].time, other.motion.instants[i].time);
    EXPECT_EQ(one.motion.instants[i].poses[0].position, other.motion.instants[i].poses[0].position);
  }
}

TEST(KerfOverSpeed, ATableOfOneWidthIsThatWidth) {
  expectSame(evaluated(turning({{5, 2.4}, {20, 2.4}})), evaluated(turning({}, 2.4)));
  expectSame(evaluated(turning({{5, 0}, {20, 0}})), evaluated(turning({})));
}

TEST(KerfOverSpeed, IsTheSameWithAnyNumberOfThreads) {
  expectSame(evaluated(turning(kTable), nullptr, 1), evaluated(turning(kTable), nullptr, 3));
}

TEST(KerfOverSpeed, IsTakenOverWhereNothingOfItChanged) {
  const Evaluation e = evaluated(turning(kTable));
  const Evaluation again = evaluated(turning(kTable), &e);
  EXPECT_EQ(again.cut().middle.value, e.cut().middle.value);
  EXPECT_EQ(again.cut().sweep.value, e.cut().sweep.value);
  EXPECT_EQ(again.cut().analysis.value, e.cut().analysis.value);
  // What it hangs on makes it anew, and it comes to what it comes to from nothing.
  Design slower = turning(kTable);
  slower.process.cuttingSpeed = 12;
  expectSame(evaluated(slower, &e), evaluated(slower));
  Design firmer = turning(kTable);
  firmer.blade.length = 720;
  expectSame(evaluated(firmer, &e), evaluated(firmer));
  expectSame(evaluated(turning({}, 2.4), &e), evaluated(turning({}, 2.4)));
  Design open = turning(kTable);
  open.blade.autoLength = true;
  const Evaluation sought = evaluated(open);
  const Evaluation kept = evaluated(open, &sought);
  EXPECT_EQ(kept.cut().lengths.value, sought.cut().lengths.value);
  EXPECT_EQ(kept.cut().sweep.value, sought.cut().sweep.value);
}

TEST(KerfOverSpeed, HoldsWithAnOffsetAndOnTheOtherSide) {
  for (const double back :
       {1.2, 15.0}) {  // that of half the width of the fastest: the middle is on the target
    Design design = turning(kTable);
    design.cut().offset = back;
    const Evaluation e = evaluated(design);
    std::vector<double> off = standingOff(e.cut(), bladePoints(e.cut(), 20), kTable);
    for (double& one : off) one += back;
    EXPECT_LT(farthest(off), e.result()->analysis.summary.deviationMax + 0.01) << back;
  }
  Design above = turning(kTable);
  above.cut().keep = KeptSide::above;
  const Evaluation e = evaluated(above);
  KerfTable other = kTable;
  for (KerfAt& entry : other) entry.width = -entry.width;
  EXPECT_LT(farthest(standingOff(e.cut(), bladePoints(e.cut(), 20), other)),
            e.result()->analysis.summary.deviationMax + 0.01);
}

TEST(KerfOverSpeed, AProgramMeltsByTheSpeedsThatItHas) {
  Design design = turning(kTable);
  const Evaluation e = evaluated(design);
  const Result<Cell> cell = loadCell(design.output.cell);
  ASSERT_TRUE(cell);
  const auto run = [&](const Motion& motion) {
    const Result<robotio::Program> program = robotio::writeJson(motion, *cell);
    EXPECT_TRUE(program);
    Result<ProgramRun> done = runProgram(*program, &design, {});
    EXPECT_TRUE(done) << done.error().message;
    return std::move(*done);
  };
  const CutResult result = *e.cut().result();
  const ProgramRun planned = run(result.motion);
  EXPECT_NEAR(planned.surface->toTargetMax, result.analysis.summary.deviationMax, 0.05);
  // At half the speed all points melt more, and nothing of the way of the blade tells.
  Motion slowed = result.motion;
  for (MotionInstant& at : slowed.instants) at.time *= 2;
  const ProgramRun slow = run(slowed);
  double least = 1e9, most = 0;
  for (const BladePoint& point : bladePoints(e.cut(), 20)) {
    const double more = 0.5 * (kerfAt(kTable, 0.5 * point.speed) - kerfAt(kTable, point.speed));
    least = std::min(least, more);
    most = std::max(most, more);
  }
  EXPECT_GT(least, 0.25);
  EXPECT_NEAR(slow.surface->toTargetMax, most, 0.1 + result.analysis.summary.deviationMax);
  EXPECT_NEAR(slow.surface->toDesignMax, planned.surface->toDesignMax, 1e-6);
  // What stands of it lies that much lower.
  const auto lower = [](const ProgramRun& of, const ProgramRun& than) {
    const SurfaceGrid a = standingBeside(of.simulation.swept(), of.kerf, *of.melted),
                      b = standingBeside(than.simulation.swept(), than.kerf, *than.melted);
    const std::size_t middle = std::size_t(a.rows / 2) * std::size_t(a.columns) + std::size_t(a.columns / 2);
    return (b.points[middle] - a.points[middle]).norm();
  };
  EXPECT_GT(lower(slow, planned), least - 0.1);
  EXPECT_LT(lower(slow, planned), most + 0.1);
}

TEST(KerfOverSpeed, TheSketchHasTheSpeedsOfTheLastEvaluation) {
  const auto pulled = [](double up) {
    Design design = turning(kTable);
    std::get<FormulaSurface>(design.source().surface->shape).formula +=
        " + " + std::to_string(up) + " * sin(y / 64)";
    return design;
  };
  Sketcher sketcher(std::make_shared<const Evaluation>(evaluated(pulled(1))));
  const std::optional<Sketch> sketch = sketcher.draw(pulled(4), {});
  ASSERT_TRUE(sketch);
  const CutSketch& cut = sketch->blocks[0][0];
  const Evaluation anew = evaluated(pulled(4));
  EXPECT_LT(cut.look->deviationMax, anew.result()->analysis.summary.deviationMax + 0.1);
  const std::unique_ptr<SurfaceSampler> sampler = anew.cut().target.value->sampler();
  for (const Vector3d& p : cut.look->cut.points)
    EXPECT_LT(std::abs(sampler->offset(p, *sampler->closest(p, nullptr))), cut.look->deviationMax + 0.1);
}

TEST(KerfOverSpeed, LeavesThePartsThatAreAskedFor) {
  std::vector<double> volumes;
  for (const bool table : {false, true}) {
    Design design = exampleDesign("two-crossing-cuts").value();
    design.output.programs.clear();
    if (table) design.process.kerfTable = kTable;
    Evaluation e = evaluated(design);
    ASSERT_TRUE(addParts(e, {}));
    ASSERT_TRUE(e.blocks[0].part.value->solid);
    volumes.push_back(e.blocks[0].part.value->solid->volume());
  }
  EXPECT_NEAR(volumes[1], volumes[0], 0.03 * 360000);
}

}  // namespace
}  // namespace bw::pipeline
