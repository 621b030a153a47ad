// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "bw/core/sweep/sweep_check.h"

namespace bw::sweep {

/// The velocity of the part that cuts at a station, at `columns` points of equal shares of its length, where
/// the fastest point of the whole blade goes at `cuttingSpeed` (mm/s): thesis 5.3 with the blade's own
/// material points. `travel` of all poses, mm, two or more.
[[nodiscard]] StationVelocity stationVelocity(const std::vector<BladePose>& poses,
                                              const std::vector<double>& travel, std::size_t i, int columns,
                                              double cuttingSpeed);

}  // namespace bw::sweep
