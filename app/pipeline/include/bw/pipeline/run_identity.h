// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/motion/cell.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// The name of a run: the fingerprint of all that its results depend on, which are the design without its
/// names and what only chooses among outputs, the bytes of the CAD file, the version of the program, the cell
/// if there are programs, and the motion that came out. Runs of equal input have equal names, for any number
/// of threads. Needs a sweep.
std::string runId(const Evaluation& evaluation, const Cell* cell);

/// True for a folder that holds results of ours, whole or not: a report.json of ours, a
/// sweep.json or a folder "programs".
bool isResultFolder(const std::filesystem::path& folder);

/// Compares files with the report.json of their run: `path` is a folder of results, or a folder or file of
/// programs below one. An error for each file that is of another run, missing, listed without a fingerprint
/// or not as it was written, also for modules of other runs that it does not list; a warning for a module of
/// the run that was changed since. An error too where results have no report; and where it is damaged or
/// names no run. Nothing for what is not among results.
Findings compareWithReport(const std::filesystem::path& path);

/// Refuses a folder of results whose design and sweep are not those of its report (`ErrorCode::badInput`).
/// One without a report passes: the design speaks for itself.
Result<void> checkOneRun(const std::filesystem::path& folder, const std::string& designFile);

/// The lengths of the blades that the results in a folder were made with, whether their design gave them or
/// left them open. Empty where no report tells.
CutLengths lengthsMadeWith(const std::filesystem::path& folder);
/// The errors that the report of a folder of results tells of its design; none where it has no such report.
std::vector<std::string> errorsOfReport(const std::filesystem::path& folder);
/// Of these the ones that were sought, and found to serve: a search would find them again.
CutLengths foundLengths(const std::filesystem::path& folder);

}  // namespace bw::pipeline
