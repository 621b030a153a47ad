// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/neighbours.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace bw {

namespace {

using Eigen::Vector3d;

constexpr double kInside = 3;    // mm from the face of a block: there a surface of its own surely is
constexpr double kSample = 5;    // mm between places at which two surfaces are held against each other
constexpr double kSteep = 0.01;  // squared sine of the angle to the boundary: less, and it is run along
constexpr double kShare = 0.5;   // of what one surface has at the boundary, at which they are to meet

/// True if more of the way than `kTouching` is in the box.
bool passes(const Vector3d& from, const Vector3d& to, const Box& box) {
  const Vector3d a = box.frame.toLocal(from), way = box.frame.toLocal(to) - a;
  double enters = 0, leaves = 1;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(way(k)) < 1e-9) {
      if (a(k) < 0 || a(k) > box.size(k)) return false;
      continue;
    }
    const double x = -a(k) / way(k), y = (box.size(k) - a(k)) / way(k);
    enters = std::max(enters, std::min(x, y));
    leaves = std::min(leaves, std::max(x, y));
  }
  return (leaves - enters) * way.norm() > kTouching;
}

/// What of a surface comes to the boundary: pieces of the line.
struct Piece {
  Vector3d from, to;
};

bool inside(const Box& box, const Vector3d& p, double slack) {
  const Vector3d local = box.frame.toLocal(p);
  return (local.array() >= -slack).all() && (local.array() <= box.size.array() + slack).all();
}

/// `side` 1: the boundary's normal points out of the block.
std::vector<Piece> piecesOf(const SurfaceInBlock& surface, const Box& other, const Boundary& boundary,
                            double side) {
  const double back = 0.5 * boundary.apart + kInside;  // mm from the boundary to where it is looked at
  const double slack = 0.5 * boundary.apart + kTouching;
  const TriangleMesh& mesh = surface.mesh;
  std::vector<double> away;  // mm past that place, towards the boundary
  away.reserve(mesh.points.size());
  for (const Vector3d& p : mesh.points) away.push_back(side * boundary.normal.dot(p - boundary.point) + back);
  std::vector<Piece> pieces;
  for (const std::array<int, 3>& corners : mesh.triangles) {
    std::vector<Vector3d> places;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = std::size_t(corners[k]), b = std::size_t(corners[(k + 1) % 3]);
      if ((away[a] < 0) == (away[b] < 0)) continue;
      places.push_back(mesh.points[a] + away[a] / (away[a] - away[b]) * (mesh.points[b] - mesh.points[a]));
    }
    if (places.size() != 2) continue;
    const Vector3d& corner = mesh.points[std::size_t(corners[0])];
    const Vector3d normal = (mesh.points[std::size_t(corners[1])] - corner)
                                .cross(mesh.points[std::size_t(corners[2])] - corner)
                                .stableNormalized();
    const Vector3d onward = boundary.normal - boundary.normal.dot(normal) * normal;
    if (onward.squaredNorm() < kSteep) continue;
    const Vector3d lead = side * back / onward.squaredNorm() * onward;
    const Piece piece{places[0] + lead, places[1] + lead};
    const Vector3d middle = 0.5 * (piece.from + piece.to);
    if (inside(surface.block, middle, slack) && inside(other, middle, slack)) pieces.push_back(piece);
  }
  return pieces;
}

/// How much of the pieces lies near to the others, as a share of their length; 0 where there are none.
double shareNear(const std::vector<Piece>& pieces, const std::vector<Piece>& others, double within) {
  const auto near = [&](const Vector3d& p) {
    return std::ranges::any_of(others, [&](const Piece& other) {
      const Vector3d way = other.to - other.from;
      const double length = way.squaredNorm();
      const double s = length > 0 ? std::clamp(way.dot(p - other.from) / length, 0.0, 1.0) : 0;
      return (p - other.from - s * way).squaredNorm() <= within * within;
    });
  };
  double all = 0, met = 0;
  for (const Piece& piece : pieces) {
    const double length = (piece.to - piece.from).norm();
    const int count = std::max(1, int(length / kSample));
    for (int k = 0; k < count; ++k) {
      all += length / count;
      if (near(piece.from + (k + 0.5) / count * (piece.to - piece.from))) met += length / count;
    }
  }
  return all > 0 ? met / all : 0;
}

}  // namespace

std::vector<Neighbours> neighboursAmong(const std::vector<BlockRow>& rows, const std::vector<Box>& blocks,
                                        double apart, const MayMeet& mayMeet) {
  std::vector<Neighbours> pairs;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      if (rows[i].block == rows[j].block || !mayMeet(i, j)) continue;
      const std::optional<Boundary> boundary = boundaryOf(blocks[i], blocks[j], apart);
      if (!boundary) continue;
      const Vector3d half = 0.5 * boundary->apart * boundary->normal;
      bool parted = false;
      for (std::size_t k = 0; k < rows.size() && boundary->apart > kTouching && !parted; ++k)
        parted = rows[k].block != rows[i].block && rows[k].block != rows[j].block && mayMeet(i, k) &&
                 mayMeet(k, j) && passes(boundary->point - half, boundary->point + half, blocks[k]);
      if (!parted) pairs.push_back({i, j, *boundary});
    }
  return pairs;
}

bool comeTogether(const SurfaceInBlock& first, const SurfaceInBlock& second, const Boundary& boundary,
                  double within) {
  const std::vector<Piece> a = piecesOf(first, second.block, boundary, 1);
  const std::vector<Piece> b = piecesOf(second, first.block, boundary, -1);
  return std::max(shareNear(a, b, within), shareNear(b, a, within)) >= kShare;
}

}  // namespace bw
