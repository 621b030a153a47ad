// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// A plane curve, immutable and cheap to copy: Bézier, B-spline (any knots, rational or not) or a chain of
/// points. Parameters run over [start(), end()]; lengths in mm (any unit, consistently); curvature is
/// positive counter-clockwise. Copies may be used from several threads at once.
class PlanarCurve {
 public:
  enum class Kind { bezier, bspline, points };

  /// A Bézier curve over [0, 1] with 2 or more poles. Fails on fewer poles, non-finite numbers or zero
  /// length.
  static Result<PlanarCurve> bezier(std::vector<Eigen::Vector2d> poles);

  /// A B-spline of degree ≥ 1; `knots` flat with multiplicity (size = poles + degree + 1, non-decreasing,
  /// inner multiplicity ≤ degree); the domain is [knots[degree], knots[poles]]. `weights` empty = not
  /// rational, else one > 0 a pole. Fails with the offending index and value.
  static Result<PlanarCurve> bspline(int degree, std::vector<double> knots,
                                     std::vector<Eigen::Vector2d> poles, std::vector<double> weights = {});

  /// A chain of 2 or more points parameterised by its own arc length [0, L]. Coincident neighbours are
  /// merged; value and tangent follow the polyline, curvature is estimated from the turning angles
  /// (thesis 4.2).
  static Result<PlanarCurve> points(std::vector<Eigen::Vector2d> points);

  Kind kind() const;
  int degree() const;
  const std::vector<double>& knots() const;
  const std::vector<Eigen::Vector2d>& poles() const;  ///< poles, or the points of a chain
  const std::vector<double>& weights() const;         ///< empty if not rational

  double start() const;
  double end() const;

  struct Derivatives {
    Eigen::Vector2d value, first, second;
  };
  /// Value at parameter t, clamped to the domain.
  Eigen::Vector2d value(double t) const;
  /// Value and the first two derivatives with respect to the parameter.
  Derivatives derivatives(double t) const;
  /// Signed curvature, 1/mm. Zero where the first derivative vanishes.
  double curvature(double t) const;
  /// Unit tangent; where the first derivative vanishes, the limit direction.
  Eigen::Vector2d tangent(double t) const;

  /// Total arc length; relative accuracy 1e-10 for smooth spans.
  double length() const;
  /// Arc length from the start to t.
  double arcLength(double t) const;
  /// The parameter at arc length s from the start, clamped to [0, length].
  double parameterAt(double s) const;

  /// Samples for integrals over arc length: Gauss nodes of every knot span in order. ∫ f ds ≈ Σ weight_i f_i.
  struct Quadrature {
    std::vector<double> parameter;
    std::vector<double> arc;     ///< arc length from the start
    std::vector<double> weight;  ///< in arc length; sums to length()
    std::vector<Eigen::Vector2d> point;
    std::vector<Eigen::Vector2d> tangent;  ///< unit
    std::vector<double> curvature;
  };
  /// Computed once when the curve is made.
  const Quadrature& quadrature() const;

  PlanarCurve reversed() const;
  /// The part between parameters t0 < t1, exact (knot insertion). A B-spline keeps its parameters; a part of
  /// a Bézier runs over [0, 1], a part of a chain from 0. Fails if the part is empty.
  Result<PlanarCurve> subCurve(double t0, double t1) const;
  /// Rotated by `angle` about the origin, then scaled by `scale` > 0, then moved.
  PlanarCurve transformed(double angle, double scale, const Eigen::Vector2d& translation) const;

  /// The parameter of the point nearest to p, to 1e-9 of the length; global (all spans are searched).
  double nearestParameter(const Eigen::Vector2d& p) const;
  /// The parameter of a point locally nearest to p, found downhill from `seed`; much faster than the global
  /// search.
  double nearestParameter(const Eigen::Vector2d& p, double seed) const;

  /// `count` ≥ 2 points at equal arc length, ends included.
  std::vector<Eigen::Vector2d> sample(int count) const;

 private:
  struct Data;
  explicit PlanarCurve(std::shared_ptr<const Data> data);
  std::shared_ptr<const Data> data_;
};

}  // namespace bw
