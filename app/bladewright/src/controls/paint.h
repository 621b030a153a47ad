// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace bw::app {

/// Results out of date stay visible, so faint.
inline constexpr double kStaleOpacity = 0.6;

/// The largest of 1, 2, 5 · 10ⁿ that is not above `value`; 0 for values ≤ 0.
inline double roundBelow(double value) {
  if (!(value > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (double step : {5.0, 2.0})
    if (step * power <= value) return step * power;
  return power;
}

}  // namespace bw::app
