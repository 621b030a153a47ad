// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "shape/fitted_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shape/shapes.h"

namespace bw::shape {

namespace {

constexpr int kDegree = 3;
/// Where in a span the spline is held against the surface: parts that are not even, so that no wave that the
/// places miss is missed here too.
constexpr std::array<double, 3> kShares = {0.2113, 0.5, 0.7887};
constexpr double kWidestShare = kShares[1] - kShares[0];  // between two of them

/// How far the spline lies from the surface at most, and where.
struct Miss {
  double distance = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  void take(double found, double u, double y) {
    if (!(found > distance)) return;
    distance = found;
    place = {u, y};
  }
};

/// What the spline misses between its places: along u on its rows, along y on its columns, and in all.
struct Misses {
  Miss alongU, alongY, all;
};

using Flat = Eigen::Vector2d;
using Space = Eigen::Vector3d;

template <class Point>
using Rows = std::function<Result<void>(double y, std::span<const double> u, std::span<Point> out)>;

/// The pole of a spline, and back. Where all of a row lies in one plane, its y is that of the row.
Space poleOf(const Flat& p, double y) { return {p.x(), y, p.y()}; }
Space poleOf(const Space& p, double) { return p; }
template <class Point>
Point pointOf(const Space& pole) {
  if constexpr (Point::RowsAtCompileTime == 3)
    return pole;
  else
    return {pole.x(), pole.z()};
}

template <class Point>
Result<SplineSurface> through(const Rows<Point>& rowOf, const std::vector<double>& u,
                              const std::vector<double>& y) {
  const std::size_t columns = u.size(), rows = y.size();
  std::vector<Point> points(columns * rows);
  for (std::size_t j = 0; j < rows; ++j)
    if (Result<void> ok = rowOf(y[j], u, std::span(points).subspan(j * columns, columns)); !ok)
      return tl::unexpected<Error>(ok.error());
  const SplineInterpolation alongU(u, kDegree), alongY(y, kDegree);
  std::vector<double> atY = y;
  alongY.solve(atY.data(), 1);
  for (std::size_t j = 0; j < rows; ++j) alongU.solve(&points[j * columns], 1);
  for (std::size_t i = 0; i < columns; ++i) alongY.solve(&points[i], columns);
  SplineSurface spline{kDegree, kDegree, alongU.knots(), alongY.knots(), int(columns), int(rows), {}};
  spline.poles.reserve(points.size());
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      spline.poles.push_back(poleOf(points[j * columns + i], atY[j]));
    }
  return spline;
}

/// The values of all basis functions at each of some parameters.
struct Basis {
  std::vector<int> first;
  std::vector<std::array<double, 4>> values;
  Basis(const std::vector<double>& knots, const std::vector<double>& at) {
    const int poles = int(knots.size()) - kDegree - 1;
    for (const double t : at) {
      const auto above = std::upper_bound(knots.begin() + kDegree, knots.begin() + poles, t);
      const int span = int(above - knots.begin()) - 1;
      first.push_back(span - kDegree);
      values.push_back(splineBasis(knots, kDegree, span, t));
    }
  }
};

/// Places and those between them, at which a spline is held against its surface: `kShares` of each span, or
/// `parts` even ones.
struct Between {
  std::vector<double> all;
  std::size_t step;  ///< the place `k` has the index k · step
  Between(const std::vector<double>& places, int parts)
      : step(parts > 0 ? std::size_t(parts) : 1 + kShares.size()) {
    all.reserve((places.size() - 1) * step + 1);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double span = places[i + 1] - places[i];
      all.push_back(places[i]);
      for (std::size_t k = 1; k < step; ++k)
        all.push_back(places[i] + span * (parts > 0 ? double(k) / double(parts) : kShares[k - 1]));
    }
    all.push_back(places.back());
  }
};

/// In how many even parts spans are to be looked at, so that no two places are further apart than `widest`; 0
/// where those of `kShares` are near enough.
int partsOf(const Places& places, int most) {
  double span = 0;
  for (std::size_t k = 0; k + 1 < places.breaks.size(); ++k)
    span = std::max(span, (places.breaks[k + 1] - places.breaks[k]) / places.parts);
  if (span * kWidestShare <= places.widest) return 0;
  // Never more places than the finest grid is looked at.
  const double spans = double((places.breaks.size() - 1) * std::size_t(places.parts));
  const double limit = std::floor(double(1 + kShares.size()) * double(most - 1) / spans);
  return int(std::min(std::ceil(span / places.widest), std::max(limit, 1.0)));
}

