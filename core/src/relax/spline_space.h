// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace bw::relax {

/// Splines of one degree with simple inner knots over [0, 1], clamped at the ends.
struct SplineSpace {
  int degree = 3;
  std::vector<double> breaks;  ///< ascending, from 0 to 1

  int size() const { return int(breaks.size()) - 1 + degree; }  ///< number of control points
  std::vector<double> knots() const;
  /// The non-zero basis functions at t: value, first and second derivative a column each, degree + 1 rows;
  /// returns the first's index.
  int basis(double t, Eigen::MatrixX3d& values) const;
  /// Control points of the spline through `curve` at the means of the knots (Greville); exact for splines of
  /// this space.
  Eigen::MatrixX2d interpolate(const std::function<Eigen::Vector2d(double)>& curve) const;
};

}  // namespace bw::relax
