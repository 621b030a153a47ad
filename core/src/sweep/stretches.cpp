// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/stretches.h"

namespace bw::detail {

Place placeOf(const std::vector<BladePose>& poses, const Stretch& stretch) {
  const BladePose& worst = poses[stretch.worst];
  return {
      StationRange{poses[stretch.first].index, poses[stretch.last].index, worst.index, int(stretch.count)},
      middleOf(worst)};
}

Eigen::Vector3d middleOf(const BladePose& pose) {
  return pose.frame.toWorld(pose.cut.point(0.5 * pose.cut.length()));
}

}  // namespace bw::detail
