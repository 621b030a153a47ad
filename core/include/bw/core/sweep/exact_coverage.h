// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/coverage.h"

namespace bw {

/// `coverageOf`, where triangles of the `target` lie off its `surface` by so much that it matters: a place
/// that they have off the cut is taken where the surface has it.
[[nodiscard]] Coverage exactCoverageOf(const SurfaceGrid& cut, const Sweep& sweep, const TriangleMesh& target,
                                       SurfaceSampler& surface, double tolerance, double back = 0);

}  // namespace bw
