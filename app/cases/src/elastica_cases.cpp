// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/elastica/elastica.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

Result<ordered_json> elasticaCase(const json& object, bool&) {
  ObjectReader reader(object, "case");
  const json* shape = reader.member("elastica");
  const json* at = reader.member("at");
  reader.need("elastica", "the case needs the key elastica");
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<Elastica> elastica = elasticaFromJson(*shape, "elastica");
  if (!elastica) return passOn(elastica.error());
  std::vector<double> arcs;
  if (at) reader.take(readNumbers(at, "at"), arcs);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const auto start = std::chrono::steady_clock::now();
  std::vector<Elastica::State> states(arcs.size());
  elastica->at(arcs, states);
  const double energy = elastica->energy();
  const std::vector<double> inflections = elastica->inflections();
  const double largest = elastica->maxCurvature();
  const bool crosses = elastica->selfIntersects();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ordered_json result;
  result["elastica"] = elasticaToJson(*elastica);
  ordered_json points = ordered_json::array(), angles = ordered_json::array(),
               curvatures = ordered_json::array();
  for (const Elastica::State& state : states) {
    points.push_back(state.point);
    angles.push_back(state.angle);
    curvatures.push_back(state.curvature);
  }
  result["points"] = points;
  result["angles"] = angles;
  result["curvatures"] = curvatures;
  result["energy"] = energy;
  result["inflections"] = inflections;
  result["max_curvature"] = largest;
  result["self_intersects"] = crosses;
  result["seconds"] = seconds;
  return result;
}

}  // namespace

Result<CaseAnswer> elasticaCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, elasticaCase);
}

}  // namespace bw::cases
