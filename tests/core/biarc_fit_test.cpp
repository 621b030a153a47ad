// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bw/core/biarc.h"
#include "bw/core/cases.h"
#include "bw/core/file_set.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using Points = std::vector<Vector2d>;

/// The example of the report, section 4.1.
const Points kSeven = {{1, 0}, {0, 2}, {1, 4}, {2, 6}, {3, 5}, {4, 4}, {5.5, 3}};

BiarcOptions throughOneFourSeven() {
  BiarcOptions options;
  options.select = BiarcSelect::index;
  options.indices = {0, 3, 6};
  return options;
}

Points lamp() { return parseCurveCsv(readFile(std::string(BW_TEST_DATA) + "/lamp-53.csv").value())->poles(); }

Points ellipse(int count) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(100 * std::cos(2 * pi * i / count), 40 * std::sin(2 * pi * i / count));
  return points;
}

/// The smallest distance by brute force, independent of the solver's.
double distanceTo(const BiarcCurve& curve, const Vector2d& p) {
  double best = 1e300;
  for (const CircularArc& arc : curve.arcs) {
    const int steps = 2000;
    int at = 0;
    double near = 1e300;
    for (int i = 0; i <= steps; ++i)
      if (const double d = (arc.pointAt(arc.length * i / steps) - p).norm(); d < near) {
        near = d;
        at = i;
      }
    double a = arc.length * std::max(0, at - 1) / steps, b = arc.length * std::min(steps, at + 1) / steps;
    for (int i = 0; i < 60; ++i) {
      const double c = a + (b - a) / 3, d = b - (b - a) / 3;
      ((arc.pointAt(c) - p).norm() < (arc.pointAt(d) - p).norm() ? b : a) =
          (arc.pointAt(c) - p).norm() < (arc.pointAt(d) - p).norm() ? d : c;
    }
    best = std::min(best, (arc.pointAt((a + b) / 2) - p).norm());
  }
  return best;
}

void expectSmooth(const BiarcCurve& curve) {
  double size = 0;
  for (const CircularArc& arc : curve.arcs) size += arc.length;
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < curve.arcs.size(); ++i) {
    const CircularArc &arc = curve.arcs[i], &next = curve.arcs[(i + 1) % curve.arcs.size()];
    EXPECT_LT((arc.end() - next.start).norm(), 1e-12 * size);
    EXPECT_LT(std::abs(std::remainder(arc.endAngle() - next.startAngle, 2 * pi)), 1e-12);
    EXPECT_GT(arc.length, 0);
  }
}

}  // namespace

TEST(BiarcFit, MeasuresTheReportsExampleAsConstructed) {
  BiarcOptions options = throughOneFourSeven();
  options.goal = BiarcGoal::nothing;
  const BiarcResult r = fitBiarcs(kSeven, options).value();
  ASSERT_EQ(r.curve.arcs.size(), 4u);
  EXPECT_EQ(r.status, BiarcStatus::constructed);
  EXPECT_EQ(r.curve.points[1], Vector2d(2, 6));
  EXPECT_NEAR(r.curve.tangents[0], std::atan2(6, 1), 1e-14);
  EXPECT_NEAR(r.curve.tangents[1], std::atan2(3, 4.5), 1e-14);
  EXPECT_NEAR(r.curve.tangents[2], std::atan2(-3, 3.5), 1e-14);
  expectSmooth(r.curve);
  double sum = 0, squares = 0, largest = 0, energy = 0, angle = 0;
  for (const Vector2d& p : kSeven) {
    const double d = distanceTo(r.curve, p);
    sum += d;
    squares += d * d;
    largest = std::max(largest, d);
  }
  for (const CircularArc& arc : r.curve.arcs) {
    energy += std::abs(arc.turning / *arc.radius());
    angle += std::abs(arc.turning) / (*arc.radius() * *arc.radius());
  }
  EXPECT_NEAR(r.measures.mean, sum / 7, 1e-9);
  EXPECT_NEAR(r.measures.rms, std::sqrt(squares / 7), 1e-9);
  EXPECT_NEAR(r.measures.max, largest, 1e-9);
  EXPECT_NEAR(r.measures.energy, energy, 1e-12);
  EXPECT_NEAR(r.measures.angle, std::sqrt(angle), 1e-12);
}

TEST(BiarcFit, EachMeasureIsSmallestWhereItIsTheGoal) {
  for (const Points& data : {kSeven, lamp()}) {
    BiarcResult results[3];
    for (int i = 0; i < 3; ++i) {
      BiarcOptions options = throughOneFourSeven();
      if (data.size() == 53) options.indices = {0, 16, 34, 52};
      options.distance = BiarcDistance(i);
      results[i] = fitBiarcs(data, options).value();
      expectSmooth(results[i].curve);
      EXPECT_LT(results[i].objective, 0.5 * fitBiarcs(data, options)->initial.max);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(results[0].measures.mean, results[i].measures.mean * (1 + 1e-3));
      EXPECT_LE(results[1].measures.rms, results[i].measures.rms * (1 + 1e-6));
      EXPECT_LE(results[2].measures.max, results[i].measures.max * (1 + 1e-3));
    }
  }
}

