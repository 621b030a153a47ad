// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>

#include "bw/core/files/file_set.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

namespace fs = std::filesystem;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

fs::path scratch(const std::string& name) {
  const fs::path folder = fs::path(BW_TEST_OUTPUT) / "geometry";
  fs::create_directories(folder);
  return folder / name;
}

TEST(BadFile, MissingFileIsNamed) {
  expectError(CadModel::read("/nowhere/panel.step"), ErrorCode::cannotRead, "/nowhere/panel.step");
}

TEST(BadFile, FolderIsNotAFile) {
  const fs::path folder = scratch("folder.step");
  fs::create_directories(folder);
  expectError(CadModel::read(folder), ErrorCode::cannotRead, "folder.step");
}

TEST(BadFile, EmptyFileSaysSo) {
  for (const char* bytes : {"", " \n\n"}) {
    expectError(CadModel::readBytes(bytes, "empty.step"), ErrorCode::cannotRead, "empty");
  }
}

TEST(BadFile, EveryTruncationOfAStepFileIsAnError) {
  const std::string step = exampleStep("saddle").value();
  for (std::size_t length = 1; length + 20 < step.size(); length += 97) {
    const auto model = CadModel::readBytes(step.substr(0, length), "cut.step");
    ASSERT_FALSE(model) << length;
    EXPECT_EQ(model.error().code, ErrorCode::cannotRead);
  }
  expectError(CadModel::readBytes(step.substr(0, step.size() / 2), "cut.step"), ErrorCode::cannotRead,
              "cut short");
}

TEST(BadFile, StepWithoutItsGeometryHoldsNoFaces) {
  const std::string step =
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
      "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.,0.));\nENDSEC;\nEND-"
      "ISO-10303-21;\n";
  expectError(CadModel::readBytes(step, "points.step"), ErrorCode::badInput, "no faces");
}

TEST(BadFile, GarbageWithAnySuffixIsRefused) {
  std::mt19937_64 engine(7);
  std::string bytes;
  for (int i = 0; i < 20000; ++i) bytes += char(engine() & 255u);
  for (const char* name : {"noise.step", "noise.iges", "noise.igs", "noise.brep", "noise.stl", "noise"}) {
    expectError(CadModel::readBytes(bytes, name), ErrorCode::cannotRead, "noise");
  }
}

TEST(BadFile, DamagedStepNeverCrashes) {
  const std::string step = exampleStep("saddle").value();
  std::mt19937_64 engine(11);
  for (int round = 0; round < 200; ++round) {
    std::string damaged = step;
    for (int k = 0; k < 3; ++k)
      damaged[std::size_t(engine() % (damaged.size() - 40))] = char('!' + engine() % 90);
    const auto model = CadModel::readBytes(damaged, "damaged.step");
    if (!model) {
      EXPECT_FALSE(model.error().message.empty());
      continue;
    }
    EXPECT_TRUE(model->info().bounds.min.allFinite() && model->info().bounds.max.allFinite());
  }
}

TEST(BadFile, StepEntitiesOfOneNumberAreRefused) {
  std::string step = exampleStep("saddle").value();
  const std::size_t at = step.find("#7=");
  ASSERT_NE(at, std::string::npos);
  step.replace(at, 3, "#6=");
  expectError(CadModel::readBytes(step, "twice.step"), ErrorCode::cannotRead, "#6 is there twice");
  step.replace(at, 3, "#0=");
  expectError(CadModel::readBytes(step, "zero.step"), ErrorCode::cannotRead, "\"#0\"");
  step.replace(at, 3, "#12345678901=");
  expectError(CadModel::readBytes(step, "huge.step"), ErrorCode::cannotRead, "#12345678901");
}

TEST(BadFile, NumberSignsInTextsAndCommentsAreNoEntities) {
  std::string step = exampleStep("saddle").value();
  const std::size_t at = step.find("DATA;") + 5;
  step.insert(at, "\n/* #1=, '#' */");
  const std::size_t name = step.find("FILE_DESCRIPTION((''");
  ASSERT_NE(name, std::string::npos);
  step.insert(name + 19, "it''s #1=");
  EXPECT_TRUE(CadModel::readBytes(step, "remarks.step"));
}

TEST(BadFile, BrepThatStopsEarlyIsRefused) {
  expectError(
      CadModel::readBytes(
          "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 4\n",
          "cut.brep"),
      ErrorCode::cannotRead, "Curves");
  expectError(CadModel::readBytes("CASCADE Topology V1\nLocations 99999999\n", "big.brep"),
              ErrorCode::cannotRead, "99999999");
}

TEST(BadFile, IgesWithoutItsEndIsRefused) {
  std::string iges(72, ' ');
  iges += "S0000001\n" + std::string(72, ' ') + "G0000001\n";
  expectError(CadModel::readBytes(iges, "cut.iges"), ErrorCode::cannotRead, "cut short");
}

TEST(BadChoice, FaceOutOfRangeTellsTheRange) {
  const CadModel model = modelOf(exampleStep("saddle").value());
  for (const int index : {-1, 1, 100}) {
    FaceChoice choice{FaceChoice::Kind::indices, {index}};
    const auto chosen = model.choose(choice);
    expectError(chosen, ErrorCode::badInput, "face " + std::to_string(index));
    EXPECT_NE(chosen.error().message.find("one face, of index 0"), std::string::npos)
        << chosen.error().message;
    EXPECT_FALSE(Target::make(model, choice));
  }
  expectError(model.choose({FaceChoice::Kind::indices, {}}), ErrorCode::badInput, "no face");
}

