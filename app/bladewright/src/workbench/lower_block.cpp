// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/lower_block.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <vector>

namespace bw::app {

namespace {

using Eigen::Vector3d;

constexpr double kLargest = 1e6;   ///< mm, of a block
constexpr double kTouches = 1e-6;  ///< mm by which blocks that stand beside each other may overlap

std::array<Vector3d, 3> axesOf(const Box& box) { return {box.frame.x, box.frame.y, box.frame.normal}; }

/// Whether two boxes have more than their faces in common: no plane parts them.
bool overlap(const Box& a, const Box& b) {
  std::vector<Vector3d> ways;
  for (const Vector3d& one : axesOf(a)) {
    ways.push_back(one);
    for (const Vector3d& other : axesOf(b)) ways.push_back(one.cross(other));
  }
  for (const Vector3d& other : axesOf(b)) ways.push_back(other);
  const auto apart = [&](const Vector3d& way) {
    const double length = way.norm();
    if (length < 1e-9) return false;
    double reach = 0;
    for (const Box* box : {&a, &b})
      for (int axis = 0; axis < 3; ++axis)
        reach += 0.5 * box->size(axis) * std::abs(axesOf(*box)[std::size_t(axis)].dot(way));
    return std::abs((a.center() - b.center()).dot(way)) > reach - kTouches * length;
  };
  return std::ranges::none_of(ways, apart);
}

/// The placed block higher by so much, at its face with that outward normal.
BlockPlacement grown(const BlockPlacement& placed, const Vector3d& outward, double by) {
  BlockPlacement next = placed;
  const std::array<Vector3d, 3> axes = axesOf(placed.box());
  for (int axis = 0; axis < 3; ++axis) {
    const double along = outward.dot(axes[std::size_t(axis)]);
    if (std::abs(along) < 0.5) continue;
    next.size(axis) += by;
    if (along < 0) next.origin -= by * axes[std::size_t(axis)];
  }
  return next;
}

}  // namespace

std::optional<Design> withLowerBlock(const Design& design, const std::string& cut, double by) {
  const auto own = std::ranges::find(design.cuts, cut, &Cut::id);
  if (own == design.cuts.end() || !(by > 0)) return {};
  const auto block = std::ranges::find(design.stock, own->block, &StockBlock::id);
  if (block == design.stock.end() || !block->placement) return {};
  const Box placed = block->placement->box(), lies = lying(placed, own->pose);
  const Vector3d down = -lies.frame.normal;
  Design lower = design;
  if (design.grid) {
    if (own->pose.up != BlockFace::top) return {};
    BlockGrid grid = *design.grid;
    // Its first layer is the lowest.
    if ((placed.frame.origin - grid.origin).dot(placed.frame.normal) > kTouches) return {};
    grid.sizes[2].front() += by;
    grid.origin += by * down;
    lower.stock = stockOf(grid);
    if (lower.stock.size() != design.stock.size()) return {};
    lower.grid = std::move(grid);
  } else {
    Box added = lies;
    added.size.z() = by;
    added.frame.origin += by * down;
    for (const StockBlock& other : design.stock)
      if (other.id != block->id && other.placement && overlap(added, other.placement->box())) return {};
    lower.stock[std::size_t(block - design.stock.begin())].placement = grown(*block->placement, down, by);
  }
  for (const StockBlock& one : lower.stock)
    if (one.placement && one.placement->size.maxCoeff() > kLargest) return {};
  return lower;
}

bool goesOnBelow(const TriangleMesh& surface, const Box& lies) {
  return std::ranges::any_of(surface.triangles, [&](const std::array<int, 3>& triangle) {
    Bounds seen;
    for (const int corner : triangle) seen.add(lies.frame.toLocal(surface.points[std::size_t(corner)]));
    return seen.min.z() < -kTouches && (seen.min.head<2>().array() < lies.size.head<2>().array()).all() &&
           (seen.max.head<2>().array() > 0).all();
  });
}

}  // namespace bw::app
