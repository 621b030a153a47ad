// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica_invariants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jacobi.h"

namespace bw::detail {

ElasticaInvariants invariants(const FlowParameters& parameters) {
  const double ft = parameters.tangential;
  const double fn = parameters.normal;
  const double halfCurvature = 0.5 * std::abs(parameters.curvature);
  ElasticaInvariants result;
  const double f = result.force = std::hypot(ft, fn);
  double forceSine = 0;    // √f |σ|
  double forceCosine = 0;  // √f δ
  if (f > 0) {
    // f σ² = (f − f_t)/2 and f δ² = (f + f_t)/2, of which one is a sum and the other follows from f_n = 2 f
    // |σ| δ.
    const double larger = std::sqrt(0.5 * (f + std::abs(ft)));
    const double smaller = 0.5 * std::abs(fn) / larger;
    forceSine = ft >= 0 ? smaller : larger;
    forceCosine = ft >= 0 ? larger : smaller;
    const double rootForce = std::sqrt(f);
    result.apexSine = (fn > 0 ? -forceSine : forceSine) / rootForce;
    result.apexCosine = forceCosine / rootForce;
  }
  result.halfPeakCurvature = std::hypot(halfCurvature, forceSine);
  result.complement = (forceCosine - halfCurvature) * (forceCosine + halfCurvature);
  return result;
}

double periodLength(const ElasticaInvariants& known) {
  const double scale = std::max(std::sqrt(known.force), known.halfPeakCurvature);
  if (scale == 0) {
    return std::numeric_limits<double>::infinity();
  }
  constexpr double kSmallestModulus = 1e-16;  // complementary; below it the period has no certain digit
  const double root = std::max(std::sqrt(std::abs(known.complement)), kSmallestModulus * scale);
  const double quarters = known.hasInflections() ? 4 : 2;
  return quarters * 0.5 * std::numbers::pi / arithmeticGeometricMean(scale, root);
}

}  // namespace bw::detail
