// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/surface_rows.h"

#include <algorithm>
#include <cmath>

namespace bw::sweep {

using Eigen::Vector3d;

SurfaceRows::SurfaceRows(const SurfaceGrid& cut, const PlaneFamily& planes)
    : cut_(cut), direction_(planes.direction()) {
  for (int r = 0; r < cut.rows; ++r) {
    const double level = direction_.dot(cut.at(r, 0));
    levels_.push_back(r == 0 ? level : std::max(level, levels_.back()));
  }
}

SurfaceRows::Seen SurfaceRows::look(const Vector3d& place) const {
  const double level = direction_.dot(place);
  Seen seen;
  seen.across = std::max({0.0, levels_.front() - level, level - levels_.back()});
  const auto above = std::ranges::upper_bound(levels_, level) - levels_.begin();
  const auto row = std::size_t(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(levels_.size()) - 2));
  const double width = levels_[row + 1] - levels_[row];
  const double share = width > 0 ? std::clamp((level - levels_[row]) / width, 0.0, 1.0) : 0.0;
  const int last = cut_.columns - 1;
  const auto at = [&](int c) -> Vector3d {
    return (1 - share) * cut_.at(int(row), c) + share * cut_.at(int(row) + 1, c);
  };
  const auto inPlane = [&](const Vector3d& v) -> Vector3d { return v - v.dot(direction_) * direction_; };

  // The nearest of some columns, and beside it the nearest place on the chords between all of them.
  constexpr int kStride = 5;
  double nearest = 1e300, column = 0;
  int about = 0;
  for (int c = 0; c <= last; c = c < last ? std::min(c + kStride, last) : last + 1) {
    const double distance = inPlane(place - at(c)).squaredNorm();
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

}  // namespace bw::sweep
