// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/surface_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bw::sweep {

using Eigen::Vector3d;

namespace {

/// The squared distance of a point from a triangle: from its plane over its inside, else from its sides.
double squaredFromTriangle(const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a), off = point - a;
  const double size = normal.squaredNorm();
  const auto inside = [&](const Vector3d& from, const Vector3d& to) {
    return (to - from).cross(point - from).dot(normal) >= 0;
  };
  if (size > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
    const double height = off.dot(normal);
    return height * height / size;
  }
  const auto fromSide = [&](const Vector3d& from, const Vector3d& to) {
    const Vector3d way = to - from;
    const double length = way.squaredNorm();
    const double t = length > 0 ? std::clamp((point - from).dot(way) / length, 0.0, 1.0) : 0.0;
    return (point - from - t * way).squaredNorm();
  };
  return std::min({fromSide(a, b), fromSide(b, c), fromSide(c, a)});
}

}  // namespace

SurfaceRows::SurfaceRows(const SurfaceGrid& cut, const PlaneFamily& planes) : cut_(cut), planes_(planes) {
  for (int r = 0; r < cut.rows; ++r) {
    const double level = planes.level(cut.at(r, 0));
    levels_.push_back(r == 0 ? level : std::max(level, levels_.back()));
  }
}

SurfaceRows::Seen SurfaceRows::look(const Vector3d& place) const {
  const double level = planes_.level(place);
  Seen seen;
  seen.across = std::max({0.0, levels_.front() - level, level - levels_.back()});
  if (planes_.turns() && seen.across > 0) seen.across *= planes_.speed(level, place);
  const auto above = std::ranges::upper_bound(levels_, level) - levels_.begin();
  const auto row = std::size_t(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(levels_.size()) - 2));
  const double width = levels_[row + 1] - levels_[row];
  const double share = width > 0 ? std::clamp((level - levels_[row]) / width, 0.0, 1.0) : 0.0;
  const int last = cut_.columns - 1;
  const Vector3d *low = &cut_.at(int(row), 0), *high = &cut_.at(int(row) + 1, 0);
  const auto at = [&](int c) -> Vector3d { return (1 - share) * low[c] + share * high[c]; };
  const Vector3d across = planes_.at(level).normal;
  const auto inPlane = [&](const Vector3d& v) -> Vector3d { return v - v.dot(across) * across; };

  // The nearest of some columns, and beside it the nearest place on the chords between all of them.
  constexpr int kStride = 5;
  double nearest = 1e300, column = 0;
  int about = 0;
  for (int c = 0; c <= last; c = c < last ? std::min(c + kStride, last) : last + 1) {
    const Vector3d off = place - at(c);
    const double out = off.dot(across), distance = off.squaredNorm() - out * out;
    if (distance >= nearest) continue;
    nearest = distance;
    about = c;
  }
  nearest = 1e300;
  const int begin = std::max(0, about - kStride), end = std::min(last, about + kStride);
  Vector3d from = at(begin);
  for (int c = begin; c < end; ++c) {
    const Vector3d to = at(c + 1), way = to - from, off = inPlane(place - from);
    const double length = way.squaredNorm();
    const double part = length > 0 ? off.dot(way) / length : 0.0;
    const double inside = std::clamp(part, 0.0, 1.0);
    const double distance = (off - inside * way).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      column = c + inside;
      seen.beside = c == 0 && part < 0          ? -part * std::sqrt(length)
                    : c + 1 == last && part > 1 ? (part - 1) * std::sqrt(length)
                                                : 0.0;
    }
    from = to;
  }
  // From there on the cubic through the four columns around it: chords cut corners.
  const int first = std::clamp(int(column) - 1, 0, last - 3);
  const Vector3d p[4] = {at(first), at(first + 1), at(first + 2), at(first + 3)};
  const auto cubic = [&](double t) -> Vector3d {
    const double a = t, b = t - 1, c = t - 2, d = t - 3;
    return -b * c * d / 6 * p[0] + a * c * d / 2 * p[1] - a * b * d / 2 * p[2] + a * b * c / 6 * p[3];
  };
  constexpr double kPast = 1;  // column: beyond an end the row goes on so far
  double t = column - first;
  for (int step = 0; step < 2; ++step) {
    constexpr double kDifference = 1e-4;  // of a column
    const Vector3d here = cubic(t), slope = (cubic(t + kDifference) - here) / kDifference;
    if (slope.squaredNorm() > 0)
      t = std::clamp(t + inPlane(place - here).dot(slope) / slope.squaredNorm(), -kPast, 3 + kPast);
  }
  seen.distance = inPlane(place - cubic(t)).norm();
  return seen;
}

double SurfaceRows::distance(const Vector3d& place, double within) const {
  const double level = planes_.level(place);
  double nearest = within;
  const auto ahead = [&](std::size_t row) {
    const Frame plane = planes_.at(levels_[row]);
    return plane.normal.dot(place - plane.origin);
  };
  const auto away = [&](std::size_t row) { return std::max({0.0, -ahead(row), ahead(row + 1)}); };
  const auto look = [&](std::size_t row) {
    const int r = int(row);
    for (int c = 0; c + 1 < cut_.columns; ++c) {
      const Vector3d &a = cut_.at(r, c), &b = cut_.at(r, c + 1), &d = cut_.at(r + 1, c),
                     &e = cut_.at(r + 1, c + 1);
      const Vector3d middle = 0.25 * (a + b + d + e);
      const double around = std::sqrt(std::max({(a - middle).squaredNorm(), (b - middle).squaredNorm(),
                                                (d - middle).squaredNorm(), (e - middle).squaredNorm()}));
      const double reach = nearest + around;
      if ((place - middle).squaredNorm() >= reach * reach) continue;
      const double squared =
          std::min(squaredFromTriangle(place, a, b, e), squaredFromTriangle(place, a, e, d));
      nearest = std::min(nearest, std::sqrt(squared));
    }
  };
  // From the planes around it outwards: none farther away has anything nearer.
  const auto above = std::ranges::upper_bound(levels_, level) - levels_.begin();
  const auto last = std::ptrdiff_t(levels_.size()) - 2;
  const auto start = std::clamp<std::ptrdiff_t>(above - 1, 0, last);
  for (std::ptrdiff_t row = start; row >= 0 && away(std::size_t(row)) < nearest; --row)
    look(std::size_t(row));
  for (std::ptrdiff_t row = start + 1; row <= last && away(std::size_t(row)) < nearest; ++row)
    look(std::size_t(row));
  return nearest;
}

}  // namespace bw::sweep
