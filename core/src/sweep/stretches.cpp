// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/stretches.h"

namespace bw::detail {

std::string placeOf(const std::vector<Station>& stations, const Stretch& stretch) {
  const auto index = [&](std::size_t i) { return std::to_string(stations[i].index + 1); };
  if (stretch.first == stretch.last) return "station " + index(stretch.first);
  const std::string range = index(stretch.first) + " to " + index(stretch.last);
  const bool all = stretch.count == stretch.last - stretch.first + 1;
  return (all ? "stations " + range + " ("
              : std::to_string(stretch.count) + " of the stations " + range + " (") +
         "worst: " + index(stretch.worst) + ")";
}

Eigen::Vector3d middleOf(const Station& station) {
  return station.frame.toWorld(station.fit.elastica.point(0.5 * station.fit.elastica.length()));
}

}  // namespace bw::detail
