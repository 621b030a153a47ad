// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// The cubic B-spline surface through all points of `grid` (rows × columns, both ≥ 2), as OpenCASCADE
/// interpolates it. Parameters are 0…1 in u (uniform) and `rowParameters` in v (strictly ascending; chord
/// length for a skin). Not-a-knot ends; degree falls to rows − 1 for fewer than four rows. Errors: `badInput`
/// for a grid that is too small and for coincident parameters; `noSolution` where numbers overflow.
Result<SplineSurface> loft(const SurfaceGrid& grid, const std::vector<double>& rowParameters);

/// The surface as STEP AP214 text in mm with one face named `name`; the header carries no date and no machine
/// name, so that equal input gives equal bytes.
Result<std::string> stepText(const SplineSurface& surface, const std::string& name);

/// A surface and the name of its face.
struct NamedSurface {
  std::string name;
  const SplineSurface* surface = nullptr;
};
/// The same of several surfaces, a shell of one face each, in a part called `name`. Names that would come out
/// as the same are told apart (`distinctNames`).
Result<std::string> stepText(std::span<const NamedSurface> surfaces, const std::string& name);

/// Points along a curve, its name, and that of the layer that it lies on, if any.
struct NamedCurve {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::string layer = {};
};
/// Curves as STEP AP214 text in mm: of each the cubic B-spline through its points, in as many pieces as it
/// has corners (turns of more than 20°) and one, as a part of its name, in an assembly of its layer. Points
/// that lie in one place count once; what is no curve then is left out. Names that would come out as the same
/// are told apart (`distinctNames`). The head is that of a surface's.
/// Error `noSolution` where numbers overflow.
Result<std::string> curvesStepText(std::span<const NamedCurve> curves, const std::string& name);

/// The surface as IGES text in mm, one trimmed face; the head carries no date and no machine, as with STEP.
/// `name` in ASCII, other characters become "_". Errors: a surface whose poles, knots and degrees do not fit
/// (`badInput`); `internal` if OpenCASCADE fails.
Result<std::string> igesText(const SplineSurface& surface, const std::string& name);

/// The example surfaces with known formulas, in the order of the start page.
struct Example {
  std::string name;     ///< file stem: "panel-600x670", "graph", "saddle", "sphere-cap", "torus-patch",
                        ///< "wavy-wall", "ramp-corner-hollow", "ramp-corner-domed"
  std::string title;    ///< for people
  std::string formula;  ///< the exact formula, in words and symbols
};
const std::vector<Example>& exampleList();

/// The example of that name as STEP text (mm), from the resources. The B-spline differs from the formula by
/// less than 0.001 mm (spheres and tori are exact). Errors: an unknown name (`badInput`, with the nearest);
/// those of `resourceFolder` and `readFile`.
Result<std::string> exampleStep(const std::string& name);

}  // namespace bw::geometry
