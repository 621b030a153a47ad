// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Where the surfaces of several cuts of one block meet, and what of one another they take away.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/surface_sampler.h"

namespace bw {

/// A surface with its triangles.
struct MeshedSurface {
  const TriangleMesh* mesh = nullptr;
  SurfaceSampler* sampler = nullptr;
};

using Polyline = std::vector<Eigen::Vector3d>;

/// The point nearest to `p` at which both surfaces pass, mm in the file's frame; empty where they do not meet
/// near to it, or have one tangent plane. Errors: those of the samplers.
[[nodiscard]] Result<std::optional<Eigen::Vector3d>> nearestMeeting(const Eigen::Vector3d& p,
                                                                    SurfaceSampler& first,
                                                                    SurfaceSampler& second);

/// The curves in a box along which two surfaces meet: points of both to 1e-6 mm, some 1/60 of the box's
/// diagonal apart. Meetings that are smaller than that may be missed. Surfaces that end where they meet do
/// so along their borders. Errors: `cancelled`, those of the samplers.
[[nodiscard]] Result<std::vector<Polyline>> meetingCurves(const MeshedSurface& first,
                                                          const MeshedSurface& second, const Box& box,
                                                          const RunContext& context);

/// A cut of a block: what was to be cut, and all that the blade sweeps; of one that is not made, since it
/// meets nothing of what is left, the first alone. Those that are made come first.
struct CutSurfaces {
  std::string id;
  MeshedSurface target, cut;
  Eigen::Vector3d kept = -Eigen::Vector3d::UnitZ();     ///< the way to the foam that stays, and
  int side = 1;                                         ///< its side of `cut` (`sideKept`)
  const std::vector<Eigen::Vector3d>* shown = nullptr;  ///< points of what is shown of it; may be null
};

/// The edge that two cuts leave.
struct Crease {
  std::size_t first = 0, second = 0;  ///< of the cuts
  std::vector<Polyline> curves = {};
  /// mm from the crease of the surfaces designed, of each point; empty where these do not meet near to it.
  std::vector<std::vector<std::optional<double>>> off = {};
  double length = 0;               ///< mm
  double alone = 0;                ///< mm of it where the surfaces designed do not meet
  double lacking = 0;              ///< mm of the crease designed where the cuts do not meet
  double offMax = 0, offMean = 0;  ///< mm, over the points of both for which it is known
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();
};

/// What cuts of one block do to each other.
struct CutsTogether {
  std::vector<Crease> creases = {};
  /// Of each cut, of each point that is shown of it, mm by which it lies in what all others leave.
  std::vector<std::vector<double>> depths = {};
  Findings findings = {};
};

/// Finds the creases that all cuts of a block leave and measures them against those designed; tells of
/// creases that are off by more than the tolerance (mm), and of surfaces of which the blade of another cut
/// takes more than that away where it goes on beyond its own surface. Errors: `cancelled`, those of the
/// samplers.
[[nodiscard]] Result<CutsTogether> compareCuts(const std::vector<CutSurfaces>& cuts, const Box& box,
                                               double tolerance, const RunContext& context);

}  // namespace bw
