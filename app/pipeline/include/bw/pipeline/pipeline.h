// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/cell.h"
#include "bw/core/design.h"
#include "bw/core/file_set.h"
#include "bw/core/mesh.h"
#include "bw/core/result.h"
#include "bw/core/run_context.h"
#include "bw/core/sweep.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"

namespace bw::pipeline {

/// Seconds that each step took; 0 where an earlier result was used again.
struct Seconds {
  double read = 0, sections = 0, fit = 0, extend = 0, check = 0, write = 0, total = 0;
};

/// A derived result with the key of all that it depends on. Results are never edited.
template <class T>
struct Stage {
  std::string key;
  std::shared_ptr<const T> value;
  Issues issues = {};
};

struct SweepResult {
  Sweep sweep;  ///< with the checks' numbers filled in
  SweepAnalysis analysis;
  Motion motion;
};

/// Everything that follows from a design. Stages that failed or were not reached are null.
struct Evaluation {
  Design design;
  Stage<geometry::CadModel> model;
  Stage<geometry::Target> target;
  Stage<TriangleMesh> targetMesh;
  Stage<geometry::Setup> setup;
  Stage<std::vector<Section>> sections;
  Stage<Sweep> fits;  ///< the sweep before its checks
  Stage<SweepResult> sweep;
  Stage<Cell>
      cell;  ///< only where the job asks for programs; its issues tell how the motion lies in the cell
  Issues programs;  ///< what the check of the programs warns of, once `resultFiles` made them
  Seconds seconds;

  Issues issues() const;  ///< of all stages in order, and of the programs
};

/// How far an evaluation got before it failed: the stages done stay usable, and the error names the step.
struct Outcome {
  Evaluation evaluation;
  std::optional<Error> error = std::nullopt;
};

/// Evaluates a design. Stages of `previous` whose keys are unchanged are used again, so that a change
/// recomputes only what depends on it.
Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context);

/// report.json, sweep.json, surface.step, mesh.obj, stations.csv and deviation.csv of an evaluation, plus the
/// programs of its job in programs/, as files to be written together. Program files that fail their check are
/// an error.
Result<FileSet> resultFiles(Evaluation& evaluation, const RunContext& context);

/// report.json alone. `files` are listed in it.
std::string reportJson(const Evaluation& evaluation, const std::vector<std::filesystem::path>& files);

/// Programs of a motion: formats "rapid", "csv", "json"; an unknown format is an error naming the nearest
/// one. What their check warns of is added to `warnings`.
Result<FileSet> programFiles(const Motion& motion, const Cell& cell, const std::vector<std::string>& formats,
                             const std::string& name, Issues& warnings);

}  // namespace bw::pipeline
