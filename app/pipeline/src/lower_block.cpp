// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/pipeline/lower_block.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "bw/core/sweep/lowest_place.h"

namespace bw::pipeline {

namespace {

using Eigen::Vector3d;

constexpr double kLargest = 1e6;   ///< mm, of a block
constexpr int kTrials = 4;         ///< of how much lower a way needs
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

/// What of a polygon has sign · p(axis) ≥ limit.
std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon, int axis, double sign, double limit) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = sign * a(axis) - limit, to = sign * b(axis) - limit;
    if (from >= 0) kept.push_back(a);
    if ((from >= 0) != (to >= 0)) kept.push_back(a + from / (from - to) * (b - a));
  }
  return kept;
}

/// Whether a blade is told to come below the floor beside the stations.
bool isOnTheWay(const Finding& finding) {
  return std::holds_alternative<NearBottom>(finding.cause) && finding.where.stations &&
         finding.where.stations->count == 0;
}

/// Whether two ways are one or meet: into the row, out of it, or between stations of both.
bool isBeside(const StationRange& a, const StationRange& b) {
  if (a.first < 0 || b.first < 0) return a.first < 0 && b.first < 0;
  if (a.last < 0 || b.last < 0) return a.last < 0 && b.last < 0;
  return a.first <= b.last && b.first <= a.last;
}

/// What is told of the ways of the cut's row where its block goes on below by so much: none without a way.
/// Errors: it is stopped.
Result<std::optional<Findings>> toldOfWays(const CutEvaluation& cut, double by, const RunContext& context) {
  if (context.stopped()) return stoppedError();
  Sweep row = *cut.sweep.value;
  row.block = deeper(row.block, by);
  const Result<EntryExit> ends = planEntryExit(row, cut.ends.request, context);
  if (context.stopped()) return stoppedError();
  if (!ends) return std::optional<Findings>();
  Findings told;
  if (!buildMotion(row, *ends, cut.way.value->targets, cut.motion.request, told))
    return std::optional<Findings>();
  return std::optional(std::move(told));
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
    std::vector<Vector3d> corners;
    for (const int corner : triangle)
      corners.push_back(lies.frame.toLocal(surface.points[std::size_t(corner)]));
    for (int axis = 0; axis < 2; ++axis)
      for (const auto& [sign, limit] : {std::pair{1.0, 0.0}, std::pair{-1.0, -lies.size(axis)}})
        corners = clipped(corners, axis, sign, limit);
    return std::ranges::any_of(corners, [](const Vector3d& p) { return p.z() < -kTouches; });
  });
}

Result<double> deeperForWays(const CutEvaluation& cut, const RunContext& context) {
  Findings told = cut.motion.findings;
  double by = 0;
  for (int trial = 0; trial <= kTrials; ++trial) {
    double missing = 0;
    for (const Finding& finding : told)
      if (isOnTheWay(finding)) {
        const auto& low = std::get<NearBottom>(finding.cause);
        missing = std::max(missing, low.floor - low.height);
      }
    if (missing <= 0) return by;
    by += std::ceil(missing);
    Result<std::optional<Findings>> ways = toldOfWays(cut, by, context);
    if (!ways) return tl::unexpected<Error>(ways.error());
    if (!*ways) break;
    told = std::move(**ways);
  }
  return 0;
}

Result<std::vector<LowerWay>> lowerForWays(const CutEvaluation& cut, const Findings& findings,
                                           const RunContext& context) {
  std::vector<LowerWay> lower;
  for (const Finding& finding : findings) {
    if (!isOnTheWay(finding)) continue;
    const auto& low = std::get<NearBottom>(finding.cause);
    const StationRange range = *finding.where.stations;
    double by = 0, height = low.height;
    for (int trial = 0; trial < kTrials; ++trial) {
      by += std::ceil(low.floor - height);
      const Result<std::optional<Findings>> ways = toldOfWays(cut, by, context);
      if (!ways) return tl::unexpected<Error>(ways.error());
      if (!*ways) break;
      const auto still = std::ranges::find_if(**ways, [&](const Finding& other) {
        return isOnTheWay(other) && isBeside(range, *other.where.stations);
      });
      if (still == (*ways)->end()) {
        lower.push_back({range, by});
        break;
      }
      height = std::get<NearBottom>(still->cause).height;
      if (height >= low.floor) break;  // it is told for another reason, which no block takes away
    }
  }
  return lower;
}

void adviseLowerBlock(Findings& findings, const CutEvaluation& cut, const Design& design) {
  const auto own = std::ranges::find(design.cuts, cut.id, &Cut::id);
  if (own == design.cuts.end() || !cut.targetMesh.value) return;
  const auto block = std::ranges::find(design.stock, own->block, &StockBlock::id);
  if (block == design.stock.end() || !block->placement) return;
  std::optional<bool> below;
  for (Finding& finding : findings) {
    NearBottom* low = std::get_if<NearBottom>(&finding.cause);
    if (!low || !finding.where.stations) continue;
    if (!below) below = goesOnBelow(*cut.targetMesh.value, lying(block->placement->box(), own->pose));
    if (*below) {
      low->lower = NearBottom::Lower::alsoCut;
      continue;
    }
    // The sections stay, and with them the blades at the stations.
    double by = std::ceil(low->floor - low->height);
    if (isOnTheWay(finding)) {
      if (!cut.lower.value) continue;
      const auto way = std::ranges::find(*cut.lower.value, *finding.where.stations, &LowerWay::stations);
      if (way == cut.lower.value->end()) continue;
      by = way->by;
    }
    low->lower = withLowerBlock(design, cut.id, by) ? NearBottom::Lower::keeps : NearBottom::Lower::noRoom;
    low->lowerBy = by;
  }
}

}  // namespace bw::pipeline
