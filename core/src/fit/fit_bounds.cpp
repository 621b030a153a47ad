// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Bounds of a fit: on the curvature over the segment or a longer range about its middle, and on the shape,
// against self-intersection, on inflections and on periods.

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "fit/fit_constrained.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// A peak of the curvature that stands out by less than this part is covered by the fixed places.
constexpr double kPeakExcess = 1e-11;
// Places between the ends of an extended range where the direction of the curve is looked at for a peak.
constexpr int kRangePlaces = 33;
// Places of peaks that are remembered.
constexpr std::size_t kPeaks = 4;
// Peaks nearer than this (parts of half the range) are one.
constexpr double kSamePeak = 1e-9;
// An elastica whose curvature varies by less than this part is so near to a circle that its peaks are not
// definite.
constexpr double kRound = 1e-3;
// A range longer than this (lengths of the elastica) is no blade any more.
constexpr double kLongestRange = 1000;
// Over a range of so many lengths and more no curve that winds on by more than this (rad) can keep the bound:
// it would only cost time to follow it.
constexpr double kLongRange = 10;
constexpr double kMostWinding = 100;

// Distance (lengths of the elastica) by which an end stays off another strand, and part of a bound by which
// the other bounds against self-intersection and on the inflections are kept.
constexpr double kClearance = 1e-6;
// k² of the elastica whose neighbouring loops touch; k = 0.855092407720383.
constexpr double kTouching = 0.855092407720383 * 0.855092407720383;
// The force (times the length squared) that ω² is of the order of, for a bound of order one.
constexpr double kLoopUnit = 10;
// Newton's method for a foot: its steps, their largest and least length (lengths of the elastica), and the
// least derivative that it divides by.
constexpr int kFootSteps = 12;
constexpr double kFootStep = 0.1;
constexpr double kFootTolerance = 1e-14;
constexpr double kLeastFootRate = 0.3;
// The two means of a period agree to this part after a few steps, each of which doubles the digits.
constexpr double kMeanRounding = 1e-15;
constexpr int kMeanSteps = 40;

}  // namespace

