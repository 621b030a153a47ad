// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica_scaled.h"

#include <algorithm>
#include <cmath>

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

}  // namespace bw::detail
