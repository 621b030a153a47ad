// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/legend_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bw::scene {

namespace {

constexpr int kTicks = 6;

}  // namespace

FieldSummary summarize(const std::vector<double>& values) {
  FieldSummary summary{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 0};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    summary.min = std::min(summary.min, v);
    summary.max = std::max(summary.max, v);
    ++summary.count;
  }
  if (summary.count == 0) summary = {};
  return summary;
}

std::pair<double, double> legendRangeOf(const std::string& field, const FieldSummary& summary,
                                        const Style& style) {
  std::pair<double, double> range;
  if (field == "deviation") {
    const double reach = std::max({std::abs(summary.min), std::abs(summary.max), 2 * style.tolerance, 1e-3});
    const double end = roundRange(0, reach, kTicks / 2).second;
    range = {-end, end};
  } else {
    // A scale that begins near zero begins at zero.
    const double low = summary.min > 0 && summary.min < 0.5 * summary.max ? 0 : summary.min;
    range = roundRange(low, summary.max, kTicks);
  }
  const auto finite = [](const std::optional<double>& v) { return v && std::isfinite(*v); };
  if (finite(style.rangeMin)) range.first = *style.rangeMin;
  if (finite(style.rangeMax)) range.second = *style.rangeMax;
  if (!(range.second > range.first))
    range.second = range.first + std::max(1e-6, 1e-6 * std::abs(range.first));
  return range;
}

Ticks legendTicks(const std::pair<double, double>& range) {
  return ticksIn(range.first, range.second, kTicks);
}

}  // namespace bw::scene
