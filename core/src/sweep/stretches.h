// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/issue.h"
#include "bw/core/sweep.h"

namespace bw::detail {

/// Stations that break a rule, from the first to the last, and the worst of them: indices into the stations
/// of a sweep.
struct Stretch {
  std::size_t first, last, worst, count;
};

/// "station 8", "stations 3 to 9 (worst: 7)" or "4 of the stations 3 to 9 (worst: 7)".
[[nodiscard]] std::string placeOf(const std::vector<Station>& stations, const Stretch& stretch);

/// The middle of a station's cut in the file's frame, mm.
[[nodiscard]] Eigen::Vector3d middleOf(const Station& station);

/// The stretches of neighbouring stations for which `bad(station)` holds, `worse(a, b)` telling the worst, or
/// all of them as one stretch where they are many: a list of places is no message.
template <class Bad, class Worse>
std::vector<Stretch> stretchesOf(const std::vector<Station>& stations, Bad bad, Worse worse) {
  constexpr std::size_t kMostStretches = 3;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (!bad(stations[i])) continue;
    if (stretches.empty() || stretches.back().last + 1 != i) stretches.push_back({i, i, i, 0});
    Stretch& stretch = stretches.back();
    stretch.last = i;
    ++stretch.count;
    if (worse(stations[i], stations[stretch.worst])) stretch.worst = i;
  }
  if (stretches.size() <= kMostStretches) return stretches;
  Stretch all = stretches.front();
  for (std::size_t k = 1; k < stretches.size(); ++k) {
    all.last = stretches[k].last;
    all.count += stretches[k].count;
    if (worse(stations[stretches[k].worst], stations[all.worst])) all.worst = stretches[k].worst;
  }
  return {all};
}

/// Tells each such stretch as one issue at its worst station; `text(station, stretch)` follows the place.
template <class Bad, class Worse, class Text>
void reportStretches(const std::vector<Station>& stations, Severity severity, const char* kind, Bad bad,
                     Worse worse, Text text, Issues& issues) {
  for (const Stretch& stretch : stretchesOf(stations, bad, worse)) {
    const Station& w = stations[stretch.worst];
    issues.push_back({severity, kind, placeOf(stations, stretch) + ": " + text(w, stretch),
                      Place{stationName(w.index), 0, w.index, middleOf(w)}});
  }
}

}  // namespace bw::detail
