// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw {

/// The four poles of a cubic Bézier curve.
using CubicPoles = std::array<Eigen::Vector2d, 4>;

/// What an elastica of the same length and ends would be, predicted without solving for it: the curvature of
/// the curve, projected on the affine functions of place, gives the elastica to first order, and the
/// remainder, integrated twice, its distance.
struct ProxyPrediction {
  double deviation = 0;  ///< largest distance between the curve and that elastica, mm; to first order
  Elastica elastica;  ///< first-order guess with the curve's start, start angle and length; its end is near
                      ///< the curve's
};

/// The prediction for any plane curve, in a few µs for a cubic. Right within 35 % for nine of ten cubics,
/// within a factor of two for 98 of 100, where the predicted deviation is below 0.5 % of the length
/// (docs/mathematics.md, "Spline constructions"). Fails only where the guess is no elastica (not finite).
[[nodiscard]] Result<ProxyPrediction> predictElastica(const PlanarCurve& curve);

/// How well a cubic Bézier stands in for an elastica.
struct BezierProxy {
  Elastica elastica;        ///< with the ends, end tangents and length of the Bézier
  double deviation = 0;     ///< largest distance of 1000 points of the elastica to the Bézier, mm
  double predicted = 0;     ///< the same by `predictElastica`
  double bezierEnergy = 0;  ///< ½ ∫ κ² ds of the Bézier, 1/mm; never far below that of the elastica
  double length = 0;        ///< of both, mm
};

/// The elastica with the same end points, end tangents and length as a cubic Bézier
/// (designing-for-hot-blade-cutting, Figure 12), near to it. Fails on poles that make no curve, and with
/// `noSolution` where no elastica near the Bézier meets all conditions.
[[nodiscard]] Result<BezierProxy> elasticaOfBezier(const CubicPoles& poles);

/// A chain of cubic Béziers with common tangents, one between each two neighbouring points (one in each
/// block, where the points lie on block boundaries). The lengths of the control legs are J. Hobby's (Smooth,
/// easy to compute interpolating splines, 1986), which keep a piece close to an elastica. `tangents`: angles
/// at the points; empty = those of `cubicSplineThrough`. Fails on fewer than 2 points, coincident neighbours,
/// numbers that are not finite, a wrong number of tangents.
[[nodiscard]] Result<std::vector<CubicPoles>> bezierChain(const std::vector<Eigen::Vector2d>& points,
                                                          const std::vector<double>& tangents = {});

/// The cubic spline with continuous curvature whose knots (simple, at chord-length parameters) lie at the
/// points: one cubic piece in each block. The end tangents are given as angles or, if empty, free (no
/// curvature at that end). Fails as `bezierChain`.
[[nodiscard]] Result<PlanarCurve> cubicSplineThrough(const std::vector<Eigen::Vector2d>& points,
                                                     std::optional<double> startAngle = std::nullopt,
                                                     std::optional<double> endAngle = std::nullopt);

/// What holds an elastic spline at its ducks.
struct DuckOptions {
  enum class Lengths {
    free,   ///< the spline slides through the ducks and may draw in as much length as it likes
    given,  ///< each piece has its length in `lengths`
    total,  ///< the spline slides, its whole length is `totalLength`
  };
  Lengths mode = Lengths::free;
  std::vector<double> lengths = {};                 ///< one a piece, mm
  double totalLength = 0;                           ///< mm
  std::optional<double> startAngle = std::nullopt;  ///< empty: the end may turn freely (no curvature there)
  std::optional<double> endAngle = std::nullopt;
  /// Empty: the spline turns freely in the ducks, so that its curvature is continuous (G2). Else one tangent
  /// angle a duck (G1); the end angles then come from here.
  std::vector<double> tangents = {};
};

struct DuckSpline {
  bool stable = false;           ///< the spline rests so: a strict minimum of the energy under what holds it
  std::vector<Elastica> pieces;  ///< one between each two ducks
  double energy = 0;             ///< ½ ∫ κ² ds over all, 1/mm
  double length = 0;             ///< mm
  double largestGap = 0;         ///< between the end of a piece and its duck, mm
  double largestKink = 0;        ///< of the tangents at a duck, rad
  double largestJump = 0;        ///< of the curvature at an inner duck, 1/mm; not small with given tangents
  int iterations = 0;
};

/// The physical spline: an elastica chain through given points, an equilibrium (stable or not: see the
/// result) near the cubic spline through them. With given tangents and free lengths each piece is its own
/// free elastica. Gaps and kinks are below 1e-9 of the size. Fails on bad input, on a length shorter than the
/// way between its ducks
/// (`noSolution`), and with `noSolution` where no equilibrium near is found: a spline that slides freely has
/// none between ducks that turn too sharply, and one pressed along a straight line buckles to either side.
[[nodiscard]] Result<DuckSpline> splineThroughDucks(const std::vector<Eigen::Vector2d>& ducks,
                                                    const DuckOptions& options = {});

}  // namespace bw
