// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/relax/curve_relaxation.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e12;

}  // namespace

Result<ordered_json> answerRelaxation(ObjectReader& reader, bool& limited) {
  const json* shape = reader.member("curve");
  reader.need("curve", "the case needs the key curve");
  RelaxOptions options;
  reader.need("tolerance", "the case needs the key tolerance, in mm");
  reader.number("tolerance", options.tolerance, 1e-12, kHuge);
  reader.integer("degree", options.degree, 3, 5);
  reader.integer("spans", options.spans, 4, 200);
  reader.boolean("endpoints", options.endpoints);
  reader.boolean("tangents", options.tangents);
  reader.number("elastica_tolerance", options.elasticaTolerance, 1e-12, 1);
  int word = 0;
  if (const json* length = reader.member("length")) {
    if (length->is_number()) {
      options.length = 0;
      reader.number("length", *options.length, 1e-12, kHuge);
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

Result<CaseAnswer> relaxCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, [](const json& object, bool& limited) {
    ObjectReader reader(object, "case");
    return answerRelaxation(reader, limited);
  });
}

}  // namespace bw::cases
