// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/fit/elastica_fit.h"

#include <span>

#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;

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

}  // namespace

Result<CaseAnswer> fitCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, fitCase);
}

Result<std::string> fitCaseFromCsv(std::string_view text) {
  const Result<std::vector<Eigen::Vector2d>> points = pointsFromCsv(text);
  if (!points) return passOn(points.error());
  return json{{"curve", {{"type", "points"}, {"points", *points}}}}.dump();
}

}  // namespace bw::cases
