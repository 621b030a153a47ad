// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/overall.h"

#include <algorithm>
#include <cmath>

#include "make_files.h"

namespace bw::pipeline {

Overall overallOf(const Evaluation& e) {
  Overall all;
  const std::vector<Strip> strips = stripsOf(e);
  double area = e.uncutArea, uncovered = e.uncutArea, programs = 0;
  bool known = true, followed = true;
  SweepSummary& s = all.summary;
  const bool one = strips.size() == 1;
  all.outside = e.outsideShare;
  for (const Strip& strip : strips) {
    const CutResult result = *strip.cut->result();
    const SweepSummary& own = result.analysis.summary;
    const double weight = result.coverage.area, stations = double(result.size());
    all.stations += result.size();
    all.lost += std::size_t(std::ranges::count(result.rest.stations, Rest::lost));
    all.cuttingTime += result.motion.cuttingTime();
    all.runTime += result.motion.duration();
    all.uncovered = std::max(all.uncovered, result.coverage.distance);
    followed = followed && !result.way.instants.empty();
    all.betweenMax = std::max(all.betweenMax.value_or(0), result.between.deviationMax);
    if (const SimulatedSurface* cut = strip.cut->programCut()) {
      all.programMax = std::max(all.programMax.value_or(0), cut->toTargetMax);
      all.fromShown = std::max(all.fromShown.value_or(0), cut->toDesignMax);
      programs += weight * cut->toTargetMean;
      if (one) all.programMean = cut->toTargetMean;
    } else {
      known = false;
    }
    if (one) {
      s = own;
      all.covered = e.uncutArea > 0 ? 1 - (result.coverage.uncovered + e.uncutArea) / (weight + e.uncutArea)
                                    : result.coverage.share();
      break;
    }
    if (strip.index == 0) s.withinTolerance = 0;  // and the speed ratio is 1 at most
    s.R4Max = std::max(s.R4Max, own.R4Max);
    s.hausdorffMax = std::max(s.hausdorffMax, own.hausdorffMax);
    s.deviationMax = std::max(s.deviationMax, own.deviationMax);
    s.angleMax = std::max(s.angleMax, own.angleMax);
    s.angleStationMeanMax = std::max(s.angleStationMeanMax, own.angleStationMeanMax);
    s.speedRatioMin = std::min(s.speedRatioMin, own.speedRatioMin);
    if (own.minRadius > 0)
      s.minRadius = s.minRadius > 0 ? std::min(s.minRadius, own.minRadius) : own.minRadius;
    s.R4Mean += stations * own.R4Mean;
    s.hausdorffMean += stations * own.hausdorffMean;
    s.deviationMean += weight * own.deviationMean;
    s.deviationRms += weight * own.deviationRms * own.deviationRms;
    s.withinTolerance += weight * own.withinTolerance;
    s.angleMean += weight * own.angleMean;
    uncovered += result.coverage.uncovered;
    area += weight;
  }
  if (!followed) all.betweenMax = std::nullopt;
  if (!known) all.programMax = all.programMean = all.fromShown = std::nullopt;
  if (one || !(area > 0)) return all;
  s.R4Mean /= double(all.stations);
  s.hausdorffMean /= double(all.stations);
  s.deviationMean /= area;
  s.deviationRms = std::sqrt(s.deviationRms / area);
  s.withinTolerance /= area;
  s.angleMean /= area;
  if (known) all.programMean = programs / area;
  all.covered = 1 - uncovered / area;
  return all;
}

}  // namespace bw::pipeline
