// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <optional>

#include "bw/core/base/result.h"
#include "bw/core/surface/surface_jet.h"

namespace bw {

/// A surface as core sees it: a point and derivatives by (face, u, v), and the closest point. CAD faces
/// (OCCT), graphs z = f(x, y) and analytic test surfaces implement it. Objects are not safe to share between
/// threads; `clone` one a thread.
class SurfaceSampler {
 public:
  virtual ~SurfaceSampler() = default;

  /// A place on the surface.
  struct Foot {
    int face = 0;
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, on the outer side of the face
    double distance = 0.0;                              ///< ≥ 0, mm, from the query point
    bool onBoundary = false;  ///< the closest point lies on the border of the trimmed surface, so that the
                              ///< side is undefined
  };

  /// The point of the surface (trimmed faces) closest to `p`. `seed`, a foot of a nearby query, makes it a
  /// few Newton steps; the result does not rely on the seed being right: a foot that is worse than the seed's
  /// neighbourhood allows is searched for globally. Accuracy 1e-6 mm.
  virtual Result<Foot> closest(const Eigen::Vector3d& p, const Foot* seed) = 0;

  /// The surface under a face at parameters as `Foot` tells them, its derivatives and its outer side; where
  /// the face is trimmed away too. `curvatureOf` (bw/core/surface/surface_jet.h) makes curvatures of it.
  /// Errors: `badInput` for a face that there is not and parameters that are not finite or lie outside the
  /// rectangle of the face; `noSolution` where the surface has no tangent plane, such as the pole of a
  /// sphere.
  virtual Result<SurfaceJet> at(int face, const Eigen::Vector2d& uv) const = 0;

  /// How far `p` lies from the surface along its normal, mm, signed by it; beyond a border from the surface
  /// continued there. `foot` is what `closest` says of it.
  virtual double offset(const Eigen::Vector3d& p, const Foot& foot) const {
    const double side = (p - foot.point).dot(foot.normal);
    if (!foot.onBoundary) return std::copysign(foot.distance, side);
    const double beyond = continued(p, foot);
    return std::abs(beyond) <= foot.distance ? beyond : std::copysign(foot.distance, side);
  }

  /// An independent copy for another thread.
  virtual std::unique_ptr<SurfaceSampler> clone() const = 0;

 protected:
  /// `offset` beyond the border that `foot` lies on: from its tangent plane unless a sampler knows more.
  virtual double continued(const Eigen::Vector3d& p, const Foot& foot) const {
    return (p - foot.point).dot(foot.normal);
  }
};

}  // namespace bw
