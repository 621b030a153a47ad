// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// mm: how far the blades halfway between neighbouring stations, on the smooth way, lie from the sections
/// that would be there, polynomials of the travel through the places of the nearest six; the farthest.
/// Infinite where a blade snaps on its way there, or is not known to stand there; a row of less than two has
/// none. Some 0.3 ms a station. Fails with `cancelled` alone.
[[nodiscard]] Result<double> offBetween(const Sweep& row, const RunContext& context);

}  // namespace bw::sweep
