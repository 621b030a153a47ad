// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// Chooses the grips of all stations together, so that the blades, with their weight, lie on their sections
/// and the grips go smoothly from one to the next (docs/mathematics.md, the row). `sweep` holds blades that
/// rest near their sections; those that do not rest, or whose ends were asked for, stay as they are. Fails on
/// a stop alone.
[[nodiscard]] Result<void> settleRow(Sweep& sweep, const RunContext& context);

}  // namespace bw::sweep
