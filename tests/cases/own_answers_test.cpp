// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Every answer of a verb is accepted as `initial` of the same case, and leads to itself. BW_HOSTILE
// multiplies the number of random cases.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

#include <nlohmann/json.hpp>

#include "architect_curves.h"
#include "bw/cases/cases.h"
#include "bw/core/base/units.h"

namespace bw::cases {

namespace {

using nlohmann::json;

int rounds(int once) {
  const char* times = std::getenv("BW_HOSTILE");
  return once * std::max(1, times ? std::atoi(times) : 1);
}

/// Grips anywhere: usual ones, closed, aligned, taut and turned far.
json grips(int i, std::mt19937& engine) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const bool wild = i % 2 == 0;
  const double length = wild ? std::pow(10, 3 * unit(engine)) : 800;
  const double direction = 9 * unit(engine);
  double share = wild ? std::abs(unit(engine)) : 0.75 + 0.24 * std::abs(unit(engine));
  if (i % 7 == 0) share = 1 - std::pow(10, -2 - 2.5 * std::abs(unit(engine)));
  if (i % 34 == 0) share = 0;
  const double reach = wild ? 10 : 1.2;
  double startAngle = (wild ? 0 : direction) + reach * unit(engine);
  double endAngle = (wild ? 0 : direction) + reach * unit(engine);
  if (i % 20 == 0) endAngle = startAngle;
  if (i % 62 == 0) startAngle = endAngle = direction;
  return {{"start", {100 * unit(engine), 100 * unit(engine)}},
          {"end", {0.0, 0.0}},
          {"start_angle", startAngle},
          {"end_angle", endAngle},
          {"length", length},
          {"share", share},
          {"direction", direction}};
}

json placed(json problem) {
  const double reach = problem["share"].get<double>() * problem["length"].get<double>();
  const double direction = problem["direction"];
  problem["end"] = {problem["start"][0].get<double>() + reach * std::cos(direction),
                    problem["start"][1].get<double>() + reach * std::sin(direction)};
  problem.erase("share");
  problem.erase("direction");
  return problem;
}

/// The same with hinges, by turns: at the end, at the start, at both, at none.
json hinged(int i, json problem) {
  if (i % 4 == 0 || i % 4 == 2) problem["end_angle"] = nullptr;
  if (i % 4 == 1 || i % 4 == 2) problem["start_angle"] = nullptr;
  return problem;
}

json answerOf(const Result<CaseAnswer>& answer) {
  return answer ? json::parse(answer->json) : json{{"error", {{"message", answer.error().message}}}};
}

double apart(const json& a, const json& b, const char* key) {
  return std::abs(a[key].get<double>() - b[key].get<double>());
}

}  // namespace

TEST(OwnAnswers, OfBoundaryValuesLeadToThemselves) {
  std::mt19937 engine(5);
  int answered = 0;
  const int count = rounds(600);
  for (int i = 0; i < count; ++i) {
    json problem = placed(grips(i, engine));
    if (i % 3 == 1) problem = hinged(i, problem);
    problem["others"] = false;
    const json first = answerOf(bvpCases(problem.dump(), {}));
    if (first.contains("error")) continue;
    ++answered;
    const json& shape = first["solutions"][0];
    problem["initial"] = shape["elastica"];
    const json again = answerOf(bvpCases(problem.dump(), {}));
    ASSERT_FALSE(again.contains("error")) << i << " " << problem << " " << again;
    const json& same = again["solutions"][0];
    EXPECT_LE(apart(shape, same, "energy"), 1e-6 * shape["energy"].get<double>()) << i << " " << problem;
    EXPECT_LE(apart(shape, same, "turning"), 1e-6) << i << " " << problem;
    EXPECT_TRUE(again["snaps_at"].is_null()) << i;
  }
  EXPECT_GT(answered, count * 3 / 4);
  std::cout << "hostile own-answers bvp: " << answered << " of " << count << " answered\n";
}

