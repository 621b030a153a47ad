// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/tight_findings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "bw/core/number_text.h"
#include "sweep/remedies.h"
#include "sweep/station_fit.h"
#include "sweep/stretches.h"
#include "sweep/tight_section.h"

namespace bw::detail {

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

std::string remedyFor(const TightRow& row, const Sweep& sweep, const CheckRequest& request) {
  std::vector<const Tight*> worstFirst;
  for (const std::optional<Tight>& tight : row)
    if (tight) worstFirst.push_back(&*tight);
  std::ranges::stable_sort(worstFirst, std::greater(), [](const Tight* t) { return t->spot.distance; });
  double widest = sweep.request.blade.minRadius(), longest = 0;
  for (const Tight* tight : worstFirst)
    if (tight->section.tightest(widest).distance > request.tolerance)
      widest = kRadiusReserve * tight->section.widestRadius(request.tolerance);
  for (const Station& station : sweep.stations)
    longest = std::max({longest, station.targetLength, station.fit.elastica.length()});
  std::string text = "it takes " + bladeThatBendsTo(widest);
  if (const std::optional<double> scale =
          scaleThatFits(worstFirst, sweep.request.blade.minRadius(), request.tolerance))
    if (const std::optional<double> length = lengthFor(*scale * longest, request.clearance))
      text += ", or a surface " + shortText(*scale, 4) + " times as large" +
              (*length > sweep.request.blade.length ? " with a blade of " + shortText(*length, 6) + " mm"
                                                    : std::string());
  return text;
}

}  // namespace

std::vector<char> addTightFindings(const Sweep& sweep, const CheckRequest& request, Issues& issues) {
  const std::vector<Station>& stations = sweep.stations;
  const double limit = sweep.request.blade.maxCurvature(), radius = sweep.request.blade.minRadius();
  TightRow row(stations.size());
  std::vector<char> found(stations.size(), 0);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (stations[i].blade.maxCurvature() <= limit && stations[i].deviationMax <= request.tolerance) continue;
    TightSection section(stations[i].target);
    const TightSpot spot = section.tightest(radius);
    if (spot.distance <= request.tolerance) continue;
    row[i] = Tight{std::move(section), spot};
    found[i] = 1;
  }
  if (std::ranges::none_of(found, [](char c) { return c != 0; })) return found;
  const std::string remedy = remedyFor(row, sweep, request);
  const auto at = [&](const Station& s) -> const std::optional<Tight>& {
    return row[std::size_t(&s - stations.data())];
  };
  // Between once and twice the tolerance a curve may be taken that the blade holds.
  const auto hopeless = [&](const Station& s) {
    return s.blade.maxCurvature() > limit || at(s)->spot.distance > kAllowance * request.tolerance;
  };
  for (const bool error : {true, false})
    for (const Stretch& stretch : stretchesOf(
             stations, [&](const Station&s) { return at(s) && hopeless(s) == error; },
             [&](const Station&a, const Station&b) { return at(a)->spot.distance > at(b)->spot.distance; })) {
      const Station& w = stations[stretch.worst];
      const TightSpot& spot = at(w)->spot;
      issues.push_back({error ? Severity::error : Severity::warning, "curvature",
                        placeOf(stations, stretch) + ": the surface is too tight: it bends to a radius of " +
                            shortText(spot.radius) + " mm, the blade only to " + shortText(radius) +
                            " mm, so that it stays " + shortText(spot.distance) +
                            " mm or more off (tolerance " + shortText(request.tolerance) + " mm); " + remedy,
                        Place{stationName(w.index), 0, w.index, w.frame.toWorld(spot.point)}});
    }
  return found;
}

}  // namespace bw::detail
