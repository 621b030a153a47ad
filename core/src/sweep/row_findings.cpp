// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_findings.h"

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "sweep/remedies.h"
#include "sweep/stretches.h"

namespace bw::detail {

namespace {

/// Where the stations themselves are nearer to the target than this part of the largest deviation, the rest
/// of it comes from between them.
constexpr double kFromBetween = 0.5;
/// More gaps than this become one finding: a list of places is no message.
constexpr std::size_t kMostGaps = 3;

/// True if stations are left out between this one of the row and the next.
bool isGap(const std::vector<Station>& stations, std::size_t i) {
  return stations[i + 1].index > stations[i].index + 1;
}

double widthAfter(const std::vector<Station>& stations, std::size_t i) {
  return stations[i + 1].travel - stations[i].travel;
}

/// The stations that are left out after the i-th of the row, with their verb: "station 8 is", "stations 8 to
/// 11 are".
std::string leftOutAfter(const std::vector<Station>& stations, std::size_t i) {
  const int first = stations[i].index + 1, last = stations[i + 1].index - 1;
  return first == last
             ? stationName(first) + " is left out"
             : "stations " + std::to_string(first + 1) + " to " + std::to_string(last + 1) + " are left out";
}

void addGaps(const std::vector<Station>& stations, Issues& issues) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    if (isGap(stations, i)) gaps.push_back(i);
  std::string more;
  if (gaps.size() > kMostGaps) {
    more = ", and others in " + std::to_string(gaps.size() - 1) + " more places";
    gaps = {*std::ranges::max_element(gaps, {}, [&](std::size_t i) { return widthAfter(stations, i); })};
  }
  for (const std::size_t i : gaps) {
    const int before = stations[i].index;
    issues.push_back(
        {Severity::error, "gap",
         leftOutAfter(stations, i) + " inside the row" + more +
             ": with nothing to follow, the blade would cut straight on over " +
             shortText(widthAfter(stations, i)) + " mm from " + stationName(before) + " to " +
             stationName(stations[i + 1].index) +
             "; choose a block on one side of the gap, one face without it, or another cutting direction",
         Place{stationName(before), 0, before, 0.5 * (middleOf(stations[i]) + middleOf(stations[i + 1]))}});
  }
}

/// What to do about a deviation that is largest after the i-th station; `own` is the largest at the stations.
std::string remedy(const std::vector<Station>& stations, std::size_t i, bool between, double largest,
                   double own) {
  if (between && isGap(stations, i))
    return "it arises where " + leftOutAfter(stations, i) + ": close that gap first";
  if (between && own < kFromBetween * largest)
    return "it arises between the stations, which are " + shortText(widthAfter(stations, i)) +
           " mm apart there; the stations themselves keep within " + shortText(own) +
           " mm, so take more of them";
  return std::string(kInParts) + ", turn the cutting direction, or allow more";
}

void addDeviation(const std::vector<Station>& stations, const CheckRequest& request, std::size_t worst,
                  SweepAnalysis& analysis) {
  const SweepSummary& summary = analysis.summary;
  if (summary.deviationMax <= request.tolerance) return;
  const std::vector<int>& rows = analysis.stationRow;
  const std::size_t columns = std::size_t(analysis.cut.columns);
  const int row = int(worst / columns);
  const std::size_t i =
      std::min(std::size_t(std::ranges::upper_bound(rows, row) - rows.begin()) - 1, stations.size() - 2);
  const bool nearNext = 2 * row >= rows[i] + rows[i + 1];
  double own = 0;
  for (const Station& station : stations) own = std::max(own, station.deviationMax);
  const int index = stations[nearNext ? i + 1 : i].index;
  const bool between = row != rows[i] && row != rows[i + 1];
  analysis.issues.push_back(
      {Severity::warning, "deviation",
       "the cut surface is up to " + shortText(summary.deviationMax) + " mm from the target near " +
           stationName(index) + ", more than the tolerance of " + shortText(request.tolerance) + " mm (" +
           fixedText(std::min(99.9, 100 * summary.withinTolerance), 1) + " % of its area lies within); " +
           remedy(stations, i, between, summary.deviationMax, own),
       Place{stationName(index), 0, index, analysis.cut.points[worst]}});
}

}  // namespace

void addRowFindings(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                    SweepAnalysis& analysis) {
  addGaps(sweep.stations, analysis.issues);
  addDeviation(sweep.stations, request, worst, analysis);
}

}  // namespace bw::detail
