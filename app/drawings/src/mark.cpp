// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "mark.h"

#include <algorithm>
#include <cmath>

namespace bw::drawings {

namespace {

constexpr double kInset = 0.02, kAlong = 0.12;  ///< of the block's edges, where foam is looked for
constexpr double kMostLeg = 0.45;               ///< of the edge along which it lies

constexpr int kPoints = 4;  ///< how many

/// How many of kPoints points about a corner are foam.
int foamAt(const Mark& mark, const Eigen::Vector3d& size, const Solid& part) {
  int found = 0;
  for (int k = -1; k < kPoints - 1; ++k) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double in = (axis == k ? kAlong : kInset) * size[axis];
      p[axis] = mark.far[std::size_t(axis)] ? size[axis] - in : in;
    }
    found += part.contains(p) ? 1 : 0;
  }
  return found;
}

}  // namespace

Mark Mark::on(const Eigen::Vector3d& size, const Solid* part) {
  Mark best;
  int most = -1;
  for (const bool y : {false, true})
    for (const bool x : {true, false})
      for (const bool z : {true, false}) {
        Mark mark = {{x, y, z}};
        const int found = part ? foamAt(mark, size, *part) : kPoints;
        mark.stays = found == kPoints;
        if (found > most) {
          most = found;
          best = mark;
        }
      }
  return best;
}

std::string Mark::place() const {
  return std::string(far[1] ? "back" : "front") + ", " + (far[0] ? "right" : "left") + ", " +
         (far[2] ? "top" : "bottom");
}

std::array<Mark::Triangle, 3> Mark::triangles(const Eigen::Vector3d& size, double leg) const {
  Eigen::Vector3d corner, out;
  for (int k = 0; k < 3; ++k) {
    corner[k] = far[std::size_t(k)] ? size[k] : 0;
    out[k] = far[std::size_t(k)] ? 1 : -1;
  }
  std::array<Triangle, 3> found;
  for (int k = 0; k < 3; ++k) {
    Triangle& triangle = found[std::size_t(k)];
    triangle.corners.fill(corner);
    int at = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != k) {
        Eigen::Vector3d& p = triangle.corners[std::size_t(at++)];
        p[axis] -= out[axis] * std::min(leg, kMostLeg * size[axis]);
      }
    triangle.out = out[k] * Eigen::Vector3d::Unit(k);
    triangle.filled = k == 1;
  }
  return found;
}

void drawMark(PdfPages& pages, const std::array<Mark::Triangle, 3>& triangles, const Eigen::Vector3d& toward,
              bool all, const std::function<Point(const Eigen::Vector3d&)>& place) {
  constexpr double kEdgeOn = 0.05;
  const auto facing = [&](const Mark::Triangle& t) { return t.out.dot(toward) > kEdgeOn; };
  const bool none = std::ranges::none_of(triangles, facing);
  for (const bool front : {false, true})  // what is seen lies over the rest
    for (const Mark::Triangle& triangle : triangles) {
      if (facing(triangle) != front || std::abs(triangle.out.dot(toward)) <= kEdgeOn) continue;
      if (!front && !none && !all) continue;
      std::vector<Point> points;
      for (const Eigen::Vector3d& corner : triangle.corners) points.push_back(place(corner));
      if (front) pages.fill(points, triangle.filled ? 0.0 : 1.0);
      pages.line(points, front ? Pen{0.5, 0, {}} : Pen{0.35, 0.35, {2, 2}}, true);
    }
}

}  // namespace bw::drawings
