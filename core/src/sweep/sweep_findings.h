// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::sweep {

/// Tells which stations of an analysed sweep cannot be cut, or only badly, and why: curvature,
/// inflections, stability, clearance, cutting angle, speed. Neighbouring stations that break the same rule
/// become one finding at the worst of them.
void addStationFindings(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request,
                        SweepAnalysis& analysis);

/// Tells what is wrong between the stations of an analysed sweep: where stations inside the row are
/// left out, and where the cut surface is farther from the target than the tolerance, which of the two,
/// stations or what lies between them, is to blame. `worst` is the point of `analysis.cut` that is farthest
/// from the target.
void addRowFindings(const Sweep& sweep, const CheckRequest& request, std::size_t worst,
                    SweepAnalysis& analysis);

/// Tells where the curvature of the sections alone keeps the blade farther off than the tolerance:
/// place, radius, limit, and which blade or how large a surface would do. An error where the blade would have
/// to overbend, or where that distance is beyond what a taken curve may miss (`kAllowance` tolerances), else
/// a warning. Only stations that miss their section or break the blade are looked at; a row without such
/// costs nothing. Returns for each station whether it is among these.
std::vector<char> addTightFindings(const Sweep& sweep, const CheckRequest& request, SweepAnalysis& analysis);

/// Tells where an end of the blade turns far between one station and the next.
void addSwingFindings(const Sweep& sweep, Findings& findings);

}  // namespace bw::sweep
