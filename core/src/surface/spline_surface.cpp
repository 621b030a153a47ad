// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/spline_surface.h"

#include <algorithm>
#include <array>

namespace bw {

namespace {

/// Index i with knots[i] ≤ t < knots[i+1], the last non-empty span at the end.
int findSpan(const std::vector<double>& knots, int degree, int poles, double t) {
  const auto first = knots.begin() + degree, last = knots.begin() + poles;
  const auto it = std::upper_bound(first, last, t);
  return std::max(degree, int(it - knots.begin()) - 1);
}

}  // namespace

std::array<double, 4> splineBasis(const std::vector<double>& knots, int degree, int span, double t) {
  std::array<double, 4> n{1.0};
  std::array<double, 4> left{}, right{};
  for (int j = 1; j <= degree; ++j) {
    left[j] = t - knots[std::size_t(span + 1 - j)];
    right[j] = knots[std::size_t(span + j)] - t;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double term = n[r] / (right[r + 1] + left[j - r]);
      n[r] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    n[j] = saved;
  }
  return n;
}

Eigen::Vector3d SplineSurface::value(double u, double v) const {
  u = std::clamp(u, knotsU.front(), knotsU.back());
  v = std::clamp(v, knotsV.front(), knotsV.back());
  const int spanU = findSpan(knotsU, degreeU, polesU, u);
  const int spanV = findSpan(knotsV, degreeV, polesV, v);
  const auto bu = splineBasis(knotsU, degreeU, spanU, u);
  const auto bv = splineBasis(knotsV, degreeV, spanV, v);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j <= degreeV; ++j) {
    const std::size_t row = std::size_t(spanV - degreeV + j) * polesU + (spanU - degreeU);
    Eigen::Vector3d line = Eigen::Vector3d::Zero();
    for (int i = 0; i <= degreeU; ++i) line += bu[i] * poles[row + i];
    sum += bv[j] * line;
  }
  return sum;
}

}  // namespace bw
