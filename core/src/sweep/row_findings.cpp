// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_findings.h"

#include <algorithm>
#include <cmath>

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
bool isGap(const std::vector<BladePose>& poses, std::size_t i) {
  return poses[i + 1].index > poses[i].index + 1;
}

double widthAfter(const std::vector<BladePose>& poses, std::size_t i) {
  return poses[i + 1].travel - poses[i].travel;
}

void addGaps(const std::vector<BladePose>& poses, Findings& findings) {
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    if (isGap(poses, i)) gaps.push_back(i);
  int others = 0;
  if (gaps.size() > kMostGaps) {
    others = int(gaps.size()) - 1;
    gaps = {*std::ranges::max_element(gaps, {}, [&](std::size_t i) { return widthAfter(poses, i); })};
  }
  for (const std::size_t i : gaps) {
    const int before = poses[i].index, after = poses[i + 1].index;
    findings.push_back(
        {Severity::error,
         GapInRow{widthAfter(poses, i), others},
         {StationRange{before, after, before, 2}, 0.5 * (middleOf(poses[i]) + middleOf(poses[i + 1]))},
         {TurnDirection{}}});
  }
}

/// A tolerance that holds, in tenths of a mm; a job takes none above the widest.
Remedies toleranceFor(double deviation) {
  constexpr double kWidest = 1000;
  const double tolerance = std::ceil(10 * deviation) / 10;
  return tolerance <= kWidest ? Remedies{WiderTolerance{tolerance}} : Remedies{};
}

void addDeviation(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                  SweepAnalysis& analysis) {
  const std::vector<BladePose>& poses = sweep.poses;
  const SweepSummary& summary = analysis.summary;
  if (summary.deviationMax <= request.tolerance) return;
  const std::vector<int>& rows = analysis.stationRow;
  const std::size_t columns = std::size_t(analysis.cut.columns);
  const int row = int(worst / columns);
  const std::size_t i =
      std::min(std::size_t(std::ranges::upper_bound(rows, row) - rows.begin()) - 1, poses.size() - 2);
  const bool nearNext = 2 * row >= rows[i] + rows[i + 1];
  TooFar cause{summary.deviationMax, request.tolerance, summary.withinTolerance};
  for (const double own : analysis.stationDeviation) cause.own = std::max(cause.own, own);
  cause.spacing = widthAfter(poses, i);
  Remedies remedies;
  const bool between = row != rows[i] && row != rows[i + 1];
  if (between && isGap(poses, i)) {
    cause.source = TooFar::Source::gap;
    cause.leftFirst = poses[i].index + 1;
    cause.leftLast = poses[i + 1].index - 1;
  } else if (between && cause.own < kFromBetween * cause.deviation && cause.own <= request.tolerance) {
    cause.source = TooFar::Source::between;
    remedies = twiceAsMany(sweep, request.clearance);
  } else {
    remedies = toleranceFor(cause.deviation);
    remedies.insert(remedies.begin(), {CutInParts{}, TurnDirection{}});
  }
  const int index = poses[nearNext ? i + 1 : i].index;
  analysis.findings.push_back(
      {Severity::warning, cause, {StationRange::of(index), analysis.cut.points[worst]}, remedies});
}

}  // namespace

void addRowFindings(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                    SweepAnalysis& analysis) {
  addGaps(sweep.poses, analysis.findings);
  addDeviation(sweep, request, worst, analysis);
}

}  // namespace bw::detail
