// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace bw::geometry {

inline constexpr int kRootIterations = 60;
inline constexpr double kBracketed = 1e-15;  ///< relative: a narrower bracket holds one double

/// A root of f in [a, b], where it changes sign: Newton's method, kept within the bracket by bisection. `f(t,
/// slope)` gives the value and sets the slope; `fa`, `fb` are its values at the ends. Ends where |f| falls
/// below `tolerance`, or after `kRootIterations`.
template <class Function>
double bracketedRoot(const Function& f, double a, double fa, double b, double fb, double tolerance) {
  if (fa == 0) return a;
  if (fb == 0) return b;
  double t = a + (b - a) * (fa / (fa - fb));
  for (int i = 0; i < kRootIterations; ++i) {
    double slope = 0;
    const double ft = f(t, slope);
    if (std::abs(ft) < tolerance) break;
    if ((ft < 0) == (fa < 0)) {
      a = t;
      fa = ft;
    } else {
      b = t;
      fb = ft;
    }
    double next = slope != 0 ? t - ft / slope : a;
    if (!(next > std::min(a, b) && next < std::max(a, b))) next = 0.5 * (a + b);
    if (next == t || std::abs(b - a) <= kBracketed * (std::abs(a) + std::abs(b))) break;
    t = next;
  }
  return t;
}

}  // namespace bw::geometry
