// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bw/core/file_set.h"
#include "bw/core/run_context.h"
#include "workbench/report_print.h"

namespace bw::app {

/// All files of a result that make it understandable and usable without this program: those of
/// `pipeline::resultFiles`, the design that they follow from, the surface as IGES, the mesh as STL, the
/// report as HTML and PDF, and the pictures. What the check of the programs warns of goes to
/// `evaluation.programs`.
Result<FileSet> handoverFiles(pipeline::Evaluation& evaluation, const std::vector<ReportImage>& pictures,
                              const RunContext& context);

/// A file that was written, relative to its folder.
struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};
std::vector<WrittenFile> writtenFiles(const FileSet& files);

}  // namespace bw::app
