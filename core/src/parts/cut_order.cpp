// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/parts/cut_order.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "bw/core/base/box_distance.h"
#include "bw/core/surface/refine.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

using Eigen::Vector3d;

/// The mean normal of a surface must lie along the kept way by this share of its length.
constexpr double kLeastLean = 0.05;
/// mm: heights that differ by less are those of one height, whatever was rounded.
constexpr double kSameHeight = 0.01;
/// Points of a surface lie closer together than this part of the diagonal of a block.
constexpr double kSamples = 60;

/// What of a triangle, given in the coordinates of a box, lies in that along its first `axes` of three; empty
/// where nothing does.
std::vector<Vector3d> partInBox(const std::array<Vector3d, 3>& triangle, const Vector3d& size, int axes) {
  std::vector<Vector3d> part(triangle.begin(), triangle.end()), rest;
  for (int axis = 0; axis < axes; ++axis)
    for (const bool upper : {false, true}) {
      const auto inside = [&](const Vector3d& p) { return upper ? size(axis) - p(axis) : p(axis); };
      rest.clear();
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Vector3d &p = part[i], &q = part[(i + 1) % part.size()];
        const double a = inside(p), b = inside(q);
        if (a >= 0) rest.push_back(p);
        if ((a < 0) != (b < 0)) rest.push_back(p + a / (a - b) * (q - p));
      }
      part.swap(rest);
      if (part.size() < 3) return {};
    }
  return part;
}

/// Calls `take` with what of each triangle lies in a box along its first `axes`, in its coordinates.
template <class Take>
void eachPart(const TriangleMesh& mesh, const Box& box, int axes, const Take& take) {
  std::vector<Vector3d> points;
  points.reserve(mesh.points.size());
  for (const Vector3d& p : mesh.points) points.push_back(box.frame.toLocal(p));
  for (const auto& corners : mesh.triangles) {
    const std::array<Vector3d, 3> triangle = {
        points[std::size_t(corners[0])], points[std::size_t(corners[1])], points[std::size_t(corners[2])]};
    const Eigen::Array3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]).array(),
                         high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]).array();
    if ((high.head(axes) < 0).any() || (low.head(axes) > box.size.head(axes).array()).any()) continue;
    if (const std::vector<Vector3d> part = partInBox(triangle, box.size, axes); !part.empty()) take(part);
  }
}

/// Calls `take` with the area and the mean height of each triangle of a convex polygon.
template <class Take>
void eachPiece(const std::vector<Vector3d>& part, const Take& take) {
  for (std::size_t i = 1; i + 1 < part.size(); ++i)
    take(0.5 * Vector3d(part[i] - part[0]).cross(Vector3d(part[i + 1] - part[0])).norm(),
         (part[0].z() + part[i].z() + part[i + 1].z()) / 3);
}

}  // namespace

AreaInBox areaInBox(const TriangleMesh& mesh, const Box& box) {
  AreaInBox in;
  double moment = 0;
  eachPart(mesh, box, 3, [&](const std::vector<Vector3d>& part) {
    eachPiece(part, [&](double area, double height) {
      in.area += area;
      moment += area * height;
    });
  });
  if (in.area > 0) in.height = moment / in.area;
  return in;
}

AreaOutside areaOutside(const TriangleMesh& mesh, const std::vector<Box>& boxes, Outside where) {
  AreaOutside outside;
  const auto look = [&](const Vector3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box& box : boxes) nearest = std::min(nearest, boxDistance(box, p));
    if (!(nearest > outside.distance) || std::isinf(nearest)) return;
    outside.distance = nearest;
    outside.point = p;
  };
  for (const auto& [a, b, c] : mesh.triangles)
    eachPiece({mesh.points[std::size_t(a)], mesh.points[std::size_t(b)], mesh.points[std::size_t(c)]},
              [&](double area, double) { outside.all += area; });
  double looked = where == Outside::anywhere ? outside.all : 0, inside = 0;
  for (const Box& box : boxes) {
    inside += areaInBox(mesh, box).area;
    if (where == Outside::overOrUnder)
      eachPart(mesh, box, 2, [&](const std::vector<Vector3d>& part) {
        eachPiece(part, [&](double area, double) { looked += area; });
        for (const Vector3d& p : part)
          look(box.frame.origin + p.x() * box.frame.x + p.y() * box.frame.y + p.z() * box.frame.normal);
      });
  }
  if (where == Outside::anywhere)
    for (const Vector3d& p : mesh.points) look(p);
  outside.area = std::max(0.0, looked - inside);
  return outside;
}

std::vector<std::size_t> orderOf(const std::vector<CutTurn>& turns) {
  std::vector<std::size_t> order(turns.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const CutTurn &first = turns[a], &second = turns[b];
    if (first.told || second.told) return first.told && (!second.told || *first.told < *second.told);
    return std::llround(first.height / kSameHeight) < std::llround(second.height / kSameHeight);
  });
  return order;
}

