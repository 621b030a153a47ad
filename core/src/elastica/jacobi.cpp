// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/jacobi.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bw::detail {

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

double ellipticIntegralF(double s, double c, double d) {
  if (c == 0 && d == 0) {
    return std::copysign(std::numeric_limits<double>::infinity(), s);
  }
  // Carlson's R_F(c², d², 1) by duplication, then its series to seventh order about equal arguments
  // (B. C. Carlson, Numerical computation of real or complex elliptic integrals, 1995).
  double x = c * c;
  double y = d * d;
  double z = 1;
  constexpr int kMaxSteps = 400;
  constexpr double kSpread = 2e-3;  // series error is about kSpread^8
  double mean = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    mean = (x + y + z) / 3;
    const double spread = std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)});
    if (spread <= kSpread * mean) {
      break;
    }
    const double shift =
        std::sqrt(x) * std::sqrt(y) + std::sqrt(y) * std::sqrt(z) + std::sqrt(z) * std::sqrt(x);
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
  }
  const double dx = 1 - x / mean;
  const double dy = 1 - y / mean;
  const double dz = -dx - dy;
  const double e2 = dx * dy - dz * dz;
  const double e3 = dx * dy * dz;
  const double series = 1 + e2 * (-1.0 / 10 + e2 / 24 - 3 * e3 / 44 - 5 * e2 * e2 / 208) +
                        e3 * (1.0 / 14 + 3 * e3 / 104 + e2 * e2 / 16);
  return s * series / std::sqrt(mean);
}

}  // namespace bw::detail
