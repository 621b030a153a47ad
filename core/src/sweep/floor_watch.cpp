// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/floor_watch.h"

#include <algorithm>

namespace bw::sweep {

namespace {

/// mm by which a way is lower than a station beside it that lies below the floor, so that it is told too.
constexpr double kLower = 0.1;

}  // namespace

bool FloorWatch::isLow(const Way& way, double heightFrom, double heightTo) const {
  double least = *floor_ - kFloorRounded;
  for (const double station : {heightFrom, heightTo})
    if (station < *floor_) least = std::min(least, station - kLower);
  return way.lowest.height < least;
}

void FloorWatch::see(std::span<const Eigen::Vector3d> points, int station) {
  if (!floor_) return;
  const LowestPlace here = lowestPlace(block_, points);
  if (station < 0) {
    if (here.height < now_.lowest.height) now_.lowest = here;
    return;
  }
  now_.to = station;
  if (isLow(now_, stationHeight_, here.height)) {
    std::optional<Way>& worst = now_.from < 0 ? in_ : between_;
    if (!worst || now_.lowest.height < worst->lowest.height) worst = now_;
  }
  now_ = {station, -1, {}};
  stationHeight_ = here.height;
}

Finding FloorWatch::finding(const Way& way) const {
  const int worst = way.from < 0 ? way.to : way.from;
  return {severityOfLow(way.lowest.height),
          NearBottom{way.lowest.height, *floor_},
          {StationRange{way.from, way.to, worst, 0}, way.lowest.point},
          {}};
}

Findings FloorWatch::told() {
  Findings findings;
  if (!floor_) return findings;
  for (const std::optional<Way>& way : {in_, between_})
    if (way) findings.push_back(finding(*way));
  if (now_.from >= 0 && isLow(now_, stationHeight_, std::numeric_limits<double>::infinity()))
    findings.push_back(finding(now_));
  return findings;
}

}  // namespace bw::sweep
