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

/// What a station's velocity is from its slowest to its fastest point, mean of the angle.
struct VelocitySpan {
  double angleMean = 0, angleMax = 0;  ///< rad
  double relativeMin = 1;              ///< slowest over fastest
  double speedMin = 0, speedMax = 0;   ///< mm/s
};

/// Of the points that are `held`, one flag each; where none is, of all.
[[nodiscard]] VelocitySpan spanOf(const StationVelocity& velocity, const std::vector<char>& held);

}  // namespace bw::sweep
