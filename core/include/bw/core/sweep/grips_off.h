// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// What brings blades that are held into another shape where one grip is off by as much as the request says:
/// of each station the grip and the way are those that lower the barrier most, to first order, and the blade
/// and what it would pass are followed there. Findings (`HeldByLittle`, warnings) where that is less than
/// `kLeastBarrier`, or the blade snaps. `cancelled` on a stop. Some 0.5 ms a station.
[[nodiscard]] Result<Findings> heldWithGripsOff(const Sweep& sweep, const RowCertainty& certainty,
                                                const RowRest& rest, const CheckRequest& request,
                                                const RunContext& context);

}  // namespace bw