Result<int> sideKept(const TriangleMesh& mesh, SurfaceSampler& surface, const Vector3d& kept) {
  // Of the triangles, turned as the surface is.
  Vector3d mean = Vector3d::Zero();
  double area = 0, agrees = 0;
  for (const auto& corners : mesh.triangles) {
    const Vector3d &a = mesh.points[std::size_t(corners[0])], &b = mesh.points[std::size_t(corners[1])],
                   &c = mesh.points[std::size_t(corners[2])];
    const Vector3d twice = Vector3d(b - a).cross(Vector3d(c - a));
    mean += twice;
    area += twice.norm();
  }
  // Which way they are turned is asked at some of them.
  constexpr std::size_t kAsked = 9;
  SurfaceSampler::Foot foot;
  for (std::size_t k = 0; k < kAsked && !mesh.triangles.empty(); ++k) {
    const auto& corners = mesh.triangles[k * (mesh.triangles.size() - 1) / (kAsked - 1)];
    const Vector3d &a = mesh.points[std::size_t(corners[0])], &b = mesh.points[std::size_t(corners[1])],
                   &c = mesh.points[std::size_t(corners[2])];
    const Result<SurfaceSampler::Foot> found = surface.closest((a + b + c) / 3, k > 0 ? &foot : nullptr);
    if (!found) return tl::unexpected<Error>(found.error());
    foot = *found;
    agrees += Vector3d(b - a).cross(Vector3d(c - a)).normalized().dot(foot.normal);
  }
  const double lean = area > 0 ? mean.dot(kept) / area : 0;
  if (std::abs(lean) < kLeastLean)
    return fail(ErrorCode::badInput,
                "the surface stands upright on the whole, so that no foam lies on the side that is to stay "
                "(its mean normal leans that way by " +
                    shortText(std::round(1e3 * std::abs(lean)) / 1e3) + ", at least " +
                    shortText(kLeastLean) +
                    " is needed); tell the side by keep: below, above, left, right, front or back",
                "keep", std::abs(lean), kLeastLean);
  return (lean > 0) == (agrees > 0) ? 1 : -1;
}

Result<double> depthIn(const std::vector<PartedBy>& cuts, const Vector3d& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (const PartedBy& cut : cuts) {
    const Result<SurfaceSampler::Foot> foot = cut.surface->closest(p, nullptr);
    if (!foot) return tl::unexpected<Error>(foot.error());
    depth = std::min(depth, cut.side * cut.surface->offset(p, *foot));
  }
  return depth;
}

Result<double> meets(const TriangleMesh& mesh, const Box& box, const std::vector<PartedBy>& before,
                     const RunContext& context) {
  double most = 0;
  for (const Vector3d& p : refined(mesh, box, box.size.norm() / kSamples).points) {
    if (context.stopped()) return stoppedError();
    const Vector3d local = box.frame.toLocal(p);
    if ((local.array() < 0).any() || (local.array() > box.size.array()).any()) continue;
    const Result<double> depth = depthIn(before, p);
    if (!depth) return depth;
    most = std::max(most, *depth);
  }
  return most;
}

namespace {

/// The part of the ray from `p` along `way` that lies in a box, mm; its end is less than its start where none
/// does.
std::array<double, 2> rayInBox(const Box& box, const Vector3d& p, const Vector3d& way) {
  const Vector3d from = box.frame.toLocal(p);
  const Vector3d along(way.dot(box.frame.x), way.dot(box.frame.y), way.dot(box.frame.normal));
  std::array<double, 2> part = {0, box.size.norm() + from.norm()};
  for (int axis = 0; axis < 3; ++axis) {
    if (along(axis) == 0) {
      if (from(axis) < 0 || from(axis) > box.size(axis)) part[1] = -1;
      continue;
    }
    const double a = -from(axis) / along(axis), b = (box.size(axis) - from(axis)) / along(axis);
    part = {std::max(part[0], std::min(a, b)), std::min(part[1], std::max(a, b))};
  }
  return part;
}

}  // namespace

Result<double> takes(const TakingCut& cut, const Box& box, const std::vector<PartedBy>& before, double enough,
                     const RunContext& context) {
  const Result<double> met = meets(*cut.mesh, box, before, context);
  if (!met || *met >= enough) return met;
  double most = *met;
  const Vector3d way = -cut.kept.normalized();
  for (const Vector3d& p : refined(*cut.mesh, box, box.size.norm() / kSamples).points) {
    if (context.stopped()) return stoppedError();
    // What is left lies no nearer than its depth tells.
    const auto [from, to] = rayInBox(box, p, way);
    for (double t = from; t <= to;) {
      const Vector3d q = p + t * way;
      const Result<double> depth = depthIn(before, q);
      if (!depth) return depth;
      if (*depth >= 0) {
        const Result<double> taken = depthIn({{cut.surface.surface, -cut.surface.side}}, q);
        if (!taken || *taken >= enough) return taken;
        most = std::max(most, *taken);
      }
      t += std::max(std::abs(*depth), 0.5 * enough);
    }
  }
  return most;
}

}  // namespace bw
