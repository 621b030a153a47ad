// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The bound on the curvature of a fit, over the segment or a longer range about its middle.

#include <algorithm>
#include <cmath>

#include "fit/condition_names.h"
#include "fit/fit_constrained.h"

namespace bw::detail {
namespace {

using Eigen::VectorXd;

// A peak of the curvature that stands out by less than this part is covered by the fixed places.
constexpr double kPeakExcess = 1e-11;
// Places between the ends of an extended range where the direction of the curve is looked at for a peak.
constexpr int kRangePlaces = 33;
// Places of peaks that are remembered.
constexpr std::size_t kPeaks = 4;
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

bool ConstrainedFit::curvatureBounds(const VectorXd& v, Conditions& out) {
  // At both ends and in the middle, and at a peak of |κ| between them. Three fixed places keep the bound
  // smooth where the elastica is nearly a circle and has no definite peak.
  static constexpr int kPlaces[] = {kCurvatureStart, kCurvatureMiddle, kCurvatureEnd};
  const Shape shape = v.head<3>();
  const double ft = shape[1];
  const double fn = shape[2];
  const auto slopeAt = [&](double angle) { return fn * std::cos(angle) - ft * std::sin(angle); };
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
  const ShapeEnds ends(whole);
  double highest = 0;
  for (int place = 0; place < 3; ++place) {
    const auto end = static_cast<std::size_t>(place / 2);
    const double kappa = place == 1 ? shape[0] : ends.state(end).curvature;
    const double sign = kappa < 0 ? -1 : 1;
    auto slope = out.slopes.col(out.add(std::abs(kappa) * scale - 1, kPlaces[place]));
    for (int j = 0; j < 3; ++j)
      slope[j] = sign * scale * (place == 1 ? (j == 0 ? 1.0 : 0.0) : ends.curvatureDerivative(end, j));
    slope[3] = -std::abs(kappa) * scale;
    // A range of fixed length covers less of a longer elastica.
    if (extended && place != 1)
      slope[3] += sign * scale * slopeAt(ends.angle(end)) * (place == 0 ? half : -half);
    highest = std::max(highest, std::abs(kappa));
  }
  // κ' = f_n cos ψ − f_t sin ψ changes sign where the tangent runs with the force. The height of the peak is
  // known in closed form, κ_peak² = κ² + 2 (f − f_t).
  if (extended) {
    std::vector<double> places;
    for (int i = 1; i + 1 < kRangePlaces; ++i) places.push_back(half * (2.0 * i / (kRangePlaces - 1) - 1));
    between_.moveTo(std::move(places));
  }
  ShapeEvaluator& between = extended ? between_ : nodes_;
  if (!between.evaluate(shape, false)) return false;
  double before = slopeAt(ends.angle(0));
  double placeBefore = ends.arc(0);
  bool peak = false;
  double peakPlace = 0;
  for (std::size_t i = 0; i <= between.size() && !peak; ++i) {
    const double angle = i < between.size() ? between.angle(i) : ends.angle(1);
    const double place = i < between.size() ? between.arc(i) : ends.arc(1);
    const double here = slopeAt(angle);
    peak = before * here < 0 && ft * std::cos(angle) + fn * std::sin(angle) > 0;
    if (peak) peakPlace = placeBefore + (place - placeBefore) * before / (before - here);
    before = here;
    placeBefore = place;
  }
  const double f = std::hypot(ft, fn);
  const double height = std::sqrt(std::max(0.0, shape[0] * shape[0] + 2 * (f - ft)));
  if (peak && f > 0 && height > highest * (1 + kPeakExcess)) {
    auto slope = out.slopes.col(out.add(height * scale - 1, kCurvaturePeak));
    slope[0] = scale * shape[0] / height;
    slope[1] = scale * (ft / f - 1) / height;
    slope[2] = scale * (fn / f) / height;
    slope[3] = -height * scale;
    // On a circle there is no peak, but every small change may raise one. Where one was met on the way, the
    // bound is kept from then on.
    const double part = peakPlace / half;
    if (height * scale > 1 &&
        std::none_of(peaks_.begin(), peaks_.end(), [&](double p) { return std::abs(p - part) < 1e-9; })) {
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
    const double kappa = foot_.state(0).curvature;
    const double sign = kappa < 0 ? -1 : 1;
    auto slope = out.slopes.col(out.add(std::abs(kappa) * scale - 1, kPeakPlace + static_cast<int>(i)));
    for (int j = 0; j < 3; ++j) slope[j] = sign * scale * foot_.curvatureDerivative(0, j);
    slope[3] = -std::abs(kappa) * scale;
    if (extended) slope[3] -= sign * scale * slopeAt(foot_.angle(0)) * peaks_[i] * half;
  }
  return true;
}

}  // namespace bw::detail
