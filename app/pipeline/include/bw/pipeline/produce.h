// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/files/file_set.h"
#include "bw/pipeline/exit_status.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/result_folder.h"
#include "bw/pipeline/wanted.h"
#include "bw/words/findings.h"

namespace bw::pipeline {

/// The design file that lies beside the results, so that they can be shown and exported again.
inline constexpr const char* kDesignFile = "design.bladewright";

/// Makes further files of the caller, when the findings of the programs are in the evaluation; `made` names
/// the files that are there already, relative to the folder.
using MoreFiles = std::function<Result<FileSet>(const Evaluation& evaluation,
                                                const std::vector<std::filesystem::path>& made)>;

/// What is made of a design, and how.
struct Policy {
  enum class Contents {
    evaluation,  ///< no files
    results,     ///< sweep, surface, mesh, tables, programs of the job, the design, report.json
    programs     ///< those of the job alone
  };
  Contents contents = Contents::results;
  /// A robot program whose design has findings of severity error is written all the same, the errors in the
  /// head of each module.
  bool despiteErrors = false;
  words::Reader reader = words::Reader::commandLine;  ///< of the findings in the report
  std::string programName = "Blade";                  ///< of the modules of `Contents::programs`
  std::filesystem::path programFolder = {};           ///< where these lie in the folder
  MoreFiles more = {};                                ///< beside the results
  Wanted wanted = {};                                 ///< of the results, and blocks of the programs
  /// Where the design leaves the length of its blade open: those that were found for it before
  /// (`foundLengths`), in place of searches.
  CutLengths lengths = {};
};

/// What was made of a design, or how far that came.
struct Product {
  Evaluation evaluation;
  FileSet files;     ///< to be written together; nothing was
  FolderState seen;  ///< of the folder, before the work
  std::optional<Error> error = std::nullopt;

  Findings findings() const { return evaluation.findings(); }
  /// The stations at which the files hold OpenCASCADE's section in place of the traced one that a live
  /// evaluation shows.
  Findings takenOver() const;
  /// 0, 1 where a stated tolerance or a limit is exceeded, or that of the error.
  int status() const;
};

/// Evaluates a design and makes its files for `folder`: the one way of every verb and of the window. Errors:
/// those of `evaluate`; a cell that cannot be read, before the work; no sweep, or an unknown format of
/// program (`badInput`); a program that fails its check; a CAD file that is not the one any more that was
/// read (`cannotRead`); `cancelled`. What of `previous` still holds is used again.
Product produce(const Design& design, const std::filesystem::path& folder, const Policy& policy,
                const RunContext& context, const Evaluation* previous = nullptr);
/// The same of an evaluation that stands.
Product produce(Evaluation evaluation, const std::filesystem::path& folder, const Policy& policy,
                const RunContext& context);

/// The design of an evaluation as it is stored beside the results: without its versions, with the CAD file
/// inside where that is small (8 MB), else linked by its whole path. Error `cannotRead` where the file is not
/// the one any more that the results were made from.
Result<Design> storedDesign(const Evaluation& evaluation);
/// What a design loses where the one that is stored beside its results takes its place, in words that go on
/// from its name ("has named versions, which …"); empty for nothing.
std::string lostInResults(const Design& design);

/// report.json alone, of the run of that name. `files` are listed in it.
std::string reportJson(const Evaluation& evaluation, const std::string& run, const FileSet& files,
                       words::Reader reader);

}  // namespace bw::pipeline
