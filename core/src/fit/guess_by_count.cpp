// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "fit/fit_guess.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// The count of pieces says nothing about s0 where the modulus k² is beyond this (nearly a circle).
constexpr double kNearCircle = 1e8;
// The elliptic integrals take no modulus of 1.
constexpr double kLargestModulus = 1 - 1e-12;
// Lengths of a guess (in lengths of the target) beyond which it has nothing to do with the target.
constexpr double kShortest = 1e-3, kLongest = 20;

}  // namespace

std::optional<Placement> guessByCount(const FitTarget& target, const AffineCurvature& law) {
  const LawOrbit orbit = orbitOf(law);
  const double largest = 2 * orbit.omega;
  if (!(orbit.omega > 0) || !(orbit.force > 0) || orbit.omega * orbit.omega > kNearCircle * orbit.force)
    return std::nullopt;
  const bool inflectional = orbit.inflectional();
  const double sense = inflectional ? 1 : orbit.sense;
  const double smallest =
      inflectional ? -largest : std::sqrt(std::max(0.0, largest * largest - 4 * orbit.force));

  // κ̂ = λ u + α stands for u. A piece counts only if it is higher than half the range.
  std::vector<double> kappa;
  kappa.push_back(sense * law.curvatureAt(target.start));
  for (const Vector2d& p : target.point) kappa.push_back(sense * law.curvatureAt(p));
  kappa.push_back(sense * law.curvatureAt(target.end));
  const double height = 0.5 * (largest - smallest);
  double low = kappa[0];
  double high = kappa[0];
  int pieces = 1;
  int going = 0;  // +1 up, −1 down, 0 not known yet
  int first = 0;
  for (const double value : kappa) {
    if (going >= 0) {
      high = std::max(high, value);
      if (high - value > height) {
        pieces += going != 0 ? 1 : 0;
        going = -1;
        low = value;
      }
    }
    if (going <= 0) {
      low = std::min(low, value);
      if (value - low > height) {
        pieces += going != 0 ? 1 : 0;
        going = 1;
        high = value;
      }
    }
    if (first == 0) first = going;
  }
  if (first == 0) first = kappa.back() >= kappa.front() ? 1 : -1;
  const bool falling = first < 0;

  // Within its piece the phase runs over π (k < 1) or π/2 (k ≥ 1); odd pieces run like the first.
  const double root = std::sqrt(orbit.force);
  const double rate = inflectional ? root : orbit.omega;
  const double k = inflectional ? orbit.omega / root : root / orbit.omega;
  const double modulus = std::min(k, kLargestModulus);
  const double width = inflectional ? kPi : kPi / 2;
  double arc[2];
  for (int end = 0; end < 2; ++end) {
    const double ratio =
        std::clamp((end == 0 ? kappa.front() : kappa.back()) / largest, smallest / largest, 1.0);  // cn(s, k)
    const double part = inflectional
                            ? std::acos(ratio)
                            : std::asin(std::min(1.0, std::sqrt(std::max(0.0, 1 - ratio * ratio)) / k));
    const int piece = end == 0 ? 1 : pieces;
    const bool pieceFalls = (piece % 2 == 1) == falling;
    // A falling first piece starts at phase 0, a rising one at `width`.
    const double base = (piece - 1 + (falling ? 0 : 1)) * width;
    const double phase = pieceFalls ? base + part : base + width - part;
    // F(φ + m π) = F(φ) + 2 m K; the standard function wants |φ| ≤ π/2.
    const double turns = std::round(phase / kPi);
    arc[end] = (2 * turns * std::comp_ellint_1(modulus) + std::ellint_1(modulus, phase - turns * kPi)) / rate;
  }
  const double length = arc[1] - arc[0];
  if (!(length > kShortest && length < kLongest)) return std::nullopt;
  return placePart(target, orbit, fromApex(orbit), arc[0], length);
}

}  // namespace bw::fit
