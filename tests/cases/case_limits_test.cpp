// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// What a case may cost, and what it may do to the others.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bw/cases/cases.h"

namespace bw::cases {
namespace {

using nlohmann::json;
using Verb = Result<CaseAnswer> (*)(std::string_view, const RunContext&);

const char* const kWave = R"({"type": "bezier", "poles": [[0, 0], [100, 150], [200, -100], [300, 30]]})";
const char* const kSlip = R"({"type": "points", "points": [[0, 0], [10, 2], [20, 3], [1e8, 3], [40, 0]]})";
const char* const kFar = R"({"type": "bezier", "poles": [[0, 0], [1e135, 1e134], [2e135, 0]]})";

std::string spline(const char* knot) {
  return std::string(R"({"type": "bspline", "degree": 2, "knots": [0, 0, 0, )") + knot +
         R"(, 1, 1, 1], "poles": [[0, 0], [1, 1], [2, 0], [3, 1]]})";
}

json answerOf(Verb verb, const std::string& text) {
  const Result<CaseAnswer> answer = verb(text, {});
  EXPECT_TRUE(answer);
  return answer ? json::parse(answer->json) : json();
}

// Without the time that it took.
json untimed(json result) {
  result.erase("seconds");
  return result;
}

TEST(CaseLimits, AHopelessCaseGetsItsErrorAndTheOthersTheirResults) {
  const auto pieces = [](const std::string& curve) {
    return R"({"curve": )" + curve + R"(, "pieces": 2, "position": 1})";
  };
  for (const Verb verb : {&fitCases, &piecewiseCases}) {
    const auto one = [&](const std::string& curve) {
      return verb == &fitCases ? R"({"curve": )" + curve + "}" : pieces(curve);
    };
    const json results = answerOf(verb, R"({"cases": [)" + one(kWave) + "," + one(kSlip) + "," + one(kFar) +
                                            "," + one(spline("1e-150")) + "," + one(spline("1e-300")) + "," +
                                            one(spline("1e-13")) + "," + one(kWave) + "]}")["results"];
    ASSERT_EQ(results.size(), 7u);
    EXPECT_TRUE(results[0].contains("R4")) << results[0];
    EXPECT_EQ(untimed(results[6]), untimed(results[0]));
    // A point that lost its decimal point is a curve still, if a wild one.
    if (results[1].contains("error"))
      EXPECT_EQ(results[1]["error"]["code"], "no-solution") << results[1];
    else
      EXPECT_TRUE(results[1]["R4"].is_number());
    for (const int i : {2, 3, 4, 5}) {
      ASSERT_TRUE(results[i].contains("error")) << results[i];
      EXPECT_EQ(results[i]["error"]["code"], "bad-input") << results[i];
    }
    EXPECT_EQ(results[2]["error"]["where"], "pole 1");
    EXPECT_EQ(results[5]["error"]["where"], "knot 3");
    EXPECT_NEAR(results[5]["error"]["limit"].get<double>(), 1e-12, 1e-18);
  }
}

TEST(CaseLimits, DeepNestingAndHugeNumbersAreErrors) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  EXPECT_FALSE(fitCases(R"({"curve": )" + deep + "}", {}));
  EXPECT_FALSE(fitCases(R"({"curve": {"type": "bezier", "poles": [[1e999, 0], [1, 1]]}})", {}));
}

TEST(CaseLimits, ALengthOutOfReachIsRefusedAtOnce) {
  for (const double length : {100.0, 2000.0}) {
    const json result =
        answerOf(relaxCases, R"({"curve": )" + std::string(kWave) + R"(, "tolerance": 5, "length": )" +
                                 std::to_string(length) + "}");
    ASSERT_TRUE(result.contains("error")) << result;
    EXPECT_EQ(result["error"]["code"], "no-solution");
    EXPECT_EQ(result["error"]["where"], "length");
    // The limit is one that can be believed: between the chord and three lengths of the curve.
    const double limit = result["error"]["limit"];
    EXPECT_TRUE(length < 300 ? limit > length && limit <= 301.5 : limit < length && limit > 400) << limit;
  }
}

TEST(CaseLimits, TooHardACaseStopsSaysSoAndStopsAtTheSamePlaceAgain) {
  const std::string text =
      R"({"curve": )" + std::string(kWave) + R"(, "tolerance": 5, "spans": 200, "length": 500})";
  const json result = answerOf(relaxCases, text);
  ASSERT_FALSE(result.contains("error")) << result;
  EXPECT_EQ(result["status"], "work-limit");
  EXPECT_NE(result["message"].get<std::string>().find("work limit"), std::string::npos);
  const Result<CaseAnswer> again = relaxCases(text, {{}, {}, 1});
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->limited);
  EXPECT_EQ(untimed(json::parse(again->json)), untimed(result));
}

TEST(CaseLimits, ALengthThatIsNotMetForLackOfWorkIsNotCalledOutOfReach) {
  // 375 mm are within reach.
  const json result = answerOf(
      relaxCases, R"({"curve": )" + std::string(kWave) + R"(, "tolerance": 5, "spans": 185, "length": 370})");
  ASSERT_FALSE(result.contains("error")) << result;
  EXPECT_EQ(result["status"], "work-limit");
}

TEST(CaseLimits, PointsWhoseDistancesGrowAreDroppedAsFastAsOthers) {
  // Dropped one after the other from the left, the farthest of them always the last.
  json points = json::array();
  for (int i = 0; i < 60000; ++i) points.push_back({i, (i % 2 ? -1e-6 : 1e-6) * i});
  const json job = {{"points", points}, {"points_kept", 20}, {"select", "tube"}, {"minimise", "nothing"}};
  const Result<CaseAnswer> answer = biarcCases(job.dump(), {});
  ASSERT_TRUE(answer);
  const json result = json::parse(answer->json);
  EXPECT_EQ(result["status"], "constructed") << result["message"];
  EXPECT_EQ(result["points"].size(), 20u);
  EXPECT_LT(result["seconds"].get<double>(), 10);
}

TEST(CaseLimits, EachCaseHasItsOwnWork) {
  const std::string hard =
      R"({"curve": )" + std::string(kWave) + R"(, "tolerance": 5, "spans": 200, "length": 500})";
  const std::string easy = R"({"curve": )" + std::string(kWave) + R"(, "tolerance": 5, "spans": 12})";
  const json results = answerOf(relaxCases, R"({"cases": [)" + hard + "," + easy + "]}")["results"];
  EXPECT_EQ(results[0]["status"], "work-limit");
  EXPECT_NE(results[1]["status"], "work-limit");
}

}  // namespace
}  // namespace bw::cases
