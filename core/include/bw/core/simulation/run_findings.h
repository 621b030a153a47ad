// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/simulation/barriers.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/row_motion.h"

namespace bw {

/// What the run of a row's motion tells of the blade between its stations, on the way in and on the way out:
/// where it crosses itself, where a round one does not rest in its plane, where a point of it goes faster
/// than `kFaster` times the cutting speed, and where what is cut lies farther off than `request` allows. What
/// `known` tells already, of stations beside or of the way between them, is not told again. The range of a
/// finding has the stations beside, −1 for none, and counts 0 of them; that of `OffTheSurfaceShown` the
/// station before.
[[nodiscard]] Findings runFindings(const Simulation& simulation, const SimulatedSurface& surface,
                                   const Motion& motion, const SweepAnalysis& analysis,
                                   const WayRequest& request, const Findings& known);

/// How many times the cutting speed a run may have: durations are rounded, and corners.
inline constexpr double kFaster = 1.1;
/// How much less than this a run may keep of a margin: what is rounded in programs.
inline constexpr double kMarginRounded = 1e-3;

/// How loosely the blade rests along the run. Where a push of less than `kLeastBarrier` brings it into
/// another shape: the least such place; else the first where it could not be found out how little does; both
/// told as `OtherShape`, but where `known` tells that shapes are lost. And stretches that keep less than the
/// margin of the request (`LowMargin`), or whose blades snap where a grip is off (`GripErrors`; one of
/// `snapsByGrip` a blade), but where `known` tells that of stations beside, or that blades snap there anyway.
/// Ranges as above.
[[nodiscard]] Findings restFindings(const std::vector<BarrierLook>& looks,
                                    const std::vector<char>& snapsByGrip, const Simulation& simulation,
                                    const Motion& motion, const CheckRequest& request, const Findings& known);

}  // namespace bw
