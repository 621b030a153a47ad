// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/motion.h"

#include <algorithm>

namespace bw {

double Motion::cuttingTime() const {
  const auto atStation = [](const MotionInstant& instant) { return instant.station >= 0; };
  const auto first = std::ranges::find_if(instants, atStation);
  if (first == instants.end()) return duration();
  auto last = instants.end() - 1;
  while (!atStation(*last)) --last;
  const auto from = first == instants.begin() ? first : first - 1,
             to = last + 1 == instants.end() ? last : last + 1;
  return to->time - from->time;
}

namespace {

constexpr double kMostCut = 0.06;  // mm that a corner in the foam is cut by, at most

/// How far, in parts of its zone, a corner is passed: where the speed goes evenly from v to w over the time
/// that the faster end takes for twice the zone, its place is |w − v| / 4 of half of that time off, of which
/// what lies along the way does not count.
double cornerCut(const std::vector<MotionInstant>& instants, std::size_t i) {
  const MotionInstant &before = instants[i - 1], &at = instants[i], &after = instants[i + 1];
  double fastest = 0, turn = 0;
  for (std::size_t end = 0; end < at.poses.size(); ++end) {
    const Eigen::Vector3d arriving =
                              (at.poses[end].position - before.poses[end].position) / (at.time - before.time),
                          leaving =
                              (after.poses[end].position - at.poses[end].position) / (after.time - at.time);
    fastest = std::max({fastest, arriving.norm(), leaving.norm()});
    const Eigen::Vector3d change = leaving - arriving, along = (arriving + leaving).normalized();
    turn = std::max(turn, (change - change.dot(along) * along).norm());
  }
  return fastest > 0 ? 0.25 * turn / fastest : 0;
}

}  // namespace

double plannedZone(const std::vector<MotionInstant>& instants, std::size_t i) {
  constexpr double kLeastLength = 1e-3;  // mm; shorter segments only turn
  if (i == 0 || i + 1 >= instants.size()) return 0;
  double room = 2 * kZones.front();
  for (std::size_t end = 0; end < instants[i].poses.size(); ++end)
    for (const std::size_t other : {i - 1, i + 1}) {
      const double length = (instants[other].poses[end].position - instants[i].poses[end].position).norm();
      if (length >= kLeastLength) room = std::min(room, length);
    }
  const double cut = instants[i].station >= 0 ? cornerCut(instants, i) : 0;
  const auto fits =
      std::ranges::find_if(kZones, [&](double zone) { return 0.5 * room >= zone && zone * cut <= kMostCut; });
  return fits == kZones.end() ? kZones.back() : *fits;
}

}  // namespace bw
