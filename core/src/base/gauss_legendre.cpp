// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "base/gauss_legendre.h"

#include <array>
#include <cmath>

#include "bw/core/base/result.h"
#include "bw/core/base/units.h"

namespace bw::detail {
namespace {

struct Table {
  // Rule n starts at n (n − 1) / 2.
  static constexpr int kSize = kMaxGaussNodes * (kMaxGaussNodes + 1) / 2;
  std::array<double, kSize> nodes;
  std::array<double, kSize> weights;

  Table() {
    for (int n = 1; n <= kMaxGaussNodes; ++n) {
      const int offset = n * (n - 1) / 2;
      for (int i = 0; i < n; ++i) {
        // Newton on the Legendre polynomial from the usual cosine estimate; quadratic, so a few steps reach
        // rounding.
        double x = std::cos(kPi * (n - i - 0.25) / (n + 0.5));
        double slope = 1;
        for (int step = 0; step < 8; ++step) {
          double previous = 1;
          double p = x;
          for (int k = 2; k <= n; ++k) {
            const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
            previous = p;
            p = next;
          }
          slope = n * (x * p - previous) / (x * x - 1);
          x -= p / slope;
        }
        nodes[offset + i] = 0.5 * (1 + x);
        weights[offset + i] = 1 / ((1 - x * x) * slope * slope);
      }
    }
  }
};

}  // namespace

GaussRule gaussRule(int n) {
  BW_CHECK(n >= 1 && n <= kMaxGaussNodes);
  static const Table table;
  const auto offset = static_cast<std::size_t>(n * (n - 1) / 2);
  const auto count = static_cast<std::size_t>(n);
  return {std::span<const double>(table.nodes).subspan(offset, count),
          std::span<const double>(table.weights).subspan(offset, count)};
}

}  // namespace bw::detail
