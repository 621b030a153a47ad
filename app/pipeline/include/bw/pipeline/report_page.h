// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// A picture in a report.
struct ReportPicture {
  std::string title;  ///< what it shows, for people
  std::string
      source;  ///< what stands in the page's `src`: a data URL, or a name that the page's reader knows
  int width = 0, height = 0;  ///< pixels on the page
};

/// The report of a result for people, as one HTML page: verdict, pictures, numbers beside their limits, the
/// parameters that made them, findings, stations, and what each of `files` beside it is. Plain enough
/// (tables, no scripts, no fonts from elsewhere) for a printer's simple engine. `program` is what made it,
/// with its version. Equal input gives equal bytes. Without a sweep it tells the findings alone.
std::string reportPage(const Evaluation& evaluation, const std::vector<ReportPicture>& pictures,
                       const std::vector<std::filesystem::path>& files, const std::string& program);

/// Bytes as text for people: "812 bytes", "48 kB", "3.1 MB".
std::string sizeText(std::uintmax_t bytes);

/// Triangles as binary STL, in mm, normals by the order of their corners (zero for a triangle without area).
/// `name` goes into the head, at most 79 characters of it.
std::string stlBytes(const TriangleMesh& mesh, const std::string& name);

}  // namespace bw::pipeline
