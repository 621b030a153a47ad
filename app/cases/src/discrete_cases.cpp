// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/discrete/discrete_elastica.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

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

Result<CaseAnswer> discreteCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, discreteCase);
}

}  // namespace bw::cases