TEST(BiarcFit, RecoversTheArcsThatMadeTheData) {
  // Three biarcs of our own, sampled without error.
  const BiarcCurve truth =
      biarcCurve({{0, 0}, {40, 25}, {90, 20}, {120, -10}}, {1.1, 0.3, -0.6, -0.9}).value();
  Points data;
  for (const CircularArc& arc : truth.arcs)
    for (int i = 0; i < 12; ++i) data.push_back(arc.pointAt(arc.length * i / 12));
  data.push_back(truth.arcs.back().end());
  BiarcOptions options;
  options.points = 4;
  const BiarcResult r = fitBiarcs(data, options).value();
  EXPECT_LT(r.measures.max, 1e-4);
}

TEST(BiarcFit, AnswersStraightDataWithStraightPieces) {
  Points line;
  for (int i = 0; i <= 10; ++i) line.emplace_back(i, 2 * i);
  BiarcOptions options;
  options.points = 3;
  const BiarcResult r = fitBiarcs(line, options).value();
  EXPECT_LT(r.measures.max, 1e-12);
  EXPECT_LT(r.measures.turning, 1e-9);
  const BiarcResult two = fitBiarcs({{0, 0}, {3, 4}}, BiarcOptions{.points = 2}).value();
  EXPECT_NEAR(two.measures.length, 5, 1e-12);
}

TEST(BiarcFit, ClosesCurves) {
  Points circle;
  for (int i = 0; i < 30; ++i)
    circle.emplace_back(5 + 3 * std::cos(2 * pi * i / 30), 3 * std::sin(2 * pi * i / 30));
  for (const int count : {2, 3, 5}) {
    BiarcOptions options;
    options.closed = true;
    options.points = count;
    const BiarcResult r = fitBiarcs(circle, options).value();
    EXPECT_EQ(r.curve.arcs.size(), std::size_t(2 * count));
    EXPECT_LT(r.measures.max, 1e-6);
    EXPECT_NEAR(r.measures.length, 6 * pi, 1e-5);
    expectSmooth(r.curve);
  }
}

TEST(BiarcFit, KeepsATolerance) {
  int before = 1000;
  for (const double tolerance : {0.01, 0.1, 1.0}) {
    BiarcOptions options;
    options.closed = true;
    options.tolerance = tolerance;
    const BiarcResult r = fitBiarcs(ellipse(200), options).value();
    EXPECT_EQ(r.status, BiarcStatus::converged);
    EXPECT_LE(r.measures.max, tolerance * (1 + 1e-9));
    EXPECT_LT(int(r.curve.arcs.size()), before);
    before = int(r.curve.arcs.size());
  }
  BiarcOptions tooFew;
  tooFew.points = 2;
  tooFew.tolerance = 0.01;
  const BiarcResult r = fitBiarcs(lamp(), tooFew).value();
  EXPECT_EQ(r.status, BiarcStatus::toleranceExceeded);
  EXPECT_FALSE(r.message.empty());
}

TEST(BiarcFit, RefusesBadInputWithASentence) {
  const auto message = [](const Points& data, const BiarcOptions& options) {
    const Result<BiarcResult> r = fitBiarcs(data, options);
    EXPECT_FALSE(r);
    return r ? std::string() : r.error().message;
  };
  BiarcOptions three;
  three.points = 3;
  EXPECT_NE(message({{0, 0}, {1, NAN}, {2, 0}}, three).find("data point 1"), std::string::npos);
  EXPECT_NE(message({{1, 1}, {1, 1}, {1, 1}}, three).find("different"), std::string::npos);
  EXPECT_NE(message({}, three).find("at least 2"), std::string::npos);
  BiarcOptions index = throughOneFourSeven();
  index.indices = {0, 9};
  EXPECT_NE(message(kSeven, index).find("index 9"), std::string::npos);
  index.indices = {0, 3, 3, 6};
  EXPECT_NE(message(kSeven, index).find("coincide"), std::string::npos);
  BiarcOptions tangents = throughOneFourSeven();
  tangents.tangents = std::vector<double>{0, 1};
  EXPECT_NE(message(kSeven, tangents).find("tangent"), std::string::npos);
  EXPECT_NE(message(kSeven, BiarcOptions{}).find("how many"), std::string::npos);
}

TEST(BiarcFit, SurvivesARepeatedPointAndAReversal) {
  BiarcOptions options;
  options.points = 3;
  EXPECT_TRUE(fitBiarcs({{0, 0}, {1, 0}, {1, 0}, {2, 1}, {2, 1}}, options));
  const BiarcResult back = fitBiarcs({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 0}, {1, 0}}, options).value();
  EXPECT_TRUE(std::isfinite(back.measures.length));
  expectSmooth(back.curve);
}

TEST(BiarcCases, AnswersArcsAndAllMeasures) {
  using nlohmann::json;
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

}  // namespace bw