bool ConstrainedFit::curvatureBounds(const VectorXd& v, optimise::Constraints& out) {
  const Shape shape = v.head<3>();
  const double ft = shape[1];
  const double fn = shape[2];
  const auto curvatureRateAt = [&](double angle) { return fn * std::cos(angle) - ft * std::sin(angle); };
  const double scale = std::exp(-v[3]) / *constraints_.maxCurvature;
  const bool extended = constraints_.curvatureRange.has_value();
  // Half the range, in lengths of the elastica.
  const double half = extended ? 0.5 * *constraints_.curvatureRange * std::exp(-v[3]) : 0.5;
  if (!(half <= 0.5 * kLongestRange)) return false;
  if (half > 0.5 * kLongRange && half * (std::abs(shape[0]) + std::sqrt(std::hypot(ft, fn))) > kMostWinding)
    return false;
  ShapeEvaluator& whole = extended ? range_ : nodes_;
  if (extended) range_.moveTo({-half, half});
  if (!whole.evaluate(shape, true)) return false;
  const std::size_t first = whole.end(0), last = whole.end(1);
  double highest = 0;
  // The bound at a place, `part` of half the range from the middle.
  const auto hold = [&](int name, double kappa, const Eigen::Vector3d& derivative, double angle,
                        double part) {
    const double sign = kappa < 0 ? -1 : 1;
    auto gradient = out.add(std::abs(kappa) * scale - 1, name);
    gradient.head<3>() = sign * scale * derivative;
    gradient[3] = -std::abs(kappa) * scale;
    // A range of fixed length covers less of a longer elastica.
    if (extended) gradient[3] -= sign * scale * curvatureRateAt(angle) * part * half;
    highest = std::max(highest, std::abs(kappa));
  };
  // At both ends and in the middle, and at a peak of |κ| between them. Three fixed places keep the bound
  // smooth where the elastica is nearly a circle and has no definite peak.
  hold(kCurvatureStart, whole.curvature(first), whole.curvatureGradient(first), whole.angle(first), -1);
  hold(kCurvatureMiddle, shape[0], Eigen::Vector3d::UnitX(), 0, 0);
  hold(kCurvatureEnd, whole.curvature(last), whole.curvatureGradient(last), whole.angle(last), 1);
  // κ' = f_n cos ψ − f_t sin ψ changes sign where the tangent runs with the force. The height of the peak is
  // known in closed form, κ_peak² = κ² + 2 (f − f_t).
  if (extended) {
    std::vector<double> places;
    for (int i = 1; i + 1 < kRangePlaces; ++i) places.push_back(half * (2.0 * i / (kRangePlaces - 1) - 1));
    between_.moveTo(std::move(places));
  }
  ShapeEvaluator& between = extended ? between_ : nodes_;
  if (!between.evaluate(shape, false)) return false;
  double before = curvatureRateAt(whole.angle(first));
  double placeBefore = whole.arc(first);
  bool peak = false;
  double peakPlace = 0;
  for (std::size_t i = 0; i <= between.size() && !peak; ++i) {
    const double angle = i < between.size() ? between.angle(i) : whole.angle(last);
    const double place = i < between.size() ? between.arc(i) : whole.arc(last);
    const double here = curvatureRateAt(angle);
    peak = before * here < 0 && ft * std::cos(angle) + fn * std::sin(angle) > 0;
    if (peak) peakPlace = placeBefore + (place - placeBefore) * before / (before - here);
    before = here;
    placeBefore = place;
  }
  const double f = std::hypot(ft, fn);
  const double height = std::sqrt(std::max(0.0, shape[0] * shape[0] + 2 * (f - ft)));
  if (peak && f > 0 && height > highest * (1 + kPeakExcess)) {
    out.add(height * scale - 1, kCurvaturePeak).head<4>() << scale * shape[0] / height,
        scale * (ft / f - 1) / height, scale * (fn / f) / height, -height * scale;
    // On a circle there is no peak, but every small change may raise one. Where one was met on the way, the
    // bound is kept from then on.
    const double part = peakPlace / half;
    if (height * scale > 1 && std::none_of(peaks_.begin(), peaks_.end(),
                                           [&](double p) { return std::abs(p - part) < kSamePeak; })) {
      if (peaks_.size() < kPeaks)
        peaks_.push_back(part);
      else
        peaks_[nextPeak_++ % kPeaks] = part;
    }
  }
  if (f * half > kRound * highest) return true;
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    foot_.moveTo({peaks_[i] * half});
    if (!foot_.evaluate(shape, true)) return false;
    hold(kPeakPlace + static_cast<int>(i), foot_.curvature(0), foot_.curvatureGradient(0), foot_.angle(0),
         peaks_[i]);
  }
  return true;
}

// agm(√f, √g) / 2π with inflections, else agm(ω, √−g) / π, where ω² = κ²/4 + (f − f_t)/2 and g = f − ω². The
// mean is differentiated along with its iteration.
Periods periodsOf(const Shape& shape) {
  const double f = shape.tail<2>().norm();
  const Eigen::Vector3d fGradient =
      f > 0 ? Eigen::Vector3d(0, shape[1] / f, shape[2] / f) : Eigen::Vector3d::Zero();
  const double squared = 0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]);
  const Eigen::Vector3d squaredGradient = Eigen::Vector3d(0.5 * shape[0], -0.5, 0) + 0.5 * fGradient;
  const double g = 0.5 * (f + shape[1]) - 0.25 * shape[0] * shape[0];
  const bool inflectional = g >= 0;
  const double larger = inflectional ? f : squared;
  double a = std::sqrt(larger);
  double b = std::sqrt(std::abs(g));
  if (!(a > 0) || !(b > 0)) return {};
  Eigen::Vector3d aGradient = (inflectional ? fGradient : squaredGradient) / (2 * a);
  Eigen::Vector3d bGradient =
      (inflectional ? fGradient - squaredGradient : squaredGradient - fGradient) / (2 * b);
  for (int i = 0; i < kMeanSteps && std::abs(a - b) > kMeanRounding * a; ++i) {
    const double root = std::sqrt(a * b);
    const Eigen::Vector3d rootGradient = (b * aGradient + a * bGradient) / (2 * root);
    aGradient = 0.5 * (aGradient + bGradient);
    a = 0.5 * (a + b);
    bGradient = rootGradient;
    b = root;
  }
  const double factor = 1 / (inflectional ? 2 * kPi : kPi);
  return {a * factor, aGradient * factor};
}

