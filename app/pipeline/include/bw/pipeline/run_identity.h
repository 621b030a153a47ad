// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "bw/core/cell.h"
#include "bw/core/issue.h"
#include "bw/core/result.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// Kind of the finding that tells of files from different runs.
inline constexpr const char* kRunIssue = "run";

/// The name of a run: the fingerprint of all that its results depend on, which are the job without what only
/// chooses among outputs (`programs`, `threads`), the bytes of the CAD file, the version of the program, the
/// cell if there are programs, and the motion that came out. Runs of equal input have equal names, for any
/// number of threads. Needs a sweep.
std::string runId(const Evaluation& evaluation, const Cell* cell);

/// True for a folder with a report.json of ours that names its run.
bool isResultFolder(const std::filesystem::path& folder);

/// Compares files with the report.json of their run: `path` is a folder of results, or a folder or file of
/// programs below one. An error for each file that is of another run, missing, or not as it was written; a
/// warning for a module of the run that was changed since. Nothing where there is no report, or one of a
/// version that named no runs.
Issues compareWithReport(const std::filesystem::path& path);

/// Refuses a folder of results whose design and sweep are not those of its report (`ErrorCode::badInput`).
Result<void> checkOneRun(const std::filesystem::path& folder, const std::string& designFile);

}  // namespace bw::pipeline
