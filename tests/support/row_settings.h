// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/sweep_check.h"
#include "interpolated.h"

namespace bw::test {

/// What a test asks of a row of blades, in one place.
struct RowSettings : FitRequest {
  double cuttingSpeed = 20;      ///< mm/s
  double lead = 20;              ///< mm
  double motionTolerance = 0.1;  ///< mm

  operator CheckRequest() const { return {tolerance, clearance, cuttingSpeed, margin}; }  // NOLINT
  operator WayRequest() const { return {tolerance, clearance, motionTolerance}; }         // NOLINT
  operator FollowRequest() const { return {motionTolerance, cuttingSpeed}; }              // NOLINT
  operator MotionRequest() const { return {cuttingSpeed, lead, motionTolerance}; }        // NOLINT
};

/// A flat NiCr blade of 5 × 1 mm; `length` in mm.
inline Blade flatBlade(double length) {
  Blade blade;
  blade.section = Blade::Section::flat;
  blade.width = 5;
  blade.thickness = 1;
  blade.density = 8300;
  blade.length = length;
  return blade;
}

/// A row of these, which hang down in their weight.
inline RowSettings flatRow(double length) {
  RowSettings settings;
  settings.blade = flatBlade(length);
  settings.weight = -settings.blade.weight() * Eigen::Vector3d::UnitZ();
  return settings;
}

/// A sweep that is checked and then compared with its target, its surface being that through its stations.
inline Result<SweepAnalysis> analysisOf(const Sweep& sweep, const CheckRequest& request,
                                        const SurfaceSampler& target, const RunContext& context = {}) {
  const Result<SweepCheck> check = checkSweep(sweep, request, context);
  if (!check) return tl::unexpected<Error>(check.error());
  return analyzeSweep(sweep, sweep.poses, *check, request, target, interpolated, context);
}

}  // namespace bw::test
