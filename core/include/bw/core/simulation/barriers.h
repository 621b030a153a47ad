// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/simulation/simulation.h"

namespace bw {

/// What else a blade could rest in at a moment of a motion that is run, and how much keeps it from that.
struct BarrierLook {
  double time = 0;          ///< s
  std::size_t instant = 0;  ///< of the motion, the last one that was passed
  bool unsure = false;      ///< another stable shape was found that is not clearly higher
  /// N mm that bring the blade over into another one, where it is unsure; none where the way there was not
  /// found.
  std::optional<double> barrier = std::nullopt;
};

/// Looks at moments spread over the run, where the margin between them is least, and nearer and nearer to the
/// least barrier found; in the order of time. `stiffness` (N mm²) is that of the blade that was run. A place
/// where nothing could be found out counts as unsure, without a barrier. What is there between two looks
/// alone is not seen. Errors: `cancelled`. Some 0.1 s.
[[nodiscard]] Result<std::vector<BarrierLook>> barriersAlong(const Simulation& simulation, double stiffness,
                                                             const RunContext& context);

/// The one with the least barrier; null if none has one.
const BarrierLook* leastBarrier(const std::vector<BarrierLook>& looks);

}  // namespace bw
