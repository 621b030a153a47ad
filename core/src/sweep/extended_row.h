// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/section.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// The blades of a row whose grips are held by their sections, extended: each has their ends, tangents and
/// length, on the branch of the elastica that lies nearest to them. Where there is none that one itself,
/// which its fit tells. `sections` are those of the poses.
[[nodiscard]] Result<void> solveExtended(Sweep& sweep, const std::vector<const Section*>& sections,
                                         const RunContext& context);

}  // namespace bw::sweep
