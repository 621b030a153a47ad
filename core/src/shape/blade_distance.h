// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/shape/key_blades.h"

namespace bw::detail {

inline constexpr int kBladeSamples = 65;  ///< of a curve and of its blade, at even shares of their lengths

/// mm, the largest distance of a blade from so many samples of a curve, each at the same share of the length:
/// no smaller than that of the curves. Infinite where the numbers are no blade.
double distanceOf(const KeyBlade& blade, const std::vector<Eigen::Vector2d>& samples);

}  // namespace bw::detail
