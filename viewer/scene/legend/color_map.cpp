// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/legend/color_map.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/sweep/maps.h"

namespace bw::scene {

namespace {

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

constexpr Rgb kNeutral = Rgb::hex(0xFAFAF8);
constexpr Rgb kBelowPale = Rgb::hex(0xA6CCF0), kBelowNear = Rgb::hex(0x3D86D4),
              kBelowFar = Rgb::hex(0x0A3F8C);
constexpr Rgb kAbovePale = Rgb::hex(0xF8BDAC), kAboveNear = Rgb::hex(0xE4553E),
              kAboveFar = Rgb::hex(0x8F0D1C);
constexpr Rgb kOverLimit = Rgb::hex(0xE8590C), kFarOverLimit = Rgb::hex(0xA8101F);

}  // namespace

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
  if (!limit) return viridis(high > low ? (value - low) / (high - low) : 0.0);
  if (value > *limit) return mixEvenly(kOverLimit, kFarOverLimit, std::clamp(value / *limit - 1, 0.0, 1.0));
  const double top = std::min(high, *limit);
  return cividis(top > low ? (value - low) / (top - low) : 1.0);
}

}  // namespace bw::scene
