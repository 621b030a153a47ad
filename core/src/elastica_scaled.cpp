// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica_scaled.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jacobi.h"

namespace bw::detail {

ScaledElastica scaled(const Elastica& elastica) {
  ScaledElastica result;
  result.cosine = std::cos(elastica.startAngle());
  result.sine = std::sin(elastica.startAngle());
  const double lambda1 = elastica.force().x();
  const double lambda2 = elastica.force().y();
  const double rootForce = std::sqrt(std::hypot(lambda1, lambda2));
  const double rate = std::max({std::abs(elastica.startCurvature()), rootForce, 1 / elastica.length()});
  result.unit = 1 / rate;
  result.flow.curvature = elastica.startCurvature() / rate;
  // Divided twice, since the square of a small rate may fall below the smallest double.
  result.flow.tangential = (lambda1 * result.cosine + lambda2 * result.sine) / rate / rate;
  result.flow.normal = (lambda2 * result.cosine - lambda1 * result.sine) / rate / rate;
  result.length = elastica.length() * rate;
  return result;
}

ElasticaInvariants invariants(const FlowParameters& parameters) {
  const double ft = parameters.tangential;
  const double fn = parameters.normal;
  const double halfCurvature = 0.5 * std::abs(parameters.curvature);
  ElasticaInvariants result;
  const double f = result.force = std::hypot(ft, fn);
  // f σ² = (f − f_t)/2 and f δ² = (f + f_t)/2, each without cancellation.
  double forceSine = 0;    // √f σ
  double forceCosine = 0;  // √f δ
  if (f > 0) {
    const double larger = std::sqrt(0.5 * (f + std::abs(ft)));
    const double smaller = 0.5 * std::abs(fn) / larger;
    forceSine = ft >= 0 ? smaller : larger;
    forceCosine = ft >= 0 ? larger : smaller;
    const double rootForce = std::sqrt(f);
    result.apexSine = (fn > 0 ? -forceSine : forceSine) / rootForce;
    result.apexCosine = forceCosine / rootForce;
  }
  const double omega = result.halfPeakCurvature = std::hypot(halfCurvature, forceSine);
  result.complement = (forceCosine - halfCurvature) * (forceCosine + halfCurvature);

  // k = 1 is never told from its neighbours within rounding: its period is that of the nearest double beyond it.
  constexpr double kSmallestComplement = 1e-16;  // of the modulus, hence about the square root of double precision squared
  const double scale = std::max(std::sqrt(f), omega);
  if (scale > 0) {
    const double root = std::max(std::sqrt(std::abs(result.complement)), kSmallestComplement * scale);
    const double agm = arithmeticGeometricMean(scale, root);
    const bool inflectional = result.complement >= 0;
    result.period = (inflectional ? 2 : 1) * std::numbers::pi / agm;
    result.periodTurning = inflectional ? 0 : std::copysign(2 * std::numbers::pi, parameters.curvature);
  }
  return result;
}

}  // namespace bw::detail
