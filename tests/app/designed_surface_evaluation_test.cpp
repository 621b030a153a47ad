// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Surfaces that are designed, on the whole way of a CAD file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/design/design_versions.h"
#include "bw/model/document.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/lower_block.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/run_identity.h"
#include "bw/pipeline/simulate.h"

namespace bw::pipeline {
namespace {

constexpr double kFloor = 20;  // mm of foam below the blade

Evaluation evaluated(const Design& design, const Evaluation* previous = nullptr) {
  Outcome outcome = evaluate(design, previous, {});
  EXPECT_FALSE(outcome.error) << outcome.error->message;
  return std::move(outcome.evaluation);
}

class DesignedExample : public testing::TestWithParam<std::string> {};

TEST_P(DesignedExample, IsCutFirmlyWithinItsBlockAsItOpens) {
  const Design design = exampleDesign(GetParam()).value();
  const BlockPlacement& block = *design.block().placement;
  EXPECT_EQ(block.size, Eigen::Vector3d(600, 800, 500));
  EXPECT_EQ(design.blade.length, GetParam() == "ripple-across" ? 720 : 800);
  const Evaluation e = evaluated(design);
  ASSERT_TRUE(e.result());
  const CutResult result = *e.result();
  EXPECT_EQ(result.size(), 33u);
  EXPECT_LT(result.analysis.summary.deviationMax, 0.2);
  EXPECT_EQ(result.coverage.share(), 1);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const StationView station = result.station(i);
    EXPECT_TRUE(station.rest == Rest::certain || station.rest == Rest::held) << i;
    double lowest = 1e300;
    for (const Eigen::Vector3d& point : station.pose.bladePoints(50)) {
      lowest = std::min(lowest, point.z() - block.origin.z());
      EXPECT_LE(point.z() - block.origin.z(), block.size.z() - kFloor) << i;
    }
    EXPECT_GE(station.check.aboveBottom, kFloor) << i;
    EXPECT_NEAR(station.check.aboveBottom, lowest, 0.1) << i;
  }
  for (const Finding& finding : e.findings()) EXPECT_NE(finding.severity, Severity::error);
}

TEST(DesignedSurface, TheFloorIsKeptByBlocksAroundSurfacesAndAskedOfOthers) {
  Design design = exampleDesign("bump").value();
  design.output.programs.clear();
  const Evaluation whole = evaluated(design);
  double lowest = 1e300;
  for (const StationCheck& station : whole.cut().check.value->stations)
    lowest = std::min(lowest, station.aboveBottom);
  design.process.floor = lowest + 1;
  const Findings told = evaluated(design).findings();
  EXPECT_TRUE(std::ranges::any_of(told, [](const Finding& f) { return f.kind() == FindingKind::floor; }));
  EXPECT_TRUE(exceedsLimit(told));
  design.process.floor = lowest - 1;
  EXPECT_FALSE(exceedsLimit(evaluated(design).findings()));
  // A block that reaches as much lower as the message tells keeps it.
  design.process.floor = lowest + 1;
  const auto low = std::ranges::find(told, FindingKind::floor, &Finding::kind);
  ASSERT_NE(low, told.end());
  const NearBottom cause = std::get<NearBottom>(low->cause);
  EXPECT_EQ(cause.lower, NearBottom::Lower::keeps);
  EXPECT_EQ(cause.lowerBy, 1);
  EXPECT_FALSE(exceedsLimit(evaluated(*withLowerBlock(design, design.cut().id, cause.lowerBy)).findings()));
  // There is none where another block lies.
  Design walled = design;
  walled.stock.push_back({"below", BlockPlacement{{0, 0, -400}, {600, 800, 400}}});
  Findings again = {*low};
  adviseLowerBlock(again, evaluated(design).cut(), walled);
  EXPECT_EQ(std::get<NearBottom>(again[0].cause).lower, NearBottom::Lower::noRoom);
  // One that is made around the surface is as low as that asks for.
  design.block().placement.reset();
  for (const double floor : {20.0, 80.0}) {
    design.process.floor = floor;
    const Evaluation around = evaluated(design);
    for (const Finding& finding : around.findings()) EXPECT_NE(finding.kind(), FindingKind::floor);
    double least = 1e300;
    for (const StationCheck& station : around.cut().check.value->stations)
      least = std::min(least, station.aboveBottom);
    // Whole mm, with 5 mm for what hangs lower between the stations.
    EXPECT_GE(least, floor + 5);
    EXPECT_LT(least, floor + 6);
    const Box &is = around.cut().block(), &was = around.cut().placed.value->block;
    EXPECT_NEAR(is.size.z() - was.size.z(), was.frame.origin.z() - is.frame.origin.z(), 1e-9);
  }
}

TEST(DesignedSurface, ALowerBlockIsAdvisedOnlyWhereItHelps) {
  // Ways in and out, too, whose blade comes below the floor where it is an arc: all that is advised keeps it.
  Design design = exampleDesign("ripple-along").value();
  design.output.programs.clear();
  const auto over = [&](const std::string& formula) {
    design.sources[0].surface = DesignedSurface{FormulaSurface{{{0, 0}, {600, 800}}, formula}};
    return evaluated(design);
  };
  const auto lows = [](const Evaluation& e) {
    std::vector<NearBottom> all;
    for (const Finding& finding : e.findings())
      if (const auto* low = std::get_if<NearBottom>(&finding.cause)) all.push_back(*low);
    return all;
  };
  const Evaluation shallow = over("9+6*sin(pi*x/600)+0*y");
  const std::vector<NearBottom> helped = lows(shallow);
  ASSERT_FALSE(helped.empty());
  double most = 0;
  for (const NearBottom& low : helped) {
    EXPECT_EQ(low.lower, NearBottom::Lower::keeps);
    most = std::max(most, low.lowerBy);
  }
  EXPECT_TRUE(lows(evaluated(*withLowerBlock(design, design.cut().id, most))).empty());
  // One that falls through the bottom is cut lower by a lower block, too: none is advised, and none helps.
  const Evaluation deep = over("60+6*sin(pi*x/600)-0.2*y");
  const std::vector<NearBottom> lost = lows(deep);
  ASSERT_FALSE(lost.empty());
  most = 0;
  for (const NearBottom& low : lost) {
    EXPECT_EQ(low.lower, NearBottom::Lower::alsoCut);
    most = std::max(most, std::ceil(low.floor - low.height));
  }
  EXPECT_FALSE(lows(evaluated(*withLowerBlock(design, design.cut().id, most))).empty());
}

TEST(DesignedSurface, TellsOverWhatStretchKeyBladesAreNone) {
  Design design = exampleDesign("key-blade-fan").value();
  design.output.programs.clear();
  const auto told = [](const Evaluation& e) {
    Findings all = e.findings();
    std::erase_if(all, [](const Finding& f) { return f.kind() != FindingKind::keyBlades; });
    return all;
  };
  const Evaluation good = evaluated(design);
  ASSERT_EQ(good.told.size(), 1u);
  ASSERT_TRUE(good.told[0].value);
  EXPECT_TRUE(good.told[0].value->empty());
  EXPECT_TRUE(told(good).empty());
  auto& blades = std::get<BladesSurface>(design.sources[0].surface->shape).blades;
  const double radius = design.blade.minRadius(), y = blades[1].y;
  blades[1].bend = std::copysign(1.1 * blades[1].length / radius, blades[1].bend);
  // It is told whether or not the rest comes to a result.
  const Evaluation bad = evaluate(design, &good, {}).evaluation;
  const Findings tight = told(bad);
  ASSERT_EQ(tight.size(), 1u);
  const auto& cause = std::get<ToldBlades>(tight[0].cause);
  EXPECT_EQ(cause.fault, ToldBlades::Fault::tight);
  EXPECT_LT(cause.from, y);
  EXPECT_GT(cause.to, y);
  EXPECT_LE(cause.radius, radius / 1.1 + 1e-6);
  EXPECT_EQ(cause.limit, radius);
  // Another tolerance asks nothing anew of it; another blade does.
  design.process.tolerance *= 2;
  const Evaluation same = evaluate(design, &bad, {}).evaluation;
  EXPECT_EQ(same.told[0].value, bad.told[0].value);
  design.blade.yieldStress *= 2;
  EXPECT_TRUE(told(evaluate(design, &bad, {}).evaluation).empty());
  // Other surfaces are told by no blades.
  EXPECT_FALSE(evaluated(exampleDesign("bump").value()).told[0].value);
}

/// A surface so low over the bottom of its block that the grips of a slack arc would lie below it.
Design lowRipple() {
  Design design = exampleDesign("ripple-along").value();
  design.sources[0].surface = DesignedSurface{FormulaSurface{{{0, 0}, {600, 800}}, "24+6*sin(pi*x/600)+0*y"}};
  design.output.cell = "irb1600-pair";
  design.output.programs = {"json"};
  design.process.gripError = design.process.gripAngle = 0;  // blades with so little slack snap by any
  return design;
}

TEST(DesignedSurface, TheFloorIsKeptOnTheWholeWay) {
  const Design design = lowRipple();
  const Evaluation e = evaluated(design);
  ASSERT_TRUE(e.result());
  EXPECT_FALSE(exceedsLimit(e.findings()));
  for (const MotionInstant& instant : e.cut().motion.value->instants)
    for (const Pose& grip : instant.poses) EXPECT_GE(grip.position.z(), kFloor - 1e-6);
  // A program whose way in is lower is found so.
  const Cell cell = loadCell(design.output.cell).value();
  const auto exceeded = [&](double down) {
    Motion motion = *e.cut().motion.value;
    for (std::size_t i = 0; motion.instants[i].station < 0; ++i)
      for (Pose& grip : motion.instants[i].poses) grip.position.z() -= down;
    int told = 0;
    const auto seen = [&told](const ProgramRun& now) {
      ++told;
      EXPECT_TRUE(now.surface && now.compared.target && now.compared.cut.rows > 1);
      EXPECT_TRUE(now.barriers.empty()) << "which pictures need not wait for";
    };
    const ProgramRun run =
        runProgram(robotio::writeJson(motion, cell).value(), &design, {}, {}, seen).value();
    EXPECT_EQ(told, 1);
    EXPECT_FALSE(run.barriers.empty());
    return std::ranges::any_of(run.exceeded, [](const std::string& text) {
      return text.find("the face that the block lies on (floor: 20 mm)") != std::string::npos;
    });
  };
  EXPECT_FALSE(exceeded(0));
  EXPECT_TRUE(exceeded(5));
}

TEST(DesignedSurface, AHomeOfTheCellBelowTheFloorIsTold) {
  // The block stands so much higher than in the cell that is there that the home of the robots is below it.
  Design design = lowRipple();
  std::ifstream in(*resourceFolder() / "cells" / "irb1600-pair.json");
  nlohmann::json cell = nlohmann::json::parse(in);
  cell["work_object"]["pose"]["position"][2] = 1300;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "bladewright_low_home_cell.json";
  std::ofstream(file) << cell.dump();
  design.output.cell = file.string();
  design.output.programs = {"rapid"};
  const Findings told = evaluated(design).cell.findings;
  std::filesystem::remove(file);
  const auto low = std::ranges::find(told, FindingKind::floor, &Finding::kind);
  ASSERT_NE(low, told.end());
  EXPECT_EQ(low->severity, Severity::warning);
  EXPECT_FALSE(low->where.stations);
  EXPECT_LT(std::get<NearBottom>(low->cause).height, 0);
  design.output.cell = "irb1600-pair";
  EXPECT_FALSE(std::ranges::count(evaluated(design).cell.findings, FindingKind::floor, &Finding::kind));
}

TEST(DesignedSurface, AHomeOfTheCellInTheBlockIsTold) {
  std::ifstream in(*resourceFolder() / "cells" / "irb1600-pair.json");
  nlohmann::json cell = nlohmann::json::parse(in);
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / "bladewright_home_in_block_cell.json";
  Design design = exampleDesign("single-block").value();
  design.output.programs = {"rapid"};
  const auto told = [&](double towards) {
    nlohmann::json other = cell;
    other["work_object"]["pose"]["position"][1] = 335 + towards;
    std::ofstream(file) << other.dump();
    design.output.cell = file.string();
    const Findings all = evaluated(design).cell.findings;
    std::filesystem::remove(file);
    const auto own = std::ranges::find_if(
        all, [](const Finding& finding) { return std::holds_alternative<ProgramBreach>(finding.cause); });
    return own == all.end() ? Finding{} : *own;
  };
  // The block stands 300 mm nearer to where the home is, then behind it.
  const Finding inside = told(300), before = told(0);
  EXPECT_EQ(inside.severity, Severity::error);
  ASSERT_TRUE(inside.where.point);
  const auto& breach = std::get<ProgramBreach>(inside.cause);
  EXPECT_EQ(breach.rule, "cell");
  EXPECT_NE(
      breach.text.find("at the cell's home, where the program begins, the blade lies in the block: at ("),
      std::string::npos)
      << breach.text;
  EXPECT_NE(breach.text.find("home_deg"), std::string::npos);
  EXPECT_FALSE(before.where.point);
  // Home is behind the block: the blade would come through it.
  const Finding through = told(1400);
  ASSERT_TRUE(through.where.point);
  EXPECT_NE(std::get<ProgramBreach>(through.cause)
                .text.find("on the way from the cell's home to where it comes to the block"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, DesignedExample,
                         testing::Values("single-block", "ripple-along", "ripple-across",
                                         "ruled-between-curves", "twist", "bump", "three-block-wall",
                                         "block-wall", "key-blade-fan", "turning-blades"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(DesignedSurface, AChangeRecomputesOnlyWhatHangsOnIt) {
  Design design = exampleDesign("bump").value();
  design.output.programs.clear();
  const Evaluation before = evaluated(design);
  Design faster = design;
  faster.process.cuttingSpeed = 10;
  const Evaluation slow = evaluated(faster, &before);
  EXPECT_EQ(slow.source.value, before.source.value);
  EXPECT_EQ(slow.cut().sweep.value, before.cut().sweep.value);
  Design raised = design;
  std::get<PolesSurface>(raised.source().surface->shape).at(2, 1).height += 5;
  const Evaluation after = evaluated(raised, &before);
  EXPECT_NE(after.source.value, before.source.value);
  EXPECT_NE(after.cut().sweep.value, before.cut().sweep.value);
  EXPECT_FALSE(after.source.value->content == before.source.value->content);
  // The same as from nothing.
  EXPECT_EQ(after.result()->analysis.summary.deviationMax,
            evaluated(raised).result()->analysis.summary.deviationMax);
  // Back again: by its request, though it was made anew in between.
  EXPECT_EQ(evaluated(design, &after).source.value->content, before.source.value->content);
  // A variable that only names what the surface does not use changes nothing.
  Design renamed = design;
  renamed.variables.push_back({"other", 1, 0, 2, ""});
  EXPECT_EQ(evaluated(withVariables(renamed, {{"other", 2}}).value(), &before).cut().motion.value,
            before.cut().motion.value);
}

TEST(DesignedSurface, ARunIsNamedByTheNumbersThatVariablesComeTo) {
  Design design = exampleDesign("ripple-along").value();
  const std::string run = runId(evaluated(design), nullptr);
  EXPECT_NE(runId(evaluated(withVariables(design, {{"amplitude", 12}}).value()), nullptr), run);
  Design other = design;
  other.variables.push_back({"unused", 1, 0, 2, ""});
  EXPECT_EQ(runId(evaluated(other), nullptr), run);
}

TEST(DesignedSurface, VersionsAreNoPartOfWhatIsComputed) {
  const Design design = exampleDesign("ripple-along").value();
  Design other = withVariables(design, {{"amplitude", 12}}).value();
  other.versions.push_back({"first", std::make_shared<const Design>(design)});
  const Product plain = produce(withoutVersions(other), {}, {}, {});
  const Product with = produce(other, {}, {}, {});
  ASSERT_FALSE(with.error) << with.error->message;
  EXPECT_EQ(with.files.paths(), plain.files.paths());
  ASSERT_GT(plain.files.paths().size(), 6u);
  for (std::size_t i = 0; i < plain.files.paths().size(); ++i)
    if (plain.files.paths()[i] != "report.json") {  // which tells how long it took
      EXPECT_EQ(with.files.bytes()[i], plain.files.bytes()[i]) << plain.files.paths()[i];
    }
  const Evaluation before = evaluated(withoutVersions(other)), after = evaluated(other, &before);
  EXPECT_EQ(runId(after, nullptr), runId(before, nullptr));
  EXPECT_EQ(after.cut().motion.value, before.cut().motion.value);
  EXPECT_EQ(storedDesign(after).value(), withoutVersions(other));
}

TEST(DesignedSurface, IsStoredWithTheResults) {
  const Design design = exampleDesign("twist").value();
  const Evaluation e = evaluated(design);
  EXPECT_EQ(storedDesign(e).value(), design);
}

TEST(DesignedSurface, ThatCannotBeMadeIsAnErrorWithItsPlace) {
  Design design = exampleDesign("ripple-along").value();
  std::get<FormulaSurface>(design.source().surface->shape).formula = "200 + 1/(x - 300)";
  const Outcome outcome = evaluate(design, nullptr, {});
  ASSERT_TRUE(outcome.error);
  EXPECT_NE(outcome.error->message.find("x = 300"), std::string::npos) << outcome.error->message;
}

TEST(DesignedSurface, IsADocumentThatIsSavedAndUndone) {
  model::Document document({});
  document.start(exampleDesign("bump").value());
  EXPECT_FALSE(document.empty());
  const Design before = *document.design();
  document.editDesign("Move pole", 1, [](Design& design) {
    std::get<PolesSurface>(design.source().surface->shape).at(2, 1).height += 5;
  });
  EXPECT_FALSE(*document.design() == before);
  document.undoStack().undo();
  EXPECT_EQ(*document.design(), before);
}

}  // namespace
}  // namespace bw::pipeline
