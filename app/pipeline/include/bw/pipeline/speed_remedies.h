// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What helps where the slowest point of a blade stands nearly still beside its fastest.
#pragma once

#include <string>

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// The cut of an evaluation whose blade has the most uneven speeds, of those of which a finding tells it;
/// null if there is none.
const CutEvaluation* mostUnevenCut(const Evaluation& e);

/// The design with other planes for a cut, and for all that are as it: of its surface and direction.
Design withPlanes(const Design& design, const std::string& cut, const UnevenSpeed::Planes& planes);

/// Seeks what helps that cut. Splits of its block across the blade are tried, fewest parts first, and other
/// families of planes: those of its key blades, where its own are parallel, or those of the direction that a
/// search finds; parallel ones where its own turn; those along the blade. Each is evaluated as a design of
/// its own, and is none where a part of the blade is slower than kSpeedRatioLimit of its fastest point, or
/// where it brings an error or a warning of a kind that the design does not have. Of the families the one
/// with the most even speeds is taken. Error: `cancelled`.
Result<SpeedRemedies> speedRemedies(const Evaluation& e, const CutEvaluation& cut, const RunContext& context);

/// Tells findings of uneven speeds what was found to help, in place of what was not tried.
void adviseSpeeds(Findings& findings, const CutEvaluation& cut);

}  // namespace bw::pipeline
