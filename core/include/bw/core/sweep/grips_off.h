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
/// and what it would pass are followed there. Findings (`HeldByLittle`) of `rest` where that is less than
/// `kLeastBarrier` (warning), or the blade snaps (error), which is lost there. `cancelled` on a stop. Some
/// 0.5 ms a station.
[[nodiscard]] Result<void> judgeGripsOff(const Sweep& sweep, const RowCertainty& certainty,
                                         const CheckRequest& request, const RunContext& context,
                                         RowRest& rest);

}  // namespace bw
