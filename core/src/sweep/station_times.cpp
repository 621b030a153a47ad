// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/station_times.h"

#include <cmath>
#include <cstddef>

namespace bw {

std::vector<double> stationTimes(const Motion& motion, const std::vector<BladePose>& poses) {
  std::vector<double> times;
  for (const MotionInstant& instant : motion.instants) {
    if (instant.station < 0) continue;
    const std::size_t before = times.size();
    std::size_t at = before;
    while (at < poses.size() && poses[at].index != instant.station) ++at;
    if (at == poses.size() || (before == 0 && at > 0)) return {};
    for (std::size_t k = before; k < at; ++k) {
      const double from = poses[before - 1].travel;
      times.push_back(
          std::lerp(times[before - 1], instant.time, (poses[k].travel - from) / (poses[at].travel - from)));
    }
    times.push_back(instant.time);
  }
  return times.size() == poses.size() ? times : std::vector<double>();
}

}  // namespace bw
