// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"

namespace bw {

/// What of a surface lies in a box.
struct AreaInBox {
  double area = 0;    ///< mm²
  double height = 0;  ///< mm, mean over that area, along the box's z from its bottom; 0 where there is none
};
[[nodiscard]] AreaInBox areaInBox(const TriangleMesh& mesh, const Box& box);

/// Where what lies in no box is looked for.
enum class Outside {
  anywhere,
  overOrUnder  ///< along the z of the boxes, not beside them
};
/// What of a surface lies in none of the boxes, which have no more than their faces in common.
struct AreaOutside {
  double area = 0, all = 0;                         ///< mm², and of all of the surface
  double distance = 0;                              ///< mm from the nearest box, at most at its points
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< where
};
[[nodiscard]] AreaOutside areaOutside(const TriangleMesh& mesh, const std::vector<Box>& boxes,
                                      Outside where = Outside::anywhere);

/// When a cut is made: first those that were told a place, by it, then the others, the lowest first.
struct CutTurn {
  std::optional<int> told = std::nullopt;
  double height = 0;  ///< mm, mean over the base of the finished part
};
/// Their indices in the order of the cuts; equal ones as they come.
[[nodiscard]] std::vector<std::size_t> orderOf(const std::vector<CutTurn>& turns);

/// On which side of a surface foam stays: 1 where its normal points there, −1 where away from it. Error
/// `badInput`: the surface stands along `kept` on the whole, so that it has no such side.
[[nodiscard]] Result<int> sideKept(const TriangleMesh& mesh, SurfaceSampler& surface,
                                   const Eigen::Vector3d& kept);

/// A surface along which foam is parted.
struct PartedBy {
  SurfaceSampler* surface = nullptr;
  int side = 1;  ///< of `sideKept`
};
/// mm by which `p` lies inside of what stays of the foam; less than 0 for what was taken.
[[nodiscard]] Result<double> depthIn(const std::vector<PartedBy>& cuts, const Eigen::Vector3d& p);

/// The farthest that a surface comes into what other cuts left of the box, mm; 0 where nowhere, infinite
/// where nothing was cut before. Errors: `cancelled`, and those of the samplers.
[[nodiscard]] Result<double> meets(const TriangleMesh& mesh, const Box& box,
                                   const std::vector<PartedBy>& before, const RunContext& context);

/// A cut of a block, and which way the foam lies that it leaves.
struct TakingCut {
  const TriangleMesh* mesh = nullptr;
  PartedBy surface;
  Eigen::Vector3d kept = -Eigen::Vector3d::UnitZ();
};
/// mm, of the thickest foam that a cut takes of what other cuts left of the box, as far from its surface as
/// `enough`, and 0 where it takes nothing. A surface that comes that far into it takes as much; where it does
/// not all that was left may still lie on the side that it takes. Errors as of `meets`.
[[nodiscard]] Result<double> takes(const TakingCut& cut, const Box& box, const std::vector<PartedBy>& before,
                                   double enough, const RunContext& context);

}  // namespace bw
