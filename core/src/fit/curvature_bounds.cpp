// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The bound on the curvature of a fit, over the segment or a longer range about its middle.

#include <algorithm>
#include <cmath>

#include "fit/fit_constrained.h"

namespace bw::fit {
namespace {

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

}  // namespace bw::fit
