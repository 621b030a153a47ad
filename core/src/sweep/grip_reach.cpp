// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/grip_reach.h"

#include <algorithm>
#include <cmath>

#include "bw/core/elastica/elastica_stability.h"
#include "sweep/station_fit.h"

namespace bw::detail {

namespace {

/// The search steps by this part of the length at least: a blade's length is not ordered more finely.
constexpr double kLeastStep = 0.01;

/// By how much the nearer grip misses the clearance if the station's curve is continued to this length; a
/// grip moves by half of what the blade grows at most, so no blade longer by less than twice the miss does.
double miss(const Sweep& sweep, const BladePose& pose, double length, double clearance) {
  const Elastica& cut = pose.cut;
  const double extra = 0.5 * (length - cut.length());
  double nearest = boxDistance(sweep.block, pose.frame.toWorld(cut.point(-extra)));
  nearest = std::min(nearest, boxDistance(sweep.block, pose.frame.toWorld(cut.point(cut.length() + extra))));
  return clearance - nearest;
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
  const Result<Elastica> blade = extendedBlade(pose.cut, length);
  return blade && blade->maxCurvature() <= sweep.request.blade.maxCurvature() &&
         stabilityMargin(*blade) > 0 &&
         (sweep.request.blade.section == Blade::Section::flat || outOfPlaneMargin(*blade) > 0);
}

}  // namespace

double boxDistance(const Box& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d half = 0.5 * box.size;
  const Eigen::Vector3d q = (box.frame.toLocal(point) - half).cwiseAbs() - half;
  const double outside = q.cwiseMax(0.0).norm();
  return outside > 0 ? outside : q.maxCoeff();
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

}  // namespace bw::detail
