// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/piecewise/piecewise_fit.h"

#include <algorithm>

#include "bw/core/base/units.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr int kMostPieces = 100;
constexpr double kHuge = 1e15;

PiecewiseOptions optionsFromJson(ObjectReader& reader, const PlanarCurve& curve) {
  PiecewiseOptions options;
  const json* splits = reader.member("splits");
  if (splits && splits->is_array()) {
    std::vector<double>& parameters = options.parameters;
    reader.take(readNumbers(splits, "splits"), parameters);
    // The ends of the curve may be named or not.
    if (!parameters.empty() && parameters.front() == curve.start()) parameters.erase(parameters.begin());
    if (!parameters.empty() && parameters.back() == curve.end()) parameters.pop_back();
    options.splits = PiecewiseOptions::Splits::given;
    if (reader.has("pieces")) reader.complain("pieces", "give either a list of splits or a number of pieces");
  } else {
    int word = 0;
    reader.word("splits", {"uniform", "optimised"}, word);
    options.splits = word == 1 ? PiecewiseOptions::Splits::optimised : PiecewiseOptions::Splits::uniform;
    reader.integer("pieces", options.pieces, 1, kMostPieces);
  }
  reader.number("tolerance", options.tolerance, 1e-12, kHuge);
  if (options.tolerance) {
    if (!reader.has("pieces")) options.pieces = 20;
  } else if (!reader.has("pieces") && !(splits && splits->is_array())) {
    reader.complain("pieces", "the case needs splits, a number of pieces or a tolerance");
  }
  double degrees = 0;
  reader.number("position", options.position, 0, kHuge);
  reader.number("angle_deg", degrees, 0, 90);
  options.angle = fromDegrees(degrees);
  int continuity = 0;
  reader.word("continuity", {"G1", "G2"}, continuity);
  options.curvature = continuity == 1;
  reader.number("max_curvature", options.maxCurvature, 0, kHuge);
  reader.boolean("endpoints", options.endpoints);
  reader.boolean("tangents", options.tangents);
  return options;
}

Result<ordered_json> piecewiseCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  const json* shape = reader.member("curve");
  reader.need("curve", "the case needs the key curve");
  if (!shape) return passOn(reader.finish().error());
  const Result<PlanarCurve> curve = curveFromJson(*shape, "curve");
  if (!curve) return passOn(curve.error());
  const PiecewiseOptions options = optionsFromJson(reader, *curve);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<PiecewiseResult> fit = fitPiecewise(*curve, options);
  if (!fit) return passOn(fit.error());
  if (fit->status == FitStatus::infeasible) return fail(ErrorCode::noSolution, fit->message, "position");
  limited = fit->status == FitStatus::iterationLimit || !fit->withinTolerance;
  ordered_json result;
  result["elastica"] = json::array();
  result["pieces"] = json::array();
  for (std::size_t i = 0; i < fit->pieces.size(); ++i) {
    result["elastica"].push_back(elasticaToJson(fit->pieces[i]));
    result["pieces"].push_back({{"parameters", {fit->splits[i], fit->splits[i + 1]}},
                                {"R4", fit->R4[i]},
                                {"hausdorff", fit->hausdorff[i]},
                                {"max_curvature", fit->pieces[i].maxCurvature()}});
  }
  result["splits"] = fit->splits;
  result["joints"] = json::array();
  for (const PiecewiseJoint& joint : fit->joints)
    result["joints"].push_back(
        {{"gap", joint.gap}, {"angle_deg", toDegrees(joint.angle)}, {"curvature_jump", joint.curvatureJump}});
  result["R4"] = fit->totalR4;
  result["hausdorff"] = *std::max_element(fit->hausdorff.begin(), fit->hausdorff.end());
  result["iterations"] = fit->iterations;
  result["status"] = fitStatusName(fit->status);
  result["message"] = fit->message;
  result["seconds"] = fit->seconds;
  return result;
}

}  // namespace

Result<CaseAnswer> piecewiseCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, piecewiseCase);
}

}  // namespace bw::cases
