// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a program does around its cut, and how fast it goes through the block.
#pragma once

#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/simulate.h"
#include "bw/robotio/dialects.h"

namespace bw::pipeline {

/// What a program is looked at with.
struct ProgramLook {
  const robotio::Dialect& dialect;
  const robotio::Program& files;  ///< of that dialect
  const Design& design;
  const CutEvaluation& cut;  ///< that it is of
  const Cell* cell;          ///< of the design; null where there is none
  bool exchanged;            ///< its ends stand the other way round, which is told
  const Blade& blade;
  const Eigen::Vector3d& weight;
};

/// Runs the program from home on to where it ends, and adds to `run` what is found on the way to the block
/// and from it: contact with the block, what no blade can do, and in what home, approach, retreat and targets
/// differ from what the design planned; then where the blade stands still in the block or passes it more
/// slowly than the design has it. Errors: `cancelled`.
Result<void> judgeAround(ProgramRun& run, const ProgramLook& look, const RunContext& context);

}  // namespace bw::pipeline
