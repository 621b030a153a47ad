// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// What the report.json of a folder says of its run.
struct ReportRecord {
  std::filesystem::path folder;
  std::string run;                                  ///< empty if it names none
  std::set<std::string> files;                      ///< that it lists, by path within the folder
  std::map<std::string, std::string> fingerprints;  ///< of those files, by the same paths
  CutLengths lengths;                               ///< of their blades
  std::set<std::string> found;                      ///< cuts for which they were sought, and found to serve
  std::vector<std::string> errors;                  ///< of its design
};

/// Reads it. Nothing where there is no report.json, or somebody else's; an error where it cannot be read or
/// is ours and damaged. Paths that lead out of the folder are left out.
Result<std::optional<ReportRecord>> readReportRecord(const std::filesystem::path& folder);

}  // namespace bw::pipeline
