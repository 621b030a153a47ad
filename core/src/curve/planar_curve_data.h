// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "curve/bezier_span.h"

namespace bw {

/// What a curve is made of, and the tables that are computed once.
struct PlanarCurve::Data {
  /// Nodes of the rule inside one cell of the arc-length table.
  static constexpr int kCellNodes = 10;

  Kind kind = Kind::bezier;
  int degree = 1;
  std::vector<double> knots;
  std::vector<Eigen::Vector2d> poles;
  std::vector<double> weights;
  double start = 0, end = 1;

  /// Splines: one piece a non-empty knot span. Chains: empty.
  std::vector<curve::BezierSpan> spans;

  /// Arc-length table: cell i runs over [cellT[i], cellT[i + 1]], inside one span, short enough for the inner
  /// Gauss rule. Chains: the vertices.
  std::vector<double> cellT, cellS;
  std::vector<int> cellSpan;
  double length = 0;

  std::vector<double> vertexCurvature;  ///< chains: estimated from the turning angles

  std::size_t cellAt(double t) const;
  const curve::BezierSpan& spanAt(double t) const;
  double clamp(double t) const;
  Eigen::Vector2d value(double t) const;
  Derivatives derivatives(double t) const;
  Eigen::Vector2d tangent(double t) const;
  double arcLength(double t) const;
  double parameterAt(double s) const;
  /// Found when it is first asked for: a curve that follows a hand is never integrated along.
  const Quadrature& quadrature() const;

  /// Fails if the length is zero or not finite.
  static Result<PlanarCurve> makeCurve(Kind kind, int degree, std::vector<double> knots,
                                       std::vector<Eigen::Vector2d> poles, std::vector<double> weights);
  /// With every table; null if the length is zero or not finite.
  static std::shared_ptr<const Data> make(Kind kind, int degree, std::vector<double> knots,
                                          std::vector<Eigen::Vector2d> poles, std::vector<double> weights);

  /// Poles (and weights, if rational) of the curve on the flat knot vector `newKnots`, which refines the
  /// curve's own inside [a, b] and lies in that interval. Exact: knot insertion by blossoming.
  std::vector<Eigen::Vector2d> polesOver(double a, double b, const std::vector<double>& newKnots,
                                         std::vector<double>& newWeights) const;

 private:
  mutable std::once_flag once_;
  mutable Quadrature quadrature_;

  bool buildSpline();
  bool buildChain();
  void addCells(int span, double a, double b, double estimate, double tolerance, int depth);
  /// In planar_curve_quadrature.cpp.
  void addSplineQuadrature(Quadrature& q) const;
  void addChainQuadrature(Quadrature& q) const;
  void addSideQuadrature(Quadrature& q, std::size_t i) const;
  void addBlockQuadrature(Quadrature& q, std::size_t i, std::size_t last) const;
};

}  // namespace bw
