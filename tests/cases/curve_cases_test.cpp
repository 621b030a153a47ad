// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Curves and chains: biarcs, pieces, splines, polylines, relaxed curves; and the lengths of blades.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bw/cases/cases.h"
#include "bw/core/calibration/blade_length.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;

TEST(BiarcCases, AnswersArcsAndAllMeasures) {
  std::vector<std::string> pictures;
  const Result<CaseAnswer> answer = biarcCases(
      R"({"cases": [{"points": [[1,0],[0,2],[1,4],[2,6],[3,5],[4,4],[5.5,3]], "points_kept": [0,3,6], "distance": "max"},
      {"points": [[0,0],[1,0],[2,0]], "arcs": 2}, {"points": [[0,0],[1,0]], "arcs": 3}, {"points": [[0,0],[1,0]]}]})",
      {}, &pictures);
  ASSERT_TRUE(answer) << answer.error().message;
  const json results = json::parse(answer->json)["results"];
  ASSERT_EQ(results.size(), 4u);
  for (const char* key : {"start", "radius", "angle", "length", "start_angle"})
    EXPECT_TRUE(results[0]["arcs"][0].contains(key)) << key;
  const json& arc = results[0]["arcs"][0];
  EXPECT_NEAR(arc["radius"].get<double>() * arc["angle"].get<double>(), arc["length"].get<double>(), 1e-12);
  for (const char* key : {"mean", "rms", "max"}) EXPECT_TRUE(results[0]["distance"].contains(key));
  for (const char* key : {"energy", "angle"}) EXPECT_TRUE(results[0]["curvature"].contains(key));
  EXPECT_TRUE(results[1]["arcs"][0]["radius"].is_null());
  EXPECT_EQ(results[1]["arcs"][0]["angle"], 0);
  EXPECT_NE(results[2]["error"]["message"].get<std::string>().find("even"), std::string::npos);
  EXPECT_EQ(results[3]["error"]["code"], "bad-input");
  ASSERT_EQ(pictures.size(), 4u);
  EXPECT_EQ(pictures[0].substr(0, 4), "<svg");
  EXPECT_TRUE(pictures[2].empty());
}

TEST(BiarcCases, DoNotDependOnTheNumberOfThreads) {
  json cases = json::array();
  for (int i = 0; i < 8; ++i) {
    json points = json::array();
    for (int j = 0; j <= 40; ++j) points.push_back({j, 5 * std::sin(0.1 * j * (1 + 0.1 * i))});
    cases.push_back({{"points", points}, {"tolerance", 0.1}});
  }
  std::vector<std::string> outputs;
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    json parsed = json::parse(biarcCases(json{{"cases", cases}}.dump(), context)->json);
    for (json& result : parsed["results"]) result.erase("seconds");
    outputs.push_back(parsed.dump());
  }
  EXPECT_EQ(outputs[0], outputs[1]);
}

TEST(PiecewiseCases, AreTheSameForAnyNumberOfThreads) {
  std::string text = R"({"cases": [)";
  for (int i = 0; i < 8; ++i)
    text += (i ? "," : "") + std::string(R"({"curve": {"type": "bezier", "poles": [[0,0],[150,260],[300,)") +
            std::to_string(40 * i - 310) + R"(],[450,270],[600,0]]}, "splits": ")" +
            (i % 2 ? "optimised" : "uniform") + R"(", "pieces": 3})";
  text += "]}";
  std::vector<std::string> outputs;
  for (const int threads : {1, 4}) {
    RunContext context;
    context.threads = threads;
    json parsed = json::parse(piecewiseCases(text, context)->json);
    for (json& result : parsed["results"]) result.erase("seconds");
    outputs.push_back(parsed.dump());
  }
  EXPECT_EQ(outputs[0], outputs[1]);
}

TEST(PiecewiseCases, AnswersWithPiecesAndJoints) {
  const std::string curve =
      R"("curve": {"type": "bezier", "poles": [[0,0],[150,260],[300,-310],[450,270],[600,0]]})";
  const CaseAnswer answer =
      piecewiseCases("{" + curve + R"(, "pieces": 3, "position": 0.1, "angle_deg": 1})", {}).value();
  EXPECT_EQ(answer.failed, 0);
  for (const char* key :
       {"\"elastica\"", "\"joints\"", "\"angle_deg\"", "\"splits\"", "\"R4\"", "\"hausdorff\"", "\"status\""})
    EXPECT_NE(answer.json.find(key), std::string::npos) << key;
  EXPECT_EQ(piecewiseCases("{" + curve + R"(, "splits": [0.3, 0.3]})", {})->failed, 1);
  EXPECT_EQ(piecewiseCases("{" + curve + "}", {})->failed, 1);
}

