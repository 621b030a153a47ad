// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_guess.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bw::detail {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

// Below this root mean square (in lengths) the extent of the target in a direction is rounding, and the force
// that it would tell is taken as zero.
constexpr double kFlat = 1e-12;
// A root mean square curvature below this (times the length) is rounding: the target is a line.
constexpr double kStraight = 1e-10;
// κ range within which R3 counts a point as inside, relative to the largest curvature: rounding on a circle.
constexpr double kRangeSlack = 1e-9;
// Samples of one period, and trial values of s0 in it, for the first search of (3.3).
constexpr int kPeriodSamples = 128;
constexpr int kTrials = 64;
// A Newton step on (3.3) shorter than this (periods) is the last one: its own error is of the second order.
constexpr double kLastStep = 1e-5;
// At most this many nodes take part in the first search.
constexpr std::size_t kSearchNodes = 24;
// The count of pieces says nothing about s0 where the modulus k² is beyond this (nearly a circle).
constexpr double kNearCircle = 1e8;

// Everything that the guesses need of the elastica of a law: f, ω and the sense of turning, in the frame of
// the target.
struct Orbit {
  double force = 0;
  double angle = 0;  ///< of the force: the tangent angle at the apex
  double omega = 0;
  double sense = 1;  ///< sign of the curvature, if it does not change
  bool inflectional() const { return omega <= std::sqrt(force); }
};

Orbit orbitOf(const AffineCurvature& law) {
  Orbit orbit;
  orbit.force = law.force.norm();
  orbit.angle = std::atan2(law.force.y(), law.force.x());
  orbit.omega = law.omega;
  orbit.sense = law.alpha < 0 ? -1 : 1;  // α is the mean curvature, since the origin is the centroid
  return orbit;
}

double signedPeak(const Orbit& orbit) { return 2 * orbit.omega * (orbit.inflectional() ? 1 : orbit.sense); }

// The elastica of an orbit from its apex, where the thesis has s = 0.
Elastica fromApex(const Orbit& orbit) {
  const Result<Elastica> elastica = Elastica::make(Vector2d::Zero(), orbit.angle, signedPeak(orbit),
                                                   orbit.force * direction(orbit.angle), 1);
  return elastica ? *elastica : Elastica();
}

// The placement of the part of an apex elastica that starts at arc length `from`, moved so that (2.25) holds.
Placement placePart(const FitTarget& target, const Orbit& orbit, const Elastica& apex, double from,
                    double length) {
  std::vector<double> s(target.size() + 1);
  for (std::size_t i = 0; i < target.size(); ++i) s[i] = from + (target.s[i] + 0.5) * length;
  s.back() = from + 0.5 * length;
  std::vector<Elastica::State> states(s.size());
  apex.at(s, states);
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) mean += target.weight[i] * states[i].point;
  const Elastica::State& middle = states.back();
  Placement out;
  out.logLength = std::log(length);
  out.angle = middle.angle;
  out.middle = middle.point - mean;
  const Vector2d force =
      turnedBack(direction(middle.angle), orbit.force * direction(orbit.angle)) * length * length;
  out.shape = {middle.curvature * length, force.x(), force.y()};
  return out;
}

}  // namespace

AffineCurvature fitAffineCurvature(const FitTarget& target) {
  AffineCurvature law;
  const std::size_t count = target.size();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    covariance += target.weight[i] * target.point[i] * target.point[i].transpose();
    law.alpha += target.weight[i] * target.curvature[i];
    squares += target.weight[i] * target.curvature[i] * target.curvature[i];
  }
  if (std::sqrt(squares) < kStraight) {
    law.alpha = 0;
    return law;
  }
  // (2.17) about the centroid: α is the mean curvature, and the gradient of κ follows along the two principal
  // axes separately.
  const double axis = 0.5 * std::atan2(2 * covariance(0, 1), covariance(0, 0) - covariance(1, 1));
  Vector2d gradient = Vector2d::Zero();
  for (int k = 0; k < 2; ++k) {
    const Vector2d e = direction(axis + k * pi / 2);
    double moment = 0;
    double product = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = e.dot(target.point[i]);
      moment += target.weight[i] * x * x;
      product += target.weight[i] * x * (target.curvature[i] - law.alpha);
    }
    if (moment > kFlat * kFlat) gradient += e * (product / moment);
  }
  law.force = {-gradient.y(), gradient.x()};

  const double lambda = law.force.norm();
  double missed = 0;
  double beta = 0;
  const auto sine = [&](std::size_t i) {
    return lambda > 0 ? law.force.dot(target.tangent[i]) / lambda : 0.0;
  };
  // With κ̂ = λ u + α: ½ λ u² + α u = (κ̂² − α²) / (2 λ), which must not be formed where λ is small.
  const auto parabola = [&](std::size_t i) {
    const double u =
        lambda > 0 ? (law.force.y() * target.point[i].x() - law.force.x() * target.point[i].y()) / lambda
                   : 0.0;
    return (0.5 * lambda * u + law.alpha) * u;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double miss = target.curvature[i] - law.curvatureAt(target.point[i]);
    missed += target.weight[i] * miss * miss;
    beta += target.weight[i] * (sine(i) - parabola(i));
  }
  law.beta = beta;
  law.R1 = squares > 0 ? std::sqrt(missed / squares) : 0.0;
  double spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double miss = sine(i) - parabola(i) - beta;
    spread += target.weight[i] * miss * miss;
  }
  law.R2 = std::sqrt(spread);
  const double larger = std::sqrt(std::max(0.0, law.alpha * law.alpha - 2 * lambda * (beta - 1)));  // δ₋
  law.omega = 0.5 * larger;
  // u in [u_min, u_max] says that κ̂ lies between the curvatures which the elastica has.
  const bool inflectional = law.omega * law.omega <= lambda;
  const double smaller =
      inflectional ? -larger : std::sqrt(std::max(0.0, larger * larger - 4 * lambda));  // δ₊
  const double sense = inflectional || law.alpha >= 0 ? 1 : -1;
  const double slack = kRangeSlack * larger;
  for (std::size_t i = 0; i < count; ++i) {
    const double kappa = sense * law.curvatureAt(target.point[i]);
    if (kappa > larger + slack || kappa < smaller - slack) law.R3 += target.weight[i];
  }
  return law;
}

