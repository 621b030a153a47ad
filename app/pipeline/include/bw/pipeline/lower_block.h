// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/design/design.h"
#include "bw/core/surface/mesh.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// The design whose block reaches so many mm lower, as it lies for a cut: it gets higher, and all that is cut
/// stays where it is. In a grid that is the lowest layer. Empty where that cannot be: there is no such cut,
/// its block is not placed, something else lies below, or it would be larger than a block may be.
std::optional<Design> withLowerBlock(const Design& design, const std::string& cut, double by);

/// Whether a surface goes on below a block, over its bottom: a block that reached lower would then be cut
/// lower, too. Where it does not, the sections of a lower block are those of this one.
bool goesOnBelow(const TriangleMesh& surface, const Box& lies);

/// Of each way between stations, into the row or out of it that comes below the floor (`NearBottom` of a
/// range that counts no station, among `findings`) by how much lower its block would have to reach, where one
/// that does leads to a way that keeps it. Entry, exit and motion are planned again for such blocks, the row
/// being as it is; some four sizes are tried. Error: `cancelled`.
Result<std::vector<LowerWay>> lowerForWays(const CutEvaluation& cut, const Findings& findings,
                                           const RunContext& context);

/// mm by which a block that is made around its surface has to reach lower, so that all these ways keep the
/// floor, the row being as it is; 0 where they do already, or no size that is tried helps. Error:
/// `cancelled`.
Result<double> deeperForWays(const CutEvaluation& cut, const RunContext& context);

/// Tells findings of blades that come below the floor what a block that reaches lower comes to. Those of the
/// cell's home, and all of a cut without a block that is placed, stay as they are.
void adviseLowerBlock(Findings& findings, const CutEvaluation& cut, const Design& design);

}  // namespace bw::pipeline
