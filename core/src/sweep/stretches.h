// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// Stations that break a rule, from the first to the last, and the worst of them: indices into the stations
/// of a sweep.
struct Stretch {
  std::size_t first, last, worst, count;
};

/// The middle of a station's cut in the file's frame, mm.
[[nodiscard]] inline Eigen::Vector3d middleOf(const BladePose& pose) {
  return pose.frame.toWorld(pose.cut.point(0.5 * pose.cut.length()));
}

/// Where that is; the point is the middle of the worst station's cut.
[[nodiscard]] inline Place placeOf(const std::vector<BladePose>& poses, const Stretch& stretch) {
  const BladePose& worst = poses[stretch.worst];
  return {
      StationRange{poses[stretch.first].index, poses[stretch.last].index, worst.index, int(stretch.count)},
      middleOf(worst)};
}

/// The stretches of neighbouring ones of `count` stations for which `bad(i)` holds, `worse(i, j)` telling the
/// worst, or all of them as one stretch where they are many: a list of places is no message.
template <class Bad, class Worse>
std::vector<Stretch> stretchesOf(std::size_t count, Bad bad, Worse worse) {
  constexpr std::size_t kMostStretches = 3;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < count; ++i) {
    if (!bad(i)) continue;
    if (stretches.empty() || stretches.back().last + 1 != i) stretches.push_back({i, i, i, 0});
    Stretch& stretch = stretches.back();
    stretch.last = i;
    ++stretch.count;
    if (worse(i, stretch.worst)) stretch.worst = i;
  }
  if (stretches.size() <= kMostStretches) return stretches;
  Stretch all = stretches.front();
  for (std::size_t k = 1; k < stretches.size(); ++k) {
    all.last = stretches[k].last;
    all.count += stretches[k].count;
    if (worse(stretches[k].worst, all.worst)) all.worst = stretches[k].worst;
  }
  return {all};
}

}  // namespace bw::sweep
