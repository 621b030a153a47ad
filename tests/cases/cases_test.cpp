// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/cases/cases.h"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;

TEST(ElasticaCases, AnswersACircleExactly) {
  const Result<CaseAnswer> answer = elasticaCases(
      R"({"elastica": {"start": [0,0], "start_angle": 0, "start_curvature": 0.01, "force": [0,0], "length": 100}, "at": [0, 157.07963267948966]})",
      {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json result = json::parse(answer->json);
  EXPECT_NEAR(result["points"][1][0].get<double>(), 100, 1e-9);
  EXPECT_NEAR(result["points"][1][1].get<double>(), 100, 1e-9);
  EXPECT_NEAR(result["energy"].get<double>(), 0.5 * 1e-4 * 100, 1e-12);
  EXPECT_TRUE(result["elastica"]["control_parameters"].is_null());
  EXPECT_FALSE(result["self_intersects"].get<bool>());
}

TEST(ElasticaCases, AnAnchorHoldsBothEndsAndComesBackAsItIs) {
  const std::string anchor =
      R"("anchor": {"at": 31.25, "point": [1, 2], "angle": 0.5, "curvature": 0, "force": [-1, 1e-13]})";
  const auto run = [](const std::string& elastica) {
    const Result<CaseAnswer> answer =
        elasticaCases(R"({"elastica": )" + elastica + R"(, "at": [0, 62.5]})", {});
    EXPECT_TRUE(answer);
    return json::parse(answer->json);
  };
  const json first = run("{" + anchor + R"(, "length": 62.5})");
  ASSERT_TRUE(first.contains("points")) << first.dump();
  // An inflection at the anchor: the ends lie opposite each other.
  for (const int i : {0, 1})
    EXPECT_NEAR(first["points"][0][i].get<double>() + first["points"][1][i].get<double>(), 2.0 * (1 + i),
                1e-11);
  EXPECT_GT(std::abs(first["angles"][0].get<double>() - 0.5), 0.5);
  const json again = run(first["elastica"].dump());
  EXPECT_EQ(again["points"], first["points"]);
  EXPECT_EQ(again["elastica"], first["elastica"]);
  json other = first["elastica"];
  other["start_angle"] = 0.1;
  EXPECT_EQ(run(other.dump())["error"]["code"], "bad-input");
  EXPECT_EQ(run(R"({"anchor": {"at": 1}, "length": 5})")["error"]["code"], "bad-input");
}

TEST(ElasticaCases, OneFailingCaseNeverEndsTheOthers) {
  const Result<CaseAnswer> answer = elasticaCases(R"({"cases": [
    {"elastica": {"start": [0,0], "start_angle": 0, "start_curvature": 0, "force": [0,0], "length": 10}, "at": [5]},
    {"elastica": {"start": [0,0], "start_angle": 0, "start_curvature": 0, "force": [0,0], "length": -1}, "at": [5]},
    {"elastica": {"control_parameters": {"k": 0.5, "s0": 0.1, "l": 2, "S": 30, "phi": 0.2, "x": 1, "y": 2}}, "at": [0]}, 7]})",
                                                  {});
  ASSERT_TRUE(answer) << answer.error().message;
  const json results = json::parse(answer->json)["results"];
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0]["points"][0][0], 5);
  EXPECT_EQ(results[1]["error"]["code"], "bad-input");
  EXPECT_NEAR(results[2]["elastica"]["length"].get<double>(), 60, 1e-12);
  EXPECT_TRUE(results[3].contains("error"));
  EXPECT_EQ(answer->failed, 2);
}

TEST(FitCases, IsTheSameForAnyNumberOfThreads) {
  std::string text = R"({"cases": [)";
  for (int i = 0; i < 12; ++i)
    text += (i ? "," : "") + std::string(R"({"curve": {"type": "bezier", "poles": [[0,0],[200,)") +
            std::to_string(10 * i) + "],[400," + std::to_string(150 - 20 * i) + "],[600,0]]}}";
  text += "]}";
  std::vector<std::string> outputs;
  for (const int threads : {1, 3}) {
    RunContext context;
    context.threads = threads;
    const Result<CaseAnswer> answer = fitCases(text, context);
    ASSERT_TRUE(answer) << answer.error().message;
    json parsed = json::parse(answer->json);
    for (json& result : parsed["results"]) {
      EXPECT_EQ(result["status"], "converged");
      result.erase("seconds");
    }
    outputs.push_back(parsed.dump());
  }
  EXPECT_EQ(outputs[0], outputs[1]);
}

