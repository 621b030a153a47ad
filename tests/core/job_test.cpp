// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"
#include "bw/core/design/variables.h"

namespace bw {

namespace {

std::string messageOf(const char* text) {
  const Result<Design> design = parseJob(text);
  return design ? "accepted" : design.error().message;
}

}  // namespace

TEST(Job, EveryKeyIsOptional) {
  const Result<Design> design = parseJob("{}");
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_TRUE(design->cut().sections.byTolerance());
  EXPECT_EQ(design->blade.name, "steel-tube-3-2.5");
  EXPECT_FALSE(design->block().placement);
  EXPECT_FALSE(design->cut().direction);
}

TEST(Job, ReadsEveryKeyOfTheContract) {
  int threads = 0;
  const Result<Design> design = parseJob(R"({
    "face": [3, 1], "block": {"origin": [1, 2, 3], "size": [600, 670, 300], "rotation_deg": [0, 0, 90]},
    "direction": [0, 3, 4], "planes": {"type": "parallel"}, "stations": {"spacing": 5}, "lead": 30,
    "blade": {"preset": "nicr-flat-5x1", "length": 1000}, "fit": {"length": "exact", "endpoints": true, "tangents": true, "max_periods": 2},
    "tolerance": 1.5, "cutting_speed": 12, "clearance": 40, "programs": ["csv", "rapid"], "cell": "irb1600-pair", "threads": 2})",
                                         &threads);
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(threads, 2);
  EXPECT_EQ(designToJson(*design).find("threads"), std::string::npos) << "a machine is no part of a job";
  EXPECT_EQ(design->cut().face.indices, (std::vector<int>{1, 3}));
  EXPECT_NEAR(design->block().placement->rotation.z(), kPi / 2, 1e-15);
  EXPECT_LT((*design->cut().direction - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(design->cut().sections.spacing, 5.0);
  EXPECT_EQ(design->blade.section, Blade::Section::flat);
  EXPECT_EQ(design->blade.length, 1000);
  EXPECT_EQ(design->process.fitLength, FitOptions::Length::exact);
  EXPECT_EQ(design->output.programs, (std::vector<std::string>{"csv", "rapid"}));
}

TEST(Job, WritesWhatItReads) {
  for (
      const char* text :
      {"{}",
       R"({"face": "all", "block": {"origin": [0.1, 0.2, 0.3], "size": [400, 300.7, 200]}, "stations": {"spacing": 0.7}, "direction": "x"})",
       R"({"stations": "auto"})", R"({"stations": 60})",
       R"({"blade": "steel-rod-1", "face": 4, "programs": []})",
       R"({"unit": "cm", "sewing": 0.02, "near": [1, 2, 3]})", R"({"face": ["a", "b"]})",
       R"({"face": {"group": 3}})", R"({"sections": "kernel"})"}) {
    const Result<Design> design = parseJob(text);
    ASSERT_TRUE(design) << design.error().message;
    const std::string once = designToJson(*design);
    int version = 0;
    const Result<Design> again = parseDesign(once, &version);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(version, Design::kVersion);
    EXPECT_EQ(designToJson(*again), once);
  }
}

TEST(Job, ReadsUnitSewingAndTheWaysToChooseFaces) {
  const Result<Design> design = parseJob(R"({"unit": "in", "sewing": 0.3, "near": [1, -2.5, 3]})");
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(design->source().unit, LengthUnit::inch);
  EXPECT_EQ(design->readOptions(design->source()).sewing, 0.3);
  EXPECT_EQ(design->cut().face.kind, FaceChoice::Kind::nearest);
  EXPECT_EQ(design->cut().face.point, Eigen::Vector3d(1, -2.5, 3));
  const auto face = [](const std::string& text) {
    return parseJob("{\"face\": " + text + "}").value().cut().face;
  };
  EXPECT_EQ(face("\"Roof\"").names, std::vector<std::string>{"Roof"});
  EXPECT_EQ(face(R"(["Roof", "Wall"])").names.size(), 2u);
  EXPECT_EQ(face(R"({"group": 2})").kind, FaceChoice::Kind::group);
  EXPECT_EQ(face(R"({"group": 2})").group, 2);
  EXPECT_EQ(face("\"largest\"").kind, FaceChoice::Kind::largest);
}

TEST(Job, SewsWithinATenthOfTheToleranceButAtMostATenthOfAMillimetre) {
  const auto options = [](const char* text) {
    const Design design = parseJob(text).value();
    return design.readOptions(design.source());
  };
  EXPECT_EQ(options("{}").sewing, 0.1);
  EXPECT_EQ(options(R"({"tolerance": 0.5})").sewing, 0.05);
  EXPECT_EQ(options(R"({"tolerance": 0.5, "sewing": 0})").sewing, 0);
  EXPECT_FALSE(options("{}").unit);
}

TEST(Job, ReadsByWhichRouteSectionsAreFound) {
  EXPECT_EQ(parseJob("{}").value().cut().sections.route, SectionRoute::automatic);
  EXPECT_EQ(parseJob(R"({"sections": "auto"})").value().cut().sections.route, SectionRoute::automatic);
  EXPECT_EQ(parseJob(R"({"sections": "kernel"})").value().cut().sections.route, SectionRoute::kernel);
  EXPECT_EQ(parseJob(R"({"sections": "traced"})").value().cut().sections.route, SectionRoute::traced);
  EXPECT_NE(messageOf(R"({"sections": "occt"})").find("kernel"), std::string::npos);
}

TEST(Job, FacesAreChosenOnceAndInOneWay) {
  EXPECT_NE(messageOf(R"({"face": 3, "near": [0, 0, 0]})").find("by face and by near"), std::string::npos);
  EXPECT_NE(messageOf(R"({"near": [0, 0]})").find("near"), std::string::npos);
  EXPECT_NE(messageOf(R"({"face": [1, "Roof"]})").find("a list of names"), std::string::npos);
  EXPECT_NE(messageOf(R"({"face": {"gruop": 1}})").find("did you mean \"group\"?"), std::string::npos);
  EXPECT_NE(messageOf(R"({"face": {"group": -1}})").find("group"), std::string::npos);
  EXPECT_NE(messageOf(R"({"unit": "inch"})").find("\"in\""), std::string::npos);
  EXPECT_NE(messageOf(R"({"sewing": -1})").find("-1"), std::string::npos);
}

TEST(Job, TellsWhatHoldsTheGripsAndTheFloor) {
  const Result<Design> design = parseJob(R"({"fit": {"extend": "surface"}, "floor": 35})");
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(design->process.extend, Extension::surface);
  EXPECT_EQ(design->process.floor, 35);
  EXPECT_EQ(parseDesign(designToJson(*design))->process, design->process);
  EXPECT_EQ(designToJson(Design()).find("extend"), std::string::npos);
  EXPECT_NE(messageOf(R"({"fit": {"extend": "tangent"}})").find("curvature"), std::string::npos);
  EXPECT_NE(messageOf(R"({"floor": -1})").find("-1"), std::string::npos);
}

TEST(Job, NamesTheNearestKeyOfATypo) {
  EXPECT_NE(messageOf(R"({"sations": 60})").find("did you mean \"stations\"?"), std::string::npos);
  EXPECT_NE(messageOf(R"({"fit": {"lenght": "free"}})").find("did you mean \"length\"?"), std::string::npos);
  EXPECT_NE(messageOf(R"({"blade": "steel-tube-3-25"})").find("did you mean \"steel-tube-3-2.5\"?"),
            std::string::npos);
  EXPECT_NE(messageOf(R"({"programs": ["rapide"]})").find("did you mean \"rapid\"?"), std::string::npos);
  EXPECT_NE(messageOf(R"({"block": {"orign": [0,0,0]}})").find("did you mean \"origin\"?"),
            std::string::npos);
}

TEST(Job, TellsTheNumberAndTheLimit) {
  EXPECT_NE(messageOf(R"({"stations": 1})").find("from 2 to 20000"), std::string::npos);
  EXPECT_NE(messageOf(R"({"stations": 2.5})").find("2.5"), std::string::npos);
  EXPECT_NE(messageOf(R"({"stations": "many"})").find("\"auto\", a number from 2"), std::string::npos);
  EXPECT_NE(messageOf(R"({"tolerance": -1})").find("-1"), std::string::npos);
  EXPECT_NE(messageOf(R"({"direction": [0,0,0]})").find("length zero"), std::string::npos);
  EXPECT_NE(messageOf(R"({"lead": "long"})").find("must be a number"), std::string::npos);
  EXPECT_NE(messageOf(R"({"face": -1})").find("index from 0"), std::string::npos);
  EXPECT_NE(messageOf("{\n \"lead\": 1,,\n}").find("line 2"), std::string::npos);
  EXPECT_NE(messageOf("").find("empty"), std::string::npos);
  EXPECT_NE(messageOf("[]").find("must be a JSON object"), std::string::npos);
}

TEST(Blade, PresetsHaveTheRadiiOfTheirSections) {
  const Result<std::vector<Blade>> presets = bladePresets();
  ASSERT_TRUE(presets) << presets.error().message;
  ASSERT_EQ(presets->size(), 3u);
  for (const Blade& blade : *presets) {
    // At the smallest radius the outermost fibre carries the yield stress over the safety.
    EXPECT_NEAR(blade.stress(blade.maxCurvature()), blade.yieldStress / blade.safety,
                1e-9 * blade.yieldStress);
    EXPECT_GT(blade.flexuralRigidity(), 0);
  }
  const Result<Blade> tube = bladePreset("steel-tube-3-2.5");
  ASSERT_TRUE(tube);
  EXPECT_NEAR(tube->secondMoment(), kPi / 64 * (81 - 39.0625), 1e-9);
}

TEST(Job, AKeyThatStandsTwiceIsASlip) {
  const Result<Design> job = parseJob(R"({"stations": 5, "blade": {"length": 900}, "stations": 6})");
  ASSERT_FALSE(job);
  EXPECT_NE(job.error().message.find("\"stations\" twice"), std::string::npos) << job.error().message;
  EXPECT_TRUE(parseJob(R"({"blade": {"length": 900}, "stations": {"spacing": 5}})"))
      << "one key in two objects";
}

TEST(Job, MissingPresetsAreToldAndNotReplacedByOtherNumbers) {
  const std::string before = std::getenv("BLADEWRIGHT_RESOURCES") ? std::getenv("BLADEWRIGHT_RESOURCES") : "";
  const std::string whole = designToJson(*parseJob("{}"));
  ::setenv("BLADEWRIGHT_RESOURCES", BW_TEST_DATA, 1);
  const Result<Design> job = parseJob("{}");
  const Result<Design> stored = parseDesign(whole);
  if (before.empty())
    ::unsetenv("BLADEWRIGHT_RESOURCES");
  else
    ::setenv("BLADEWRIGHT_RESOURCES", before.c_str(), 1);
  ASSERT_FALSE(job);
  EXPECT_NE(job.error().message.find("no blade presets"), std::string::npos) << job.error().message;
  ASSERT_TRUE(stored) << "a design that is written whole needs none: " << stored.error().message;
  EXPECT_EQ(designToJson(*stored), whole);
}

TEST(Job, NoFileHasMinusZeros) {
  Design design = *parseJob("{}");
  design.stock.front().placement = BlockPlacement{{-0.0, 5, -0.0}, {600, 800, 500}, {-0.0, 0.5, -0.0}};
  design.cuts.front().direction = Eigen::Vector3d(-0.0, 1, -0.0);
  DesignedSurface surface;
  surface.shape =
      BladesSurface{{{-0.0, {-0.0, 1}, -0.0, 600, -0.0, {-0.0, -0.0}}, {800, {0, 1}, 0, 600, 0, {0, 0}}}};
  design.sources.front().surface = surface;
  const std::string text = designToJson(design);
  EXPECT_EQ(text.find("-0.0"), std::string::npos) << text;
  EXPECT_EQ(parseDesign(text)->stock, design.stock) << "it means the same";
}

TEST(Design, RoundTripsWithAnEmbeddedSource) {
  Design design;
  design.name = "Panel \"A\"";
  design.source().path = "panel.step";
  for (int length = 0; length < 6; ++length) {
    design.source().bytes = std::string("\x00\xff\x10zyx", 6).substr(0, std::size_t(length));
    const std::string text = designToJson(design);
    const Result<Design> read = parseDesign(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->source(), design.source());
    EXPECT_EQ(read->name, design.name);
    EXPECT_EQ(designToJson(*read), text);
  }
}

TEST(Design, KeepsTheWayUpAsItIsTold) {
  Design design;
  design.process.up = Eigen::Vector3d(0, 0.5, 2);  // only its direction counts
  const Result<Design> read = parseDesign(designToJson(design));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->process.up, design.process.up);
  design.process.up.reset();  // that of each block
  EXPECT_FALSE(parseDesign(designToJson(design))->process.up);
  EXPECT_FALSE(parseJob("{}")->process.up);
  EXPECT_FALSE(parseJob(R"({"up": "block"})")->process.up);
  EXPECT_EQ(parseJob(R"({"up": [0, 0, 1]})")->process.up, Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(parseJob(R"({"up": "top"})"));
}

TEST(Job, TakesBothGripErrorsAtOnce) {
  const Result<Design> job = parseJob(R"({"grip_error": {"mm": 0.3, "deg": 0.1}})");
  ASSERT_TRUE(job) << job.error().message;
  EXPECT_EQ(job->process.gripError, 0.3);
  EXPECT_EQ(job->process.gripAngle, 0.1);
  EXPECT_EQ(parseJob(R"({"grip_error": {"deg": 0.1}})")->process.gripError, Process().gripError);
  EXPECT_FALSE(parseJob(R"({"grip_error": {"rad": 0.1}})"));
  EXPECT_FALSE(parseJob(R"({"grip_error": {"mm": -1}})"));
  EXPECT_FALSE(parseJob(R"({"grip_error": [0.3, 0.1]})"));
  const Result<Design> twice = parseJob(R"({"grip_error": {"deg": 0.1}, "grip_angle_error": 0.2})");
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find("tell it once"), std::string::npos) << twice.error().message;
}

