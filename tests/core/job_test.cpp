// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/job.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"

namespace bw {

namespace {

std::string messageOf(const char* text) {
  const Result<Job> job = parseJob(text);
  return job ? "accepted" : job.error().message;
}

}  // namespace

TEST(Job, EveryKeyIsOptional) {
  const Result<Job> job = parseJob("{}");
  ASSERT_TRUE(job) << job.error().message;
  EXPECT_EQ(job->stations, 60);
  EXPECT_EQ(job->blade.name, "steel-tube-3-2.5");
  EXPECT_FALSE(job->block);
  EXPECT_FALSE(job->direction);
}

TEST(Job, ReadsEveryKeyOfTheContract) {
  int threads = 0;
  const Result<Job> job = parseJob(R"({
    "face": [3, 1], "block": {"origin": [1, 2, 3], "size": [600, 670, 300], "rotation_deg": [0, 0, 90]},
    "direction": [0, 3, 4], "planes": {"type": "parallel"}, "stations": {"spacing": 5}, "lead": 30,
    "blade": {"preset": "nicr-flat-5x1", "length": 1000}, "fit": {"length": "exact", "endpoints": true, "tangents": true, "max_periods": 2},
    "tolerance": 1.5, "cutting_speed": 12, "clearance": 40, "programs": ["csv", "rapid"], "cell": "irb1600-pair", "threads": 2})",
                                   &threads);
  ASSERT_TRUE(job) << job.error().message;
  EXPECT_EQ(threads, 2);
  EXPECT_EQ(jobToJson(*job).find("threads"), std::string::npos) << "a machine is no part of a job";
  EXPECT_EQ(job->face.indices, (std::vector<int>{1, 3}));
  EXPECT_NEAR(job->block->rotation.z(), kPi / 2, 1e-15);
  EXPECT_LT((*job->direction - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(job->spacing, 5.0);
  EXPECT_EQ(job->blade.section, Blade::Section::flat);
  EXPECT_EQ(job->blade.length, 1000);
  EXPECT_EQ(job->fitLength, FitOptions::Length::exact);
  EXPECT_EQ(job->programs, (std::vector<std::string>{"csv", "rapid"}));
}

TEST(Job, WritesWhatItReads) {
  for (
      const char* text :
      {"{}",
       R"({"face": "all", "block": {"origin": [0.1, 0.2, 0.3], "size": [400, 300.7, 200]}, "stations": {"spacing": 0.7}, "direction": "x"})",
       R"({"blade": "steel-rod-1", "face": 4, "programs": []})",
       R"({"unit": "cm", "sewing": 0.02, "near": [1, 2, 3]})", R"({"face": ["a", "b"]})",
       R"({"face": {"group": 3}})", R"({"sections": "kernel"})"}) {
    const Result<Job> job = parseJob(text);
    ASSERT_TRUE(job) << job.error().message;
    const std::string once = jobToJson(*job);
    const Result<Job> again = parseJob(once);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(jobToJson(*again), once);
  }
}

TEST(Job, ReadsUnitSewingAndTheWaysToChooseFaces) {
  const Result<Job> job = parseJob(R"({"unit": "in", "sewing": 0.3, "near": [1, -2.5, 3]})");
  ASSERT_TRUE(job) << job.error().message;
  EXPECT_EQ(job->unit, LengthUnit::inch);
  EXPECT_EQ(job->sewingTolerance(), 0.3);
  EXPECT_EQ(job->face.kind, FaceChoice::Kind::nearest);
  EXPECT_EQ(job->face.point, Eigen::Vector3d(1, -2.5, 3));
  const auto face = [](const std::string& text) { return parseJob("{\"face\": " + text + "}").value().face; };
  EXPECT_EQ(face("\"Roof\"").names, std::vector<std::string>{"Roof"});
  EXPECT_EQ(face(R"(["Roof", "Wall"])").names.size(), 2u);
  EXPECT_EQ(face(R"({"group": 2})").kind, FaceChoice::Kind::group);
  EXPECT_EQ(face(R"({"group": 2})").group, 2);
  EXPECT_EQ(face("\"largest\"").kind, FaceChoice::Kind::largest);
}

TEST(Job, SewsWithinATenthOfTheToleranceButAtMostATenthOfAMillimetre) {
  EXPECT_EQ(parseJob("{}").value().sewingTolerance(), 0.1);
  EXPECT_EQ(parseJob(R"({"tolerance": 0.5})").value().sewingTolerance(), 0.05);
  EXPECT_EQ(parseJob(R"({"tolerance": 0.5, "sewing": 0})").value().sewingTolerance(), 0);
  EXPECT_FALSE(parseJob("{}").value().unit);
}

TEST(Job, ReadsByWhichRouteSectionsAreFound) {
  EXPECT_EQ(parseJob("{}").value().sections, SectionRoute::automatic);
  EXPECT_EQ(parseJob(R"({"sections": "auto"})").value().sections, SectionRoute::automatic);
  EXPECT_EQ(parseJob(R"({"sections": "kernel"})").value().sections, SectionRoute::kernel);
  EXPECT_EQ(parseJob(R"({"sections": "traced"})").value().sections, SectionRoute::traced);
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
  const Result<Job> job = parseJob(R"({"stations": 5, "blade": {"length": 900}, "stations": 6})");
  ASSERT_FALSE(job);
  EXPECT_NE(job.error().message.find("\"stations\" twice"), std::string::npos) << job.error().message;
  EXPECT_TRUE(parseJob(R"({"blade": {"length": 900}, "stations": {"spacing": 5}})"))
      << "one key in two objects";
}

TEST(Job, MissingPresetsAreToldAndNotReplacedByOtherNumbers) {
  const std::string before = std::getenv("BLADEWRIGHT_RESOURCES") ? std::getenv("BLADEWRIGHT_RESOURCES") : "";
  const std::string whole = jobToJson(*parseJob("{}"));
  ::setenv("BLADEWRIGHT_RESOURCES", BW_TEST_DATA, 1);
  const Result<Job> job = parseJob("{}");
  const Result<Job> stored = parseJob(whole);
  if (before.empty())
    ::unsetenv("BLADEWRIGHT_RESOURCES");
  else
    ::setenv("BLADEWRIGHT_RESOURCES", before.c_str(), 1);
  ASSERT_FALSE(job);
  EXPECT_NE(job.error().message.find("no blade presets"), std::string::npos) << job.error().message;
  ASSERT_TRUE(stored) << "a job that is written whole needs none: " << stored.error().message;
  EXPECT_EQ(jobToJson(*stored), whole);
}

TEST(Design, RoundTripsWithAnEmbeddedSource) {
  Design design;
  design.name = "Panel \"A\"";
  design.source.path = "panel.step";
  for (int length = 0; length < 6; ++length) {
    design.source.bytes = std::string("\x00\xff\x10zyx", 6).substr(0, std::size_t(length));
    const std::string text = designToJson(design);
    const Result<Design> read = parseDesign(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->source, design.source);
    EXPECT_EQ(read->name, design.name);
    EXPECT_EQ(designToJson(*read), text);
  }
}

TEST(Design, RefusesNewerVersionsAndOtherFiles) {
  const Result<Design> newer = parseDesign(R"({"bladewright_design": 99})");
  ASSERT_FALSE(newer);
  EXPECT_NE(newer.error().message.find("newer Bladewright"), std::string::npos);
  EXPECT_FALSE(parseDesign("{}"));
  EXPECT_FALSE(parseDesign(R"({"bladewright_design": 1, "source": {"base64": "a"}})"));
  EXPECT_FALSE(parseDesign(R"({"bladewright_design": 1, "jop": {}})"));
}

}  // namespace bw
