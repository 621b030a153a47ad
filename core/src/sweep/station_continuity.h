// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/station_fit.h"

namespace bw::detail {

/// Where a section tells little of a blade that is much longer, its nearest curve may swing the blade's ends
/// about although the section hardly changes. Then the shape of the blade moves from the neighbour's towards
/// the nearest one only as far as the ends may turn, if it stays within the tolerance of the section (or as
/// near as the nearest curve, where that is farther); its status then says that a bound is active. Otherwise
/// `nearest` comes back as it is. docs/mathematics.md, sweep.
[[nodiscard]] StationFit besideNeighbour(StationFit nearest, const StationFit& neighbour,
                                         const PlanarCurve& section, const FitRequest& request);

/// Tells where an end of the blade turns far between one station and the next.
void addSwingFindings(const Sweep& sweep, Findings& findings);

}  // namespace bw::detail