template <class Point>
Result<Misses> compare(const Rows<Point>& rowOf, const SplineSurface& spline, const std::vector<double>& u,
                       const std::vector<double>& y, int partsU = 0, int partsY = 0) {
  const Between betweenU(u, partsU), betweenY(y, partsY);
  const std::vector<double>&manyU = betweenU.all, &manyY = betweenY.all;
  const Basis basisU(spline.knotsU, manyU), basisY(spline.knotsV, manyY);
  Misses misses;
  std::vector<Point> row(std::size_t(spline.polesU)), points(manyU.size());
  for (std::size_t j = 0; j < manyY.size(); ++j) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i].setZero();
      for (std::size_t k = 0; k <= kDegree; ++k) {
        const Eigen::Vector3d& pole = spline.poles[(std::size_t(basisY.first[j]) + k) * row.size() + i];
        row[i] += basisY.values[j][k] * pointOf<Point>(pole);
      }
    }
    if (Result<void> ok = rowOf(manyY[j], manyU, points); !ok) return tl::unexpected<Error>(ok.error());
    for (std::size_t i = 0; i < manyU.size(); ++i) {
      Point own = Point::Zero();
      for (std::size_t k = 0; k <= kDegree; ++k)
        own += basisU.values[i][k] * row[std::size_t(basisU.first[i]) + k];
      const double distance = (own - points[i]).squaredNorm();
      const bool onRow = j % betweenY.step == 0, onColumn = i % betweenU.step == 0;
      if (onRow && onColumn) continue;
      misses.all.take(distance, manyU[i], manyY[j]);
      if (onRow) misses.alongU.take(distance, manyU[i], manyY[j]);
      if (onColumn) misses.alongY.take(distance, manyU[i], manyY[j]);
    }
  }
  for (Miss* miss : {&misses.alongU, &misses.alongY, &misses.all}) miss->distance = std::sqrt(miss->distance);
  return misses;
}

}  // namespace

std::vector<double> Places::all() const {
  std::vector<double> places;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (int i = 0; i < parts; ++i) places.push_back(breaks[k] + (breaks[k + 1] - breaks[k]) * i / parts);
  places.push_back(breaks.back());
  return places;
}

namespace {

template <class Point>
Result<FittedGrid> fitted(const Rows<Point>& rowOf, Places u, Places y, double tolerance, int most) {
  const auto spent = [most](const Places& places) {
    return (places.breaks.size() - 1) * std::size_t(places.parts) * 2 + 1 > std::size_t(most);
  };
  for (;;) {
    const std::vector<double> atU = u.all(), atY = y.all();
    Result<SplineSurface> spline = through<Point>(rowOf, atU, atY);
    if (!spline) return tl::unexpected<Error>(spline.error());
    Result<Misses> misses = compare<Point>(rowOf, *spline, atU, atY);
    // Only a spline that is near at a few places of each span is worth a look at many.
    const int partsU = partsOf(u, most), partsY = partsOf(y, most);
    if (misses && misses->all.distance <= tolerance && (partsU > 0 || partsY > 0))
      misses = compare<Point>(rowOf, *spline, atU, atY, partsU, partsY);
    if (!misses) return tl::unexpected<Error>(misses.error());
    // Both ways where neither alone tells: what is left over is of both.
    const bool neither = std::max(misses->alongU.distance, misses->alongY.distance) <= tolerance / 2;
    const bool finerU = neither || misses->alongU.distance > tolerance / 2;
    const bool finerY = neither || misses->alongY.distance > tolerance / 2;
    if (misses->all.distance <= tolerance || (finerU && spent(u)) || (finerY && spent(y)))
      return FittedGrid{std::move(*spline), misses->all.distance, misses->all.place};
    if (finerU) u.parts *= 2;
    if (finerY) y.parts *= 2;
  }
}

}  // namespace

Result<FittedGrid> fittedGrid(const RowOf& rowOf, Places u, Places y, double tolerance, int most) {
  return fitted<Flat>(rowOf, std::move(u), std::move(y), tolerance, most);
}

Result<FittedGrid> fittedGrid(const SpaceRowOf& rowOf, Places u, Places y, double tolerance, int most) {
  return fitted<Space>(rowOf, std::move(u), std::move(y), tolerance, most);
}

}  // namespace bw::shape
