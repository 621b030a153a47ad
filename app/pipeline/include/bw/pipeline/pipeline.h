// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/cell.h"
#include "bw/core/design.h"
#include "bw/core/face_mesh.h"
#include "bw/core/file_set.h"
#include "bw/core/mesh.h"
#include "bw/core/result.h"
#include "bw/core/run_context.h"
#include "bw/core/sweep.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"
#include "bw/pipeline/direction_search.h"
#include "bw/pipeline/requests.h"

namespace bw::pipeline {

/// Seconds that each step took; 0 where an earlier result was used again.
struct Seconds {
  double read = 0, direction = 0, sections = 0, fit = 0, extend = 0, check = 0, write = 0, total = 0;
};

/// The results that another stands on, by identity.
using Inputs = std::vector<std::shared_ptr<const void>>;

/// A derived result, and what it was made from: a request, and the results that it stands on. Where both are
/// as they were, so is the result. Results are never edited.
template <class Request, class T>
struct Stage {
  Request request = {};
  Inputs inputs = {};
  std::shared_ptr<const T> value = {};
  Issues issues = {};
};

/// A CAD file that was read.
struct CadSource {
  geometry::CadModel model;
  Fingerprint content;  ///< of the bytes that were read
};

struct SweepResult {
  Sweep sweep;  ///< with the checks' numbers filled in
  SweepAnalysis analysis;
  Motion motion;
};

/// Everything that follows from a design. Stages that failed or were not reached are null.
struct Evaluation {
  Design design;
  Issues sourceIssues;  ///< whether the linked source is another than when the design was saved
  Stage<SourceRequest, CadSource> source;
  Stage<FaceChoice, geometry::Target> target;
  Stage<NoRequest, TriangleMesh> targetMesh;
  Stage<NoRequest, FaceMesh> faceMesh;  ///< of all faces of the file; only from `addFaceMesh`
  Stage<geometry::SetupRequest, geometry::Setup> placed;
  Stage<RowRequest, DirectionSearch> directions;  ///< only where the job's direction is "auto"
  std::shared_ptr<const geometry::Setup> setup;   ///< `placed` with the direction that was chosen
  Stage<PlanesRequest, std::vector<Section>> sections;
  Stage<RowRequest, Sweep> fits;  ///< the sweep before its checks
  Stage<ResultRequest, SweepResult> sweep;
  Stage<CellRequest, Cell> cell;  ///< only where the job asks for programs; its issues tell how the motion
                                  ///< lies in the cell
  Issues programs;                ///< what the check of the programs warns of, once `resultFiles` made them
  Seconds seconds;

  Issues issues() const;  ///< of all stages in order, and of the programs
};

/// How far an evaluation got before it failed: the stages done stay usable, and the error names the step.
struct Outcome {
  Evaluation evaluation;
  std::optional<Error> error = std::nullopt;
};

/// Kind of the finding that the linked source is another than when the design was saved.
inline constexpr const char* kSourceIssue = "source";

/// Evaluates a design. Stages of `previous` whose keys are unchanged are used again, so that a change
/// recomputes only what depends on it.
Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context);

/// Adds the triangles of all faces of the file, to choose among them, unless the file has one face only or
/// was not read. Those of `previous` are used again where the file is the same. A stop leaves them out.
void addFaceMesh(Evaluation& evaluation, const Evaluation* previous, const RunContext& context);

/// What becomes of a robot program whose design has findings of severity error: by default it is not written.
struct ProgramPolicy {
  bool despiteErrors = false;  ///< written all the same, the errors in the head of each module
  std::string remedy = {};     ///< how the caller offers that, to close the message of a refusal
};

/// The design file that lies beside the results, so that they can be shown and exported again.
inline constexpr const char* kDesignFile = "design.bladewright";

/// The design of an evaluation as it is stored beside the results: with the CAD file inside where that is
/// small (8 MB), else linked by its whole path. Error `cannotRead` where the file is not the one any more
/// that the results were made from.
Result<Design> storedDesign(const Evaluation& evaluation);

/// Makes further files of the caller, when the findings of the programs are in the evaluation; `made` names
/// the files that are there already, relative to the folder.
using MoreFiles = std::function<Result<FileSet>(const std::vector<std::filesystem::path>& made)>;

/// sweep.json, surface.step, mesh.obj, stations.csv and deviation.csv of an evaluation, the programs of its
/// job in programs/ as `programFiles` has them, `more` of the caller, and last report.json, as files to be
/// written together. The report lists exactly these, with the fingerprint of each and the name of the run.
/// Errors: no sweep (`badInput`), a cell that cannot be read, a program that fails its check, `cancelled`,
/// and those of `more`.
Result<FileSet> resultFiles(Evaluation& evaluation, const RunContext& context,
                            const ProgramPolicy& policy = {}, const MoreFiles& more = {});

/// report.json alone, of the run of that name. `files` are listed in it.
std::string reportJson(const Evaluation& evaluation, const std::string& run, const FileSet& files);

/// Kind of the finding that tells of a robot program not written, or written despite errors.
inline constexpr const char* kProgramIssue = "program";

/// Programs of an evaluated sweep in formats "rapid", "csv", "json"; an unknown format is an error naming the
/// nearest one, and so is a program that fails its check. Where the evaluation has errors, RAPID is left out
/// unless `policy` says otherwise; motions as CSV and JSON, which no robot runs, are written all the same.
/// `findings` gets what the check warns of, after a finding of kind `kProgramIssue` where errors stand
/// against the program: an error if it is left out, a warning if it is marked.
Result<FileSet> programFiles(const Evaluation& evaluation, const Cell& cell,
                             const std::vector<std::string>& formats, const std::string& name,
                             const ProgramPolicy& policy, Issues& findings);

}  // namespace bw::pipeline
