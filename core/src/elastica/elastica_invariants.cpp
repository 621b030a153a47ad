// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/elastica_invariants.h"

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

}  // namespace bw::elastica
