// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <utility>

#include "shape/shapes.h"

namespace bw::shape {

SplineInterpolation::SplineInterpolation(const std::vector<double>& at, int degree, std::vector<double> knots)
    : count_(int(at.size())),
      degree_(degree),
      knots_(std::move(knots)),
      band_(at.size() * std::size_t(2 * degree + 1), 0.0) {
  for (int i = 0; i < count_; ++i) {
    const auto above = std::upper_bound(knots_.begin() + degree, knots_.begin() + count_, at[std::size_t(i)]);
    const int span = int(above - knots_.begin()) - 1;
    const std::array<double, 4> basis = splineBasis(knots_, degree, span, at[std::size_t(i)]);
    for (int k = 0; k <= degree; ++k)
      if (basis[std::size_t(k)] != 0) entry(i, span - degree + k) = basis[std::size_t(k)];
  }
  // No minor of such a matrix is negative: it needs no exchange of rows.
  for (int k = 0; k < count_; ++k)
    for (int i = k + 1; i <= std::min(count_ - 1, k + degree_); ++i) {
      entry(i, k) /= entry(k, k);
      for (int j = k + 1; j <= std::min(count_ - 1, k + degree_); ++j)
        entry(i, j) -= entry(i, k) * entry(k, j);
    }
}

}  // namespace bw::shape
