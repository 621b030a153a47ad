// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/stretches.h"

namespace bw::detail {

Place placeOf(const std::vector<Station>& stations, const Stretch& stretch) {
  const Station& worst = stations[stretch.worst];
  return {StationRange{stations[stretch.first].index, stations[stretch.last].index, worst.index,
                       int(stretch.count)},
          middleOf(worst)};
}

Eigen::Vector3d middleOf(const Station& station) {
  return station.frame.toWorld(station.fit.elastica.point(0.5 * station.fit.elastica.length()));
}

}  // namespace bw::detail
