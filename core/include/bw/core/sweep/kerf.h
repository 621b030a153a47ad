// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <memory>

#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/kerf_table.h"

namespace bw {

/// The foam that a hot blade melts away: what stands lies half of that from the middle of the blade, and
/// `back` mm from the surface that is asked for.
struct Kerf {
  double width = 0;                                  ///< mm, ≥ 0
  KerfTable table = {};                              ///< over the speed of the blade; empty: `width` at any
  double back = 0;                                   ///< mm towards the foam that stays, ≥ 0
  Eigen::Vector3d kept = -Eigen::Vector3d::UnitZ();  ///< the way to the foam that stays, unit
  bool operator==(const Kerf&) const = default;
};

/// A surface whose offsets are those from where it lies `off` mm farther along its normals: what the middle
/// of the blade is held against. Feet are those on the surface itself.
[[nodiscard]] std::unique_ptr<SurfaceSampler> movedBy(std::unique_ptr<SurfaceSampler> surface, double off);

/// The surface that stands where the middle of the blade sweeps `swept`: its points moved by half the kerf
/// along the normals of the grid, to the side of it that on the whole lies towards the foam that stays. At
/// least two rows and columns. The same grid, fields included, where there is no kerf.
[[nodiscard]] SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf);

}  // namespace bw
