// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// The way of the blade through its stations as the robots move its grips from target to target: their places
/// in a straight line, their tangents evenly.
struct RowMotion {
  /// All stations in the order of travel, and poses between them (of index −1) where the blade would leave
  /// the smooth way through the stations without, or the ends of what it cuts run along it in a corner. The
  /// surface goes through them.
  std::vector<BladePose> course = {};
  /// Where robots have their targets: of these all but stations without which the blade keeps as near to the
  /// smooth way, in moves of a second at most, which take kTargetSeconds or more where they can.
  std::vector<BladePose> targets = {};
  /// The blade between two targets.
  struct Instant {
    std::size_t station = 0;                   ///< the one before
    std::vector<Eigen::Vector3d> places = {};  ///< of the part that cuts
  };
  std::vector<Instant> instants = {};
  int snaps = 0;  ///< times that the blade leaves its shape on the way
  /// One a station: 1 where the blade comes from the one before in the shapes of the row; 0 at the first.
  std::vector<char> reached = {};
  Findings findings = {};
};

/// s from target to target: less only where the motion tolerance asks for it. Controllers stutter where
/// targets come in faster than they plan.
inline constexpr double kTargetSeconds = 0.1;

/// How robots move the blade through a row.
struct FollowRequest {
  double motionTolerance = 0.1;  ///< mm, from the smooth way
  double cuttingSpeed = 20;      ///< mm/s of the fastest point
  bool operator==(const FollowRequest&) const = default;
};

/// Chooses the targets of a row so that the blade stays well within the tolerance of the smooth way, cubics
/// of the travel through the numbers of all stations, and bends the blade with its weight at instants between
/// them, from each station to the next: its shape there decides the branch that it follows
/// (docs/mathematics.md, sweep). Fails with `cancelled` alone. Some 30 ms for 60 stations.
[[nodiscard]] Result<RowMotion> followRow(const Sweep& sweep, const FollowRequest& request,
                                          const RunContext& context);

/// How the blade is judged between its stations.
struct WayRequest {
  double tolerance = 2;          ///< mm, deviation of the cut surface
  double clearance = 50;         ///< mm between a grip and the block
  double motionTolerance = 0.1;  ///< mm, from the surface shown
  bool operator==(const WayRequest&) const = default;
};

/// How far the blade lies off between its stations.
struct WayDeviation {
  double deviationMax = 0;  ///< mm, |distance| of the real blade from the target
  Eigen::Vector3d worst = Eigen::Vector3d::Zero();
  double fromShown = 0;  ///< mm, the farthest that it lies from the surface shown, in its own plane
  Findings findings = {};
};

/// Compares the blade between the targets with the target surface and with the surface shown, that of
/// `analysis`. Errors: those of the sampler; `cancelled`.
[[nodiscard]] Result<WayDeviation> deviationOf(const RowMotion& motion, const Sweep& sweep,
                                               const SweepAnalysis& analysis, const WayRequest& request,
                                               const SurfaceSampler& target, const RunContext& context);

}  // namespace bw
