// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/motion/cell.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {

/// sweep.json, surface.step, mesh.obj, stations.csv and deviation.csv of an evaluated sweep, the programs of
/// its job in programs/ as `programFiles` has them, the design, those of the policy's caller, and last
/// report.json. The report lists exactly these, with the fingerprint of each and the name of the run.
Result<FileSet> resultFiles(Evaluation& evaluation, const RunContext& context, const Policy& policy);

/// Programs of an evaluated sweep in the formats of its job; an unknown format is an error naming the nearest
/// one, and so is a program that fails its check. Where the evaluation has errors, RAPID is left out unless
/// `policy` says otherwise; motions as CSV and JSON, which no robot runs, are written all the same.
/// `evaluation.programs` gets what the check warns of, after `ProgramDespiteErrors` where errors stand
/// against the program: an error if it is left out, a warning if it is marked.
Result<FileSet> programFiles(Evaluation& evaluation, const Cell& cell, const std::string& name,
                             const Policy& policy);

/// A surface as Wavefront OBJ.
std::string objText(const SurfaceGrid& cut);

}  // namespace bw::pipeline
