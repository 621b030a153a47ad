// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/ticks.h"

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"

namespace bw::scene {

double roundStep(double span, int count) {
  if (!(span > 0) || !std::isfinite(span)) return 1;
  const double raw = span / std::max(1, count);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  // Geometric means of neighbours decide which of 1, 2, 5, 10 is nearest.
  return power * (lead < std::sqrt(2.0) ? 1 : lead < std::sqrt(10.0) ? 2 : lead < std::sqrt(50.0) ? 5 : 10);
}

std::pair<double, double> roundRange(double low, double high, int count) {
  if (!(high > low)) {
    const double half = std::max(std::abs(low) * 0.1, 0.5);
    low -= half;
    high += half;
  }
  const double step = roundStep(high - low, count), slack = 1e-9;
  return {std::floor(low / step + slack) * step, std::ceil(high / step - slack) * step};
}

Ticks ticksIn(double low, double high, int count) {
  Ticks ticks;
  if (!(high > low)) return ticks;
  ticks.step = roundStep(high - low, count);
  ticks.decimals = std::max(0, -int(std::floor(std::log10(ticks.step) + 1e-9)));
  const double slack = 1e-9;
  const auto first = (long long)(std::ceil(low / ticks.step - slack));
  const auto last = (long long)(std::floor(high / ticks.step + slack));
  for (long long i = first; i <= last && ticks.values.size() < 100; ++i)
    ticks.values.push_back(double(i) * ticks.step);
  return ticks;
}

std::string tickText(double value, int decimals, bool sign) {
  std::string text = fixedText(value, decimals);
  if (text.starts_with('-')) return "\u2212" + text.substr(1);
  if (sign && text.find_first_of("123456789") != std::string::npos) return "+" + text;
  return text;
}

}  // namespace bw::scene
