// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/elastica_scaled.h"

#include <algorithm>
#include <cmath>

namespace bw::detail {

ScaledElastica scaled(const Elastica& elastica) {
  ScaledElastica result;
  const double rootForce = std::sqrt(std::hypot(elastica.force().x(), elastica.force().y()));
  const double rate = std::max({std::abs(elastica.startCurvature()), rootForce, 1 / elastica.length()});
  const int exponent = std::ilogb(rate) + 1;
  result.unit = std::ldexp(1.0, -exponent);
  const long double curvature = std::ldexp(elastica.startCurvature(), -exponent);
  const long double lambda1 = std::ldexp(elastica.force().x(), -2 * exponent);
  const long double lambda2 = std::ldexp(elastica.force().y(), -2 * exponent);
  const long double cosine = std::cos(static_cast<long double>(elastica.startAngle()));
  const long double sine = std::sin(static_cast<long double>(elastica.startAngle()));
  const long double tangential = lambda1 * cosine + lambda2 * sine;
  const long double normal = lambda2 * cosine - lambda1 * sine;
  result.cosine = static_cast<double>(cosine);
  result.sine = static_cast<double>(sine);
  result.flow.curvature = static_cast<double>(curvature);
  result.flow.tangential = static_cast<double>(tangential);
  result.flow.normal = static_cast<double>(normal);
  result.known = invariants(curvature, tangential, normal);
  result.length = elastica.length() / result.unit;
  return result;
}

}  // namespace bw::detail
