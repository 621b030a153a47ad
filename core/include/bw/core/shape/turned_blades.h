// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rows of curves whose planes turn, told by key blades that turn.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/shape/key_blades.h"

namespace bw {

/// A curve in an upright plane, which is turned as those of key blades are.
struct TurnedCurve {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< (x, y) from which the first coordinate counts, mm
  double turn = 0;                                 ///< of the plane, from x towards y, rad
  PlanarCurve curve;                               ///< (along the plane, z)

  Eigen::Vector3d placed(const Eigen::Vector2d& place) const;
};

/// What key blades are to follow, in the frame of their surface.
struct TurnedRow {
  std::vector<TurnedCurve> curves;  ///< in the order of the travel; each runs towards where its plane does
  /// Places of the same surface on lines between the curves, each run as these are and at equal shares of its
  /// length.
  std::vector<std::vector<Eigen::Vector3d>> between = {};
  Box block;                     ///< in which the planes of the blades must not meet
  double before = 0, after = 0;  ///< mm of travel that blades go on before the first curve and after the last
};

struct FewestTurnedBlades {
  std::vector<KeyBlade> blades;
  /// mm: so far a place of the curves, or of what lies between them, is from the blade in whose plane it
  /// lies, and an end from its end, at most.
  double deviation = 0;
  double worst = 0;      ///< y of the blade there
  double turnedOff = 0;  ///< rad, the most that the plane of a curve is turned off that of the blade there
};

/// Key blades whose sweep comes within `tolerance` (mm) of a row, as `fewestBlades` finds them. The planes of
/// key blades are those of their curves; those between them turn as the numbers run, so that what a sweep is
/// off is told in its own planes, not in those of the curves. Errors: `badInput` for fewer than two curves,
/// where the middles of the blades do not go on along the travel, or where planes meet in the block with any
/// choice; `noSolution` where no choice tells blades all along the row; those of `fitElastica`, with its
/// curve's y; `cancelled`.
Result<FewestTurnedBlades> fewestTurnedBlades(const TurnedRow& row, double tolerance,
                                              const RunContext& context = {});

}  // namespace bw
