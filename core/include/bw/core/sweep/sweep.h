// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/blade/blade.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/sweep/blade_pose.h"
#include "bw/core/sweep/extension.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/core/sweep/section.h"

namespace bw {

/// How the blade of a station was found: by a fit to the section of the target.
struct StationFit {
  PlanarCurve target;     ///< the section, in the plane of the pose's frame
  FitResult fit = {};     ///< its elastica is the pose's `cut`; R4 and hausdorff are of the blade that hangs
  bool heldBack = false;  ///< not the nearest curve, but one whose blade keeps its radius and rests
  /// The share of its weight at which the blade leaves the shape that was fitted; empty if it never does.
  std::optional<double> snapsAt = std::nullopt;
  std::string unknown = {};  ///< why it is not known how the blade hangs in its weight; empty if it is
  std::array<bool, 2> nearMargin =
      {};  ///< whether its margins, in the plane and across it, had to be bounded
  /// The section as the request extends it, a chain of points; empty where it does not.
  std::optional<PlanarCurve> extended = std::nullopt;
  /// The unstable shapes over which a push brings the blade into others, where its barrier had to be bounded.
  std::vector<HeavyBlade> passes = {};
  double push = 0;  ///< N mm, by which these are to be higher at least: more where the blade dips beside
};

/// How the blades of a row are found.
struct FitRequest {
  Blade blade;
  FitOptions::Length fitLength = FitOptions::Length::free;
  bool fitEndpoints = false, fitTangents = false;  ///< the segment meets those of its section
  double maxPeriods = 1;                           ///< of the segment that is fitted
  double tolerance =
      2;  ///< mm within which a curve may stand for the nearest one, where the blade asks for it
  double clearance = 50;  ///< mm between a grip and the block, which advice about lengths keeps
  double margin = 0.15;   ///< of stability, that the blade is to keep where the tolerance lets it
  /// N mm that it must take to bring the blade into another shape that is no higher by more than 5 %, which
  /// `firmRow` sees to; 0 asks for nothing.
  double barrier = 0;
  /// What holds the grips. With none it is the row as a whole, by the distance of its blades from their
  /// sections; else each blade has the ends, tangents and length of the section so extended.
  Extension extend = Extension::none;
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  ///< of a length of blade, N/mm, in the file's frame
  bool operator==(const FitRequest&) const = default;
};

/// One continuous motion of the blade.
struct Sweep {
  Box block;
  PlaneFamily planes;
  FitRequest request;            ///< what `poses` answer
  std::vector<BladePose> poses;  ///< in the order of travel
  std::vector<StationFit> fits;  ///< one a pose
};

/// Fits one elastica a section, from the longest section to both ends of the row, each from the shape of its
/// neighbour, and extends it to the blade's length, its weight let be. `sections` in the order of travel, all
/// curves running the same way; those without a chosen branch are left out. A blade shorter than a section is
/// an error.
Result<Sweep> fitSweep(const std::vector<Section>& sections, const FitRequest& request, const Box& block,
                       const PlaneFamily& planes, const RunContext& context);

/// The blades of a row, with their weight: one is found a station, from the longest section on, and then the
/// grips of all are chosen together, so that the blades lie on their sections and the grips go smoothly from
/// one to the next (docs/mathematics.md, sweep). Where the request gives ends or length, those of `fitSweep`.
/// Where it extends the sections, each blade is that of its own section alone. Same errors. `LiveRow` is for
/// while a hand moves them.
Result<Sweep> buildSweep(const std::vector<Section>& sections, const FitRequest& request, const Box& block,
                         const PlaneFamily& planes, const RunContext& context, Findings& findings,
                         double* fitSeconds = nullptr, double* settleSeconds = nullptr);

}  // namespace bw
