// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "bw/core/surface/spline_surface.h"

namespace bw::test {

/// The i-th basis function of a B-spline with flat knots at t, by its definition (Cox–de Boor).
inline double basisValue(const std::vector<double>& knots, int i, int degree, double t) {
  if (degree == 0) {
    const bool last = knots[i] < knots[i + 1] && knots[i + 1] == knots.back() && t == knots.back();
    return (t >= knots[i] && t < knots[i + 1]) || last ? 1.0 : 0.0;
  }
  double value = 0;
  const double a = knots[i + degree] - knots[i], b = knots[i + degree + 1] - knots[i + 1];
  if (a > 0) value += (t - knots[i]) / a * basisValue(knots, i, degree - 1, t);
  if (b > 0) value += (knots[i + degree + 1] - t) / b * basisValue(knots, i + 1, degree - 1, t);
  return value;
}

/// A row of basis values for each parameter.
inline Eigen::MatrixXd collocation(int degree, const std::vector<double>& knots,
                                   const std::vector<double>& at) {
  const int n = int(at.size());
  Eigen::MatrixXd matrix(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) matrix(i, j) = basisValue(knots, j, degree, at[i]);
  return matrix;
}

/// Fills in the poles of a surface with knots and degrees that goes through points(row, column) at the
/// parameters `u` and `v`: dense algebra, apart from what the program does.
inline void interpolate(SplineSurface& surface, const std::vector<double>& u, const std::vector<double>& v,
                        const std::vector<Eigen::Vector3d>& points) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> alongU(collocation(surface.degreeU, surface.knotsU, u));
  const Eigen::PartialPivLU<Eigen::MatrixXd> alongV(collocation(surface.degreeV, surface.knotsV, v));
  surface.polesU = int(u.size());
  surface.polesV = int(v.size());
  surface.poles.resize(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::MatrixXd values(u.size(), v.size());
    for (int k = 0; k < values.size(); ++k) values(k) = points[k][axis];
    const Eigen::MatrixXd half = alongU.solve(values);
    const Eigen::MatrixXd poles = alongV.solve(half.transpose()).transpose();
    for (int k = 0; k < poles.size(); ++k) surface.poles[k][axis] = poles(k);
  }
}

/// A `Loft` for tests without CAD: not-a-knot cubics, averaged knots for lower degrees.
inline Result<SplineSurface> interpolated(const SurfaceGrid& grid, const std::vector<double>& rowParameters) {
  const auto knotsAt = [](const std::vector<double>& t, int degree) {
    std::vector<double> knots(degree + 1, t.front());
    for (int i = 1; i + degree < int(t.size()); ++i)
      knots.push_back(degree == 3 ? t[i + 1] : degree == 2 ? (t[i] + t[i + 1]) / 2 : t[i]);
    knots.insert(knots.end(), degree + 1, t.back());
    return knots;
  };
  SplineSurface surface;
  surface.degreeU = std::min(3, grid.columns - 1);
  surface.degreeV = std::min(3, grid.rows - 1);
  std::vector<double> u;
  for (int c = 0; c < grid.columns; ++c) u.push_back(double(c) / (grid.columns - 1));
  surface.knotsU = knotsAt(u, surface.degreeU);
  surface.knotsV = knotsAt(rowParameters, surface.degreeV);
  interpolate(surface, u, rowParameters, grid.points);
  return surface;
}

}  // namespace bw::test
