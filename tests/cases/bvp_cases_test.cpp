// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "bw/cases/cases.h"

namespace bw::cases {

using nlohmann::json;

TEST(BvpCases, AnswerOneOrAllShapes) {
  const Result<CaseAnswer> answer = bvpCases(R"({"cases": [
    {"start": [0,0], "end": [720,0], "start_angle": 0.4, "end_angle": -0.3, "length": 800},
    {"start": [0,0], "end": [720,0], "start_angle": 0.4, "end_angle": -0.3, "length": 800, "all": true, "turning": null},
    {"start": [0,0], "end": [800,0], "start_angle": 0, "end_angle": 0, "length": 800},
    {"start": [0,0], "end": [810,0], "start_angle": 0, "end_angle": 0, "length": 800},
    {"start": [0,0], "end": [720,0], "start_angle": 0.4, "end_angle": -0.3, "lenght": 800},
    {"start": [0,0], "end": [800,0], "start_angle": null, "end_angle": null, "length": 800}]})",
                                             {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json results = json::parse(answer->json)["results"];
  ASSERT_EQ(results[0]["solutions"].size(), 1u);
  const json& best = results[0]["solutions"][0];
  EXPECT_TRUE(best["stable"].get<bool>());
  EXPECT_GT(best["stability_margin"].get<double>(), 0);
  EXPECT_GT(best["sensitivity"]["per_mm"].get<double>(), 0.5);
  EXPECT_GT(results[1]["solutions"].size(), 2u);
  EXPECT_NEAR(results[1]["solutions"][0]["energy"].get<double>(), best["energy"].get<double>(), 1e-12);
  EXPECT_EQ(results[2]["case"], "straight");
  EXPECT_TRUE(results[2]["solutions"][0]["sensitivity"]["per_mm"].is_null());
  EXPECT_EQ(results[3]["error"]["code"], "no-solution");
  EXPECT_EQ(results[4]["error"]["code"], "bad-input");
  EXPECT_TRUE(results[2]["solutions"][0]["sensitivity"]["per_deg"].is_null());
  EXPECT_EQ(results[5]["case"], "straight");
  EXPECT_EQ(results[5]["solutions"][0]["sensitivity"]["per_deg"], 0.0) << "there is no angle to turn";
  EXPECT_EQ(answer->failed, 2);
}

TEST(BvpCases, StayOnTheBranchOfTheInitialBlade) {
  // Bowed down on purpose: of the two buckled shapes the one that is asked for.
  const Result<CaseAnswer> answer = bvpCases(
      R"({"start": [0,0], "end": [720,0], "start_angle": 0, "end_angle": 0, "length": 800, "all": true})",
      {});
  ASSERT_TRUE(answer);
  const json all = json::parse(answer->json);
  int seen = 0;
  for (const json& solution : all["solutions"]) {
    if (!solution["stable"].get<bool>() || std::abs(solution["turning"].get<double>()) > 1) continue;
    json object = {{"start", {0, 0}},   {"end", {725, 3}}, {"start_angle", 0.02},
                   {"end_angle", 0.01}, {"length", 800},   {"initial", solution["elastica"]}};
    const Result<CaseAnswer> moved = bvpCases(object.dump(), {});
    ASSERT_TRUE(moved && moved->failed == 0) << moved->first->message;
    const json result = json::parse(moved->json);
    EXPECT_TRUE(result["snaps_at"].is_null());
    EXPECT_GT(result["solutions"][0]["elastica"]["start_curvature"].get<double>() *
                  solution["elastica"]["start_curvature"].get<double>(),
              0);
    ++seen;
  }
  EXPECT_EQ(seen, 2);
}

TEST(BvpCases, TellOtherStableShapesAndSliding) {
  const auto answer = [](const char* text) {
    const Result<CaseAnswer> result = bvpCases(text, {});
    EXPECT_TRUE(result);
    return result ? json::parse(result->json) : json();
  };
  const json one = answer(
      R"({"start": [0, 0], "end": [720, 0], "start_angle": 0.1, "end_angle": -0.1, "length": 800, "max_turning": 3})");
  EXPECT_EQ(one["solutions"].size(), 1u);
  EXPECT_EQ(one["solutions"][0]["sliding"], false);
  EXPECT_EQ(one["other_stable"], 1);
  EXPECT_GT(one["next_energy"].get<double>(), one["solutions"][0]["energy"].get<double>());
  EXPECT_NEAR(one["next_turning"].get<double>(), -0.2, 1e-12);
  const json alone = answer(
      R"({"start": [0, 0], "end": [780, 0], "start_angle": 1, "end_angle": -1, "length": 800, "max_turning": 3})");
  EXPECT_EQ(alone["other_stable"], 0);
  EXPECT_TRUE(alone["next_energy"].is_null());
}

