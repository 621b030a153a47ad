// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/remedies.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/box_distance.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/section_request.h"
#include "sweep/held_blade.h"
#include "sweep/station_fit.h"

namespace bw::sweep {

namespace {

/// A fit beside another blade length may be longer by this part.
constexpr double kLengthReserve = 1.02;
/// A blade's length is not told more finely, mm.
constexpr double kLengthStep = 0.5;
/// Stations that a shorter blade is tried out on, lengths that are tried, and the part from one to the next.
constexpr std::size_t kTriedStations = 8;
constexpr int kTriedLengths = 5;
constexpr double kShorter = 0.88;

/// The search steps by this part of the length at least: a blade's length is not ordered more finely.
constexpr double kLeastStep = 0.01;

/// By how much both grips miss the clearance if the station's blade is continued to this length and lies as
/// lopsided as serves best; together they move by what the blade grows at most, so no blade longer by less
/// than twice the miss does.
double miss(const Sweep& sweep, const BladePose& pose, double length, double clearance) {
  constexpr int kHalvings = 24;
  const auto missed = [&](double arc) {
    return clearance - boxDistance(sweep.block, pose.frame.toWorld(pose.blade.point(arc)));
  };
  // So much of the blade lies before its start as it is now; what cuts stays between the grips.
  double low = -pose.before, high = std::max(low, length - pose.before - pose.cut.length());
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (missed(-middle) > missed(length - middle) ? low : high) = middle;
  }
  return std::max(missed(-low), missed(length - low));
}

/// The first whole length from `length` on that clears, or empty.
std::optional<double> clearingLength(const Sweep& sweep, const BladePose& pose, double length,
                                     double clearance) {
  for (length = std::ceil(length); length <= Blade::kLongest;) {
    const double missing = miss(sweep, pose, length, clearance);
    if (missing <= 0) return length;
    length = std::ceil(length + std::max(2 * missing, kLeastStep * length));
  }
  return {};
}

bool holdsAt(const Sweep& sweep, const BladePose& pose, double length) {
  const Result<Elastica> blade = extendedBlade(pose.blade, length);
  return blade && blade->maxCurvature() <= sweep.request.blade.maxCurvature() &&
         stabilityMargin(*blade) > 0 &&
         (sweep.request.blade.section == Blade::Section::flat || outOfPlaneMargin(*blade) > 0);
}

double longestCut(const Sweep& sweep) {
  double longest = 0;
  for (const BladePose& pose : sweep.poses) longest = std::max(longest, pose.cut.length());
  return longest;
}

}  // namespace

BendingBlade bladeThatBendsTo(double radius) {
  BendingBlade wanted{radius};
  const Result<std::vector<Blade>> presets = bladePresets();
  if (!presets || presets->empty()) return wanted;
  const auto byRadius = [](const Blade& a, const Blade& b) { return a.minRadius() < b.minRadius(); };
  const Blade* does = nullptr;
  for (const Blade& blade : *presets)
    if (blade.minRadius() <= radius && (!does || byRadius(*does, blade))) does = &blade;
  const Blade& named = does ? *does : *std::ranges::min_element(*presets, byRadius);
  wanted.preset = named.name;
  wanted.title = named.title;
  wanted.presetRadius = named.minRadius();
  return wanted;
}

FlatBlade flatBladeFor(const Sweep& sweep) {
  double sharpest = 0;
  for (const BladePose& pose : sweep.poses) sharpest = std::max(sharpest, pose.blade.maxCurvature());
  const Result<std::vector<Blade>> presets = bladePresets();
  if (!presets) return {};
  FlatBlade thinner;
  for (const Blade& blade : *presets) {
    if (blade.section != Blade::Section::flat) continue;
    const double bends = blade.minRadius() * sharpest;
    if (bends < 1) return {blade.name, blade.title};
    // What a blade bends to grows with its thickness.
    thinner.thickness = std::max(thinner.thickness.value_or(0), blade.thickness / bends);
  }
  return thinner;
}

