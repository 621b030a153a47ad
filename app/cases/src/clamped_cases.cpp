// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/discrete/discrete_elastica.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kLargest = 1e9;
/// An end that misses its grip by more than this part of the length is reported as a limit exceeded.
constexpr double kEndTolerance = 1e-6;

/// Nothing where it is infinite.
std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

ordered_json solutionToJson(const ClampedSolution& solution) {
  ordered_json result;
  result["elastica"] = elasticaToJson(solution.elastica);
  result["energy"] = solution.energy;
  result["turning"] = solution.turning;
  result["inflections"] = solution.inflections;
  result["stable"] = solution.stable;
  result["sliding"] = solution.sliding;
  result["stability_margin"] = solution.stabilityMargin;
  result["out_of_plane_margin"] = solution.outOfPlaneMargin;
  result["sensitivity"] = {{"per_mm", finite(solution.sensitivity.perMm)},
                           {"per_deg", finite(solution.sensitivity.perDegree)}};
  result["self_intersects"] = solution.selfIntersects;
  result["end_error"] = solution.endError;
  return result;
}

Result<ordered_json> bvpCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  ClampedProblem problem;
  ClampedOptions options;
  for (const char* key : {"start", "end", "start_angle", "end_angle", "length"})
    reader.need(key,
                std::string("the case needs the key ") + key +
                    (std::string_view(key).ends_with("angle") ? ", in rad, or null for a hinged end" : ""));
  const json* start = reader.member("start");
  const json* end = reader.member("end");
  // null: hinged.
  problem.startAngle = problem.endAngle = std::nullopt;
  reader.number("start_angle", problem.startAngle, -kLargest, kLargest);
  reader.number("end_angle", problem.endAngle, -kLargest, kLargest);
  reader.number("length", problem.length, 1 / kLargest, kLargest);
  reader.number("turning", problem.turning, -8 * kPi, 8 * kPi);
  bool all = false;
  reader.boolean("all", all);
  reader.integer("max_inflections", options.maxInflections, 0, 12);
  reader.number("max_turning", options.maxTurning, 0, 8 * kPi);
  reader.number("torsion_ratio", options.torsionRatio, 0, 1e6);
  options.others = true;
  reader.boolean("others", options.others);
  const json* initial = reader.given("initial");
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  reader.take(readPoint(start, "start"), problem.start);
  reader.take(readPoint(end, "end"), problem.end);
  if (initial) reader.take(elasticaFromJson(*initial, "initial"), options.initial);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const auto begin = std::chrono::steady_clock::now();
  const Result<ClampedAnswer> answer =
      all ? solveAllClamped(problem, options) : solveClamped(problem, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!answer) return passOn(answer.error());
  ordered_json result;
  result["solutions"] = ordered_json::array();
  for (const ClampedSolution& solution : answer->solutions) {
    result["solutions"].push_back(solutionToJson(solution));
    limited = limited || solution.endError > kEndTolerance * problem.length;
  }
  if (all || options.others) {
    const ClampedOthers& others = answer->others;
    result["other_stable"] = others.stable;
    result["next_energy"] = others.stable > 0 ? ordered_json(others.energy) : ordered_json(nullptr);
    result["next_turning"] = others.stable > 0 ? ordered_json(others.turning) : ordered_json(nullptr);
  }
  result["case"] = clampedKindName(answer->kind);
  result["snaps_at"] = answer->snapsAt;
  result["message"] = answer->message;
  result["seconds"] = seconds;
  return result;
}

constexpr double kHuge = 1e12;

void readEnds(ObjectReader& reader, ClampedEnds& ends) {
  for (const char* key : {"start", "end", "start_angle", "end_angle", "length"})
    reader.need(key, std::string("the case needs the key ") + key);
  for (const auto& [key, point] : {std::pair{"start", &ends.start}, std::pair{"end", &ends.end}})
    if (const json* value = reader.member(key)) reader.take(readPoint(value, key), *point);
  reader.number("start_angle", ends.startAngle, -kHuge, kHuge);
  reader.number("end_angle", ends.endAngle, -kHuge, kHuge);
  reader.number("length", ends.length, 1e-9, kHuge);
}

void readGuide(ObjectReader& reader, DiscreteOptions& options) {
  const json* initial = reader.given("initial");
  if (initial && initial->is_array())
    reader.take(readNumbers(initial, "initial"), options.turningAngles);
  else if (initial)
    reader.take(elasticaFromJson(*initial, "initial"), options.shape);
  if (const json* sketch = reader.given("sketch"))
    reader.take(curveFromJson(*sketch, "sketch"), options.sketch);
}

Result<ordered_json> discreteCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  ClampedEnds ends;
  DiscreteOptions options;
  readEnds(reader, ends);
  readGuide(reader, options);
  reader.integer("segments", options.segments, 4, 2000);
  int held = 0;
  reader.word("ends", {"tangent", "half"}, held);
  options.ends = DiscreteOptions::Ends(held);
  reader.number("turning", options.turning, -kHuge, kHuge);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const auto start = std::chrono::steady_clock::now();
  const Result<DiscreteElastica> discrete = discreteElastica(ends, options);
  if (!discrete) return passOn(discrete.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Result<AnalyticElastica> analytic = analyticElastica(*discrete);
  limited = !discrete->stable;
  ordered_json result;
  result["vertices"] = discrete->vertices;
  result["turning_angles"] = discrete->turningAngles;
  result["turning"] = discrete->ends.endAngle - discrete->ends.startAngle;
  result["energy"] = discrete->energy;
  result["squared_turning"] = discrete->squaredTurning;
  result["force"] = discrete->force;
  result["stable"] = discrete->stable;
  result["closure"] = discrete->closure;
  result["iterations"] = discrete->iterations;
  result["elastica"] = analytic ? elasticaToJson(analytic->elastica) : ordered_json();
  result["deviation"] = analytic ? ordered_json(analytic->deviation) : ordered_json();
  result["message"] = analytic ? std::string() : analytic.error().message;
  result["seconds"] = seconds;
  return result;
}

}  // namespace

Result<CaseAnswer> bvpCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, bvpCase);
}

Result<CaseAnswer> discreteCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, discreteCase);
}

}  // namespace bw::cases
