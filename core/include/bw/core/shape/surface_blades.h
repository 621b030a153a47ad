// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A whole surface told by key blades.
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/surface/spline_surface.h"

namespace bw {

/// Of what a cut or a surface may be off, the share that telling it by key blades may take; the rest is left
/// for the blades that cut it.
inline constexpr double kKeyBladeShare = 0.25;

struct SurfaceBlades {
  BladesSurface shape;
  double from = 0, to = 0;  ///< y, where all of the surface across the travel is there
  double deviation =
      0;             ///< mm, of the blades from the surface, also halfway between the curves they are made of
  double worst = 0;  ///< y there
};

/// The key blades of `fewestBlades` for curves of a surface at even places along y, of which there are taken
/// more until the sweep comes within `tolerance` (mm) of the surface halfway between them, too. u of the
/// surface runs across the travel, v along it, y ascending with v. Where an elastica itself lies farther off,
/// the deviation tells. Errors: `badInput` for a surface that nowhere lies all across the travel; those of
/// `fewestBlades`.
Result<SurfaceBlades> fewestBladesOf(const SplineSurface& surface, double tolerance,
                                     const RunContext& context = {});

}  // namespace bw