TEST(BadChoice, RepeatedIndexCountsOnce) {
  const auto chosen = modelOf(exampleStep("saddle").value()).choose({FaceChoice::Kind::indices, {0, 0}});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(*chosen, std::vector<int>{0});
}

TEST(BadChoice, FaceThinnerThanTheToleranceIsRefused) {
  const auto sliver = [](double u, double v) { return Eigen::Vector3d(0.004 * u, 200 * v, 0); };
  const CadModel model = modelOf(stepOf(sliver, 4, 4));
  for (const auto kind : {FaceChoice::Kind::largest, FaceChoice::Kind::all, FaceChoice::Kind::indices}) {
    expectError(model.choose({kind, {0}}), ErrorCode::badInput, "tolerance of 0.01 mm");
  }
}

TEST(BadSetup, ZeroOrInfiniteDirectionIsRefused) {
  const Target target = exampleTarget("saddle");
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, kNaN, 0), Eigen::Vector3d(1e300, 1e300, 0)}) {
    CutSettings settings;
    settings.direction = d;
    Findings findings;
    expectError(resolveSetup(target, settings, findings), ErrorCode::badInput, "direction");
    auto setup = resolveSetup(target, CutSettings{}, findings).value();
    setup.planes = PlaneFamily::across(setup.block, d);
    expectError(cutSections(target, setup, settings, {}, findings), ErrorCode::badInput, "direction");
  }
}

TEST(BadSetup, BlockThatMissesTheTargetTellsByHowMuch) {
  const Target target = exampleTarget("saddle");
  CutSettings settings;
  settings.block = BlockPlacement{{1300, 0, 0}, {100, 100, 100}, {0, 0, 0}};
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  expectError(setup, ErrorCode::badInput, "misses the target by 1000 mm");
  EXPECT_EQ(setup.error().where, "block");
}

TEST(BadSetup, BlockBesideTheSurfaceHasNoSections) {
  // Within the bounds of the saddle, but below it.
  const Target target = exampleTarget("saddle");
  CutSettings settings;
  settings.block = BlockPlacement{{-50, -50, -120}, {100, 100, 50}, {0, 0, 0}};
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  ASSERT_TRUE(setup) << setup.error().message;
  expectError(cutSections(target, *setup, settings, {}, findings), ErrorCode::badInput, "block");
}

TEST(BadSetup, BlockWithoutSizeIsRefused) {
  const Target target = exampleTarget("saddle");
  Findings findings;
  for (const Eigen::Vector3d& size :
       {Eigen::Vector3d(0, 100, 100), Eigen::Vector3d(100, -1, 100), Eigen::Vector3d(100, kNaN, 100)}) {
    CutSettings settings;
    settings.block = BlockPlacement{{0, 0, 0}, size, {0, 0, 0}};
    expectError(resolveSetup(target, settings, findings), ErrorCode::badInput, "block");
  }
}

TEST(BadSetup, DirectionAcrossAPlaneHasNoSections) {
  const Target target =
      targetOf(stepOf([](double u, double v) { return Eigen::Vector3d(500 * u, 400 * v, 0); }, 4, 4));
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitZ();
  Findings findings;
  const auto setup = resolveSetup(target, settings, findings);
  ASSERT_TRUE(setup);
  expectError(cutSections(target, *setup, settings, {}, findings), ErrorCode::badInput, "direction");
}

TEST(BadSetup, StationsOutOfRangeAreRefused) {
  const Target target = exampleTarget("saddle");
  Findings findings;
  auto setup = resolveSetup(target, CutSettings{}, findings).value();
  for (const int stations : {-3, 0, 1, SectionRequest::kMost + 1}) {
    CutSettings settings;
    settings.stations = stations;
    expectError(cutSections(target, setup, settings, {}, findings), ErrorCode::badInput,
                std::to_string(stations));
  }
  for (const double spacing : {0.0, -1.0, kNaN, 1e-4}) {
    CutSettings settings;
    settings.spacing = spacing;
    expectError(cutSections(target, setup, settings, {}, findings), ErrorCode::badInput, "spacing");
  }
}

TEST(BadSetup, SectionsStopOnRequest) {
  const Target target = exampleTarget("saddle");
  Findings findings;
  auto setup = resolveSetup(target, CutSettings{}, findings).value();
  std::stop_source source;
  source.request_stop();
  const auto sections = cutSections(target, setup, CutSettings{}, RunContext{source.get_token()}, findings);
  ASSERT_FALSE(sections);
  EXPECT_EQ(sections.error().code, ErrorCode::cancelled);
}

TEST(BadQuery, PointThatIsNotFiniteIsRefused) {
  const auto sampler = exampleTarget("saddle").sampler();
  expectError(sampler->closest({0, kNaN, 0}, nullptr), ErrorCode::badInput, "not finite");
}

TEST(BadQuery, WrongSeedDoesNoHarm) {
  const Target target = exampleTarget("saddle");
  const auto sampler = target.sampler();
  SurfaceSampler::Foot seed;
  for (const int face : {-1, 7, 0}) {
    seed.face = face;
    seed.uv = {face == 0 ? kNaN : 0.3, -1e9};
    const auto foot = sampler->closest({10, 20, 30}, &seed);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->distance, sampler->closest({10, 20, 30}, nullptr)->distance, 1e-9);
  }
}

}  // namespace
}  // namespace bw::geometry::test
