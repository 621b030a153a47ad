// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_projection.h"

namespace bw::detail {

/// A fit (R4) at least this good is taken; a worse one is compared with descents from other starts. Chosen on
/// 1900 random curves: none better than 6.4e-3 was ever improved by another start.
inline constexpr double kGoodFit = 5e-3;
/// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
inline constexpr std::size_t kManyNodes = 64;
inline constexpr int kCoarseNodes = 32;

/// A fit without end conditions and bounds.
struct FreeFitResult {
  Placement placement;
  double value = 0;  ///< of the objective
  int iterations = 0;
  bool converged = false;
};

/// The best of the descents from some starts; if `more` is set and the result is poor, also from the nearest
/// places of the atlas, and under H1 and H2 from an arc, a line and two S-shapes. Done on `coarse` and
/// finished on `full`, if these are not the same. Empty if no start can be placed.
std::optional<FreeFitResult> freeFit(const FitTarget& full, const FitTarget& coarse,
                                     const FitObjective& objective, const std::vector<Shape>& starts,
                                     bool more);

}  // namespace bw::detail
