// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/legend_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"

namespace bw::scene {

namespace {

constexpr int kTicks = 6;
constexpr double kDeviationFloor = 0.1;  ///< of the tolerance
constexpr double kNearTolerance = 0.5;   ///< of the tolerance: from here on the legend shows all of it
constexpr double kSpanFloor = 0.1;       ///< of the largest value
constexpr double kLeastSpan = 1e-3;      ///< of a deviation, mm, and of what is no map of ours

std::pair<double, double> deviationRange(const FieldSummary& summary, double tolerance) {
  const double reach = std::max(std::abs(summary.min), std::abs(summary.max));
  double end = tolerance;
  if (reach > tolerance || reach <= kNearTolerance * tolerance)
    end = roundRange(0, std::max({reach, kDeviationFloor * tolerance, kLeastSpan}), kTicks / 2).second;
  return {-end, end};
}

std::pair<double, double> plainRange(const std::string& field, const FieldSummary& summary) {
  double low = summary.min, high = summary.max;
  // A scale that begins near zero begins at zero.
  if (low > 0 && low < 0.5 * high) low = 0;
  const double size = std::max(std::abs(low), std::abs(high));
  const MapInfo* map = cutMap(field);
  const double floor = std::max(kSpanFloor * size, map ? map->leastSpan : kLeastSpan);
  if (high - low < floor) {
    // Room below the largest value, but not below zero where nothing is negative.
    low = low >= 0 ? std::max(0.0, high - floor) : high - floor;
    high = std::max(high, low + floor);
  }
  return roundRange(low, high, kTicks);
}

}  // namespace

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
                                        const Style& style, const std::optional<double>& limit) {
  std::pair<double, double> range;
  if (mapRule(field) == MapRule::banded) {
    range = deviationRange(summary, style.tolerance);
  } else if (limit) {
    range = {0, summary.max > *limit ? roundRange(0, summary.max, kTicks).second : *limit};
  } else if (mapRule(field) == MapRule::share) {
    range = {0, std::max(1.0, summary.max)};
  } else {
    range = plainRange(field, summary);
  }
  const double span = range.second - range.first;
  const auto finite = [](const std::optional<double>& v) { return v && std::isfinite(*v); };
  const bool lowGiven = finite(style.rangeMin), highGiven = finite(style.rangeMax);
  if (lowGiven) range.first = *style.rangeMin;
  if (highGiven) range.second = *style.rangeMax;
  if (lowGiven && highGiven && range.second < range.first) std::swap(range.first, range.second);
  if (range.second - range.first >= (lowGiven != highGiven ? kSpanFloor * span : 0) &&
      range.second > range.first)
    return range;
  if (lowGiven) {
    range.second = range.first + span;
  } else {
    range.first = range.second - span;
  }
  return range;
}

Ticks legendTicks(const std::pair<double, double>& range) {
  return ticksIn(range.first, range.second, kTicks);
}

}  // namespace bw::scene
