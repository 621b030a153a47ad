// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::detail {

/// Tells where the curvature of the sections alone keeps the blade farther off than the tolerance:
/// place, radius, limit, and which blade or how large a surface would do. An error where the blade would have
/// to overbend, or where that distance is beyond what a taken curve may miss (`kAllowance` tolerances), else
/// a warning. Only stations that miss their section or break the blade are looked at; a row without such
/// costs nothing. Returns for each station whether it is among these.
std::vector<char> addTightFindings(const Sweep& sweep, const CheckRequest& request, SweepAnalysis& analysis);

}  // namespace bw::detail
