// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Where a finding is: what is selected, framed and marked for it.
#include <algorithm>
#include <cmath>

#include "workbench/workbench.h"

namespace bw::app {

namespace {

/// How far a point lies inside the block, mm; negative outside.
double depthIn(const Box& block, const Eigen::Vector3d& point) {
  const Eigen::Array3d p = block.frame.toLocal(point).array();
  return std::min(p.minCoeff(), (block.size.array() - p).minCoeff());
}

/// The point of a station that a finding of that kind is about.
Eigen::Vector3d pointOf(const std::string& kind, const Station& station, const Box& block) {
  if (kind == "clearance") {
    const Eigen::Vector3d left = station.leftPoint(), right = station.rightPoint();
    return depthIn(block, left) >= depthIn(block, right) ? left : right;
  }
  const double length = station.fit.elastica.length();
  if (kind == "curvature") {
    // Where the blade bends most.
    constexpr int kSteps = 200;
    double arc = 0.5 * station.blade.length(), most = -1;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = station.blade.length() * i / kSteps, bend = std::abs(station.blade.at(s).curvature);
      if (bend > most) {
        most = bend;
        arc = s;
      }
    }
    return station.frame.toWorld(station.blade.point(arc));
  }
  return station.frame.toWorld(station.fit.elastica.point(0.5 * length));
}

Selection::Kind partOf(const Issue& issue) {
  static const std::pair<const char*, Selection::Kind> kParts[] = {
      {"block", Selection::Kind::block},     {"blade", Selection::Kind::blade},
      {"curvature", Selection::Kind::blade}, {"clearance", Selection::Kind::block},
      {"healing", Selection::Kind::surface}, {"face", Selection::Kind::surface}};
  for (const auto& [word, kind] : kParts)
    if (issue.kind.find(word) != std::string::npos || issue.where.text.find(word) != std::string::npos)
      return kind;
  return Selection::Kind::result;
}

}  // namespace

void Workbench::showPlace(const Issue& issue) {
  const pipeline::SweepResult* result = sweep();
  const Place& place = issue.where;
  Spot spot{issue, {}, {}};
  const auto add = [&](const Box& block) {
    for (const Eigen::Vector3d& corner : block.corners())
      if (corner.allFinite()) spot.bounds.add(corner);
  };
  if (place.point && place.point->allFinite()) spot.point = place.point;
  const Station* station = nullptr;
  if (place.station && result) {
    const auto& stations = result->sweep.stations;
    const auto found = std::find_if(stations.begin(), stations.end(),
                                    [&](const Station& s) { return s.index == *place.station; });
    if (found != stations.end()) {
      station = &*found;
      selectStation(int(found - stations.begin()));
    }
  }
  if (station) {
    const bool middleOnly = issue.kind == "clearance" || issue.kind == "curvature";
    if (!spot.point || middleOnly) spot.point = pointOf(issue.kind, *station, result->sweep.block);
    for (const Eigen::Vector2d& p : station->blade.sample(33)) spot.bounds.add(station->frame.toWorld(p));
  } else if (!place.station) {
    select({partOf(issue), -1});
  }
  // The block as the person placed it, where no result has one.
  if (job().block) {
    add(job().block->box());
    if (!spot.point && selection_.kind == Selection::Kind::block) {
      const Box block = job().block->box();
      spot.point = block.frame.toWorld(0.5 * block.size.head<2>(), 0.5 * block.size.z());
    }
  } else if (const auto evaluation = shown(); evaluation && evaluation->setup) {
    add(evaluation->setup->block);
  }
  if (const auto evaluation = shown(); !station && evaluation && evaluation->target.value) {
    spot.bounds.add(evaluation->target.value->bounds().min);
    spot.bounds.add(evaluation->target.value->bounds().max);
  }
  if (spot.point) spot.bounds.add(*spot.point);
  emit spotShown(spot);
}

}  // namespace bw::app
