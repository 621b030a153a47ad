// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What no blade can be of all that key blades tell: looked at over the whole of their travel, not only where
// stations stand or keys lie.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/shape/designed_surface.h"

namespace bw {

/// A stretch of the travel, mm of y, over which key blades tell shapes that no blade can have.
struct ToldStretch {
  ToldBlades::Fault fault = ToldBlades::Fault::unstable;
  double from = 0, to = 0;  ///< its ends lie within kStretchEnd of where the fault begins and ends
  double worst = 0;         ///< where the margin is least, the bend sharpest, or a loop closes the most
  double radius = 0;        ///< mm, the sharpest bend there
};

/// mm of the travel within which the ends of a stretch are told.
inline constexpr double kStretchEnd = 1e-3;

/// The stretches over which a blade as long as the told one, clamped at its ends, does not rest in its shape,
/// bends sharper than `minRadius` (mm, above 0) or crosses itself: by fault, then by y. A longer blade that
/// holds such a shape between its grips does neither rest, nor bend less, nor uncross. Between two
/// neighbouring keys 25 blades are looked at; where a number comes nearest to its limit between these, it is
/// followed to there, and the ends are found by bisection. A loop that opens and closes again between two of
/// them is found where the chord over its arc tells it. Errors: those of `BladeSweep::through` and
/// `elasticaOf`; `badInput` where `minRadius` is not above 0; `cancelled`. Some 0.1 ms a blade.
[[nodiscard]] Result<std::vector<ToldStretch>> toldStretches(const BladesSurface& surface, double minRadius,
                                                             const RunContext& context = {});

/// A finding for each of them, at the middle of the worst blade: warnings, since the blades that cut are
/// fitted to the surface and told of by themselves. `surface` is one of key blades, those of the stretches.
[[nodiscard]] Findings toldFindings(const DesignedSurface& surface, const std::vector<ToldStretch>& stretches,
                                    double minRadius);

/// The blades that a stretch is marked by in the file's frame: those at its ends, the worst, and so many
/// between that none is farther than `spacing` (mm) of travel from the next; 65 points each.
[[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> markedBlades(const DesignedSurface& surface,
                                                                     const ToldStretch& stretch,
                                                                     double spacing);

}  // namespace bw
