// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "sweep/remedies.h"
#include "sweep/station_fit.h"
#include "sweep/stretches.h"
#include "sweep/sweep_findings.h"
#include "sweep/tight_section.h"

namespace bw::sweep {

namespace {

/// Steps in which a larger surface is sought; its scale is told in tenths.
constexpr double kScaleStep = 1.05;
constexpr double kLargestScale = 1000;

struct Tight {
  TightSection section;
  TightSpot spot;
};

using TightRow = std::vector<std::optional<Tight>>;

/// The least scale, in steps, at which the blade's radius keeps within the tolerance of all of the row.
std::optional<double> scaleThatFits(const std::vector<const Tight*>& row, double radius, double tolerance) {
  double scale = 1;
  std::size_t fitting = 0;
  for (std::size_t i = 0; fitting < row.size(); i = (i + 1) % row.size()) {
    ++fitting;
    while (scale * row[i]->section.tightest(radius / scale).distance > tolerance) {
      scale = std::ceil(10 * kScaleStep * scale) / 10;
      fitting = 0;
      if (scale > kLargestScale) return {};
    }
  }
  return scale;
}

Remedies remediesFor(const TightRow& row, const Sweep& sweep, const CheckRequest& request) {
  std::vector<const Tight*> worstFirst;
  for (const std::optional<Tight>& tight : row)
    if (tight) worstFirst.push_back(&*tight);
  std::ranges::stable_sort(worstFirst, std::greater(), [](const Tight* t) { return t->spot.distance; });
  double widest = sweep.request.blade.minRadius(), longest = 0;
  for (const Tight* tight : worstFirst)
    if (tight->section.tightest(widest).distance > request.tolerance)
      widest = kRadiusReserve * tight->section.widestRadius(request.tolerance);
  for (const StationFit& fit : sweep.fits)
    longest = std::max({longest, fit.target.length(), fit.fit.elastica.length()});
  Remedies remedies = {bladeThatBendsTo(widest)};
  if (const std::optional<double> scale =
          scaleThatFits(worstFirst, sweep.request.blade.minRadius(), request.tolerance))
    if (const std::optional<double> length = lengthFor(*scale * longest, request.clearance))
      remedies.push_back(
          LargerSurface{*scale, *length > sweep.request.blade.length ? length : std::optional<double>()});
  return remedies;
}

}  // namespace

std::vector<char> addTightFindings(const Sweep& sweep, const CheckRequest& request, SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const double limit = sweep.request.blade.maxCurvature(), radius = sweep.request.blade.minRadius();
  TightRow row(poses.size());
  std::vector<char> found(poses.size(), 0);
  const auto overbent = [&](std::size_t i) { return poses[i].blade.maxCurvature() > limit; };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!overbent(i) && analysis.stationDeviation[i] <= request.tolerance) continue;
    TightSection section(sweep.fits[i].target);
    const TightSpot spot = section.tightest(radius);
    if (spot.distance <= request.tolerance) continue;
    row[i] = Tight{std::move(section), spot};
    found[i] = 1;
  }
  if (std::ranges::none_of(found, [](char c) { return c != 0; })) return found;
  const Remedies remedies = remediesFor(row, sweep, request);
  // Between once and twice the tolerance a curve may be taken that the blade holds.
  const auto hopeless = [&](std::size_t i) {
    return overbent(i) || row[i]->spot.distance > kAllowance * request.tolerance;
  };
  for (const bool error : {true, false})
    for (const Stretch& stretch : stretchesOf(
             poses.size(), [&](std::size_t i) { return row[i] && hopeless(i) == error; },
             [&](std::size_t a, std::size_t b) { return row[a]->spot.distance > row[b]->spot.distance; })) {
      const TightSpot& spot = row[stretch.worst]->spot;
      analysis.findings.push_back(
          {error ? Severity::error : Severity::warning,
           TooTight{spot.radius, radius, spot.distance, request.tolerance},
           {placeOf(poses, stretch).stations, poses[stretch.worst].frame.toWorld(spot.point)},
           remedies});
    }
  return found;
}

}  // namespace bw::sweep
