// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::detail {

/// Tells what is wrong between the stations of an analysed sweep: where stations inside the row are
/// left out, and where the cut surface is farther from the target than the tolerance, which of the two,
/// stations or what lies between them, is to blame. `worst` is the point of `analysis.cut` that is farthest
/// from the target.
void addRowFindings(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                    SweepAnalysis& analysis);

}  // namespace bw::detail
