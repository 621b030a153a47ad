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

double plannedZone(const std::vector<MotionInstant>& instants, std::size_t i) {
  constexpr double kLeastLength = 1e-3;  // mm; shorter segments only turn
  if (i == 0 || i + 1 >= instants.size()) return 0;
  double room = 2 * kZones.front();
  for (std::size_t end = 0; end < instants[i].poses.size(); ++end)
    for (const std::size_t other : {i - 1, i + 1}) {
      const double length = (instants[other].poses[end].position - instants[i].poses[end].position).norm();
      if (length >= kLeastLength) room = std::min(room, length);
    }
  const auto fits = std::ranges::find_if(kZones, [&](double zone) { return 0.5 * room >= zone; });
  return fits == kZones.end() ? kZones.back() : *fits;
}

}  // namespace bw