TEST(BvpCases, NullAnglesAreHinges) {
  const auto answer = [](const std::string& angles) {
    const Result<CaseAnswer> result =
        bvpCases(R"({"start": [0, 0], "end": [600, 0], "length": 800, )" + angles + "}", {});
    EXPECT_TRUE(result);
    return json::parse(result->json);
  };
  const json both = answer(R"("start_angle": null, "end_angle": null, "all": true)");
  EXPECT_EQ(both["case"], "buckling");
  EXPECT_GE(both["solutions"].size(), 10u);
  EXPECT_EQ(both["other_stable"], 1);
  EXPECT_EQ(both["solutions"][0]["sensitivity"]["per_deg"], 0.0);
  EXPECT_TRUE(both["solutions"][0]["inflections"].empty());
  const json one = answer(R"("start_angle": 0.3, "end_angle": null)");
  EXPECT_EQ(one["case"], "general");
  EXPECT_TRUE(one["solutions"][0]["stable"]);
  EXPECT_GT(one["solutions"][0]["sensitivity"]["per_deg"], 0.1);
  EXPECT_NEAR(one["solutions"][0]["elastica"]["start_angle"], 0.3, 1e-12);
  const json missing = answer(R"("start_angle": null)");
  EXPECT_NE(missing["error"]["message"].get<std::string>().find("null for a hinged end"), std::string::npos);
}

TEST(HeldBlade, TurnedOverFindsItsRestWithinTheWorkOfACase) {
  for (const double angle : {1.0, 1.5, 2.0}) {
    const json object = {{"start", {0, 0}},
                         {"end", {80, 0}},
                         {"start_angle", -angle},
                         {"end_angle", angle},
                         {"length", 100},
                         {"initial",
                          {{"start", {0, 0}},
                           {"start_angle", 0.9},
                           {"start_curvature", 0.0013437097792622541},
                           {"force", {0.0011623964496133192, 0}},
                           {"length", 100}}}};
    const Result<CaseAnswer> answer = bvpCases(object.dump(), {});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->failed, 0) << answer->json;
  }
}

TEST(BvpCases, TakeTheWeightOfTheBlade) {
  const char* const arch =
      R"("start": [-390,0], "end": [390,0], "start_angle": 0.2, "end_angle": -0.2, "length": 800)";
  const auto answer = [&](const std::string& more) {
    return json::parse(bvpCases("{" + std::string(arch) + more + "}", {})->json);
  };
  const json light = answer(R"(, "stiffness": 83300, "weight": [0, 0], "at": [0, 400, 800])");
  const json without = answer("");
  EXPECT_NEAR(light["solutions"][0]["energy"], without["solutions"][0]["energy"], 1e-12);
  EXPECT_EQ(light["other_stable"], 1) << "but for loops of a few millimetres";
  EXPECT_NEAR(light["next_energy"], 83300 * without["next_energy"].get<double>(), 1e-6);
  ASSERT_EQ(light["solutions"][0]["points"].size(), 3u);
  EXPECT_NEAR(light["solutions"][0]["points"][2][0], 390, 1e-6);
  const json heavy = answer(R"(, "stiffness": 83300, "weight": [0, -0.0164])")["solutions"][0];
  EXPECT_EQ(heavy["points"].size(), 101u);
  EXPECT_EQ(heavy["angles"].size(), 101u);
  EXPECT_EQ(heavy["curvatures"].size(), 101u);
  EXPECT_LT(heavy["points"][50][1], 0) << "it hangs";
  EXPECT_NEAR(heavy["snaps_at"], 0.558, 0.001);
  const json half = answer(R"(, "stiffness": 83300, "weight": [0, -0.0082])")["solutions"][0];
  EXPECT_GT(half["points"][50][1], 0) << "it still stands";
  EXPECT_TRUE(half["snaps_at"].is_null());
  EXPECT_GT(half["barrier"], 0.0);
  EXPECT_LT(half["barrier"].get<double>(), light["solutions"][0]["barrier"].get<double>());
  EXPECT_GT(answer(R"(, "stiffness": 83300, "weight": [0, -0.001], "all": true)")["solutions"].size(), 3u);
  for (const char* bad : {R"(, "weight": [0, -1])", R"(, "stiffness": 9)", R"(, "at": [3])",
                          R"(, "stiffness": 83300, "weight": [0, -1e-3], "at": [800.1])"})
    EXPECT_EQ(answer(bad)["error"]["code"], "bad-input") << bad;
}

}  // namespace bw::cases
