// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A loft through curves that were drawn elsewhere.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/space_curve.h"
#include "bw/core/shape/designed_surface.h"

namespace bw {

struct DrawnOptions {
  static constexpr double kTolerance = 0.1;            ///< mm, unless another is asked for
  static constexpr double kLeast = 1e-3, kMost = 100;  ///< mm, tolerances that are taken
  SectionCurve::Kind kind = SectionCurve::Kind::spline;
  double tolerance = kTolerance;  ///< mm between each curve and its section, and between ends that are joined
  int points = 0;                 ///< of each section; 0: as few as keep the tolerance
};

struct DrawnSections {
  DesignedSurface surface;                 ///< of `SectionsSurface`, in the order of the travel
  Bounds bounds;                           ///< of curves and loft, in the frame of the surface
  double longest = 0;                      ///< mm, of the curves
  double deviation = 0;                    ///< mm, of the curves from their sections in space, the largest
  std::string worst = {};                  ///< the curve where that is
  int joined = 0;                          ///< pieces that others were joined to
  std::vector<std::string> repeated = {};  ///< curves left out since another one is the same
  std::vector<std::string> tiny = {};      ///< and since they are shorter than the tolerance
};

/// Sections of a loft that follow drawn curves: pieces whose ends touch within the tolerance are joined, the
/// travel is the normal of the planes that the curves lie in (the way in which they lie beside each other, if
/// they are parallel lines), the axis of the world next to it where that does as well; all run the same way,
/// in the order of the travel. Each section has as many points as all others, at the same shares of its
/// length, so that the loft through them has few poles; no fewer points were found to do
/// (docs/mathematics.md, Sections of drawn curves).
///
/// Errors, `badInput` with curve, number and remedy: fewer than two curves, more pieces than kMostPieces or
/// sections than a loft takes; those of `checkSpaceCurve`; ends of three curves in one place; a closed curve,
/// one that crosses itself, or that leaves its plane by more than half the tolerance; planes that are not
/// parallel; two curves in one plane; a curve that so many points do not follow (only where `points` is 0);
/// those of `splineOf`. `cancelled`. The same for any number of threads.
Result<DrawnSections> sectionsThrough(const std::vector<SpaceCurve>& curves, const DrawnOptions& options,
                                      const RunContext& context = {});

inline constexpr std::size_t kMostPieces = 10'000;  ///< that `sectionsThrough` takes

}  // namespace bw
