// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Cases of the numeric verbs as slips and malice would have them: valid ones, mutated at random. None may end
// the program, meet a fault of our own, or answer with a number that is not finite. BW_HOSTILE multiplies the
// number of cases; 1 unless set.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "bw/cases/cases.h"

namespace bw::cases {
namespace {

using nlohmann::json;
using Random = std::mt19937_64;

struct Verb {
  const char* name;
  std::function<Result<CaseAnswer>(std::string_view)> run;
  std::vector<std::string> cases;
};

const char* const kBezier = R"({"type": "bezier", "poles": [[0, 0], [100, 150], [200, -100], [300, 30]]})";
const char* const kSpline =
    R"({"type": "bspline", "degree": 3, "knots": [0, 0, 0, 0, 1, 2, 3, 3, 3, 3], "poles": [[0, 0], [20, 30],
        [60, 40], [90, 10], [130, 5], [150, 40]], "weights": [1, 1, 2, 1, 0.5, 1]})";
const char* const kPoints =
    R"({"type": "points", "points": [[0, 0], [10, 4], [20, 7], [30, 8.5], [40, 8], [50, 6], [60, 2], [70, -3]]})";
const char* const kBlade =
    R"({"start": [1, 2], "start_angle": 0.3, "start_curvature": 0.004, "force": [1e-5, -2e-5], "length": 400})";

std::string with(const char* key, const char* value, const char* rest) {
  return std::string("{\"") + key + "\": " + value + (*rest ? std::string(", ") + rest : std::string()) + "}";
}

