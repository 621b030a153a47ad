// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/elastica_scaled.h"

#include <algorithm>
#include <cmath>

namespace bw::elastica {

ScaledElastica scaled(const Elastica& elastica) {
  ScaledElastica result;
  const Elastica::Anchor* anchor = elastica.anchor();
  result.point = anchor ? anchor->point : elastica.start();
  result.angle = anchor ? anchor->angle : elastica.startAngle();
  result.at = anchor ? anchor->at : 0;
  const double bend = anchor ? anchor->curvature : elastica.startCurvature();
  const double rootForce = std::sqrt(std::hypot(elastica.force().x(), elastica.force().y()));
  const double rate = std::max({std::abs(bend), rootForce, 1 / elastica.length()});
  const int exponent = std::ilogb(rate) + 1;
  result.unit = std::ldexp(1.0, -exponent);
  result.length = elastica.length() / result.unit;
  const long double cosine = std::cos(static_cast<long double>(result.angle));
  const long double sine = std::sin(static_cast<long double>(result.angle));
  result.cosine = static_cast<double>(cosine);
  result.sine = static_cast<double>(sine);
  long double curvature = std::ldexp(bend, -exponent);
  long double tangential = 0;
  long double normal = 0;
  if (anchor) {
    tangential = std::ldexp(anchor->force.x(), -2 * exponent);
    normal = std::ldexp(anchor->force.y(), -2 * exponent);
    result.straight = anchor->straight / result.unit;
  } else {
    const long double lambda1 = std::ldexp(elastica.force().x(), -2 * exponent);
    const long double lambda2 = std::ldexp(elastica.force().y(), -2 * exponent);
    tangential = lambda1 * cosine + lambda2 * sine;
    normal = lambda2 * cosine - lambda1 * sine;
  }
  const auto set = [&](double sign, FlowParameters& flow, ElasticaInvariants& known) {
    long double k = curvature;
    long double fn = normal;
    if (result.straight > 0) {
      // Both ends of the straight stretch lie on the way out of it: κ = ±√f χ, f_n = f χ.
      const long double root = std::sqrt(std::hypot(tangential, normal));
      if (curvature == 0) {
        k = sign * normal / root;
      } else {
        fn = sign * curvature * root;
      }
    }
    flow.curvature = static_cast<double>(k);
    flow.tangential = static_cast<double>(tangential);
    flow.normal = static_cast<double>(fn);
    known = invariants(k, tangential, fn);
    if (anchor) {
      // All its terms are told with all their digits.
      known.complementScale =
          known.force * known.apexCosine * known.apexCosine + 0.25 * flow.curvature * flow.curvature;
    }
  };
  set(1, result.flow, result.known);
  if (result.straight > 0) {
    set(-1, result.flowBack, result.knownBack);
  } else {
    result.flowBack = result.flow;
    result.knownBack = result.known;
  }
  return result;
}

}  // namespace bw::elastica
