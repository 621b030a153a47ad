// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/heavy/heavy_bvp.h"

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

double plannedZone(const std::vector<MotionInstant>& instants, std::size_t i, double cornersWithin) {
  constexpr double kLeastLength = 1e-3;  // mm; shorter segments only turn
  if (i == 0 || i + 1 >= instants.size()) return 0;
  double room = 2 * kZones.front();
  for (std::size_t end = 0; end < instants[i].poses.size(); ++end)
    for (const std::size_t other : {i - 1, i + 1}) {
      const double length = (instants[other].poses[end].position - instants[i].poses[end].position).norm();
      if (length >= kLeastLength) room = std::min(room, length);
    }
  const double cut = instants[i].station >= 0 ? cornerCut(instants, i) : 0;
  const auto fits = std::ranges::find_if(
      kZones, [&](double zone) { return 0.5 * room >= zone && zone * cut <= cornersWithin; });
  return fits == kZones.end() ? kZones.back() : *fits;
}

namespace {

constexpr double kAllButTaut = 0.02;  // mm of slack below which rounding bends a blade

/// In whole units, a way from end to end that a blade so long sags on as over `asked`, as nearly as such
/// numbers can. Along the axis that the way is nearest to it is as long as it was, or a unit more or less;
/// what the length lacks then is sought across, where a unit changes it by little.
Eigen::Vector3d tautWay(const Eigen::Vector3d& asked, double bladeLength) {
  constexpr double kOne = kPlaceUnit;
  const double apart = asked.norm(), sag = largestSag(bladeLength, apart);
  Eigen::Index main = 0;
  asked.cwiseAbs().maxCoeff(&main);
  Eigen::Vector3d best = asked;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Eigen::Vector3d& way) {
    const double cost = std::abs(largestSag(bladeLength, way.norm()) - sag) + std::abs(way.norm() - apart) +
                        (way - asked).norm();
    if (cost >= least) return;
    least = cost;
    best = way;
  };
  const auto whole = [](double value) { return kOne * std::round(value / kOne); };
  const double along = whole(asked[main]);
  for (const Eigen::Index free : {(main + 1) % 3, (main + 2) % 3}) {
    const Eigen::Index other = 3 - main - free;
    for (int a = -1; a <= 1; ++a)
      for (int b = -3; b <= 3; ++b) {
        Eigen::Vector3d way;
        way[main] = along + a * kOne;
        way[other] = whole(asked[other]) + b * kOne;
        way[free] = whole(asked[free]);
        consider(way);
        const double square = apart * apart - way[main] * way[main] - way[other] * way[other];
        if (square < 0) continue;
        way[free] = whole(std::copysign(std::sqrt(square), asked[free]));
        consider(way);
      }
  }
  return best;
}

}  // namespace

void roundPlaces(std::vector<Pose>& poses, double bladeLength) {
  const auto rounded = [](const Eigen::Vector3d& place) -> Eigen::Vector3d {
    constexpr double kUnits = 1 / kPlaceUnit;
    return (kUnits * place).array().round() / kUnits;
  };
  std::optional<Eigen::Vector3d> way;
  if (poses.size() == 2 && bladeLength > 0) {
    const Eigen::Vector3d asked = poses[1].position - poses[0].position;
    if (std::abs(bladeLength - asked.norm()) <= kAllButTaut) way = tautWay(asked, bladeLength);
  }
  for (Pose& pose : poses) pose.position = rounded(pose.position);
  if (way) poses[1].position = rounded(poses[0].position + *way);
}

}  // namespace bw
