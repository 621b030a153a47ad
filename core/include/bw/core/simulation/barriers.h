// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// What else a blade could rest in at a moment of a motion that is run, and how much keeps it from that.
struct BarrierLook {
  double time = 0;          ///< s
  std::size_t instant = 0;  ///< of the motion, the last one that was passed
  bool unsure = false;      ///< another stable shape was found that is not clearly higher
  /// N mm that bring the blade over into another one, where it is unsure; none where the way there was not
  /// found.
  std::optional<double> barrier = std::nullopt;
  /// Where all shapes were sought, as at the least one: N mm, its own energy and that of the other one, and
  /// mm between them.
  double energy = 0, other = 0, distance = 0;
};

/// Seeks all shapes at moments spread over the run, where the margin between them is least, and where the
/// least barrier is; between these follows the passes that were found, at every second moment. In the order
/// of time. `stiffness` (N mm²) is that of the blade that was run. A place where nothing could be found out
/// counts as unsure, without a barrier. Of shapes that begin and end between two looks those are seen that
/// lie across (`acrossFrom`): each moment is asked for that. Errors: `cancelled`. Some 0.1 s.
[[nodiscard]] Result<std::vector<BarrierLook>> barriersAlong(const Simulation& simulation, double stiffness,
                                                             const RunContext& context);

/// Whether each blade of a run snaps where a grip is off (`snapsByGrip`), of those between the first station
/// of the motion and its last one that are not held taut; a hundred of them are asked, evenly in time.
/// `cancelled` on a stop. Some 1 ms for each of these.
[[nodiscard]] Result<std::vector<char>> snapsByGripAlong(const Simulation& simulation, const Motion& motion,
                                                         double stiffness, const CheckRequest& request,
                                                         const RunContext& context);

/// The one with the least barrier; null if none has one.
const BarrierLook* leastBarrier(const std::vector<BarrierLook>& looks);

}  // namespace bw
