// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "crossings.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace bw::pipeline {

namespace {

using Eigen::Array3i;
using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;
using Piece = std::pair<Vector3d, Vector3d>;

constexpr int kBins = 24;  ///< along each axis of the room that both have in common

Triangle cornersOf(const TriangleMesh& mesh, std::size_t i) {
  const std::array<int, 3>& t = mesh.triangles[i];
  return {mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])], mesh.points[std::size_t(t[2])]};
}

Bounds boundsOf(const Triangle& triangle) {
  Bounds bounds;
  for (const Vector3d& p : triangle) bounds.add(p);
  return bounds;
}

Bounds boundsOf(const TriangleMesh& mesh) {
  Bounds bounds;
  for (const Vector3d& p : mesh.points) bounds.add(p);
  return bounds;
}

Bounds common(const Bounds& a, const Bounds& b) { return {a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)}; }

/// Where the sides of a triangle pass through the plane of another; empty where they do not.
std::optional<Piece> through(const Triangle& triangle, const Triangle& plane) {
  const Vector3d normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
  std::array<double, 3> height;
  for (std::size_t k = 0; k < 3; ++k) height[k] = normal.dot(triangle[k] - plane[0]);
  std::vector<Vector3d> met;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    // A corner in the plane counts as above it, so that either two sides pass or none.
    if ((height[k] >= 0) == (height[next] >= 0)) continue;
    met.push_back(triangle[k] + height[k] / (height[k] - height[next]) * (triangle[next] - triangle[k]));
  }
  return met.size() == 2 ? std::optional(Piece{met[0], met[1]}) : std::nullopt;
}

/// What two triangles have in common: both pieces lie on the line of their planes.
std::optional<Piece> meeting(const Triangle& a, const Triangle& b) {
  const std::optional<Piece> ofA = through(a, b), ofB = through(b, a);
  if (!ofA || !ofB) return {};
  const Vector3d way = ofA->second - ofA->first;
  const double length = way.squaredNorm();
  if (!(length > 0)) return {};
  const auto at = [&](const Vector3d& p) { return way.dot(p - ofA->first) / length; };
  double from = at(ofB->first), to = at(ofB->second);
  if (from > to) std::swap(from, to);
  from = std::max(from, 0.0);
  to = std::min(to, 1.0);
  if (!(from < to)) return {};
  return Piece{ofA->first + from * way, ofA->first + to * way};
}

/// What of a piece lies in the box.
std::optional<Piece> within(const Piece& piece, const Box& box) {
  const Vector3d a = box.frame.toLocal(piece.first), way = box.frame.toLocal(piece.second) - a;
  double from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, box.size(axis)}) {
      const double beyond = side > 0 ? a(axis) - side : -a(axis);
      const double more = side > 0 ? way(axis) : -way(axis);
      if (more == 0) {
        if (beyond > 0) return {};
        continue;
      }
      (more > 0 ? to : from) = more > 0 ? std::min(to, -beyond / more) : std::max(from, -beyond / more);
    }
  if (!(from < to)) return {};
  const Vector3d along = piece.second - piece.first;
  return Piece{piece.first + from * along, piece.first + to * along};
}

}  // namespace

std::vector<std::vector<Vector3d>> crossings(const TriangleMesh& first, const TriangleMesh& second,
                                             const Box& box) {
  std::vector<std::vector<Vector3d>> lines;
  const Bounds room = common(boundsOf(first), boundsOf(second));
  if (!room.valid()) return lines;
  const Eigen::Array3d step = (room.size().array() / kBins).max(1e-9);
  const auto binOf = [&](const Vector3d& p) -> Array3i {
    return ((p - room.min).array() / step).cast<int>().max(0).min(kBins - 1);
  };
  const auto eachBin = [&](const Bounds& bounds, const auto& see) {
    const Array3i from = binOf(bounds.min), to = binOf(bounds.max);
    for (int z = from.z(); z <= to.z(); ++z)
      for (int y = from.y(); y <= to.y(); ++y)
        for (int x = from.x(); x <= to.x(); ++x) see(Array3i(x, y, z));
  };
  std::vector<std::vector<std::size_t>> bins(std::size_t(kBins) * kBins * kBins);
  const auto place = [](const Array3i& bin) {
    return (std::size_t(bin.z()) * kBins + std::size_t(bin.y())) * kBins + std::size_t(bin.x());
  };
  for (std::size_t i = 0; i < second.triangles.size(); ++i) {
    const Bounds bounds = common(boundsOf(cornersOf(second, i)), room);
    if (bounds.valid()) eachBin(bounds, [&](const Array3i& bin) { bins[place(bin)].push_back(i); });
  }
  for (std::size_t i = 0; i < first.triangles.size(); ++i) {
    const Triangle one = cornersOf(first, i);
    const Bounds bounds = common(boundsOf(one), room);
    if (!bounds.valid()) continue;
    eachBin(bounds, [&](const Array3i& bin) {
      for (const std::size_t k : bins[place(bin)]) {
        const Triangle other = cornersOf(second, k);
        const Bounds both = common(bounds, boundsOf(other));
        // Those that share several bins are looked at in the first of them.
        if (!both.valid() || (binOf(both.min) != bin).any()) continue;
        const std::optional<Piece> met = meeting(one, other);
        const std::optional<Piece> inside = met ? within(*met, box) : std::nullopt;
        if (inside) lines.push_back({inside->first, inside->second});
      }
    });
  }
  return lines;
}

}  // namespace bw::pipeline
