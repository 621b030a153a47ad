// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace bw::detail {
namespace {

// Points between two of the first pass; it divides kHausdorffPoints − 1.
constexpr int kStride = 9;
constexpr int kCoarse = (kHausdorffPoints - 1) / kStride + 1;
static_assert((kHausdorffPoints - 1) % kStride == 0);
// Between two points the distance exceeds the larger of theirs by about an eighth of the second difference;
// this is four times as much.
constexpr double kBulge = 0.5;
// With more poles than this, or corners, the distance may wave between the points of the first pass: then
// every gap is looked at.
constexpr std::size_t kManyPoles = 40;
// Gaps that could raise the result by less than this, in lengths of the curve, are left alone.
constexpr double kNegligible = 1e-13;

}  // namespace

double oneSidedHausdorff(const Elastica& elastica, const PlanarCurve& curve) {
  const double step = elastica.length() / (kHausdorffPoints - 1);
  struct Sample {
    Eigen::Vector2d point;
    double foot = 0;
    double distance = 0;  ///< an upper bound until it is proven
    bool proven = false;
  };
  const auto measure = [&](const Eigen::Vector2d& point, double seed) {
    Sample sample{point, curve.nearestParameter(point, seed), 0, false};
    sample.distance = (curve.value(sample.foot) - point).norm();
    return sample;
  };
  // A foot downhill from the neighbour's foot gives an upper bound, which nearly always is the distance.
  std::array<double, kCoarse> arcs;
  std::array<Elastica::State, kCoarse> states;
  for (int i = 0; i < kCoarse; ++i) arcs[static_cast<std::size_t>(i)] = step * kStride * i;
  elastica.at(arcs, states);
  std::vector<Sample> coarse;
  coarse.reserve(kCoarse);
  double foot = curve.start();
  for (std::size_t i = 0; i < kCoarse; ++i) {
    coarse.push_back(measure(states[i].point, foot));
    foot = coarse.back().foot;
    // Lead the next seed on by the step.
    const double speed = curve.derivatives(foot).first.norm();
    if (speed > 0) foot += std::min(step * kStride / speed, 0.1 * (curve.end() - curve.start()));
  }

  std::vector<Sample> samples = coarse;
  samples.reserve(2 * kCoarse);
  double largest = 0;
  for (const Sample& s : samples) largest = std::max(largest, s.distance);

  // Gaps in which a point in between may be farther.
  struct Gap {
    std::size_t first = 0;
    double bound = 0;
    std::size_t states = 0;  ///< where its points are kept
  };
  std::vector<Gap> gaps;
  std::array<double, kCoarse> bend{};
  for (std::size_t i = 1; i + 1 < kCoarse; ++i) {
    bend[i] = std::abs(coarse[i - 1].distance - 2 * coarse[i].distance + coarse[i + 1].distance);
  }
  bend[0] = bend[1];
  bend[kCoarse - 1] = bend[kCoarse - 2];
  for (std::size_t i = 0; i + 1 < kCoarse; ++i) {
    const double top = std::max(coarse[i].distance, coarse[i + 1].distance);
    const double rise = std::min(kBulge * std::max(bend[i], bend[i + 1]), 0.5 * step * kStride);
    gaps.push_back({i, top + rise, 0});
  }
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.bound > b.bound; });
  const bool wavy =
      curve.kind() == PlanarCurve::Kind::points || curve.poles().size() > kManyPoles || curve.degree() == 1;
  // All points of the gaps that count so far in one pass along the elastica.
  std::size_t count = 0;
  while (count < gaps.size() && (wavy || gaps[count].bound > largest + kNegligible * curve.length())) ++count;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return gaps[a].first < gaps[b].first; });
  std::vector<double> inner;
  inner.reserve(count * (kStride - 1));
  for (const std::size_t i : order) {
    gaps[i].states = inner.size();
    for (int j = 1; j < kStride; ++j)
      inner.push_back(step * (kStride * static_cast<double>(gaps[i].first) + j));
  }
  std::vector<Elastica::State> between(inner.size());
  elastica.at(inner, between);
  for (std::size_t i = 0; i < count; ++i) {
    const Gap& gap = gaps[i];
    if (!wavy && gap.bound <= largest + kNegligible * curve.length()) break;
    double seed = coarse[gap.first].foot;
    for (std::size_t j = 0; j + 1 < kStride; ++j) {
      samples.push_back(measure(between[gap.states + j].point, seed));
      seed = samples.back().foot;
      largest = std::max(largest, samples.back().distance);
    }
  }

  // The farthest sample decides, once a global search has proven its distance; if that finds a nearer foot,
  // the next one does.
  const auto nearer = [](const Sample& a, const Sample& b) { return a.distance < b.distance; };
  std::make_heap(samples.begin(), samples.end(), nearer);
  while (!samples.front().proven) {
    std::pop_heap(samples.begin(), samples.end(), nearer);
    Sample& top = samples.back();
    const double distance = (curve.value(curve.nearestParameter(top.point)) - top.point).norm();
    top.distance = std::min(top.distance, distance);
    top.proven = true;
    std::push_heap(samples.begin(), samples.end(), nearer);
  }
  return samples.front().distance;
}

}  // namespace bw::detail
