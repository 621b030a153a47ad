// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/resample.h"

#include <algorithm>
#include <numeric>

#include "shape/shapes.h"

namespace bw {

namespace {

constexpr int kHalvings = 60;  // of a parameter

/// The means of as many knots as the degree, which a spline can be given values at.
std::vector<double> greville(const std::vector<double>& knots, int degree) {
  std::vector<double> at;
  for (auto first = knots.begin() + 1; first + degree < knots.end(); ++first)
    at.push_back(std::accumulate(first, first + degree, 0.0) / degree);
  return at;
}

/// The parameters at which a coordinate of one surface is what it is at given ones of another: both ascend
/// along even poles. Moved poles make it a place nearby.
template <class Coordinate>
std::vector<double> samePlaces(const std::vector<double>& places, const Coordinate& coordinate) {
  std::vector<double> at;
  for (const double place : places) {
    double from = 0, to = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (from + to);
      (coordinate(middle) < place ? from : to) = middle;
    }
    at.push_back(place <= coordinate(0) ? 0 : place >= coordinate(1) ? 1 : 0.5 * (from + to));
  }
  return at;
}

}  // namespace

Result<PolesSurface> resampled(const PolesSurface& surface, int columns, int rows) {
  const Result<SplineSurface> before = shape::splineOf(surface);
  if (!before) return tl::unexpected<Error>(before.error());
  PolesSurface after;
  after.over = surface.over;
  after.columns = columns;
  after.rows = rows;
  after.degreeX = std::clamp(columns - 1, 1, surface.degreeX);
  after.degreeY = std::clamp(rows - 1, 1, surface.degreeY);
  after.poles.assign(std::size_t(std::max(0, columns)) * std::size_t(std::max(0, rows)), {});
  const Result<SplineSurface> even = shape::splineOf(after);
  if (!even) return tl::unexpected<Error>(even.error());
  const std::vector<double> u = greville(even->knotsU, even->degreeU),
                            v = greville(even->knotsV, even->degreeV);
  std::vector<double> x, y;
  for (const double t : u) x.push_back(even->value(t, 0).x());
  for (const double t : v) y.push_back(even->value(0, t).y());
  const std::vector<double> atX = samePlaces(x, [&](double t) { return before->value(t, 0.5).x(); });
  const std::vector<double> atY = samePlaces(y, [&](double t) { return before->value(0.5, t).y(); });
  std::vector<double> heights;
  for (const double t : atY)
    for (const double s : atX) heights.push_back(before->value(s, t).z());
  const shape::SplineInterpolation alongX(u, even->degreeU, even->knotsU),
      alongY(v, even->degreeV, even->knotsV);
  for (int r = 0; r < rows; ++r) alongX.solve(&heights[std::size_t(r) * columns], 1);
  for (int c = 0; c < columns; ++c) alongY.solve(&heights[std::size_t(c)], std::size_t(columns));
  for (std::size_t i = 0; i < heights.size(); ++i) after.poles[i].height = heights[i];
  return after;
}

}  // namespace bw
