// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/cut_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bw::detail {

namespace {

/// The cut surface is sampled in about this many rows, stations included.
constexpr int kRowTarget = 240;
/// Rows from station to station where these lie evenly, at least and at most.
constexpr int kFewestBetween = 2, kMostBetween = 64;

}  // namespace

std::vector<int> stationRows(const std::vector<double>& travel) {
  const int intervals = int(travel.size()) - 1;
  const double between = std::clamp(kRowTarget / intervals, kFewestBetween, kMostBetween);
  const double width = (travel.back() - travel.front()) / intervals;
  std::vector<int> rows(1, 0);
  for (int i = 0; i < intervals; ++i) {
    const double share = width > 0 ? (travel[std::size_t(i + 1)] - travel[std::size_t(i)]) / width : 1.0;
    rows.push_back(rows.back() + std::max(kFewestBetween, int(std::lround(between * share))));
  }
  return rows;
}

std::vector<double> pointAreas(const SurfaceGrid& grid) {
  std::vector<double> areas(grid.points.size(), 0.0);
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.columns; ++c) {
      const std::size_t a = std::size_t(r) * std::size_t(grid.columns) + std::size_t(c), b = a + 1,
                        d = a + std::size_t(grid.columns), e = d + 1;
      const Eigen::Vector3d one = grid.points[e] - grid.points[a], other = grid.points[d] - grid.points[b];
      const double quarter = 0.125 * one.cross(other).norm();
      for (const std::size_t corner : {a, b, d, e}) areas[corner] += quarter;
    }
  return areas;
}

}  // namespace bw::detail
