// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/mesh_lines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
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
  std::vector<EdgeKey> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges.push_back(edgeKey(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  Segments result;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t next = i + 1;
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    if (next == i + 1)
      result.emplace_back(points[std::size_t(edges[i] >> 32)], points[std::size_t(edges[i] & 0xFFFFFFFFu)]);
    i = next;
  }
  return result;
}

}  // namespace bw::scene
