// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_guess.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// Samples of one period, and trial values of s0 in it, for the first search of (3.3).
constexpr int kPeriodSamples = 128;
constexpr int kTrials = 64;
// A Newton step on (3.3) shorter than this (periods) is the last one: its own error is of the second order.
constexpr double kLastGuessStep = 1e-5;
constexpr int kMostSteps = 12;
// So many peaks of the first search are followed, and none that is lower than the highest by more than this:
// the lookup is good to about a thousandth.
constexpr std::size_t kMostPeaks = 2;
constexpr double kClearlyLower = 0.02;
// At most this many nodes take part in the first search.
constexpr std::size_t kSearchNodes = 24;

// The count of pieces says nothing about s0 where the modulus k² is beyond this (nearly a circle).
constexpr double kNearCircle = 1e8;
// The elliptic integrals take no modulus of 1.
constexpr double kLargestModulus = 1 - 1e-12;
// Lengths of a guess (in lengths of the target) beyond which it has nothing to do with the target.
constexpr double kShortest = 1e-3, kLongest = 20;

}  // namespace

LengthGuess guessByLength(const FitTarget& target, const AffineCurvature& law) {
  LawOrbit orbit = orbitOf(law);
  const std::size_t count = target.size();
  if (orbit.force == 0 && orbit.omega == 0) {
    // A line: its direction is all there is to choose.
    Vector2d sum = Vector2d::Zero();
    for (std::size_t i = 0; i < count; ++i) sum += target.weight[i] * target.tangent[i];
    orbit.angle = std::atan2(sum.y(), sum.x());
  }
  const Elastica apex = fromApex(orbit);
  const double period = apex.period().value_or(orbit.omega > 0 ? kPi / orbit.omega : 1.0);

  // First search: the tangents of one period, looked up at the nodes for each trial s0.
  std::array<double, kPeriodSamples> arcs;
  std::array<Elastica::State, kPeriodSamples> samples;
  for (int j = 0; j < kPeriodSamples; ++j) arcs[static_cast<std::size_t>(j)] = period * j / kPeriodSamples;
  apex.at(arcs, samples);
  std::array<Vector2d, kPeriodSamples + 1> tangents;
  for (std::size_t j = 0; j < kPeriodSamples; ++j) tangents[j] = direction(samples[j].angle);
  tangents[kPeriodSamples] = tangents[0];
  const std::size_t stride = (count + kSearchNodes - 1) / kSearchNodes;
  std::array<double, kTrials> value{};
  for (std::size_t i = stride / 2; i < count; i += stride) {
    const double offset = std::fmod((target.s[i] + 0.5) / period, 1.0) * kPeriodSamples;
    const auto whole = static_cast<std::size_t>(offset);
    const double part = offset - static_cast<double>(whole);
    // Several nodes may stand for one: weights of the skipped ones are alike.
    const Vector2d goal = target.weight[i] * target.tangent[i];
    for (std::size_t k = 0; k < kTrials; ++k) {
      const std::size_t j = (whole + k * (kPeriodSamples / kTrials)) % kPeriodSamples;
      value[k] += goal.dot((1 - part) * tangents[j] + part * tangents[j + 1]);
    }
  }

  // Then Newton's method on F from the best trials that are local maxima.
  std::vector<double> nodes(count);
  std::vector<Elastica::State> states(count);
  struct Derivatives {
    double value = 0, first = 0, second = 0;
  };
  const auto evaluate = [&](double s0) {
    for (std::size_t i = 0; i < count; ++i) nodes[i] = s0 + target.s[i] + 0.5;
    apex.at(nodes, states);
    Derivatives f;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d t = direction(states[i].angle);
      const double along = target.weight[i] * target.tangent[i].dot(t);
      const double across = target.weight[i] * target.tangent[i].dot(quarterTurn(t));
      const double kappa = states[i].curvature;
      const double kappaRate = apex.force().y() * t.x() - apex.force().x() * t.y();
      f.value += along;
      f.first += across * kappa;
      f.second += across * kappaRate - along * kappa * kappa;
    }
    return f;
  };
  std::array<std::size_t, kTrials> order;
  std::size_t peaks = 0;
  for (std::size_t k = 0; k < kTrials; ++k) {
    if (value[k] >= value[(k + 1) % kTrials] && value[k] >= value[(k + kTrials - 1) % kTrials])
      order[peaks++] = k;
  }
  std::sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(peaks),
      [&](std::size_t a, std::size_t b) { return value[a] > value[b] || (value[a] == value[b] && a < b); });
  double best = 0;
  double bestValue = -2;
  const double spacing = period / kTrials;
  for (std::size_t n = 0; n < std::min(peaks, kMostPeaks); ++n) {
    if (n > 0 && value[order[n]] < value[order[0]] - kClearlyLower) break;
    const double origin = period * static_cast<double>(order[n]) / kTrials;
    double s0 = origin;
    Derivatives f = evaluate(s0);
    for (int step = 0; step < kMostSteps; ++step) {
      if (!(f.second < 0)) break;
      const double next = std::clamp(s0 - f.first / f.second, origin - spacing, origin + spacing);
      const double moved = next - s0;
      if (std::abs(moved) <= kLastGuessStep * period) {
        s0 = next;
        f.value += moved * (f.first + 0.5 * moved * f.second);
        break;
      }
      const Derivatives there = evaluate(next);
      if (there.value < f.value) break;
      s0 = next;
      f = there;
    }
    if (f.value > bestValue) {
      bestValue = f.value;
      best = s0;
    }
  }
  LengthGuess guess;
  guess.placement = placePart(target, orbit, apex, best, 1);
  guess.R3star = 1 - bestValue;
  return guess;
}

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

Shape shapeFromLaw(const FitTarget& target, const AffineCurvature& law) {
  const Vector2d force = turnedBack(direction(target.middleAngle), law.force);
  return {law.curvatureAt(target.middle), force.x(), force.y()};
}

Shape shapeFromAngles(const FitTarget& target) {
  // θ(s) = θ0 + α s + λ2 ∫x − λ1 ∫y: the law integrated once, linear in four numbers.
  const std::size_t count = target.size();
  Eigen::Matrix<double, 4, 4> normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  Vector2d sum = Vector2d::Zero();
  Vector2d before = target.start;
  double at = -0.5;
  for (std::size_t i = 0; i < count; ++i) {
    sum += 0.5 * (before + target.point[i]) * (target.s[i] - at);
    before = target.point[i];
    at = target.s[i];
    const Eigen::Vector4d row(1, at, sum.x(), sum.y());
    normal += target.weight[i] * row * row.transpose();
    right += target.weight[i] * (target.angle[i] - target.middleAngle) * row;
  }
  const Eigen::Vector4d x = normal.completeOrthogonalDecomposition().solve(right);
  const Vector2d gradient(x[2], x[3]);
  const Vector2d force = turnedBack(direction(target.middleAngle), {-gradient.y(), gradient.x()});
  return {x[1] + gradient.dot(target.middle), force.x(), force.y()};
}

}  // namespace bw::fit
