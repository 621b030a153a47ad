// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What several cuts of one block have to do with each other: which comes first, what they leave of it.
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Puts the cuts of each block, whose surfaces are meshed, into the order in which they are made, and leaves
/// those out that meet less than the tolerance of what is left; `missed` tells of them. A block that lies
/// around its surfaces gets its place here, where it has several. Errors: a surface that stands along the
/// side that is to stay (`badInput`); `cancelled`.
Result<void> orderCuts(Evaluation& e, const Evaluation* previous, const RunContext& context);

/// How the cuts of each block meet, once their blades are found. Errors: `cancelled`, and those of
/// surfaces.
Result<void> compareBlocks(Evaluation& e, const Evaluation* previous, const RunContext& context);

/// What was left of blocks of which neither place nor blades changed stays. Error: `cancelled`.
Result<void> keepParts(Evaluation& e, const Evaluation* previous);

/// What is left of a block all of whose cuts came to a result, as a solid. Some 0.4 s a cut. Error:
/// `cancelled`.
Result<void> makePart(Evaluation& e, BlockEvaluation& block, const Evaluation* previous, double& seconds,
                      const RunContext& context);

/// The same of all blocks, where files want it.
Result<void> makeParts(Evaluation& e, const Evaluation* previous, const RunContext& context);

}  // namespace bw::pipeline
