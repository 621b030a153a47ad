// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/mesh_lines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace bw::scene {

namespace {

/// The two points of an edge, the lower index first.
using EdgeKey = std::uint64_t;
EdgeKey edgeKey(int low, int high) { return (EdgeKey(std::uint32_t(low)) << 32) | std::uint32_t(high); }

/// A piece of an isoline across one triangle, between two of its edges.
struct Piece {
  std::array<EdgeKey, 2> edges;
  std::array<Eigen::Vector3d, 2> ends;
};

/// Calls `take(index of the level, piece)` for every crossing, triangle by triangle. `levels` rise.
void forEachPiece(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::array<int, 3>>& triangles, const std::vector<double>& values,
                  const std::vector<double>& levels,
                  const std::function<void(std::size_t, const Piece&)>& take) {
  for (const auto& triangle : triangles) {
    const auto value = [&](std::size_t k) { return values[std::size_t(triangle[k])]; };
    if (!std::isfinite(value(0) + value(1) + value(2))) continue;
    const auto [low, high] = std::minmax({value(0), value(1), value(2)});
    for (auto level = std::lower_bound(levels.begin(), levels.end(), low);
         level != levels.end() && *level < high; ++level) {
      // A corner on the level counts as below it, so that neighbours agree on which edges are crossed.
      Piece piece;
      std::size_t found = 0;
      for (std::size_t k = 0; k < 3 && found < 2; ++k) {
        // From the lower to the higher point, so that neighbours agree on the place to the last bit.
        const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
        const double va = values[std::size_t(a)], vb = values[std::size_t(b)];
        if ((va > *level) == (vb > *level)) continue;
        const Eigen::Vector3d &p = points[std::size_t(a)], &q = points[std::size_t(b)];
        piece.edges[found] = edgeKey(a, b);
        piece.ends[found++] = p + (*level - va) / (vb - va) * (q - p);
      }
      if (found == 2) take(std::size_t(level - levels.begin()), piece);
    }
  }
}

std::vector<double> rising(std::vector<double> levels) {
  std::sort(levels.begin(), levels.end());
  return levels;
}

/// Follows the pieces of one level from triangle to triangle.
std::vector<Polyline> joined(const std::vector<Piece>& pieces) {
  std::unordered_map<EdgeKey, std::array<int, 2>> at;  // the two pieces that meet on an edge
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const EdgeKey edge : pieces[i].edges) {
      const auto [place, fresh] = at.try_emplace(edge, std::array<int, 2>{int(i), -1});
      if (!fresh) place->second[1] = int(i);
    }
  }
  std::vector<bool> used(pieces.size(), false);
  const auto follow = [&](std::size_t piece, std::size_t end, Polyline& line) {
    for (;;) {
      line.push_back(pieces[piece].ends[end]);
      const auto& both = at.at(pieces[piece].edges[end]);
      const int next = both[0] == int(piece) ? both[1] : both[0];
      if (next < 0 || used[std::size_t(next)]) return;
      used[std::size_t(next)] = true;
      end = pieces[std::size_t(next)].edges[0] == pieces[piece].edges[end] ? 1 : 0;
      piece = std::size_t(next);
    }
  };
  std::vector<Polyline> lines;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (used[i]) continue;
    used[i] = true;
    Polyline forth, back;
    follow(i, 1, forth);
    follow(i, 0, back);
    std::reverse(back.begin(), back.end());
    back.insert(back.end(), forth.begin(), forth.end());
    lines.push_back(std::move(back));
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Polyline& a, const Polyline& b) { return lengthOf(a) > lengthOf(b); });
  return lines;
}

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

Segments isolines(const std::vector<Eigen::Vector3d>& points,
                  const std::vector<std::array<int, 3>>& triangles, const std::vector<double>& values,
                  const std::vector<double>& levels) {
  Segments segments;
  forEachPiece(points, triangles, values, rising(levels),
               [&](std::size_t, const Piece& piece) { segments.emplace_back(piece.ends[0], piece.ends[1]); });
  return segments;
}

std::vector<Isoline> joinedIsolines(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<std::array<int, 3>>& triangles,
                                    const std::vector<double>& values, const std::vector<double>& levels) {
  const std::vector<double> sorted = rising(levels);
  std::vector<std::vector<Piece>> pieces(sorted.size());
  forEachPiece(points, triangles, values, sorted,
               [&](std::size_t level, const Piece& piece) { pieces[level].push_back(piece); });
  std::vector<Isoline> result;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (Polyline& line : joined(pieces[i])) result.push_back({sorted[i], std::move(line)});
  return result;
}

std::vector<Eigen::Vector3d> pointNormals(const std::vector<Eigen::Vector3d>& points,
                                          const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Eigen::Vector3d> normals(points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d& p = points[std::size_t(a)];
    const Eigen::Vector3d area = (points[std::size_t(b)] - p).cross(points[std::size_t(c)] - p);
    for (const int corner : {a, b, c}) normals[std::size_t(corner)] += area;
  }
  for (Eigen::Vector3d& n : normals) {
    const double length = n.norm();
    n = length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::UnitZ();
  }
  return normals;
}

Segments boundaryEdges(const std::vector<Eigen::Vector3d>& points,
                       const std::vector<std::array<int, 3>>& triangles) {
  // Of each point the higher ones that it shares edges with: a few, where all edges in order would be many.
  std::vector<std::size_t> begin(points.size() + 1, 0);
  const auto eachEdge = [&](const auto& see) {
    for (const auto& triangle : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
        see(std::size_t(a), b);
      }
  };
  eachEdge([&](std::size_t a, int) { ++begin[a + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> others(3 * triangles.size());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  eachEdge([&](std::size_t a, int b) { others[end[a]++] = b; });
  Segments result;
  for (std::size_t a = 0; a < points.size(); ++a) {
    const auto first = others.begin() + std::ptrdiff_t(begin[a]),
               last = others.begin() + std::ptrdiff_t(end[a]);
    std::sort(first, last);
    for (auto at = first; at != last;) {
      const auto next = std::find_if(at, last, [at](int b) { return b != *at; });
      if (next == at + 1) result.emplace_back(points[a], points[std::size_t(*at)]);
      at = next;
    }
  }
  return result;
}

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