std::vector<Verb> verbs() {
  const RunContext one{{}, {}, 1};
  const auto plain = [one](Result<CaseAnswer> (*function)(std::string_view, const RunContext&)) {
    return [one, function](std::string_view text) { return function(text, one); };
  };
  return {
      {"elastica",
       plain(elasticaCases),
       {with("elastica", kBlade, R"("at": [0, 100, 400, 900])"),
        R"({"elastica": {"control_parameters": {"k": 0.9, "s0": 0.2, "l": 3, "S": 40, "phi": 1, "x": 0, "y": 5}}, "at": [1]})",
        R"({"elastica": {"anchor": {"at": 31, "point": [1, 2], "angle": 0.5, "curvature": 0, "force": [-1, 1e-13]}, "length": 62}, "at": [3]})"}},
      {"fit",
       plain(fitCases),
       {with("curve", kBezier, ""), with("curve", kSpline, R"("endpoints": true, "tangents": true)"),
        with("curve", kPoints,
             R"("length": "exact", "endpoints": true, "max_curvature": 0.05, "norm": "H1")"),
        with("curve", kBezier, R"("guess": "count", "max_inflections": 1, "simple": true, "epsilon": 0.01)"),
        with("curve", kSpline, (std::string("\"initial\": ") + kBlade).c_str()),
        with("curve", kBezier, R"("length": 420, "endpoints": true, "tangents": true, "max_periods": 2)")}},
      {"piecewise",
       plain(piecewiseCases),
       {with("curve", kBezier, R"("pieces": 3, "position": 0.1, "angle_deg": 1)"),
        with("curve", kSpline, R"("splits": [1, 2], "continuity": "G2")"),
        with("curve", kPoints, R"("tolerance": 0.5, "pieces": 5, "max_curvature": 0.1)"),
        with("curve", kBezier,
             R"("splits": "optimised", "pieces": 4, "endpoints": true, "tangents": true)")}},
      {"biarc",
       [one](std::string_view text) { return biarcCases(text, one); },
       {R"({"points": [[0, 0], [10, 4], [20, 7], [30, 8.5], [40, 8], [50, 6], [60, 2]], "arcs": 4, "svg": true})",
        R"({"points": [[0, 0], [10, 4], [20, 7], [10, 18], [0, 9]], "tolerance": 0.5, "closed": true})",
        R"({"points": [[0, 0], [10, 4], [20, 7], [30, 8.5], [40, 8]], "tube": 0.3, "distance": "max"})",
        R"({"points": [[0, 0], [10, 4], [20, 7], [30, 8.5]], "coordinates": [[0, 0], [15, 5], [30, 8]], "minimise": "combined", "weight": 0.2})"}},
      {"discrete",
       plain(discreteCases),
       {R"({"start": [0, 0], "end": [300, 20], "start_angle": 0.6, "end_angle": -0.4, "length": 350, "segments": 40})",
        R"({"start": [0, 0], "end": [100, 0], "start_angle": 2, "end_angle": 1, "length": 300, "ends": "half", "turning": -1})",
        with("sketch", kBezier,
             R"("start": [0, 0], "end": [300, 30], "start_angle": 1, "end_angle": 0.9, "length": 380)"),
        with("initial", kBlade,
             R"("start": [0, 0], "end": [300, 30], "start_angle": 1, "end_angle": 0.9, "length": 380)")}},
      {"relax",
       plain(relaxCases),
       {with("curve", kBezier, R"("tolerance": 5)"),
        with("curve", kSpline, R"("tolerance": 1, "length": "exact", "degree": 5, "endpoints": false)"),
        with("curve", kPoints, R"("tolerance": 2, "spans": 12, "length": 80, "tangents": false)")}},
      {"length",
       plain(lengthCases),
       {R"({"distance": 500, "height": 80, "angle": 0.2})",
        R"({"distance": 500, "height": 80, "angle": null})",
        R"({"measurements": [{"distance": 500, "height": 80, "angle": 0.2, "temperature": 30, "height_error": 0.5},
             {"distance": 600, "height": 20, "angle": 0.1, "height_error": 0.4, "angle_error": 0.01}],
            "height_offset": true, "confidence": 0.9})"}},
      {"bvp",
       plain(bvpCases),
       {R"({"start": [0, 0], "end": [300, 0], "start_angle": 1, "end_angle": -1, "length": 500})",
        R"({"start": [0, 0], "end": [300, 50], "start_angle": 0.3, "end_angle": 2, "length": 420, "all": true})",
        with("initial", kBlade,
             R"("start": [0, 0], "end": [300, 50], "start_angle": 0.3, "end_angle": 1, "length": 400)"),
        R"({"start": [0, 0], "end": [0, 0], "start_angle": 0, "end_angle": 0, "length": 100, "turning": 6.283185307179586})",
        R"({"start": [0, 0], "end": [300, 50], "start_angle": null, "end_angle": 2, "length": 420, "all": true})",
        R"({"start": [0, 0], "end": [300, 0], "start_angle": null, "end_angle": null, "length": 340, "all": true})",
        with("initial", kBlade,
             R"("start": [0, 0], "end": [300, 50], "start_angle": 0.3, "end_angle": null, "length": 400)")}},
      {"spline",
       plain(splineCases),
       {R"({"points": [[0, 0], [100, 40], [200, -20], [300, 30]]})",
        R"({"points": [[0, 0], [100, 40], [200, -20], [300, 30]], "total_length": 360, "start_angle": 0.5})",
        R"({"points": [[0, 0], [100, 40], [200, -20]], "lengths": [120, 130], "end_angle": 1})",
        R"({"points": [[0, 0], [100, 40], [200, -20]], "tangents": [0.5, 0, -0.5]})",
        R"({"points": [[0, 0], [100, 40], [200, -20]], "kind": "cubic"})",
        R"({"points": [[0, 0], [100, 40], [200, -20]], "kind": "bezier"})",
        R"({"poles": [[0, 0], [100, 150], [200, -100], [300, 30]]})"}},
  };
}

std::size_t below(Random& random, std::size_t count) { return std::size_t(random() % count); }

void collect(json& node, std::vector<json*>& out) {
  out.push_back(&node);
  if (!node.is_structured()) return;
  for (json& member : node) collect(member, out);
}

json wild(Random& random) {
  switch (below(random, 9)) {
    case 0:
      return nullptr;
    case 1:
      return "text";
    case 2:
      return random() % 2 == 0;
    case 3:
      return json::array();
    case 4:
      return json::object();
    case 5:
      return 1e308;
    case 6:
      return -5e-324;
    case 7:
      return json::parse(std::string(2000, '[') + std::string(2000, ']'));
    default:
      return std::int64_t(random());
  }
}

double slip(double x, Random& random) {
  const int digits = int(below(random, 8)) + 1;
  switch (below(random, 8)) {
    case 0:
      return x * std::pow(10.0, digits);
    case 1:
      return x * std::pow(10.0, -digits);
    case 2:
      return x * std::pow(10.0, double(below(random, 300)));
    case 3:
      return x * std::pow(10.0, -double(below(random, 300)));
    case 4:
      return -x;
    case 5:
      return 0;
    case 6:
      return x * (1 + std::pow(10.0, -2.0 * digits));
    default:
      return x + 1e6 * double(int(below(random, 3)) - 1);
  }
}

