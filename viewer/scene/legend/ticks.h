// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bw::scene {

/// The step 1, 2 or 5 × 10ⁿ that divides `span` (> 0) into about `count` parts.
double roundStep(double span, int count);

/// The smallest range with round ends that holds [low, high].
std::pair<double, double> roundRange(double low, double high, int count);

/// Round numbers in [low, high].
struct Ticks {
  std::vector<double> values;
  double step = 1;
  int decimals = 0;  ///< that the step needs
};
Ticks ticksIn(double low, double high, int count);

/// The text of a number with a true minus sign, and a plus sign if `sign`; zero has none.
std::string tickText(double value, int decimals, bool sign);

}  // namespace bw::scene
