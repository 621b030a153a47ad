// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/sweep/sweep_check.h"
#include "interpolated.h"

namespace bw::test {

/// What a test asks of a row of blades, in one place.
struct RowSettings : FitRequest {
  double cuttingSpeed = 20;  ///< mm/s
  double lead = 20;          ///< mm

  operator CheckRequest() const { return {tolerance, clearance, cuttingSpeed, margin}; }  // NOLINT
  operator MotionRequest() const { return {cuttingSpeed, lead}; }                         // NOLINT
};

/// A sweep that is checked and then compared with its target.
inline Result<SweepAnalysis> analysisOf(const Sweep& sweep, const CheckRequest& request,
                                        const SurfaceSampler& target, const RunContext& context = {}) {
  const Result<SweepCheck> check = checkSweep(sweep, request, context);
  if (!check) return tl::unexpected<Error>(check.error());
  return analyzeSweep(sweep, *check, request, target, interpolated, context);
}

}  // namespace bw::test
