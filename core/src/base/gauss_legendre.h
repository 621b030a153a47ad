// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace bw::detail {

/// Largest number of nodes that `gaussRule` knows.
inline constexpr int kMaxGaussNodes = 32;

/// A Gauss–Legendre rule on [0, 1], nodes ascending; weights sum to 1. Exact for polynomials of degree 2n
/// − 1.
struct GaussRule {
  std::span<const double> nodes;
  std::span<const double> weights;
};

/// The rule with n nodes, 1 ≤ n ≤ kMaxGaussNodes. All rules are computed once, at the first call; safe from
/// several threads.
GaussRule gaussRule(int n);

}  // namespace bw::detail
