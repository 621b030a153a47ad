// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "bw/core/base/result.h"

namespace bw {

/// A point of a surface with its partial derivatives by u and v, mm.
struct SurfaceJet {
  Eigen::Vector3d p, du, dv, duu, duv, dvv;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, on the outer side; zero where it is not told
};

/// How a surface bends at a point. Curvatures in 1/mm, above 0 where it bends towards its outer side: both
/// are −1/R on a ball, 1/R in a bowl seen from within.
struct SurfaceCurvature {
  double min = 0, max = 0;             ///< the principal curvatures
  Eigen::Vector3d alongMin, alongMax;  ///< their directions: unit, alongMin × alongMax is the normal

  double mean() const { return 0.5 * (min + max); }
  double gauss() const { return min * max; }
  /// The normal curvature along `direction`, of which the part in the tangent plane counts, whatever its
  /// length; the mean curvature where there is no such part.
  double along(const Eigen::Vector3d& direction) const;
};

/// The unit vector along du × dv; zero where these span no plane (to 1e-12).
Eigen::Vector3d normalOf(const SurfaceJet& jet);

/// The curvatures that the second derivatives tell (docs/mathematics.md, curvature of surfaces). Rounding
/// adds about 1e-16 (|duu|/|du|² + |duv|/(|du| |dv|) + |dvv|/|dv|²). Errors: `noSolution` where du and dv
/// span no plane, `badInput` where a number is not finite or `jet.normal` is not told.
Result<SurfaceCurvature> curvatureOf(const SurfaceJet& jet);

}  // namespace bw