Remedies twiceAsMany(const Sweep& sweep, double clearance) {
  const std::vector<BladePose>& poses = sweep.poses;
  // Beyond a station the lengths may go on as they came.
  double longest = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double a = poses[i - 1].cut.length(), b = poses[i].cut.length();
    longest = std::max(longest, std::max(a, b) + std::abs(b - a));
  }
  if (longest > sweep.request.blade.length) {
    const std::optional<double> length = lengthFor(longest, clearance);
    return length ? Remedies{OtherLength{*length}} : Remedies{};
  }
  const int count = 2 * (poses.back().index - poses.front().index + 1) - 1;
  return count <= SectionRequest::kMost ? Remedies{MoreStations{count}} : Remedies{};
}

bool slackensNear(const Sweep& sweep, std::size_t station) {
  if (sweep.request.weight.isZero()) return false;
  constexpr double kSwings = 4 * kOneShape;
  const std::vector<BladePose>& poses = sweep.poses;
  // A way swings by a change beside it, too.
  for (std::size_t i = std::max<std::size_t>(station, 1) - 1; i < std::min(station + 2, poses.size() - 1);
       ++i) {
    const double a = slackOf(poses[i]), b = slackOf(poses[i + 1]);
    if (std::min(a, b) < kOneShape && std::max(a, b) > kSwings) return true;
  }
  return false;
}

std::optional<double> lengthFor(double longest, double clearance) {
  const double needed = std::ceil(kLengthReserve * longest + 2 * clearance);
  return needed <= Blade::kLongest ? std::optional(needed) : std::nullopt;
}

std::optional<double> shorterBlade(const Sweep& sweep, std::size_t first, std::size_t last,
                                   const std::function<bool(const Elastica&)>& holds) {
  double least = kLengthReserve * longestCut(sweep);
  for (const StationFit& fit : sweep.fits) least = std::max(least, fit.target.length());
  const auto holdsAt = [&](const BladePose& pose, double length) {
    const Result<Elastica> blade = extendedBlade(pose.cut, length);
    return blade && holds(*blade);
  };
  double length = sweep.request.blade.length;
  for (std::size_t i = first; i <= last; ++i) {
    const BladePose& pose = sweep.poses[i];
    if (holdsAt(pose, length)) continue;
    if (!(least < length) || !holdsAt(pose, least)) return {};
    double good = least;
    while (length - good > kLengthStep) {
      const double middle = 0.5 * (good + length);
      (holdsAt(pose, middle) ? good : length) = middle;
    }
    length = good;
  }
  // A shorter blade is fitted otherwise, so that the length is tried out.
  const std::size_t stride = std::max<std::size_t>(1, (last - first + 1) / kTriedStations);
  FitRequest tried = sweep.request;
  for (int k = 0; k < kTriedLengths; ++k, length *= kShorter) {
    tried.blade.length = std::floor(length);
    if (tried.blade.length < least) return {};
    bool all = tried.blade.length < sweep.request.blade.length;
    for (std::size_t i = first; all && i <= last; i += stride) {
      const Result<StationFit> fit = fitStation(sweep.fits[i].target, tried, nullptr);
      const Result<Elastica> blade = fit ? extendedBlade(fit->fit.elastica, tried.blade.length)
                                         : Result<Elastica>(tl::unexpected<Error>(fit.error()));
      all = blade && holds(*blade);
    }
    if (all) return tried.blade.length;
  }
  return {};
}

GripReach lengthThatClears(const Sweep& sweep, const BladePose& worst, double clearance) {
  const std::vector<BladePose>& poses = sweep.poses;
  std::optional<double> length = clearingLength(sweep, worst, sweep.request.blade.length, clearance);
  for (const BladePose& pose : poses)
    if (length) length = clearingLength(sweep, pose, *length, clearance);
  // What cleared at a shorter length may have curled back since.
  if (!length ||
      std::ranges::any_of(poses, [&](const BladePose& s) { return miss(sweep, s, *length, clearance) > 0; }))
    return {};
  return {length, std::ranges::all_of(poses, [&](const BladePose& s) { return holdsAt(sweep, s, *length); })};
}

}  // namespace bw::sweep
