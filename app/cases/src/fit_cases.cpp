// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <chrono>
#include <span>

#include "bw/core/base/units.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/piecewise/piecewise_fit.h"
#include "bw/core/relax/curve_relaxation.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kLargest = 1e12, kHuge = 1e15;

/// The spline of least bending energy near a curve: reads the rest of a case and answers it
/// (docs/command-line.md, `relax`).
Result<ordered_json> answerRelaxation(ObjectReader& reader, bool& limited) {
  const json* shape = reader.member("curve");
  reader.need("curve", "the case needs the key curve");
  RelaxOptions options;
  reader.need("tolerance", "the case needs the key tolerance, in mm");
  reader.number("tolerance", options.tolerance, 1e-12, kLargest);
  reader.integer("degree", options.degree, 3, 5);
  reader.integer("spans", options.spans, 4, 200);
  reader.boolean("endpoints", options.endpoints);
  reader.boolean("tangents", options.tangents);
  reader.number("elastica_tolerance", options.elasticaTolerance, 1e-12, 1);
  int word = 0;
  if (const json* length = reader.member("length")) {
    if (length->is_number()) {
      options.length = 0;
      reader.number("length", *options.length, 1e-12, kLargest);
    } else {
      reader.word("length", {"free", "exact"}, word);
    }
  }
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<PlanarCurve> curve = curveFromJson(*shape, "curve");
  if (!curve) return passOn(curve.error());
  if (word == 1) options.length = curve->length();
  const auto start = std::chrono::steady_clock::now();
  const Result<RelaxResult> relaxed = relaxCurve(*curve, options);
  if (!relaxed) return passOn(relaxed.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  limited = relaxed->status == RelaxStatus::iterationLimit;
  ordered_json result;
  result["curve"] = {{"type", "bspline"},
                     {"degree", relaxed->curve.degree()},
                     {"knots", relaxed->curve.knots()},
                     {"poles", relaxed->curve.poles()}};
  result["length"] = relaxed->curve.length();
  result["length_error"] = relaxed->lengthError;
  result["energy"] = relaxed->energy;
  result["target_energy"] = relaxed->targetEnergy;
  result["target_error"] = relaxed->targetError;
  result["deviation"] = relaxed->deviation;
  result["active_bounds"] = relaxed->activeBounds;
  result["residual"] = relaxed->residual;
  result["is_elastica"] = relaxed->isElastica;
  result["elastica"] = relaxed->elastica ? elasticaToJson(*relaxed->elastica) : ordered_json();
  result["elastica_deviation"] =
      relaxed->elastica ? ordered_json(relaxed->elasticaDeviation) : ordered_json();
  result["gradient_norm"] = relaxed->gradientNorm;
  result["iterations"] = relaxed->iterations;
  result["status"] = relaxStatusName(relaxed->status);
  result["message"] = relaxed->message;
  result["seconds"] = seconds;
  return result;
}

FitOptions optionsFromJson(ObjectReader& reader) {
  FitOptions options;
  if (const json* length = reader.member("length")) {
    if (length->is_number()) {
      options.length = FitOptions::Length::given;
      reader.number("length", options.givenLength, 1e-12, kHuge);
    } else {
      int word = 0;
      reader.word("length", {"free", "exact"}, word);
      options.length = word == 1 ? FitOptions::Length::exact : FitOptions::Length::free;
    }
  }
  reader.number("length_tolerance", options.lengthTolerance, 0, kHuge);
  reader.boolean("endpoints", options.endpoints);
  reader.boolean("simple", options.simple);
  if (reader.given("max_inflections")) {
    int count = 0;
    reader.integer("max_inflections", count, 0, 1000);
    options.maxInflections = count;
  }
  reader.boolean("tangents", options.tangents);
  reader.number("max_curvature", options.maxCurvature, 0, kHuge);
  reader.number("curvature_range", options.curvatureRange, 1e-12, kHuge);
  reader.number("max_periods", options.maxPeriods, 1e-6, kHuge);
  int norm = 0, guess = 0;
  reader.word("norm", {"L2", "H1", "H2"}, norm);
  reader.word("guess", {"length", "count"}, guess);
  options.norm = FitOptions::Norm(norm);
  options.guess = FitOptions::Guess(guess);
  if (const json* initial = reader.given("initial"))
    reader.take(elasticaFromJson(*initial, "initial"), options.initial);
  return options;
}

// Keys that only one of the methods understands.
constexpr const char* kAnalyticKeys[] = {
    "max_curvature", "curvature_range", "max_periods", "max_inflections", "simple",
    "norm",          "guess",           "initial",     "epsilon",         "length_tolerance"};
constexpr const char* kNumericKeys[] = {"tolerance", "degree", "spans", "elastica_tolerance"};

void refuse(ObjectReader& reader, std::span<const char* const> keys, const char* method, const char* other) {
  for (const char* key : keys) {
    if (reader.has(key))
      reader.complain(key, std::string("the key ") + key + " belongs to the method \"" + other +
                               "\" and means nothing to the method \"" + method +
                               "\"; leave it out or change the method");
  }
}

Result<ordered_json> fitCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  int method = 0;
  reader.word("method", {"analytic", "numeric"}, method);
  if (method == 1) {
    refuse(reader, kAnalyticKeys, "numeric", "analytic");
    Result<ordered_json> result = answerRelaxation(reader, limited);
    if (result) (*result)["method"] = "numeric";
    return result;
  }
  refuse(reader, kNumericKeys, "analytic", "numeric");
  const json* shape = reader.member("curve");
  reader.need("curve", "the case needs the key curve");
  std::optional<double> epsilon;
  reader.number("epsilon", epsilon, 0, kHuge);
  const FitOptions options = optionsFromJson(reader);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<PlanarCurve> curve = curveFromJson(*shape, "curve");
  if (!curve) return passOn(curve.error());
  const Result<FitResult> fit = fitElastica(*curve, options);
  if (!fit) return passOn(fit.error());
  if (fit->status == FitStatus::infeasible)
    return fail(ErrorCode::noSolution,
                fit->message.empty() ? "no elastica meets all the constraints" : fit->message, "constraints");
  limited = fit->status == FitStatus::iterationLimit;
  ordered_json result;
  result["method"] = "analytic";
  result["elastica"] = elasticaToJson(fit->elastica);
  result["initial_elastica"] = elasticaToJson(fit->initial);
  result["R1"] = fit->R1;
  result["R2"] = fit->R2;
  result["R3"] = fit->R3;
  result["R3_star"] = fit->R3star;
  result["R4_initial"] = fit->R4initial;
  result["R4"] = fit->R4;
  // The guess alone tells it, also where the fit starts from elsewhere.
  const FitForecast forecast = options.initial ? forecastFit(*curve) : fit->forecast;
  result["R4_forecast"] = {{"R4", forecast.R4}, {"low", forecast.low}, {"high", forecast.high}};
  if (epsilon) {
    static constexpr const char* kVerdicts[] = {"yes", "no", "unsure"};
    result["approximable"] = kVerdicts[static_cast<int>(forecast.within(*epsilon))];
  }
  result["hausdorff"] = fit->hausdorff;
  result["gradient_norm"] = fit->gradientNorm;
  result["violation"] = fit->violation;
  result["iterations"] = fit->iterations;
  result["status"] = fitStatusName(fit->status);
  result["message"] = fit->message;
  result["seconds"] = fit->seconds;
  return result;
}

constexpr int kMostPieces = 100;
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

Result<CaseAnswer> relaxCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, [](const json& object, bool& limited) {
    ObjectReader reader(object, "case");
    return answerRelaxation(reader, limited);
  });
}

Result<CaseAnswer> fitCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, fitCase);
}

Result<std::string> fitCaseFromCsv(std::string_view text) {
  const Result<std::vector<Eigen::Vector2d>> points = pointsFromCsv(text);
  if (!points) return passOn(points.error());
  return json{{"curve", {{"type", "points"}, {"points", *points}}}}.dump();
}

Result<CaseAnswer> piecewiseCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, piecewiseCase);
}

}  // namespace bw::cases