TEST(FitCases, NumericMethodIsTheRelaxation) {
  const std::string curve = R"("curve": {"type": "bezier", "poles": [[0,0],[200,150],[400,150],[600,0]]})";
  const auto answer = [&](CaseAnswer (*ask)(const std::string&), const std::string& rest) {
    json parsed = json::parse(ask("{" + curve + rest + "}").json);
    parsed.erase("seconds");
    return parsed;
  };
  const auto fit = [](const std::string& text) { return fitCases(text, {}).value(); };
  const auto relax = [](const std::string& text) { return relaxCases(text, {}).value(); };
  json numeric = answer(fit, R"(, "method": "numeric", "tolerance": 5, "length": "exact")");
  EXPECT_EQ(numeric["method"], "numeric");
  numeric.erase("method");
  EXPECT_EQ(numeric, answer(relax, R"(, "tolerance": 5, "length": "exact")"));
  json analytic = answer(fit, R"(, "method": "analytic")");
  EXPECT_EQ(analytic, answer(fit, ""));
  // Keys of the other method are refused by name.
  const auto where = [&](const std::string& rest) {
    const CaseAnswer refused = fit("{" + curve + rest + "}");
    return refused.first ? refused.first->where + ": " + refused.first->message : std::string();
  };
  EXPECT_NE(where(R"(, "method": "numeric", "tolerance": 5, "max_curvature": 0.01)").find("max_curvature"),
            std::string::npos);
  EXPECT_NE(where(R"(, "method": "numeric", "tolerance": 5, "initial": null)").find("analytic"),
            std::string::npos);
  EXPECT_NE(where(R"(, "tolerance": 5)").find("numeric"), std::string::npos);
  EXPECT_NE(where(R"(, "method": "numeric")").find("tolerance"), std::string::npos);
  EXPECT_NE(where(R"(, "method": "numerical")").find("did you mean"), std::string::npos);
}

TEST(FitCases, NamesWhatIsWrongWithACurve) {
  const auto message = [](const char* text) {
    const Result<CaseAnswer> answer = fitCases(text, {});
    if (!answer) return answer.error().message;
    return answer->first ? answer->first->message : std::string("accepted");
  };
  EXPECT_NE(message(R"({"curve": {"type": "bezier", "poles": [[0,0],[0,"x"]]}})").find("poles[1]"),
            std::string::npos);
  EXPECT_NE(message(R"({"curve": {"type": "bezeir", "poles": []}})").find("did you mean \"bezier\"?"),
            std::string::npos);
  EXPECT_NE(message(R"({"curve": {"type": "points", "points": [[0,0],[1,1]], "degree": 2}})").find("degree"),
            std::string::npos);
  EXPECT_NE(message(R"({"curve": {"type": "points", "points": [[0,0],[0,0]]}})"), "accepted");
  EXPECT_NE(
      message(R"({"curve": {"type": "bspline", "degree": 3, "knots": [0,0,1], "poles": [[0,0],[1,0]]}})"),
      "accepted");
  EXPECT_NE(message("{}").find("curve"), std::string::npos);
}

TEST(CurveCsv, ReadsPointsWithHeaderAndComments) {
  const auto points = pointsFromCsv("x,y\n# a comment\n0, 0\n3;4\n\n6\t8 # the end\r\n");
  ASSERT_TRUE(points) << points.error().message;
  EXPECT_EQ(*points, (std::vector<Eigen::Vector2d>{{0, 0}, {3, 4}, {6, 8}}));
  const auto bad = pointsFromCsv("0,0\n1,nonsense\n");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("line 2"), std::string::npos);
  EXPECT_EQ(fitCases(fitCaseFromCsv("").value(), {})->failed, 1);
}

TEST(FitCases, TheForecastDoesNotDependOnTheStart) {
  const std::string curve =
      R"("curve": {"type": "bezier", "poles": [[0, 0], [200, 150], [400, 150], [600, 0]]})";
  const auto run = [&](const std::string& rest) {
    return json::parse(fitCases("{" + curve + R"(, "epsilon": 0.01)" + rest + "}", {})->json);
  };
  const json cold = run("");
  const json warm = run(R"(, "initial": )" + cold["elastica"].dump());
  ASSERT_TRUE(warm.contains("R4_forecast")) << warm.dump();
  EXPECT_EQ(warm["R4_forecast"], cold["R4_forecast"]);
  EXPECT_EQ(warm["approximable"], cold["approximable"]);
}

}  // namespace bw::cases
