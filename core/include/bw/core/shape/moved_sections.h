// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/core/sweep/section.h"

namespace bw {

/// The sections of what lies `off` mm beside a surface along its normals (`bw/core/sweep/kerf.h`), by the
/// planes of `sections`, those of the surface: each place of a section moved within its plane until it lies
/// so far from the surface, to 1e-5 mm, and a spline through 97 places and more. A section that is bent more
/// tightly than it is moved, or where the surface runs along its plane, is left out, which `findings` tell;
/// an error (`badInput`) if all are. Other errors: those of the sampler; `cancelled`.
[[nodiscard]] Result<std::vector<Section>> movedBy(const std::vector<Section>& sections,
                                                   const SurfaceSampler& surface, double off,
                                                   const RunContext& context, Findings& findings);

/// The same for what has an offset of 0 from `surface`, where the sections lie `reach` (mm, > 0) off that at
/// most.
[[nodiscard]] Result<std::vector<Section>> sectionsOn(const std::vector<Section>& sections,
                                                      const SurfaceSampler& surface, double reach,
                                                      const RunContext& context, Findings& findings);

/// The sections of a surface, the first and the last of which are carried out along the travel before they
/// are moved, where that has what stands begin behind them: `half` mm (≥ 0) from the middle of the blade,
/// along the normals of the surface (`kept` 1) or against them (−1). From there its edge comes to the planes
/// in which they were, all along the blade. They keep their curves, which `movedBy` brings to where the
/// surface goes on beyond them. Errors: those of the sampler.
[[nodiscard]] Result<std::vector<Section>> carriedOut(std::vector<Section> sections,
                                                      const PlaneFamily& planes, SurfaceSampler& surface,
                                                      double half, int kept);

}  // namespace bw
