// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/discrete/discrete_elastica.h"
#include "case_runner.h"
#include "elastica_json.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e12;

Result<void> readEnds(ObjectReader& reader, ClampedEnds& ends) {
  for (const char* key : {"start", "end", "start_angle", "end_angle", "length"})
    reader.need(key, std::string("the case needs the key ") + key);
  for (const auto& [key, point] : {std::pair{"start", &ends.start}, std::pair{"end", &ends.end}}) {
    const json* value = reader.member(key);
    if (!value) continue;
    const Result<Eigen::Vector2d> read = readPoint(value, key);
    if (!read) return passOn(read.error());
    *point = *read;
  }
  reader.number("start_angle", ends.startAngle, -kHuge, kHuge);
  reader.number("end_angle", ends.endAngle, -kHuge, kHuge);
  reader.number("length", ends.length, 1e-9, kHuge);
  return {};
}

Result<void> readGuide(ObjectReader& reader, DiscreteOptions& options) {
  if (const json* initial = reader.member("initial"); initial && !initial->is_null()) {
    if (initial->is_array()) {
      Result<std::vector<double>> angles = readNumbers(initial, "initial");
      if (!angles) return passOn(angles.error());
      options.turningAngles = std::move(*angles);
    } else {
      const Result<Elastica> shape = elasticaFromJson(*initial, "initial");
      if (!shape) return passOn(shape.error());
      options.shape = *shape;
    }
  }
  if (const json* sketch = reader.member("sketch"); sketch && !sketch->is_null()) {
    const Result<PlanarCurve> curve = curveFromJson(*sketch, "sketch");
    if (!curve) return passOn(curve.error());
    options.sketch = *curve;
  }
  return {};
}

Result<ordered_json> discreteCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  ClampedEnds ends;
  DiscreteOptions options;
  if (Result<void> ok = readEnds(reader, ends); !ok) return passOn(ok.error());
  if (Result<void> ok = readGuide(reader, options); !ok) return passOn(ok.error());
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
  result["vertices"] = pointsToJson(discrete->vertices);
  result["turning_angles"] = discrete->turningAngles;
  result["turning"] = discrete->ends.endAngle - discrete->ends.startAngle;
  result["energy"] = discrete->energy;
  result["squared_turning"] = discrete->squaredTurning;
  result["force"] = {discrete->force.x(), discrete->force.y()};
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
