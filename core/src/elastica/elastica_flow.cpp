// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "elastica/elastica_flow.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw::elastica {

namespace {

/// The arithmetic-geometric mean of a > 0 and b > 0, to full accuracy: K(k) = π / (2 agm(1, sqrt(1 − k²))).
double arithmeticGeometricMean(double a, double b) {
  // Quadratic convergence: from a ratio of 1e-200 nine steps, from 1e-16 six; the limit is never met.
  constexpr int kMaxSteps = 40;
  constexpr double kHalfPrecision = 1e-9;  // the next step is exact to double precision
  for (int i = 0; i < kMaxSteps; ++i) {
    const double mean = 0.5 * (a + b);
    const bool last = std::abs(a - b) <= kHalfPrecision * mean;
    b = std::sqrt(a) * std::sqrt(b);
    a = mean;
    if (last) {
      break;
    }
  }
  return a;
}

}  // namespace

ElasticaInvariants invariants(long double curvature, long double tangential, long double normal) {
  using Real = long double;
  const Real halfCurvature = 0.5L * std::abs(curvature);
  const Real f = std::hypot(tangential, normal);
  ElasticaInvariants result;
  result.force = static_cast<double>(f);
  result.complementScale = result.force;
  Real forceSine = 0;    // √f |σ|
  Real forceCosine = 0;  // √f δ
  if (f > 0) {
    // f σ² = (f − f_t)/2 and f δ² = (f + f_t)/2, of which one is a sum and the other follows from f_n = 2 f
    // |σ| δ.
    const Real larger = std::sqrt(0.5L * (f + std::abs(tangential)));
    const Real smaller = 0.5L * std::abs(normal) / larger;
    forceSine = tangential >= 0 ? smaller : larger;
    forceCosine = tangential >= 0 ? larger : smaller;
    const Real rootForce = std::sqrt(f);
    result.apexSine = static_cast<double>((normal > 0 ? -forceSine : forceSine) / rootForce);
    result.apexCosine = static_cast<double>(forceCosine / rootForce);
  }
  result.halfPeakCurvature = static_cast<double>(std::hypot(halfCurvature, forceSine));
  result.complement = static_cast<double>((forceCosine - halfCurvature) * (forceCosine + halfCurvature));
  return result;
}

double periodLength(const ElasticaInvariants& known) {
  const double scale = std::max(std::sqrt(known.force), known.halfPeakCurvature);
  if (scale == 0) {
    return std::numeric_limits<double>::infinity();
  }
  constexpr double kSmallestModulus = 1e-16;  // complementary; below it the period has no certain digit
  const double root =
      std::max(std::sqrt(std::abs(known.complement)), kSmallestModulus * std::sqrt(known.complementScale));
  const double quarters = known.hasInflections() ? 4 : 2;
  return quarters * 0.5 * kPi / arithmeticGeometricMean(scale, root);
}

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
