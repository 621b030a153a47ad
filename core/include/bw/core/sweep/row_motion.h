// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// What the blade cuts on its way from station to station, as the robots move its grips: their places in a
/// straight line, their tangents evenly. The surface shown is smooth there; a program makes this one.
struct RowMotion {
  double deviationMax = 0, deviationMean = 0;  ///< mm, |distance| of the real blade from the target
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();
  double fromShown = 0;  ///< mm, the farthest that it lies from the surface shown, in its own plane
  int snaps = 0;         ///< times that the blade leaves its shape on the way
  Findings findings = {};
};

/// Bends the blade, with its weight, at instants between the stations of a row, from the first station on:
/// its shape there decides the branch that it follows. `analysis` holds the surface shown. Errors: those of
/// the sampler; `cancelled`. Some 20 ms for 60 stations.
[[nodiscard]] Result<RowMotion> followRow(const Sweep& sweep, const SweepAnalysis& analysis,
                                          const CheckRequest& request, const SurfaceSampler& target,
                                          const RunContext& context);

}  // namespace bw
