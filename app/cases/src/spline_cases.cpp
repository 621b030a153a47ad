// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/elastica/elastica_stability.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;

/// What all kinds of spline are made from.
struct Input {
  std::vector<Eigen::Vector2d> points;
  DuckOptions options;
};

ordered_json piecesToJson(const std::vector<Elastica>& pieces) {
  ordered_json list = ordered_json::array();
  for (const Elastica& piece : pieces) {
    ordered_json object;
    object["elastica"] = elasticaToJson(piece);
    object["energy"] = piece.energy();
    object["max_curvature"] = piece.maxCurvature();
    object["stable"] = isClampedStable(piece);
    list.push_back(std::move(object));
  }
  return list;
}

Result<ordered_json> proxyOf(const json* value) {
  const Result<std::vector<Eigen::Vector2d>> poles = readPoints(value, "poles");
  if (!poles) return passOn(poles.error());
  if (poles->size() != 4)
    return fail(ErrorCode::badInput, "poles must hold the 4 poles of a cubic Bézier curve", "poles",
                double(poles->size()), 4);
  const Result<BezierProxy> proxy = elasticaOfBezier({(*poles)[0], (*poles)[1], (*poles)[2], (*poles)[3]});
  if (!proxy) return passOn(proxy.error());
  ordered_json result;
  result["elastica"] = elasticaToJson(proxy->elastica);
  result["deviation"] = proxy->deviation;
  result["predicted_deviation"] = proxy->predicted;
  result["length"] = proxy->length;
  result["energy"] = proxy->elastica.energy();
  result["bezier_energy"] = proxy->bezierEnergy;
  return result;
}

Result<ordered_json> bezierPieces(const Input& input) {
  const Result<std::vector<CubicPoles>> chain = bezierChain(input.points, input.options.tangents);
  if (!chain) return passOn(chain.error());
  ordered_json result;
  result["pieces"] = ordered_json::array();
  for (const CubicPoles& poles : *chain) {
    const Result<PlanarCurve> curve = PlanarCurve::bezier({poles.begin(), poles.end()});
    if (!curve) return passOn(curve.error());
    const Result<ProxyPrediction> prediction = predictElastica(*curve);
    if (!prediction) return passOn(prediction.error());
    ordered_json piece;
    piece["poles"] = poles;
    piece["length"] = curve->length();
    piece["predicted_deviation"] = prediction->deviation;
    result["pieces"].push_back(std::move(piece));
  }
  return result;
}

Result<ordered_json> cubicSpline(const Input& input) {
  const Result<PlanarCurve> curve =
      cubicSplineThrough(input.points, input.options.startAngle, input.options.endAngle);
  if (!curve) return passOn(curve.error());
  ordered_json result;
  result["curve"] = {
      {"type", "bspline"}, {"degree", 3}, {"knots", curve->knots()}, {"poles", curve->poles()}};
  result["length"] = curve->length();
  return result;
}

Result<ordered_json> elasticSpline(const Input& input) {
  const Result<DuckSpline> spline = splineThroughDucks(input.points, input.options);
  if (!spline) return passOn(spline.error());
  ordered_json result;
  result["pieces"] = piecesToJson(spline->pieces);
  result["length"] = spline->length;
  result["energy"] = spline->energy;
  result["stable"] = spline->stable;
  result["largest_gap"] = spline->largestGap;
  result["largest_kink"] = spline->largestKink;
  result["largest_jump"] = spline->largestJump;
  result["iterations"] = spline->iterations;
  return result;
}

Result<ordered_json> splineCase(const json& object, bool&) {
  ObjectReader reader(object, "case");
  int kind = 0;
  reader.word("kind", {"elastica", "cubic", "bezier"}, kind);
  Input input;
  const json* poles = reader.member("poles");
  const json *points = nullptr, *tangents = nullptr, *lengths = nullptr;
  if (poles) {
    if (reader.has("kind"))
      reader.complain("kind", "a case with poles is compared with its elastica; it takes no kind");
  } else {
    points = reader.member("points");
    reader.need("points", "the case needs the key points, or poles of a Bézier curve");
    tangents = kind != 1 ? reader.given("tangents") : nullptr;
    if (kind != 2) {
      reader.number("start_angle", input.options.startAngle, -kHuge, kHuge);
      reader.number("end_angle", input.options.endAngle, -kHuge, kHuge);
    }
    if (kind == 0) {
      lengths = reader.member("lengths");
      std::optional<double> total;
      reader.number("total_length", total, -kHuge, kHuge);
      if (total) {
        input.options.mode = DuckOptions::Lengths::total;
        input.options.totalLength = *total;
        if (lengths) reader.complain("total_length", "give either lengths or total_length, not both");
      }
    }
  }
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const auto begin = std::chrono::steady_clock::now();
  Result<ordered_json> result = ordered_json();
  if (poles) {
    result = proxyOf(poles);
  } else {
    reader.take(readPoints(points, "points"), input.points);
    if (tangents) reader.take(readNumbers(tangents, "tangents"), input.options.tangents);
    if (lengths && !lengths->is_null()) {
      reader.take(readNumbers(lengths, "lengths"), input.options.lengths);
      input.options.mode = DuckOptions::Lengths::given;
    }
    if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
    result = kind == 0 ? elasticSpline(input) : kind == 1 ? cubicSpline(input) : bezierPieces(input);
  }
  if (result)
    (*result)["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace

Result<CaseAnswer> splineCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, splineCase);
}

}  // namespace bw::cases