TEST(Design, KeepsExpressionsOfGripErrorsToldAtOnce) {
  const Result<Design> design = parseDesign(R"({"bladewright_design": 2,
    "variables": [{"name": "play", "value": 0.4, "min": 0, "max": 2}],
    "sources": [{"surface": {"type": "formula", "formula": "100"}}],
    "process": {"grip_error": {"mm": "=play", "deg": "=play/2"}}})");
  ASSERT_TRUE(design) << design.error().message;
  EXPECT_EQ(design->process.gripError, 0.4);
  EXPECT_EQ(design->process.gripAngle, 0.2);
  const Result<Design> changed = withVariables(*parseDesign(designToJson(*design)), {{"play", 1.2}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(changed->process.gripError, 1.2);
  EXPECT_EQ(changed->process.gripAngle, 0.6);
}

TEST(Design, RefusesNewerVersionsAndOtherFiles) {
  const Result<Design> newer = parseDesign(R"({"bladewright_design": 99})");
  ASSERT_FALSE(newer);
  EXPECT_NE(newer.error().message.find("newer Bladewright"), std::string::npos);
  EXPECT_FALSE(parseDesign("{}"));
  EXPECT_FALSE(parseDesign(R"({"bladewright_design": 1, "source": {"base64": "a"}})"));
  EXPECT_FALSE(parseDesign(R"({"bladewright_design": 1, "jop": {}})"));
}

TEST(Design, ReadsTheFirstVersionAndTellsIt) {
  int version = 0;
  const Result<Design> old = parseDesign(
      R"({"bladewright_design": 1, "name": "Panel", "source": {"path": "a.step"},
          "job": {"unit": "cm", "stations": 7, "direction": "x", "tolerance": 0.5, "cell": "c", "threads": 3}})",
      &version);
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ(version, 1);
  Design expected =
      *parseJob(R"({"unit": "cm", "stations": 7, "direction": "x", "tolerance": 0.5, "cell": "c"})");
  expected.name = "Panel";
  expected.source().path = "a.step";
  EXPECT_EQ(*old, expected);
  EXPECT_EQ(*parseDesign(designToJson(*old)), expected);
}

