// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/fit/elastica_fit.h"

namespace bw::detail {

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

/// Nothing if its numbers are beyond those of an elastica.
std::optional<Elastica> toElastica(const Placement& placement, const FitTarget& target);
/// The line along the target's tangent at its start: in place of a guess that is no elastica.
Elastica straightGuess(const FitTarget& target);
Placement toPlacement(const Elastica& elastica, const FitTarget& target);

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

  struct State {
    Eigen::Vector2d point;
    double angle, curvature;
  };
  std::size_t size() const { return s_.size(); }
  double arc(std::size_t i) const { return s_[i]; }
  State state(std::size_t i) const { return {point(i), values_[i](2, 0), values_[i](3, 0)}; }
  Eigen::Vector2d point(std::size_t i) const { return values_[i].col(0).head<2>(); }
  double angle(std::size_t i) const { return values_[i](2, 0); }
  /// Derivative of point, angle or curvature with respect to parameter j of the shape.
  Eigen::Vector2d pointDerivative(std::size_t i, int j) const { return values_[i].col(1 + j).head<2>(); }
  double angleDerivative(std::size_t i, int j) const { return values_[i](2, 1 + j); }
  double curvatureDerivative(std::size_t i, int j) const { return values_[i](3, 1 + j); }

 private:
  template <int Directions, std::size_t Order>
  void walk(const Shape& shape);

  std::vector<double> s_;
  std::optional<Shape> known_;  ///< the shape that `values_` belongs to
  bool knownDerivatives_ = false;
  bool coarse_ = false;
  std::vector<Eigen::Matrix4d> values_;  ///< rows x, y, ψ, κ; columns: state, derivatives by κ, f_t, f_n
};

/// The first and the last arc length of an evaluator: 0 and 1.
class ShapeEnds {
 public:
  explicit ShapeEnds(const ShapeEvaluator& shapes) : shapes_(shapes) {}
  double arc(std::size_t end) const { return shapes_.arc(at(end)); }
  ShapeEvaluator::State state(std::size_t end) const { return shapes_.state(at(end)); }
  Eigen::Vector2d point(std::size_t end) const { return shapes_.point(at(end)); }
  double angle(std::size_t end) const { return shapes_.angle(at(end)); }
  Eigen::Vector2d pointDerivative(std::size_t end, int j) const {
    return shapes_.pointDerivative(at(end), j);
  }
  double angleDerivative(std::size_t end, int j) const { return shapes_.angleDerivative(at(end), j); }
  double curvatureDerivative(std::size_t end, int j) const { return shapes_.curvatureDerivative(at(end), j); }

 private:
  std::size_t at(std::size_t end) const { return end == 0 ? 0 : shapes_.size() - 1; }
  const ShapeEvaluator& shapes_;
};

}  // namespace bw::detail
