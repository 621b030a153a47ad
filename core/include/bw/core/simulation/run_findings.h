// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/simulation/barriers.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/row_motion.h"

namespace bw {

/// What the run of a row's motion tells of the blade between its stations, on the way in and on the way out:
/// where it crosses itself, where a round one does not rest in its plane, and where what is cut lies farther
/// off than `request` allows. What `known` tells already, of stations beside or of the way between them, is
/// not told again. The range of a finding has the stations beside, −1 for none, and counts 0 of them; that of
/// `OffTheSurfaceShown` the station before.
[[nodiscard]] Findings runFindings(const Simulation& simulation, const SimulatedSurface& surface,
                                   const Motion& motion, const SweepAnalysis& analysis,
                                   const WayRequest& request, const Findings& known);

/// Where along the run a push of less than `kLeastBarrier` brings the blade into another shape, or it could
/// not be found out how little does: the first such place, told as `OtherShape`. Empty where `known` tells
/// already that shapes are lost. Ranges as above.
[[nodiscard]] Findings barrierFindings(const std::vector<BarrierLook>& looks, const Simulation& simulation,
                                       const Motion& motion, const Findings& known);

}  // namespace bw
