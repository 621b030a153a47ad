// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A result for others: what lets it be understood and used without this program.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "bw/pipeline/produce.h"
#include "bw/pipeline/report_page.h"

namespace bw::pipeline {

/// Makes the pictures of a report, PNG without transparency; called where pages are wanted.
using Pictures = std::function<Result<std::vector<ReportPicture>>(const Evaluation& evaluation)>;

/// A picture of a report: a map of the cut surface, or of its creases.
struct PictureOfReport {
  const char* name;   ///< of its file
  const char* title;  ///< what it shows
  const char* field;  ///< the map
  bool above;         ///< seen from above, else from a corner
};
inline constexpr std::array<PictureOfReport, 5> kReportPictures = {{
    {"deviation", "Deviation of the cut surface from the target", "deviation", false},
    {"deviation-top", "Deviation, from above", "deviation", true},
    {"angle", "Cutting angle", "angle", false},
    {"curvature", "Bending of the blade against its limit", "curvature", false},
    {"crease", "How far edges between cuts lie from those designed", "crease", false},
}};
/// Whether there are creases whose distance from those designed was measured.
bool hasCreases(const Evaluation& evaluation);
/// Whether there is something to be seen in a picture: creases only where cuts of a block meet.
bool isOf(const PictureOfReport& picture, const Evaluation& evaluation);
inline constexpr int kReportPictureWidth = 1280, kReportPictureHeight = 800;  ///< pixels

/// Adds to what `policy` makes the surface as IGES, the mesh as STL, the report as HTML and PDF, and its
/// pictures; of all these what it wants.
Policy withHandover(Policy policy, Pictures pictures, const RunContext& context);

/// Triangles as binary STL, in mm, normals by the order of their corners (zero for a triangle without area).
/// `name` goes into the head, at most 79 characters of it.
std::string stlBytes(const TriangleMesh& mesh, const std::string& name);

}  // namespace bw::pipeline
