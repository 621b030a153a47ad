// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "fit/fit_constraints.h"

namespace bw::fit {

/// Pieces of elastica of all kinds over which a target was laid, and how near each came.
struct AtlasPlace {
  Placement placement;
  double value = 0;   ///< mean square distance, more where the conditions are missed
  double order = 0;   ///< by which places are tried
  bool held = false;  ///< laid with ends or tangents
};

/// True if a descent from there does not come below a known value as far as experience tells.
bool hopeless(const AtlasPlace& place, double knownValue);

/// Where descents to a target may start so that none of the basins is left out: of a table of some thousand
/// pieces (swing or turns, periods, phase) with some inflections more than the target, laid over the target
/// as the conditions ask, those that lie nearer than their neighbours of the same length; the nearest first,
/// with a handicap beside a nearer one of another length, at most `most`. Ends are met, tangents and a length
/// only nearly. About 0.1 ms, with ends or tangents 0.3.
std::vector<AtlasPlace> placesFromAtlas(const FitTarget& target, const FitConstraints& constraints,
                                        std::size_t most);

}  // namespace bw::fit