void mutateList(json& list, Random& random) {
  const std::size_t i = below(random, list.size()), j = below(random, list.size());
  switch (below(random, 7)) {
    case 0:
      list[i] = json(list[j]);
      break;  // coincident
    case 1:
      list.erase(list.begin() + std::ptrdiff_t(i));
      break;
    case 2:
      list.insert(list.begin() + std::ptrdiff_t(i), json(list[j]));
      break;
    case 3:
      std::swap(list[i], list[j]);
      break;
    case 4:
      std::reverse(list.begin(), list.end());
      break;
    case 5:  // all on one line
      for (json& point : list)
        if (point.is_array() && point.size() == 2) point[1] = 0;
      break;
    default:  // very many
      for (int n = 0; n < 300; ++n) list.push_back(json(list[below(random, list.size())]));
  }
}

void mutate(json& object, Random& random) {
  for (std::size_t times = 1 + below(random, 3); times > 0; --times) {
    std::vector<json*> nodes;
    collect(object, nodes);
    json& node = *nodes[below(random, nodes.size())];
    if (below(random, 12) == 0) {
      node = wild(random);
    } else if (node.is_number()) {
      const double x = slip(node.get<double>(), random);
      node = std::isfinite(x) ? x : 1e300;
    } else if (node.is_array() && !node.empty()) {
      mutateList(node, random);
    } else if (node.is_object() && !node.empty()) {
      const auto key = std::next(node.begin(), std::ptrdiff_t(below(random, node.size())));
      const json value = key.value();
      const std::string name = key.key();
      if (random() % 3 == 0) node[name + "x"] = value;
      if (random() % 3 == 0) node.erase(name);
    } else if (node.is_boolean()) {
      node = !node.get<bool>();
    }
    if (!object.is_structured()) return;
  }
}

// Where an answer says "none" with null.
const std::set<std::string> kMayBeNull = {"control_parameters",
                                          "radius",
                                          "k",
                                          "angle",
                                          "snaps_at",
                                          "elastica",
                                          "elastica_deviation",
                                          "deviation",
                                          "per_mm",
                                          "per_deg",
                                          "value",
                                          "limit",
                                          "error",
                                          "low",
                                          "high",
                                          "plausibility",
                                          "other_stable",
                                          "next_energy",
                                          "next_turning"};

void expectNoHoles(const json& node, const std::string& key) {
  if (node.is_null()) {
    EXPECT_TRUE(kMayBeNull.contains(key)) << key;
  }
  if (node.is_array())
    for (const json& member : node) expectNoHoles(member, key);
  if (node.is_object())
    for (const auto& [name, member] : node.items()) expectNoHoles(member, name);
}

TEST(HostileCases, EachIsAnsweredFinitelyOrRefused) {
  const char* wanted = std::getenv("BW_HOSTILE");
  const int rounds = int(60 * std::max(0.01, wanted ? std::atof(wanted) : 1));
  Random random(20261122);
  long cases = 0, answers = 0, limited = 0;
  double slowest = 0;
  std::string slow;
  for (const Verb& verb : verbs()) {
    for (int round = 0; round < rounds; ++round) {
      json object = json::parse(verb.cases[std::size_t(round) % verb.cases.size()]);
      mutate(object, random);
      const std::string text = object.dump();
      SCOPED_TRACE(std::string(verb.name) + " " + text.substr(0, 3000));
      const auto begin = std::chrono::steady_clock::now();
      const Result<CaseAnswer> answer = verb.run(text);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      if (seconds > slowest) {
        slowest = seconds;
        slow = std::string(verb.name) + " " + text.substr(0, 600);
      }
      ++cases;
      if (!answer) {
        EXPECT_NE(answer.error().code, ErrorCode::internal) << answer.error().message;
        continue;
      }
      const json result = json::parse(answer->json);
      if (answer->failed > 0) {
        ASSERT_TRUE(result.contains("error")) << answer->json;
        EXPECT_NE(result["error"]["code"], "internal") << result["error"]["message"];
        EXPECT_FALSE(result["error"]["message"].get<std::string>().empty());
      } else {
        ++answers;
        expectNoHoles(result, "");
      }
      if (answer->json.find("stopped at the work limit") != std::string::npos) ++limited;
      if (HasFailure() && std::getenv("BW_HOSTILE_STOP")) return;
    }
  }
  std::printf(
      "hostile cases: %ld cases, %ld answered, %ld refused, %ld stopped at the work limit, none ended the "
      "program; slowest %.2f s\n",
      cases, answers, cases - answers, limited, slowest);
  if (std::getenv("BW_HOSTILE_SLOWEST")) std::printf("%s\n", slow.c_str());
}

}  // namespace
}  // namespace bw::cases
