// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace bw::curve {

/// Largest degree of a curve; evaluation keeps one row of poles on the stack.
inline constexpr int kMaxDegree = 32;

/// One polynomial or rational piece of a curve over [t0, t1], in Bézier form. Cheap to evaluate; immutable
/// after `prepare`.
struct BezierSpan {
  double t0 = 0, t1 = 1;
  std::vector<Eigen::Vector2d> poles;  ///< degree + 1
  std::vector<double> weights;         ///< empty if not rational

  struct Point {
    Eigen::Vector2d value, first, second;  ///< derivatives with respect to t
  };

  int degree() const { return static_cast<int>(poles.size()) - 1; }
  Point at(double t) const;
  Eigen::Vector2d value(double t) const;
  Eigen::Vector2d first(double t) const;
  double speed(double t) const { return first(t).norm(); }
  /// Length of the control polygon: an upper bound of the arc length.
  double polygonLength() const;

  /// Fills the Bernstein form of (r − p)·r' up to a positive factor, which is linear in p:
  /// g_k = stationaryConstant_k − p̃·stationarySlope_k with p̃ = p − poles[0].
  void prepare();
  std::vector<double> stationaryConstant;
  std::vector<Eigen::Vector2d> stationarySlope;

  /// Appends the parameters of the interior local minima of |r(t) − p| (and of points that may be one) to
  /// `out`.
  void stationaryPoints(const Eigen::Vector2d& p, std::vector<double>& out) const;
};

}  // namespace bw::curve
