// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/legend_range.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
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

using Samples = std::array<unsigned, 10>;
constexpr Samples kViridis{0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E,
                           0x1F9E89, 0x35B779, 0x6DCD59, 0xB4DE2C, 0xFDE725};
constexpr Samples kCividis{0x00204D, 0x00336F, 0x39486B, 0x575C6D, 0x707173,
                           0x8A8779, 0xA69D75, 0xC4B56C, 0xE4CF5B, 0xFFEA46};

double toLinear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double toSrgb(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Oklab (Björn Ottosson, 2020): a space in which straight lines look even.
Eigen::Array3d toOklab(const Rgb& c) {
  const double r = toLinear(c.r), g = toLinear(c.g), b = toLinear(c.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb fromOklab(const Eigen::Array3d& lab) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2]);
  const double m = cube(lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2]);
  const double s = cube(lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2]);
  return {toSrgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          toSrgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          toSrgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// Catmull–Rom through the samples.
Rgb through(const Samples& samples, double t) {
  const double x = std::clamp(std::isfinite(t) ? t : 0.0, 0.0, 1.0) * double(samples.size() - 1);
  const int last = int(samples.size()) - 1;
  const int i = std::min(int(x), last - 1);
  const double u = x - i;
  const auto lab = [&](int k) { return toOklab(Rgb::hex(samples[std::size_t(std::clamp(k, 0, last))])); };
  const Eigen::Array3d a = lab(i - 1), b = lab(i), c = lab(i + 1), d = lab(i + 2);
  return fromOklab(b + 0.5 * u * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a))));
}

Rgb mixEvenly(const Rgb& a, const Rgb& b, double t) {
  const Eigen::Array3d p = toOklab(a), q = toOklab(b);
  return fromOklab(p + t * (q - p));
}

/// From bad to good; told apart by lightness too.
constexpr std::array<unsigned, 4> kStates{0xC2281D, 0x9AA0A6, 0xF2B441, 0x2F7FB5};
constexpr Rgb kNeutral = Rgb::hex(0xFAFAF8);
constexpr Rgb kBelowPale = Rgb::hex(0xA6CCF0), kBelowNear = Rgb::hex(0x3D86D4),
              kBelowFar = Rgb::hex(0x0A3F8C);
constexpr Rgb kAbovePale = Rgb::hex(0xF8BDAC), kAboveNear = Rgb::hex(0xE4553E),
              kAboveFar = Rgb::hex(0x8F0D1C);
constexpr Rgb kOverLimit = Rgb::hex(0xE8590C), kFarOverLimit = Rgb::hex(0xA8101F);

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
  if (mapRule(field) == MapRule::words) return {-0.5, double(cutMap(field)->words.size()) - 0.5};
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

Ticks legendTicks(const std::string& field, const std::pair<double, double>& range) {
  if (mapRule(field) != MapRule::words) return ticksIn(range.first, range.second, kTicks);
  Ticks ticks;
  for (std::size_t i = 0; i < cutMap(field)->words.size(); ++i) ticks.values.push_back(double(i));
  return ticks;
}

Rgb viridis(double t) { return through(kViridis, t); }
Rgb cividis(double t) { return through(kCividis, t); }

Rgb deviationColor(double value, double tolerance, double end, double start) {
  const double size = std::abs(value);
  const auto share = [&](double from, double to) {
    return to > from ? std::clamp((size - from) / (to - from), 0.0, 1.0) : 1.0;
  };
  if (size <= tolerance)
    return mixEvenly(kNeutral, value < 0 ? kBelowPale : kAbovePale,
                     size > 0 ? share(start, std::min(tolerance, end)) : 0.0);
  return mixEvenly(value < 0 ? kBelowNear : kAboveNear, value < 0 ? kBelowFar : kAboveFar,
                   share(std::max(start, tolerance), end));
}

Rgb ColorMap::at(double value) const {
  const auto [low, high] = range;
  if (mapRule(field) == MapRule::banded)
    return deviationColor(value, tolerance, std::max(std::abs(low), std::abs(high)),
                          std::max({low, -high, 0.0}));
  if (mapRule(field) == MapRule::words)
    return Rgb::hex(kStates[std::size_t(std::clamp(std::lround(value), 0L, long(kStates.size()) - 1))]);
  if (!limit) return viridis(high > low ? (value - low) / (high - low) : 0.0);
  if (value > *limit) return mixEvenly(kOverLimit, kFarOverLimit, std::clamp(value / *limit - 1, 0.0, 1.0));
  const double top = std::min(high, *limit);
  return cividis(top > low ? (value - low) / (top - low) : 1.0);
}

}  // namespace bw::scene
