// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/grip_watch.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>

#include "bw/core/base/box_distance.h"
#include "sweep/remedies.h"

namespace bw::sweep {

namespace {

/// mm by which a way may fall short of what is asked for.
constexpr double kNearer = 0.1;
/// mm by which it must come nearer than a station beside it that falls short as well, and is told.
constexpr double kWorse = 2;
constexpr int kBits = 26;  // of the place on a way

}  // namespace

void GripWatch::go(const std::array<Eigen::Vector3d, 2>& grips, int station, bool cuts) {
  const Box& block = sweep_.block;
  double here = std::numeric_limits<double>::infinity();
  for (std::size_t grip = 0; grip < grips.size(); ++grip) {
    const Eigen::Vector3d& to = grips[grip];
    const double last = boxDistance(block, to);
    here = std::min(here, last);
    if (!before_) continue;
    const Eigen::Vector3d& from = (*before_)[grip];
    const double first = boxDistance(block, from), way = (to - from).norm();
    // No place between is nearer than this.
    if (0.5 * (first + last - way) >= now_.distance) continue;
    // Signed, the distance from a convex body is a convex function.
    const auto at = [&](double t) { return boxDistance(block, from + t * (to - from)); };
    auto [t, least] = boost::math::tools::brent_find_minima(at, 0.0, 1.0, kBits);
    for (const double end : {0.0, 1.0})
      if (at(end) < least) {
        t = end;
        least = at(end);
      }
    if (least >= now_.distance || (!cuts && least >= 0)) continue;
    now_.distance = least;
    now_.place = from + t * (to - from);
  }
  before_ = grips;
  if (station < 0) return;
  now_.to = station;
  end(here);
  now_ = {station, -1};
  stationDistance_ = here;
}

void GripWatch::end(double stationDistance) {
  const double clearance = sweep_.request.clearance;
  double least = clearance - kNearer;
  for (const double station : {stationDistance_, stationDistance})
    if (station < clearance) least = std::min(least, station - kWorse);
  // Into the block is another thing than near to it.
  const bool entered = now_.distance < -kNearer && stationDistance_ >= 0 && stationDistance >= 0;
  if (!(now_.distance < least) && !entered) return;
  std::optional<Way>& worst = now_.from < 0 ? in_ : now_.to < 0 ? out_ : between_;
  if (!worst || now_.distance < worst->distance) worst = now_;
}

Findings GripWatch::told() {
  if (now_.from >= 0) end(std::numeric_limits<double>::infinity());
  now_ = {};
  Findings findings;
  for (const std::optional<Way>& way : {in_, between_, out_}) {
    if (!way) continue;
    const double clearance = sweep_.request.clearance;
    Remedies remedies = {
        OtherBlock{way->from < 0 ? OtherBlock::How::beginsAfter : OtherBlock::How::endsBefore},
        TurnDirection{}};
    if (way->from >= 0 && way->to >= 0) remedies = twiceAsMany(sweep_, clearance);
    findings.push_back(
        {way->distance < 0 ? Severity::error : Severity::warning,
         GripTooNear{way->distance, clearance},
         {StationRange{way->from, way->to, way->from < 0 ? way->to : way->from, 0}, way->place},
         std::move(remedies)});
  }
  return findings;
}

}  // namespace bw::sweep
