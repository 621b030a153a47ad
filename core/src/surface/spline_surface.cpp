// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/surface/spline_surface.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/Splines>

#include "bw/core/text/number_text.h"

namespace bw {

namespace {

/// The basis functions that do not vanish at t, and the index of the first.
struct Basis {
  Basis(const std::vector<double>& knots, int degree, double t) {
    using Functions = Eigen::Spline<double, 1>;
    const Functions::KnotVectorType all =
        Eigen::Map<const Functions::KnotVectorType>(knots.data(), std::ssize(knots));
    first = int(Functions::Span(t, degree, all)) - degree;
    values = Functions::BasisFunctions(t, degree, all);
  }

  int first = 0;
  Eigen::ArrayXd values;
};

/// Clamped knots for interpolation at `t`: the parameters themselves without the second and the last but one
/// (not-a-knot) for a cubic, averages for lower degrees.
std::vector<double> interpolationKnots(const std::vector<double>& t, int degree) {
  const int n = int(t.size());
  std::vector<double> knots(std::size_t(degree + 1), t.front());
  for (int i = 1; i < n - degree; ++i) {
    if (degree == 3) {
      knots.push_back(t[std::size_t(i + 1)]);
    } else {
      double sum = 0;
      for (int j = i; j < i + degree; ++j) sum += t[std::size_t(j)];
      knots.push_back(sum / degree);
    }
  }
  knots.insert(knots.end(), std::size_t(degree + 1), t.back());
  return knots;
}

using Solver = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

bool factorise(Solver& solver, const std::vector<double>& t, const std::vector<double>& knots, int degree) {
  const int n = int(t.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    const Basis basis(knots, degree, t[std::size_t(i)]);
    for (int j = 0; j <= degree; ++j) entries.emplace_back(i, basis.first + j, basis.values[j]);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  solver.compute(matrix);
  return solver.info() == Eigen::Success;
}

}  // namespace

Eigen::Vector3d SplineSurface::value(double u, double v) const {
  u = std::clamp(u, knotsU.front(), knotsU.back());
  v = std::clamp(v, knotsV.front(), knotsV.back());
  const Basis alongU(knotsU, degreeU, u), alongV(knotsV, degreeV, v);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int j = 0; j <= degreeV; ++j) {
    const std::size_t row = std::size_t(alongV.first + j) * polesU + alongU.first;
    Eigen::Vector3d line = Eigen::Vector3d::Zero();
    for (int i = 0; i <= degreeU; ++i) line += alongU.values[i] * poles[row + i];
    sum += alongV.values[j] * line;
  }
  return sum;
}

Result<SplineSurface> interpolateGrid(const SurfaceGrid& grid, const std::vector<double>& rowParameters) {
  if (grid.rows < 2 || grid.columns < 2 || int(rowParameters.size()) != grid.rows ||
      grid.points.size() != std::size_t(grid.rows) * grid.columns)
    return fail(ErrorCode::badInput, "a skin needs at least two stations with at least two points each",
                "skin", double(grid.rows), 2.0);
  for (int r = 1; r < grid.rows; ++r)
    if (!(rowParameters[std::size_t(r)] > rowParameters[std::size_t(r - 1)]))
      return fail(ErrorCode::badInput,
                  "stations " + std::to_string(r) + " and " + std::to_string(r + 1) +
                      " coincide, so no surface can be laid through them; use fewer stations",
                  stationName(r));
  SplineSurface surface;
  surface.polesU = grid.columns;
  surface.polesV = grid.rows;
  surface.degreeU = std::min(3, grid.columns - 1);
  surface.degreeV = std::min(3, grid.rows - 1);
  std::vector<double> u(std::size_t(grid.columns));
  for (int c = 0; c < grid.columns; ++c) u[std::size_t(c)] = double(c) / (grid.columns - 1);
  surface.knotsU = interpolationKnots(u, surface.degreeU);
  surface.knotsV = interpolationKnots(rowParameters, surface.degreeV);
  Solver solverU, solverV;
  if (!factorise(solverU, u, surface.knotsU, surface.degreeU) ||
      !factorise(solverV, rowParameters, surface.knotsV, surface.degreeV))
    return fail(ErrorCode::noSolution, "the skin through the stations could not be computed", "skin");
  // Along u first (one right-hand side a row and coordinate), then along v.
  Eigen::MatrixXd byColumn(grid.columns, 3 * grid.rows);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) byColumn.block<1, 3>(c, 3 * r) = grid.at(r, c).transpose();
  const Eigen::MatrixXd alongU = solverU.solve(byColumn);
  Eigen::MatrixXd byRow(grid.rows, 3 * grid.columns);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) byRow.block<1, 3>(r, 3 * c) = alongU.block<1, 3>(c, 3 * r);
  const Eigen::MatrixXd both = solverV.solve(byRow);
  surface.poles.resize(grid.points.size());
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      surface.poles[std::size_t(r) * grid.columns + c] = both.block<1, 3>(r, 3 * c).transpose();
  return surface;
}

}  // namespace bw
