// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fit/fit_projection.h"

namespace bw::fit {

/// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
inline constexpr std::size_t kManyNodes = 64;
inline constexpr int kCoarseNodes = 32;

/// The best fit without constraints from some shapes; if `more` is set and the result is poor, also from
/// others (start_rules.h). Done on `coarse` and finished on `full`, if these are not the same. Empty if no
/// start can be placed.
std::optional<FitSolution> freeFit(const FitTarget& full, const FitTarget& coarse,
                                   const FitObjective& objective, const std::vector<Shape>& shapes,
                                   bool more);

}  // namespace bw::fit