// What keeps an elastica from meeting itself or from having too many inflections.
bool ConstrainedFit::shapeBounds(const VectorXd& v, optimise::Constraints& out) {
  const Shape shape = v.head<3>();
  if (constraints_.strand) {
    const FitConstraints::Strand& strand = *constraints_.strand;
    const std::size_t end = nodes_.end(strand.atStart ? 0 : 1);
    // The foot of the end on the other strand, by Newton's method.
    double place = strand.place;
    for (int step = 0; step < kFootSteps; ++step) {
      foot_.moveTo({place});
      if (!foot_.evaluate(shape, false)) return false;
      const Vector2d away = nodes_.point(end) - foot_.point(0);
      const Vector2d along = direction(foot_.angle(0));
      const double rate = 1 - foot_.curvature(0) * quarterTurn(along).dot(away);
      const double move = std::clamp(away.dot(along) / std::max(rate, kLeastFootRate), -kFootStep, kFootStep);
      place = std::clamp(place + move, -0.5, 0.5);
      if (std::abs(move) < kFootTolerance) break;
    }
    foot_.moveTo({place});
    if (!foot_.evaluate(shape, true)) return false;
    const Vector2d normal = strand.side * quarterTurn(direction(foot_.angle(0)));
    const Vector2d away = nodes_.point(end) - foot_.point(0);
    auto gradient = out.add(kClearance - normal.dot(away), kStrand);
    for (int j = 0; j < 3; ++j)
      gradient[j] = -normal.dot(nodes_.pointDerivative(end, j) - foot_.pointDerivative(0, j));
  }
  const std::size_t first = nodes_.end(0), last = nodes_.end(1);
  if (constraints_.maxTurning) {
    const double turning = nodes_.angle(last) - nodes_.angle(first);
    for (const double sign : {1.0, -1.0}) {
      const double value = sign * turning / *constraints_.maxTurning - 1 + kClearance;
      auto gradient = out.add(value, sign > 0 ? kTurningLeft : kTurningRight);
      for (int j = 0; j < 3; ++j)
        gradient[j] = sign * (nodes_.angleDerivative(last, j) - nodes_.angleDerivative(first, j)) /
                      *constraints_.maxTurning;
    }
  }
  if (constraints_.openLoops) {
    // ω² ≤ k² f.
    const double f = shape.tail<2>().norm();
    const double bound = kTouching * (1 - kClearance);
    auto gradient =
        out.add((0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]) - bound * f) / kLoopUnit, kLoops);
    gradient[0] = 0.5 * shape[0] / kLoopUnit;
    gradient[1] = -0.5 / kLoopUnit;
    if (f > 0) gradient.segment<2>(1) += (0.5 - bound) * shape.tail<2>() / f / kLoopUnit;
  }
  const auto holdSign = [&](double sign, std::size_t end, int name) {
    if (sign == 0) return;
    out.add(kClearance - sign * nodes_.curvature(end), name).head<3>() =
        -sign * nodes_.curvatureGradient(end);
  };
  holdSign(constraints_.startSign, first, kStartSign);
  holdSign(constraints_.endSign, last, kEndSign);
  return true;
}

}  // namespace bw::fit
