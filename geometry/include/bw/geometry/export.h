// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// The surface as STEP AP214 text in mm with one face named `name`; the header carries no date and no machine
/// name, so that equal input gives equal bytes.
Result<std::string> stepText(const SplineSurface& surface, const std::string& name);

/// The surface as IGES text in mm, one trimmed face; the head carries no date and no machine, as with STEP.
/// `name` in ASCII, other characters become "_". Errors: a surface whose poles, knots and degrees do not fit
/// (`badInput`); `internal` if OpenCASCADE fails.
Result<std::string> igesText(const SplineSurface& surface, const std::string& name);

/// Writes the surface as STEP in mm: temporary file, then rename. `cannotWrite` names the path and the
/// reason.
Result<void> writeStep(const SplineSurface& surface, const std::string& name,
                       const std::filesystem::path& file);

/// The example surfaces with known formulas, in the order of the start page.
struct Example {
  std::string name;     ///< file stem: "panel-600x670", "graph", "saddle", "sphere-cap", "torus-patch",
                        ///< "wavy-wall", "ramp-corner-hollow", "ramp-corner-domed"
  std::string title;    ///< for people
  std::string formula;  ///< the exact formula, in words and symbols
};
std::vector<Example> exampleList();

/// Makes the example of that name as STEP text (mm). The B-spline differs from the formula by less than 0.001
/// mm (spheres and tori are exact).
Result<std::string> exampleStep(const std::string& name);

/// The formula itself at parameters (u, v) in [0, 1]², for tests: a point of the exact surface, mm.
Result<Eigen::Vector3d> examplePoint(const std::string& name, double u, double v);

}  // namespace bw::geometry
