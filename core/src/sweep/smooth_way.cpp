// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/smooth_way.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "sweep/held_blade.h"

namespace bw::sweep {

SmoothWay::SmoothWay(const Sweep& row) : row_(row), length_(row.request.blade.length) {
  for (const BladePose& pose : row.poses) {
    const Elastica::State middle = pose.blade.at(0.5 * length_);
    Numbers n;
    n << middle.point, middle.angle, middle.curvature, pose.blade.force(), pose.before,
        pose.before + pose.cut.length();
    if (pose.blade.anchor() || isTaut(pose)) n.segment<3>(3).setZero();
    // Without whole turns from one station to the next.
    if (!numbers_.empty()) n(2) = numbers_.back()(2) + std::remainder(n(2) - numbers_.back()(2), 2 * kPi);
    numbers_.push_back(n);
  }
  findSlopes();
  boundEnds();
}

std::size_t SmoothWay::before(double travel) const {
  const auto after = std::ranges::upper_bound(row_.poses, travel, {}, &BladePose::travel);
  return std::size_t(
      std::clamp<std::ptrdiff_t>(after - row_.poses.begin() - 1, 0, std::ptrdiff_t(row_.poses.size()) - 2));
}

std::optional<BladePose> SmoothWay::at(double travel) const {
  const std::size_t i = before(travel);
  const BladePose &a = row_.poses[i], &b = row_.poses[i + 1];
  const double way = b.travel - a.travel, s = (travel - a.travel) / way, r = 1 - s;
  Numbers n = r * r * (1 + 2 * s) * numbers_[i] + s * s * (1 + 2 * r) * numbers_[i + 1] +
              s * r * way * (r * slopes_[i] - s * slopes_[i + 1]);
  // Over a gap of the target, where stations are left out, nothing tells how far the part that cuts goes on.
  if (b.index > a.index + 1) n.tail<2>() = r * numbers_[i].tail<2>() + s * numbers_[i + 1].tail<2>();
  const Result<Elastica> blade = aboutMiddle(n.head<2>(), n(2), n(3), n.segment<2>(4), length_);
  const Result<Elastica> cut = blade && n(7) > n(6) ? blade->segment(n(6), n(7)) : blade;
  if (!cut) return {};
  const PlaneFamily& planes = row_.planes;
  return BladePose{
      -1,   travel, planes.turns() ? planes.at(planes.entry + travel) : planeBetween(a.frame, b.frame, s),
      *cut, *blade, n(6)};
}

SmoothWay::Numbers SmoothWay::endSlope(bool front) const {
  const std::size_t n = numbers_.size(), count = std::min<std::size_t>(4, n), first = front ? 0 : n - count,
                    end = front ? 0 : n - 1;
  Numbers slope = Numbers::Zero();
  const auto travel = [&](std::size_t k) { return row_.poses[k].travel; };
  for (std::size_t k = first; k < first + count; ++k) {
    if (k == end) continue;
    double weight = 1 / (travel(k) - travel(end));
    for (std::size_t j = first; j < first + count; ++j)
      if (j != k && j != end) weight *= (travel(end) - travel(j)) / (travel(k) - travel(j));
    slope += weight * (numbers_[k] - numbers_[end]);
  }
  return slope;
}

void SmoothWay::findSlopes() {
  const std::size_t n = numbers_.size();
  slopes_.assign(n, Numbers::Zero());
  if (n < 2) return;
  slopes_.front() = endSlope(true);
  slopes_.back() = endSlope(false);
  std::vector<double> onward(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = wayAfter(i - 1), after = wayAfter(i);
    const double pivot = 2 * (before + after) - after * onward[i - 1];
    const Numbers chords = 3 * (after / before * (numbers_[i] - numbers_[i - 1]) +
                                before / after * (numbers_[i + 1] - numbers_[i]));
    onward[i] = before / pivot;
    slopes_[i] = (chords - after * slopes_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) slopes_[i] -= onward[i] * slopes_[i + 1];
}

void SmoothWay::boundEnds() {
  constexpr double kSteepest = 3;  // times the slope of a chord: what Fritsch and Carlson show to be enough
  constexpr double kSharper = 4;   // than the bends of what is smooth two stations away: a corner
  constexpr double kSeen = 20;     // mm that it turns the way to the next station
  constexpr std::ptrdiff_t kReach = 2;  // stations to which cubics carry on what they make of it
  const auto n = std::ptrdiff_t(numbers_.size());
  if (n < 2) return;
  for (const int end : {6, 7}) {
    const auto chord = [&](std::ptrdiff_t k) {
      k = std::clamp<std::ptrdiff_t>(k, 0, n - 2);
      return (numbers_[std::size_t(k + 1)](end) - numbers_[std::size_t(k)](end)) / wayAfter(std::size_t(k));
    };
    const auto turn = [&](std::ptrdiff_t i) {
      return i > 0 && i + 1 < n ? std::abs(chord(i) - chord(i - 1)) : 0;
    };
    const auto isCorner = [&](std::ptrdiff_t i) {
      const double beside = std::max(turn(i - kReach), turn(i + kReach));
      return n > 4 && turn(i) > kSharper * beside && turn(i) * wayAfter(std::size_t(i)) > kSeen;
    };
    for (std::ptrdiff_t i = 1; i + 1 < n; ++i) {
      if (!isCorner(i)) continue;
      for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - kReach); k <= std::min(n - 1, i + kReach);
           ++k) {
        const double before = chord(k - (k > 0)), after = chord(k);
        const double most = before * after <= 0 ? 0 : kSteepest * std::min(std::abs(before), std::abs(after));
        double& slope = slopes_[std::size_t(k)](end);
        slope = std::clamp(slope, before < 0 ? -most : 0, before < 0 ? 0 : most);
      }
    }
  }
}

}  // namespace bw::sweep
