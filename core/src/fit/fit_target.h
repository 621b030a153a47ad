// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/fit/elastica_fit.h"

namespace bw::fit {

/// Product of two plane vectors read as complex numbers: `b` turned and stretched by `a`.
inline Eigen::Vector2d turned(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}
/// `b` turned back by `a`: conj(a) b.
inline Eigen::Vector2d turnedBack(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a.x() * b.x() + a.y() * b.y(), a.x() * b.y() - a.y() * b.x()};
}
inline Eigen::Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
inline Eigen::Vector2d quarterTurn(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

using FitNorm = FitOptions::Norm;

/// The curve to approximate, moved to its centroid and scaled to length 1 (docs/mathematics.md, 7.1). Arc
/// length runs from −½ to ½.
struct FitTarget {
  Eigen::Vector2d centre;  ///< of the curve, mm
  double length = 1;       ///< of the curve, mm

  std::vector<double> s;                 ///< nodes, ascending
  std::vector<double> weight;            ///< sums to 1
  std::vector<Eigen::Vector2d> point;    ///< weighted mean 0
  std::vector<Eigen::Vector2d> tangent;  ///< unit
  std::vector<double> curvature;
  std::vector<double> angle;  ///< of the tangent, without jumps

  Eigen::Vector2d start, end, middle;
  double startAngle = 0, endAngle = 0, middleAngle = 0;  ///< continuous with `angle`

  /// From the quadrature of the curve, or from one Gauss rule along the whole curve with `nodes` nodes.
  explicit FitTarget(const PlanarCurve& curve, int nodes = 0);
  std::size_t size() const { return s.size(); }
  /// How often the curvature changes sign, seen at the nodes.
  int inflections() const;
};

/// The shape of an elastica of length 1 in the frame of its middle: (κ, f_t, f_n) there
/// (docs/mathematics.md, 7.1).
using Shape = Eigen::Vector3d;

/// The seven unknowns of a fit in the frame of the target: the shape, ln of the length, the tangent angle at
/// the middle and the point of the middle.
struct Placement {
  Shape shape = Shape::Zero();
  double logLength = 0;
  double angle = 0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
};

/// What a descent came to.
struct FitSolution {
  Placement placement;
  double value = 0;  ///< of the objective
  int iterations = 0;
  bool feasible = false;  ///< every constraint holds to optimise::kFeasible
  bool converged = false;
  bool boundActive = false;
  double violation = 0;       ///< the largest, dimensionless
  int worst = -1;             ///< the name of the constraint of the largest violation
  std::vector<double> peaks;  ///< where the curvature was found to reach its bound besides the fixed places
  std::optional<Elastica> taut;  ///< the curve, where the seven numbers at its middle do not carry it
};

/// Nothing if its numbers are beyond those of an elastica.
std::optional<Elastica> toElastica(const Placement& placement, const FitTarget& target);
/// The curve of a solution.
std::optional<Elastica> curveOf(const FitSolution& solution, const FitTarget& target);
Placement toPlacement(const Elastica& elastica, const FitTarget& target);

/// The objective of any elastica.
double objectiveOf(const Elastica& elastica, const FitTarget& target, FitNorm norm);
/// 1 − the mean of the product of the unit tangents at equal parts of the lengths.
double tangentResidual(const Elastica& elastica, const FitTarget& target);

/// Evaluates shapes at fixed arc lengths; keeps its buffers. The power series of `ElasticaFlow`, told to
/// start at the middle and to use the piece there for both sides.
class ShapeEvaluator {
 public:
  /// `s` ascending; [−½, ½] is the segment.
  explicit ShapeEvaluator(std::vector<double> s);
  /// Evaluates at other arc lengths from now on.
  void moveTo(std::vector<double> s);

  /// From now on to about seven digits, faster, or to all of them.
  void setCoarse(bool coarse);

  /// False if the shape is out of the range that makes sense. Asking again for the same shape costs nothing.
  bool evaluate(const Shape& shape, bool derivatives);

  std::size_t size() const { return s_.size(); }
  /// The place of the first arc length (0) or of the last (1).
  std::size_t end(std::size_t which) const { return which == 0 ? 0 : size() - 1; }
  double arc(std::size_t i) const { return s_[i]; }
  Eigen::Vector2d point(std::size_t i) const { return values_[i].col(0).head<2>(); }
  double angle(std::size_t i) const { return values_[i](2, 0); }
  double curvature(std::size_t i) const { return values_[i](3, 0); }
  /// Derivative of point, angle or curvature with respect to parameter j of the shape.
  Eigen::Vector2d pointDerivative(std::size_t i, int j) const { return values_[i].col(1 + j).head<2>(); }
  double angleDerivative(std::size_t i, int j) const { return values_[i](2, 1 + j); }
  double curvatureDerivative(std::size_t i, int j) const { return values_[i](3, 1 + j); }
  Eigen::Vector3d curvatureGradient(std::size_t i) const { return values_[i].row(3).tail<3>(); }

 private:
  template <int Directions, std::size_t Order>
  void walk(const Shape& shape);

  std::vector<double> s_;
  std::optional<Shape> known_;  ///< the shape that `values_` belongs to
  bool knownDerivatives_ = false;
  bool coarse_ = false;
  std::vector<Eigen::Matrix4d> values_;  ///< rows x, y, ψ, κ; columns: state, derivatives by κ, f_t, f_n
};

}  // namespace bw::fit
