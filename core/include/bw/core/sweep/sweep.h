// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/blade/blade.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/motion/motion.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/surface/surface_sampler.h"

namespace bw {

/// A planar section of the target: the curve in the coordinates of `frame`. `travel` is the position (mm)
/// along the cutting direction.
struct Section {
  int index = 0;
  double travel = 0;
  Frame frame;
  PlanarCurve curve;
};

/// One station of a sweep: the target section, the elastica that stands for it, and the blade that holds it.
struct Station {
  int index = 0;
  double travel = 0;  ///< mm along the cutting direction
  Frame frame;
  PlanarCurve target;       ///< in the plane of `frame`
  double targetLength = 0;  ///< mm
  FitResult fit = {};       ///< fit.elastica is the part that cuts the target
  bool heldBack = false;  ///< `fit` is not the nearest curve, but one whose blade keeps its radius and rests
  bool steadied =
      false;  ///< `fit` is not the nearest curve, but one near its neighbour's shape, within the tolerance
  Elastica blade = {};  ///< fit.elastica extended at both ends to the blade's length
  double extension =
      0;  ///< a: blade = parameters [−a, 1 + a] of the fitted segment, a ≥ 0; < 0 if the blade is too short
  double angleMean = 0, angleMax = 0;  ///< rad, velocity to plane normal
  double speedRatio = 1;               ///< slowest over fastest point of the fitted segment
  double deviationMax = 0;             ///< mm, the largest distance of the cut curve from the target
  double speedMin = 0, speedMax = 0;   ///< mm/s, of the points that cut
  double clearance = 0;                ///< mm between the nearer grip and the block; negative inside it
  double stabilityMargin =
      1;  ///< of the clamped blade in its plane: 1 straight, 0 about to snap (`stabilityMargin`)
  double outOfPlaneMargin =
      1;  ///< of a round blade against leaving its plane; 1 for a flat one, which is stiff across it
  bool stable = true;  ///< stabilityMargin > 0: the blade rests in this shape

  /// The ends of the blade in space: TCP origin and unit tangent in the direction of increasing arc length.
  Eigen::Vector3d leftPoint() const { return frame.toWorld(blade.start()); }
  Eigen::Vector3d leftTangent() const;
  Eigen::Vector3d rightPoint() const;
  Eigen::Vector3d rightTangent() const;
};

/// How often a blade in this shape changes the side to which it bends. Bends so slight that no blade shows
/// them (|κ| times the length at most 1e-4), such as those of a straight section, do not count.
[[nodiscard]] int bladeInflections(const Elastica& shape);

/// How the blades of a row are found.
struct FitRequest {
  Blade blade;
  FitOptions::Length fitLength = FitOptions::Length::free;
  bool fitEndpoints = false, fitTangents = false;  ///< the segment meets those of its section
  double maxPeriods = 1;                           ///< of the segment that is fitted
  double tolerance =
      2;  ///< mm within which a curve may stand for the nearest one, where the blade asks for it
  double clearance = 50;  ///< mm between a grip and the block, which advice about lengths keeps
  bool operator==(const FitRequest&) const = default;
};

/// What a row of blades is checked against.
struct CheckRequest {
  double tolerance = 2;      ///< mm, deviation of the cut surface
  double clearance = 50;     ///< mm between a grip and the block
  double cuttingSpeed = 20;  ///< mm/s of the fastest point
  bool operator==(const CheckRequest&) const = default;
};

/// How the blades of a row follow each other.
struct MotionRequest {
  double cuttingSpeed = 20;  ///< mm/s of the fastest point
  double lead = 20;  ///< mm of travel before the first and after the last station, with the shape held
  bool operator==(const MotionRequest&) const = default;
};

/// One continuous motion of the blade.
struct Sweep {
  Box block;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit, cutting direction
  FitRequest request;                                    ///< what `stations` answer
  std::vector<Station> stations;
};

/// Fits one elastica a section, from the longest section to both ends of the row, each beside its neighbour,
/// and extends it to the blade's length. `sections` in the order of travel, all curves running the same way.
/// A blade shorter than a section is an error.
Result<Sweep> buildSweep(std::vector<Section> sections, const FitRequest& request, const Box& block,
                         const Eigen::Vector3d& direction, const RunContext& context, Findings& findings,
                         double* fitSeconds = nullptr, double* extendSeconds = nullptr);

/// Fills what the stations tell by themselves, without the target: angles, speeds, margins and clearance. At
/// least two stations, else `ErrorCode::badInput`; `ErrorCode::cancelled` on a stop. Cost: some 0.1 ms a
/// station.
[[nodiscard]] Result<void> measureSweep(Sweep& sweep, const CheckRequest& request, const RunContext& context);

/// Numbers over all stations, as in report.json (mm, rad). Mean, rms and fraction of the deviation and the
/// mean angle are over the area of the cut surface; those of R4 and Hausdorff distance over the stations.
struct SweepSummary {
  double R4Max = 0, R4Mean = 0, hausdorffMax = 0, hausdorffMean = 0;
  double deviationMax = 0, deviationMean = 0, deviationRms = 0,
         withinTolerance = 1;  ///< |deviation|; fraction 0…1
  double angleMax = 0, angleMean = 0, angleStationMeanMax = 0, speedRatioMin = 1;
  double minRadius = 0;    ///< mm, over the cut segments and their extensions
  double cuttingTime = 0;  ///< s, lead included
};

/// The cut surface with its fields, and what was found.
struct SweepAnalysis {
  /// Sampled finely: every station and rows between, thinned to 481 rows where they are more (the summary and
  /// the findings are those of all). Fields "deviation" (mm, signed), "angle" (°), "speed"
  /// (mm/s), "relative_speed" (0…1), "curvature" (|κ| over the limit), "stress" (N/mm², of bending in the
  /// outermost fibre).
  SurfaceGrid cut;
  SplineSurface surface;        ///< the smooth skin through the stations
  std::vector<int> stationRow;  ///< row of `cut` of each station, or nearest to it where rows are thinned
  SweepSummary summary;
  Findings findings;
};

/// Checks a sweep against the target: velocities (thesis 5.3, following the arc length from the blade's
/// middle), curvature limit, inflections, clearance, and the deviation of the cut surface, also between
/// stations. Fills angles, speeds, deviation, margins and clearance of the stations of `sweep`.
Result<SweepAnalysis> analyzeSweep(Sweep& sweep, const CheckRequest& request, const SurfaceSampler& target,
                                   const RunContext& context);

/// Times the stations so that the fastest point of the blade moves at the cutting speed, adds the leads, and
/// puts the ends in the block frame. Quaternions keep one sign along the path.
Result<Motion> buildMotion(const Sweep& sweep, const MotionRequest& request);

}  // namespace bw
