// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/peaks.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bw::sweep {

namespace {

/// Where a function is highest between two places, and its value there.
Peak peakBetween(double from, double to, const std::function<double(double)>& valueAt) {
  constexpr int kAsked = 14;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  Peak low{to - ratio * (to - from)}, high{from + ratio * (to - from)};
  low.value = valueAt(low.place);
  high.value = valueAt(high.place);
  Peak best = low.value > high.value ? low : high;
  for (int k = 2; k < kAsked; ++k) {
    if (low.value > high.value) {
      to = high.place;
      high = low;
      low.place = to - ratio * (to - from);
      low.value = valueAt(low.place);
    } else {
      from = low.place;
      low = high;
      high.place = from + ratio * (to - from);
      high.value = valueAt(high.place);
    }
    for (const Peak& one : {low, high})
      if (one.value > best.value) best = one;
  }
  return best;
}

}  // namespace

std::vector<std::size_t> peaksOf(const std::vector<double>& samples) {
  constexpr double kHigh = 0.5;   // of the highest
  constexpr double kFlat = 1e-6;  // of a sample: rounding
  constexpr std::size_t kMost = 16;
  std::vector<std::size_t> peaks;
  if (samples.empty()) return peaks;
  const double least = kHigh * std::ranges::max(samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double before = k > 0 ? samples[k] - samples[k - 1] : 0,
                 after = k + 1 < samples.size() ? samples[k] - samples[k + 1] : 0;
    const bool stands = std::min(before, after) >= 0 && std::max(before, after) > kFlat * samples[k];
    if (stands && samples[k] > 0 && samples[k] >= least) peaks.push_back(k);
  }
  std::ranges::stable_sort(peaks, [&](std::size_t a, std::size_t b) { return samples[a] > samples[b]; });
  peaks.resize(std::min(peaks.size(), kMost));
  return peaks;
}

Peak farthestBetween(double from, double to, const std::function<Eigen::Vector3d(double)>& placeAt,
                     SurfaceSampler& target, const InFoam& foam) {
  std::optional<SurfaceSampler::Foot> seed;
  return peakBetween(from, to, [&](double at) {
    const Eigen::Vector3d place = placeAt(at);
    const Result<SurfaceSampler::Foot> foot = target.closest(place, seed ? &*seed : nullptr);
    if (foot) seed = *foot;
    return foot && foam.cuts(place, *foot) ? std::abs(target.offset(place, *foot)) : -1.0;
  });
}

}  // namespace bw::sweep
