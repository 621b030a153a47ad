// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/section_cap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "scene/actors/mesh_lines.h"

namespace bw::scene {

namespace {

using Point = Eigen::Vector2d;
using Edge = std::pair<Point, Point>;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where a + t (b − a) crosses an edge, t in (0, 1).
std::optional<double> crossing(const Point& a, const Point& b, const Edge& edge) {
  const Point along = b - a, across = edge.second - edge.first;
  const double area = cross(along, across);
  if (area == 0) return std::nullopt;
  const double t = cross(edge.first - a, across) / area, u = cross(edge.first - a, along) / area;
  return t > 0 && t < 1 && u >= 0 && u < 1 ? std::optional(t) : std::nullopt;
}

/// The plane with axes of its own, upright where the plane is: hatching looks the same in all sections of a
/// block.
Frame frameOf(const SectionPlane& plane) {
  const Eigen::Vector3d normal = plane.normal.normalized();
  const Eigen::Vector3d up =
      std::abs(normal.z()) < 0.99 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = up.cross(normal).normalized();
  return {plane.point, x, normal.cross(x), normal};
}

std::vector<Point> outlineOf(const Box& block, const SectionPlane& plane, const Frame& chart) {
  std::vector<Point> points;
  for (const auto& [from, to] : edgesOf(block)) {
    const double before = (from - plane.point).dot(plane.normal),
                 after = (to - plane.point).dot(plane.normal);
    if ((before < 0) == (after < 0)) continue;
    points.push_back(chart.toLocal(from + before / (before - after) * (to - from)).head<2>());
  }
  if (points.size() < 3) return {};
  Point center = Point::Zero();
  for (const Point& p : points) center += p / double(points.size());
  std::sort(points.begin(), points.end(), [&](const Point& a, const Point& b) {
    return std::atan2(a.y() - center.y(), a.x() - center.x()) <
           std::atan2(b.y() - center.y(), b.x() - center.x());
  });
  return points;
}

/// Lets the loose ends of a line run on a little, so that it parts the foam even where it stops at the face.
void extendEnds(std::vector<Edge>& edges, double reach) {
  const double same = 1e-6 * reach;
  std::vector<Edge> more;
  for (const Edge& edge : edges) {
    for (const auto& [end, other] :
         {std::pair(edge.first, edge.second), std::pair(edge.second, edge.first)}) {
      const Point tip = end;
      const auto touches = std::count_if(edges.begin(), edges.end(), [&](const Edge& e) {
        return (e.first - tip).norm() <= same || (e.second - tip).norm() <= same;
      });
      const Point way = end - other;
      if (touches == 1 && way.norm() > 0) more.emplace_back(end, end + reach * way.normalized());
    }
  }
  edges.insert(edges.end(), more.begin(), more.end());
}

}  // namespace

SectionCap sectionCap(const Box& block, const TriangleMesh& cut, const SectionPlane& plane, double spacing) {
  SectionCap cap;
  if (!plane.point.allFinite() || !plane.normal.allFinite() || !(plane.normal.norm() > 0)) return cap;
  const Frame chart = frameOf(plane);
  std::vector<double> heights;
  heights.reserve(cut.points.size());
  for (const Eigen::Vector3d& p : cut.points)
    heights.push_back((p - plane.point).dot(plane.normal.normalized()));
  cap.cut = isolines(cut.points, cut.triangles, heights, {0.0});

  const std::vector<Point> outline = outlineOf(block, plane, chart);
  if (outline.empty()) return cap;
  for (const Point& p : outline) cap.outline.push_back(chart.toWorld(p));
  double diagonal = 0;
  for (const Point& p : outline) diagonal = std::max(diagonal, (p - outline.front()).norm());
  std::vector<Edge> edges;
  for (const auto& [a, b] : cap.cut) {
    const Edge edge(chart.toLocal(a).head<2>(), chart.toLocal(b).head<2>());
    if ((edge.first - edge.second).norm() > 0) edges.push_back(edge);
  }
  extendEnds(edges, 0.01 * diagonal);

  // A point lies on the same side as the anchor if the way there crosses the cut an even number of times.
  const Point anchor =
      outline.front() + 0.02 * diagonal * (outline.front() - outline[outline.size() / 2]).normalized();
  const auto sideOf = [&](const Point& p) {
    return std::count_if(edges.begin(), edges.end(),
                         [&](const Edge& e) { return crossing(p, anchor, e).has_value(); }) %
           2;
  };
  spacing = std::max(spacing, diagonal / 500);
  const Point middle = 0.5 * (outline.front() + outline[outline.size() / 2]);
  const double half = std::sqrt(0.5);
  for (const int side : {0, 1}) {
    const Point along(half, side == 0 ? half : -half), across(-along.y(), along.x());
    double low = 1e300, high = -1e300;
    for (const Point& p : outline) {
      low = std::min(low, p.dot(across));
      high = std::max(high, p.dot(across));
    }
    // The same lines whatever part of the plane is seen: at whole multiples of the spacing.
    for (double k = std::ceil(low / spacing); k * spacing < high; ++k) {
      const Point a = k * spacing * across + (middle.dot(along) - 2 * diagonal) * along,
                  b = a + 4 * diagonal * along;
      std::vector<double> ends;
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (const auto t = crossing(a, b, {outline[i], outline[(i + 1) % outline.size()]}))
          ends.push_back(*t);
      if (ends.size() < 2) continue;
      const auto [first, last] = std::minmax_element(ends.begin(), ends.end());
      std::vector<double> stops = {*first, *last};
      for (const Edge& edge : edges)
        if (const auto t = crossing(a, b, edge); t && *t > *first && *t < *last) stops.push_back(*t);
      std::sort(stops.begin(), stops.end());
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const Point p = a + stops[i] * (b - a), q = a + stops[i + 1] * (b - a);
        if ((q - p).norm() < 1e-6 * diagonal || sideOf(0.5 * (p + q)) != side) continue;
        cap.hatch.emplace_back(chart.toWorld(p), chart.toWorld(q));
      }
    }
  }
  return cap;
}

}  // namespace bw::scene
