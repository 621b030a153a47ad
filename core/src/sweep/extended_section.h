// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/sweep/section.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// The unit vector at an angle.
inline Eigen::Vector2d along(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A section that goes on at both ends by half of what the blade is longer, as the request extends it.
struct ExtendedSection {
  ClampedProblem grips;  ///< at its ends, with the length of the blade and the turning from end to end
  PlanarCurve curve;     ///< a chain of points
};
/// Errors: the blade leaves less than the clearance at both ends (`badInput`).
[[nodiscard]] Result<ExtendedSection> extendedSection(const Section& section, const FitRequest& request);

}  // namespace bw::sweep
