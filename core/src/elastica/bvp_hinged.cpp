// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_search.h"

#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "elastica/pendulum_integrals.h"
#include "optimise/bracketed_root.h"

namespace bw::elastica {

namespace {

/// 1 − k² = sech² t, so that k → 1 is far away.
Modulus modulusAt(double t) {
  const double sech = 1 / std::cosh(t), tanh = std::tanh(t);
  return {tanh * tanh, -sech * sech};
}

/// A half wave.
struct HalfWave {
  Modulus modulus;
  double time = 0;  ///< √f times half its length
};

/// That whose chord along its force is 1 − `missing` of its length; `missing` in (0, 2) grows with k. Empty
/// where k is 1 to all digits of t.
std::optional<HalfWave> halfWave(double missing) {
  // Far beyond what the digits of 1 − k² tell, on both sides.
  constexpr double kSmallestLevel = 1e-60, kLargestLevel = 300;
  const auto excess = [missing](double t) {
    const PendulumIntegrals half = swing(modulusAt(t));
    return 2 * half.square - missing * half.time;
  };
  if (excess(kLargestLevel) < 0) return std::nullopt;
  const double t = optimise::bracketedRoot(excess, kSmallestLevel, kLargestLevel).high;
  return HalfWave{modulusAt(t), swing(modulusAt(t)).time};
}

/// `count` of them, the first bending to the left for `side` 1, to the right for −1; the chord along the
/// force is `share` of the length.
UnitSolution waves(const HalfWave& wave, double share, int count, double side) {
  const double delta = std::sqrt(-wave.modulus.excess), k = std::sqrt(wave.modulus.square);
  const double swing = kPi - 2 * std::asin(delta);  // the largest angle against the force
  const double root = 2 * count * wave.time, f = root * root;
  const double along = f * (2 * delta * delta - 1), across = f * 2 * k * delta;
  UnitSolution result;
  result.ends = HeldEnds::none;
  result.shape = {0, along, side * across};
  result.turning = count % 2 == 1 ? 2 * side * swing : 0;
  if (-wave.modulus.excess > kNearLoop) return result;
  // Held at the inflection nearest to the middle.
  const int place = count / 2;
  const bool odd = place % 2 == 1;
  Elastica::Anchor anchor;
  anchor.at = double(place) / count;
  anchor.point = anchor.at * share * Eigen::Vector2d(std::cos(swing), side * std::sin(swing));
  anchor.angle = odd ? 2 * side * swing : 0;
  anchor.force = {along, odd ? -side * across : side * across};
  result.anchor = anchor;
  return result;
}

}  // namespace

std::vector<UnitSolution> halfWaves(double distance, int maxInflections) {
  std::vector<UnitSolution> result;
  // The chord lies along the force, or against it: with loops between stretches under tension.
  for (const double sense : {1.0, -1.0}) {
    const std::optional<HalfWave> wave = halfWave(1 - sense * distance);
    if (!wave) continue;
    for (int count = 1; count <= maxInflections + 1; ++count)
      for (const double side : {-sense, sense}) result.push_back(waves(*wave, sense * distance, count, side));
  }
  return result;
}

}  // namespace bw::elastica
