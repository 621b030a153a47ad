// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "bw/core/base/run_context.h"
#include "bw/core/files/file_set.h"
#include "bw/pipeline/produce.h"
#include "workbench/report_print.h"

namespace bw::app {

/// Has all files of a result made that let it be understood and used without this program: beside those of
/// `Contents::results` the surface as IGES, the mesh as STL, the report as HTML and PDF, and the pictures.
pipeline::Policy handoverPolicy(std::vector<ReportImage> pictures, const RunContext& context);

/// A file that was written, relative to its folder.
struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};
std::vector<WrittenFile> writtenFiles(const FileSet& files);

}  // namespace bw::app
