// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/fit/elastica_fit.h"

namespace bw {

/// How a curve is approximated by several elastica (thesis 3.4).
struct PiecewiseOptions {
  enum class Splits { given, uniform, optimised };

  Splits splits = Splits::uniform;  ///< uniform: pieces of equal arc length
  std::vector<double>
      parameters;  ///< for Splits::given: where the curve is split, ascending, inside its domain
  int pieces = 1;  ///< for the other two; with `tolerance`, the most
  /// The farthest (mm) that the pieces may lie from the curve: the fewest pieces are sought that keep it, at
  /// most `pieces`; their splits are optimised. Not with Splits::given.
  std::optional<double> tolerance = std::nullopt;

  double position = 0;     ///< by which neighbours may miss each other at a joint: the distance, mm
  double angle = 0;        ///< by which their tangents may differ, rad
  bool curvature = false;  ///< equal curvature at the joints as well (G2)
  std::optional<double> maxCurvature = std::nullopt;  ///< bound on |κ| over every piece, 1/mm
  bool endpoints = false;                             ///< the ends of the whole curve are kept exactly
  bool tangents = false;                              ///< its end tangents are kept exactly
};

/// Where two neighbours meet.
struct PiecewiseJoint {
  double gap = 0;            ///< distance of the ends, mm
  double angle = 0;          ///< between the tangents, rad, not negative
  double curvatureJump = 0;  ///< 1/mm
};

struct PiecewiseResult {
  std::vector<Elastica> pieces;
  std::vector<double>
      splits;              ///< parameters of the curve, both ends included: one more than there are pieces
  std::vector<double> R4;  ///< of each piece, relative to its own part of the curve
  std::vector<double> hausdorff;       ///< of each piece to the whole curve, one-sided, mm
  std::vector<PiecewiseJoint> joints;  ///< one fewer than there are pieces
  double totalR4 = 0;                  ///< root mean square distance over the whole curve, over its length
  int iterations = 0;
  FitStatus status = FitStatus::converged;
  bool withinTolerance = true;  ///< the wanted tolerance is kept
  std::string message;          ///< why, if not converged or not within the tolerance
  double seconds = 0;           ///< solver time alone
};

/// The chain of elastica that minimises (3.4) of the thesis; neighbours meet, but not necessarily on the
/// curve. Fails on bad options and when stopped; conditions that cannot be met are a status. Optimised splits
/// are searched on a grid of arc lengths by dynamic programming, then improved one by one: the best on the
/// grid for pieces that need not meet, a local minimum for those that do.
[[nodiscard]] Result<PiecewiseResult> fitPiecewise(const PlanarCurve& curve,
                                                   const PiecewiseOptions& options = {},
                                                   const RunContext& context = {});

}  // namespace bw
