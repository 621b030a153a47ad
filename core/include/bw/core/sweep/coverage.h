// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>

#include "bw/core/base/finding.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// How much of a target, as far as it lies in the block, is cut.
struct Coverage {
  double area = 0;       ///< mm², of the target in the block
  double uncovered = 0;  ///< mm² of it, off the cut surface by more than the tolerance, or beyond its border
                         ///< by more than `limit`
  double distance = 0;   ///< mm, the farthest that it reaches beyond that border, or lies off what is cut
  double limit = 0;      ///< mm, how far it may reach beyond that border
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< where
  Findings findings = {};

  double share() const { return area > 0 ? 1 - uncovered / area : 0; }
};

/// How a target is held against what is cut.
struct CoverageRequest {
  double tolerance = 0;  ///< mm
  double back = 0;       ///< mm that what stands is to keep from the target
  /// The target itself, where its triangles lie off it by so much that it matters: a place that they have off
  /// the cut is taken where this has it. Null where it is its triangles.
  SurfaceSampler* surface = nullptr;
  /// What the blade leaves from grip to grip, rows as those of the cut; it is asked where the target reaches
  /// beyond the ends of the blade's cut. None: nothing is cut there.
  std::function<SurfaceGrid()> whole = {};
};

/// Looks from the target to the cut surface `cut` of a sweep, plane by plane: what lies beyond the first or
/// the last station, or beyond the ends of the blade's cut in its own plane, unless what the `whole` blade
/// leaves lies on it, is not covered, nor is what no cut surface comes near to (docs/mathematics.md,
/// coverage). An error tells it: what lies off the cut by more than the tolerance, or beyond its border by
/// more than that and half a mm, since the outer stations keep a little off the border and the leads cut on;
/// and that nothing of the target lies in the block, as in a hole of it. `cut`: rows along the blade, each in
/// a plane of the sweep's family, in the order of travel.
[[nodiscard]] Coverage coverageOf(const SurfaceGrid& cut, const Sweep& sweep, const TriangleMesh& target,
                                  const CoverageRequest& request);

}  // namespace bw
