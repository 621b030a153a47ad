// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"

namespace bw::geometry {

/// A point of a curve to be fitted.
struct CurveSample {
  Eigen::Vector2d point, tangent;  ///< tangent: unit, in the direction of travel
  double arc = 0;                  ///< arc length from the start, mm
};

struct CurveFit {
  PlanarCurve curve;
  double deviation = 0;  ///< mm, the largest distance of a sample from the curve
  int spans = 0;
  bool enough = true;  ///< false: more samples are needed to reach the tolerance
};

/// A cubic B-spline over arc length through `runs` of samples: twice continuously differentiable within a
/// run, with a corner between runs. Least squares, the spans made finer where samples are further away than
/// `tolerance` mm; at least four samples a span.
Result<CurveFit> fitCurve(const std::vector<std::vector<CurveSample>>& runs, double tolerance);

}  // namespace bw::geometry