LengthGuess guessByLength(const FitTarget& target, const AffineCurvature& law) {
  Orbit orbit = orbitOf(law);
  const std::size_t count = target.size();
  if (orbit.force == 0 && orbit.omega == 0) {
    // A line: its direction is all there is to choose.
    Vector2d sum = Vector2d::Zero();
    for (std::size_t i = 0; i < count; ++i) sum += target.weight[i] * target.tangent[i];
    orbit.angle = std::atan2(sum.y(), sum.x());
  }
  const Elastica apex = fromApex(orbit);
  const double period = apex.period().value_or(orbit.omega > 0 ? pi / orbit.omega : 1.0);

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
  struct Slope {
    double value = 0, first = 0, second = 0;
  };
  const auto evaluate = [&](double s0) {
    for (std::size_t i = 0; i < count; ++i) nodes[i] = s0 + target.s[i] + 0.5;
    apex.at(nodes, states);
    Slope f;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d t = direction(states[i].angle);
      const double along = target.weight[i] * target.tangent[i].dot(t);
      const double across = target.weight[i] * target.tangent[i].dot(quarterTurn(t));
      const double kappa = states[i].curvature;
      const double kappaSlope = apex.force().y() * t.x() - apex.force().x() * t.y();
      f.value += along;
      f.first += across * kappa;
      f.second += across * kappaSlope - along * kappa * kappa;
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
  for (std::size_t n = 0; n < std::min<std::size_t>(peaks, 2); ++n) {
    if (n > 0 && value[order[n]] < value[order[0]] - 0.02) break;  // the lookup is good to about a thousandth
    const double origin = period * static_cast<double>(order[n]) / kTrials;
    double s0 = origin;
    Slope f = evaluate(s0);
    for (int step = 0; step < 12; ++step) {
      if (!(f.second < 0)) break;
      const double next = std::clamp(s0 - f.first / f.second, origin - spacing, origin + spacing);
      const double moved = next - s0;
      if (std::abs(moved) <= kLastStep * period) {
        s0 = next;
        f.value += moved * (f.first + 0.5 * moved * f.second);
        break;
      }
      const Slope there = evaluate(next);
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
  const Orbit orbit = orbitOf(law);
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
  const int n = pieces;

  double arc[2];
  for (int end = 0; end < 2; ++end) {
    const double ratio =
        std::clamp((end == 0 ? kappa.front() : kappa.back()) / largest, smallest / largest, 1.0);  // cn(s, k)
    double phase = 0;
    double modulus = 0;
    double rate = 0;
    // Within its piece the phase runs over π (k < 1) or π/2 (k ≥ 1); odd pieces run like the first.
    double part = 0;
    double width = 0;
    if (inflectional) {
      part = std::acos(ratio);
      width = pi;
      modulus = orbit.omega / std::sqrt(orbit.force);
      rate = std::sqrt(orbit.force);
    } else {
      modulus = std::sqrt(orbit.force) / orbit.omega;
      part = std::asin(std::min(1.0, std::sqrt(std::max(0.0, 1 - ratio * ratio)) / modulus));
      width = pi / 2;
      rate = orbit.omega;
    }
    const int piece = end == 0 ? 1 : n;
    const bool pieceFalls = (piece % 2 == 1) == falling;
    // A falling first piece starts at phase 0, a rising one at `width`.
    const double base = (piece - 1 + (falling ? 0 : 1)) * width;
    phase = pieceFalls ? base + part : base + width - part;
    modulus = std::min(modulus, 1 - 1e-12);
    // F(φ + m π) = F(φ) + 2 m K; the standard function wants |φ| ≤ π/2.
    const double turns = std::round(phase / pi);
    const double rest = phase - turns * pi;
    arc[end] = (2 * turns * std::comp_ellint_1(modulus) + std::ellint_1(modulus, rest)) / rate;
  }
  const double length = arc[1] - arc[0];
  if (!(length > 1e-3) || !(length < 20)) return std::nullopt;
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

}  // namespace bw::detail
