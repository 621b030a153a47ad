// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// True if no blade of `next` stands worse than in `before`, a row of as many: none that stood snaps, is
/// unknown or has no shape, none falls below the margins asked for, and none is farther from its section but
/// within the tolerance. False at a stop.
bool keepsUp(const Sweep& next, const Sweep& before, const RunContext& context = {});

}  // namespace bw::sweep
