// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/export.h"
#include "interpolated.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bw::geometry {

namespace {

SurfaceGrid gridOf(int rows, int columns, const std::vector<double>& v,
                   Eigen::Vector3d (*f)(double, double)) {
  SurfaceGrid grid;
  grid.rows = rows;
  grid.columns = columns;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) grid.points.push_back(f(double(c) / (columns - 1), v[std::size_t(r)]));
  return grid;
}

std::vector<double> uneven(int n) {
  std::vector<double> v;
  for (int i = 0; i < n; ++i) v.push_back((i + 0.3 * std::sin(2.0 * i)) / (n - 1));
  return v;
}

Eigen::Vector3d wavyPlace(double u, double v) {
  return {600 * u, 700 * v, 80 * std::sin(3 * u) * std::cos(2 * v)};
}

Eigen::Vector3d cubic(double u, double v) { return {u * u * u - v, v * v * v + u, u * u * v * v * v}; }

}  // namespace

TEST(Loft, PassesThroughItsGrid) {
  for (const int rows : {2, 3, 4, 5, 17}) {
    const std::vector<double> v = uneven(rows);
    const SurfaceGrid grid = gridOf(rows, 9, v, wavyPlace);
    const Result<SplineSurface> surface = loft(grid, v);
    ASSERT_TRUE(surface) << surface.error().message;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < 9; ++c)
        EXPECT_LT((surface->value(c / 8.0, v[std::size_t(r)]) - grid.at(r, c)).norm(), 1e-9);
  }
}

TEST(Loft, ReproducesBicubicPolynomials) {
  const std::vector<double> v = uneven(8);
  const Result<SplineSurface> surface = loft(gridOf(8, 7, v, cubic), v);
  ASSERT_TRUE(surface);
  for (double u = 0; u <= 1; u += 0.037)
    for (double t = 0.05; t <= 0.95; t += 0.041)
      EXPECT_LT((surface->value(u, t) - cubic(u, t)).norm(), 1e-12);
}

TEST(Loft, ConvergesWithFourthOrder) {
  const auto error = [](int n) {
    std::vector<double> v;
    for (int i = 0; i < n; ++i) v.push_back(double(i) / (n - 1));
    const Result<SplineSurface> surface = loft(gridOf(n, n, v, wavyPlace), v);
    double worst = 0;
    for (double u = 0; u <= 1; u += 0.0113)
      for (double t = 0; t <= 1; t += 0.0127)
        worst = std::max(worst, (surface->value(u, t) - wavyPlace(u, t)).norm());
    return worst;
  };
  EXPECT_GT(error(11) / error(21), 12);
}

TEST(Loft, IsTheInterpolationOfDenseAlgebra) {
  for (const int rows : {2, 3, 4, 12, 60}) {
    const std::vector<double> v = uneven(rows);
    const SurfaceGrid grid = gridOf(rows, 101, v, wavyPlace);
    const Result<SplineSurface> surface = loft(grid, v), dense = bw::test::interpolated(grid, v);
    ASSERT_TRUE(surface && dense);
    EXPECT_EQ(surface->knotsU, dense->knotsU);
    EXPECT_EQ(surface->knotsV, dense->knotsV);
    for (std::size_t k = 0; k < surface->poles.size(); ++k)
      EXPECT_LT((surface->poles[k] - dense->poles[k]).norm(), 1e-9);
  }
}

TEST(Loft, RefusesCoincidentStations) {
  const SurfaceGrid grid = gridOf(3, 3, {0, 0.5, 1}, wavyPlace);
  EXPECT_FALSE(loft(grid, {0, 0, 1}));
  EXPECT_FALSE(loft(grid, {0, NAN, 1}));
  EXPECT_FALSE(loft(grid, {0, 1}));
}

}  // namespace bw::geometry