TEST(OwnAnswers, OfAllBoundaryValuesAreAccepted) {
  std::mt19937 engine(6);
  const int count = rounds(60);
  for (int i = 0; i < count; ++i) {
    json problem = placed(grips(i, engine));
    if (i % 3 == 1) problem = hinged(i, problem);
    problem["all"] = true;
    const json all = answerOf(bvpCases(problem.dump(), {}));
    if (all.contains("error")) continue;
    problem["all"] = false;
    problem["others"] = false;
    for (const json& shape : all["solutions"]) {
      problem["initial"] = shape["elastica"];
      const json again = answerOf(bvpCases(problem.dump(), {}));
      ASSERT_FALSE(again.contains("error")) << i << " " << problem << " " << again;
      if (shape["stable"].get<bool>()) {
        EXPECT_LE(apart(shape, again["solutions"][0], "energy"), 1e-6 * shape["energy"].get<double>())
            << i << " " << problem;
      }
    }
  }
}

TEST(OwnAnswers, OfChainsLeadToThemselves) {
  std::mt19937 engine(7);
  std::uniform_int_distribution<int> segments(4, 120);
  int answered = 0;
  const int count = rounds(300);
  for (int i = 0; i < count; ++i) {
    json problem = placed(grips(i, engine));
    problem["segments"] = segments(engine);
    problem["ends"] = i % 3 == 0 ? "half" : "tangent";
    const json first = answerOf(discreteCases(problem.dump(), {}));
    if (first.contains("error")) continue;
    ++answered;
    const double energy = first["energy"];
    problem["initial"] = first["turning_angles"];
    const json again = answerOf(discreteCases(problem.dump(), {}));
    ASSERT_FALSE(again.contains("error")) << i << " " << problem << " " << again;
    EXPECT_NEAR(again["energy"].get<double>(), energy, 1e-7 * energy) << i << " " << problem;
    if (first["elastica"].is_null()) continue;
    problem["initial"] = first["elastica"];
    const json analytic = answerOf(discreteCases(problem.dump(), {}));
    ASSERT_FALSE(analytic.contains("error")) << i << " " << problem << " " << analytic;
    EXPECT_NEAR(analytic["energy"].get<double>(), energy, 1e-7 * energy) << i << " " << problem;
  }
  EXPECT_GT(answered, count * 3 / 5);
  std::cout << "hostile own-answers discrete: " << answered << " of " << count << " answered\n";
}

TEST(OwnAnswers, OfFitsLeadToThemselves) {
  const int count = rounds(60);
  const std::vector<PlanarCurve> curves = test::architectCurves(count, 8);
  for (int i = 0; i < count; ++i) {
    json problem{
        {"endpoints", i % 2 == 1}, {"tangents", i % 4 >= 2}, {"length", i % 5 == 0 ? "exact" : "free"}};
    json& curve = problem["curve"];
    const PlanarCurve& c = curves[std::size_t(i)];
    const bool bezier = c.kind() == PlanarCurve::Kind::bezier;
    curve["type"] = bezier ? "bezier" : "bspline";
    for (const Eigen::Vector2d& p : c.poles()) curve["poles"].push_back({p.x(), p.y()});
    if (!bezier) {
      curve["degree"] = c.degree();
      curve["knots"] = c.knots();
    }
    const json first = answerOf(fitCases(problem.dump(), {}));
    ASSERT_FALSE(first.contains("error")) << i << " " << first;
    problem["initial"] = first["elastica"];
    const json again = answerOf(fitCases(problem.dump(), {}));
    ASSERT_FALSE(again.contains("error")) << i << " " << problem << " " << again;
    if (first["status"] != "converged") continue;
    EXPECT_EQ(again["status"], "converged") << i << " " << again["message"];
    EXPECT_NEAR(again["R4"].get<double>(), first["R4"].get<double>(),
                1e-7 * first["R4"].get<double>() + 1e-12)
        << i;
  }
}

}  // namespace bw::cases
