// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::detail {

/// Tells which stations of an analysed sweep cannot be cut, or only badly, and why: curvature,
/// inflections, stability, clearance, cutting angle, speed. Neighbouring stations that break the same rule
/// become one finding at the worst of them.
void addStationFindings(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request,
                        SweepAnalysis& analysis);

}  // namespace bw::detail
