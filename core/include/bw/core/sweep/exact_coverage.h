// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/coverage.h"

namespace bw {

/// `coverageOf`, where triangles of the `target` lie off its `surface` by so much that it matters: a place
/// that they have off the cut is taken where the surface has it. `middle`, where a kerf parts it from `cut`:
/// what the middle of the blade sweeps, of the same rows. Beside the outer ones, as far as half a kerf may
/// move their edges, what the leads leave counts: a place that lies within the limit of that is covered.
[[nodiscard]] Coverage exactCoverageOf(const SurfaceGrid& cut, const Sweep& sweep, const TriangleMesh& target,
                                       SurfaceSampler& surface, double tolerance, double back = 0,
                                       const SurfaceGrid* middle = nullptr);

}  // namespace bw
