// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/base/units.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/kerf.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// What a row of blades is checked against.
struct CheckRequest {
  double tolerance = 2;                 ///< mm, deviation of the cut surface
  double clearance = 50;                ///< mm between a grip and the block
  double cuttingSpeed = 20;             ///< mm/s of the fastest point
  double margin = 0.15;                 ///< of stability
  double gripError = 0.5;               ///< mm that a grip may be off in the plane
  double gripAngle = fromDegrees(0.2);  ///< rad that it may be turned there besides
  /// mm that the whole blade stays above the face that the block lies on; empty where the block is not given,
  /// but made around the surface.
  std::optional<double> floor = std::nullopt;
  bool operator==(const CheckRequest&) const = default;
};

/// What was seen at one station without looking at the target.
struct StationCheck {
  // Of the points that cut, as far as they lie in the block, where any do.
  double angleMean = 0, angleMax = 0;  ///< rad, velocity to plane normal
  double speedRatio = 1;               ///< slowest over fastest
  double speedMin = 0, speedMax = 0;   ///< mm/s
  double clearance = 0;                ///< mm between the nearer grip and the block; negative inside it
  double aboveBottom = 0;  ///< mm of the lowest point of the blade over the face the block lies on
  double stabilityMargin =
      1;  ///< of the clamped blade in its plane: 1 straight, 0 about to snap (`stabilityMargin`), or snapped
  double outOfPlaneMargin =
      1;  ///< of a round blade against leaving its plane; 1 for a flat one, which is stiff across it
  bool nearBottom = false;  ///< nearer to that face than the floor that was asked for
  bool stable = true;       ///< the blade rests in the shape that was fitted, its weight let be
  bool crossesItself = false;
  bool gripsSwapped = false;  ///< they lie the other way round than the ends of the part that cuts
  double movedByWeight = 0;   ///< mm, the farthest that weight moves the part that cuts
  double sideways = 0;        ///< mm, how far weight across the plane bends a round blade out of it
  double movedByGrip = 0;    ///< mm, the largest of `SweepCheck::movedByGrip`; infinite where it is not known
  bool snapsByGrip = false;  ///< the blade snaps where a grip is off
};

/// Velocity of the cut of one station, at points of equal shares of its length (docs/mathematics.md,
/// velocity).
struct StationVelocity {
  std::vector<double> angle;     ///< rad, to the plane normal
  std::vector<double> relative;  ///< speed over that of the fastest of them
  std::vector<double> speed;     ///< mm/s
};

/// What a row of blades tells by itself: one entry a pose in each list.
struct SweepCheck {
  std::vector<StationCheck> stations;
  std::vector<StationVelocity> velocities;
  /// mm, how far across itself the part that cuts moves if one grip is off by as much as the request says, at
  /// points of equal shares of its length; infinite where the blade snaps by it, or could not be followed.
  std::vector<std::vector<double>> movedByGrip;
};

/// Velocities (thesis 5.3, following the arc length from the blade's middle), margins and clearance of a
/// sweep. At least two stations, else `ErrorCode::badInput`; `ErrorCode::cancelled` on a stop. Cost: some
/// 0.1 ms a station.
[[nodiscard]] Result<SweepCheck> checkSweep(const Sweep& sweep, const CheckRequest& request,
                                            const RunContext& context);

/// True if a blade with this stiffness (N mm²) snaps where one of its grips is off, any way and turned either
/// way, by as much as the request says. Some 0.3 ms.
[[nodiscard]] bool snapsByGrip(const HeavyBlade& blade, double stiffness, const CheckRequest& request);

/// Numbers over all stations, as in report.json (mm, rad). Mean, rms and fraction of the deviation and the
/// mean angle are over the area of the cut surface; those of R4 and Hausdorff distance over the stations.
struct SweepSummary {
  double R4Max = 0, R4Mean = 0, hausdorffMax = 0, hausdorffMean = 0;
  double deviationMax = 0, deviationMean = 0, deviationRms = 0,
         withinTolerance = 1;  ///< |deviation|; fraction 0…1
  double angleMax = 0, angleMean = 0, angleStationMeanMax = 0, speedRatioMin = 1;
  double minRadius = 0;  ///< mm, over the cut segments and their extensions; 0 where all are straight
};

/// The cut surface with its fields, and what was found.
struct SweepAnalysis {
  /// What stands: beside the middle of the blade by half the kerf. Sampled finely: every station and rows
  /// between, thinned to 481 rows where they are more (the summary and the findings are those of all). Fields
  /// "deviation" (mm, signed), "angle" (°), "speed" (mm/s), "relative_speed" (0…1), "curvature" (|κ| over the
  /// limit), "stress" (N/mm², of bending in the outermost fibre). Beside the block those that tell of the cut
  /// (`MapInfo::ofBlade` false) are not a number.
  SurfaceGrid cut;
  SurfaceGrid middle = {};      ///< what the middle of the blade sweeps, where a kerf parts it from `cut`
  SplineSurface surface;        ///< the smooth skin of what stands, through the targets
  std::vector<int> stationRow;  ///< row of `cut` of each station, or nearest to it where rows are thinned
  std::vector<double> stationDeviation;  ///< mm, the largest distance of each station's cut from the target
  SweepSummary summary;
  Findings findings;

  /// What the middle of the blade sweeps: what targets for it are compared with.
  const SurfaceGrid& swept() const { return middle.points.empty() ? cut : middle; }
};

/// mm: the skin through the stations keeps this close to the blade of each; a finding tells where it does
/// not.
inline constexpr double kSkinTolerance = 0.01;

/// Checks a sweep against the target: the deviation of the cut surface, also between stations, and from it
/// and the numbers of `checkSweep` what cannot be cut, and why. The surface goes through the blades at the
/// `course` (`RowMotion`), the stations among them. `loft` lays the skin through them: what is measured here
/// is what is written. With a `kerf`, `target` is what the middle of the blade is to sweep, and what stands
/// is moved from there.
[[nodiscard]] Result<SweepAnalysis> analyzeSweep(const Sweep& sweep, const std::vector<BladePose>& course,
                                                 const SweepCheck& check, const CheckRequest& request,
                                                 const SurfaceSampler& target, const Loft& loft,
                                                 const RunContext& context, const Kerf& kerf = {});

}  // namespace bw