TEST(SplineCases, AnswersAllKinds) {
  const Result<CaseAnswer> answer = splineCases(R"({"cases": [
    {"points": [[0,0],[100,40],[220,30]]}, {"kind": "cubic", "points": [[0,0],[100,40],[220,30]], "start_angle": 1},
    {"kind": "bezier", "points": [[0,0],[100,40],[220,30]]}, {"poles": [[0,0],[200,150],[400,150],[600,0]]},
    {"points": [[0,0],[100,40]], "lengths": [90]}]})",
                                                {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json results = json::parse(answer->json)["results"];
  EXPECT_EQ(results[0]["pieces"].size(), 2u);
  EXPECT_EQ(results[1]["curve"]["poles"].size(), 5u);
  EXPECT_EQ(results[2]["pieces"][0]["poles"].size(), 4u);
  EXPECT_LT(results[3]["deviation"].get<double>(), 5);
  EXPECT_EQ(results[4]["error"]["code"], "no-solution");
  EXPECT_EQ(answer->failed, 1);
}

TEST(DiscreteCases, AnswersLikeTheLibrary) {
  const Result<CaseAnswer> answer = discreteCases(
      R"({"start": [0, 0], "end": [300, 0], "start_angle": 0.4, "end_angle": -0.4, "length": 400, "segments": 50,
          "sketch": {"type": "bezier", "poles": [[0,0],[150,200],[300,0]]}})",
      {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json result = json::parse(answer->json);
  EXPECT_EQ(result["vertices"].size(), 51u);
  EXPECT_EQ(result["turning_angles"].size(), 49u);
  EXPECT_TRUE(result["stable"].get<bool>());
  EXPECT_NEAR(result["elastica"]["length"].get<double>(), 400, 1e-12);
  EXPECT_EQ(
      discreteCases(R"({"start": [0, 0], "end": [300, 0], "start_angle": 0.4, "end_angle": 0})", {})->failed,
      1);
}

TEST(RelaxCases, AnswersWithASplineThatReadsBack) {
  const Result<CaseAnswer> answer = relaxCases(
      R"({"curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]}, "tolerance": 5, "length": "exact"})",
      {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json result = json::parse(answer->json);
  const Result<PlanarCurve> curve = curveFromJson(result["curve"], "curve");
  ASSERT_TRUE(curve) << curve.error().message;
  const PlanarCurve arch = *PlanarCurve::bezier({{0, 0}, {200, 150}, {400, 150}, {600, 0}});
  EXPECT_NEAR(curve->length(), arch.length(), 1e-5);
  EXPECT_LT(result["energy"].get<double>(), result["target_energy"].get<double>());
  EXPECT_EQ(relaxCases(R"({"curve": {"type": "bezier", "poles": [[0,0],[1,1]]}})", {})->failed, 1);
}

TEST(LengthCases, AnswersOneMeasurementAndMany) {
  const Result<CaseAnswer> one = lengthCases(R"({"distance": 600, "height": 120, "angle": 0.6})", {});
  ASSERT_TRUE(one) << one.error().message;
  const json single = json::parse(one->json);
  EXPECT_NEAR(single["length"].get<double>(), bladeLength({600, 120, 0.6})->length, 1e-12);
  EXPECT_TRUE(single["sensitivity"]["height"].is_number());
  const Result<CaseAnswer> many = lengthCases(
      R"({"measurements": [{"distance": 600, "height": 120, "angle": 0.6}, {"distance": 620, "height": 104, "angle": 0.6,
          "temperature": 20}], "blade": "nicr-flat-5x1"})",
      {});
  ASSERT_TRUE(many) << many.error().message;
  const json calibrated = json::parse(many->json);
  EXPECT_EQ(calibrated["measurements"].size(), 2u);
  EXPECT_TRUE(calibrated["interval"]["low"].is_number());
  EXPECT_NEAR(calibrated["reference_length"]["value"].get<double>(),
              calibrated["length"].get<double>() / (1 + 1.55e-5 * 330), 1e-9);
  EXPECT_EQ(lengthCases(R"({"distance": 600, "height": 120})", {})->failed, 1);
  EXPECT_EQ(lengthCases(R"({"distance": 600, "height": 120, "angel": 0.6, "angle": null})", {})->failed, 1);
}

}  // namespace bw::cases