TEST(Design, PartsNameEachOther) {
  const auto told = [](const char* text, const char* what) {
    const Result<Design> design = parseDesign(text);
    ASSERT_FALSE(design) << text;
    EXPECT_NE(design.error().message.find(what), std::string::npos) << design.error().message;
  };
  const Result<Design> named = parseDesign(
      R"({"bladewright_design": 2, "sources": [{"id": "roof", "path": "a.step"}], "stock": [{"id": "B"}],
          "cuts": [{"id": "top", "source": "roof", "block": "B", "stations": 9}], "process": {"lead": 3}})");
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_EQ(named->cut().id, "top");
  EXPECT_EQ(named->cut().sections.stations, 9);
  EXPECT_EQ(named->process.lead, 3);
  told(R"({"bladewright_design": 2, "cuts": [{"block": "block-2"}]})", "names \"block-2\"");
  told(R"({"bladewright_design": 2, "cuts": [{"source": "wall"}]})", "names \"wall\"");
  told(R"({"bladewright_design": 2, "sources": [{}, {"path": "a.step"}]})", "sources[1] is a CAD file");
  told(
      R"({"bladewright_design": 2, "sources": [{}, {"id": "b", "surface": {"type": "formula", "formula": "1"}}],
           "cuts": [{"source": "c"}]})",
      "names \"c\", but the design has 2 other sources");
  told(R"({"bladewright_design": 2, "cuts": []})", "must be a list of 1 to 10000 entries, not of 0");
  told(R"({"bladewright_design": 2, "stock": {}})", "must be a list of 1 to 2500 entries");
  told(R"({"bladewright_design": 2, "stock": [{"id": ""}], "cuts": [{"block": ""}]})", "is empty");
  told(R"({"bladewright_design": 2, "cuts": [{"sations": 4}]})", "did you mean \"stations\"?");
  told(R"({"bladewright_design": 2, "job": {}})", "job");
}

}  // namespace bw
