// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/split_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/grid_change.h"

namespace bw::app {

namespace {

constexpr int kMostParts = 4;
constexpr double kNarrowest = 100;  // mm of a part along the blade
constexpr double kStep = 5;         // mm: places are told no finer
constexpr double kReserve = 1.1;    // of the limit: rows of narrower blocks move a little otherwise
constexpr double kAcross = 0.9;     // cosine between the blade and the edge of the block that is split

/// A point of a blade: how far along the edge it lies, and how fast it is.
struct Fast {
  double at = 0, speed = 0;
};
using Station = std::vector<Fast>;

/// Whether the slowest point keeps the limit between any two of the places, at every station.
bool keeps(const std::vector<Station>& stations, const std::vector<double>& places) {
  for (const Station& station : stations)
    for (std::size_t part = 0; part + 1 < places.size(); ++part) {
      double least = std::numeric_limits<double>::infinity(), most = 0;
      for (const Fast& point : station) {
        if (point.at < places[part] || point.at > places[part + 1]) continue;
        least = std::min(least, point.speed);
        most = std::max(most, point.speed);
      }
      if (most > 0 && least < kReserve * kSpeedRatioLimit * most) return false;
    }
  return true;
}

/// Where the speeds of a station, from its slower end to its faster one, come to equal ratios.
std::vector<double> byRatio(const Station& station, int parts, double extent) {
  std::vector<double> places = {0};
  Station points = station;
  std::ranges::sort(points, {}, &Fast::at);
  const bool rises = points.front().speed < points.back().speed;
  const auto [slow, fast] = std::ranges::minmax(points, {}, &Fast::speed);
  for (int part = 1; part < parts; ++part) {
    const double share = double(rises ? part : parts - part) / parts;
    const double speed = slow.speed * std::pow(fast.speed / slow.speed, share);
    const auto beyond = std::ranges::find_if(
        points, [&](const Fast& point) { return rises ? point.speed >= speed : point.speed <= speed; });
    if (beyond == points.end()) return {};
    places.push_back(std::round(beyond->at / kStep) * kStep);
  }
  places.push_back(extent);
  return places;
}

std::vector<double> even(int parts, double extent) {
  std::vector<double> places;
  for (int part = 0; part <= parts; ++part) places.push_back(extent * part / parts);
  return places;
}

bool wideEnough(const std::vector<double>& places) {
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    if (places[i + 1] - places[i] < kNarrowest) return false;
  return places.size() > 1;
}

/// Which of the columns, rows or layers a block is in.
std::optional<std::size_t> placeIn(const BlockGrid& grid, std::size_t way, const Box& box) {
  const double from = (box.frame.origin - grid.origin).dot(rotationFromAngles(grid.rotation).col(int(way)));
  double at = 0;
  for (std::size_t i = 0; i < grid.sizes[way].size(); ++i) {
    if (std::abs(from - at) < 0.5 * grid.sizes[way][i]) return i;
    at += grid.sizes[way][i] + (i < grid.gaps[way].size() ? grid.gaps[way][i] : 0);
  }
  return {};
}

/// The cuts of a block, without what tells them from those of others.
std::vector<Cut> cutsOf(const Design& design, const std::string& block) {
  std::vector<Cut> cuts;
  for (Cut cut : design.cuts) {
    if (cut.block != block) continue;
    cut.id.clear();
    cut.block.clear();
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

}  // namespace

std::optional<BlockGrid> splitForSpeed(const BlockGrid& grid, const std::string& block, const Sweep& row,
                                       const SweepCheck& check) {
  const std::vector<BlockGrid::Cell> cells = grid.cells();
  const auto cell = cells.size() == 1 ? cells.begin() : std::ranges::find(cells, block, &BlockGrid::Cell::id);
  if (cell == cells.end() || row.poses.empty() || check.velocities.size() != row.poses.size()) return {};
  const Box box = cell->placement.box();
  const std::array<Eigen::Vector3d, 3> axes = {box.frame.x, box.frame.y, box.frame.normal};
  const auto along = [&](std::size_t way) { return std::abs(axes[way].dot(row.planes.frame.x)); };
  std::size_t way = 0;
  for (std::size_t other = 1; other < 3; ++other)
    if (along(other) > along(way)) way = other;
  const std::optional<std::size_t> place = placeIn(grid, way, box);
  if (along(way) < kAcross || !place) return {};
  std::vector<Station> stations;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const std::vector<double>& speeds = check.velocities[i].relative;
    if (speeds.size() < 2) return {};
    const std::vector<Eigen::Vector3d> points = row.poses[i].cutPoints(int(speeds.size()));
    Station& station = stations.emplace_back();
    for (std::size_t k = 0; k < speeds.size(); ++k)
      station.push_back({axes[way].dot(points[k] - box.frame.origin), speeds[k]});
    if (check.stations[i].speedRatio < check.stations[worst].speedRatio) worst = i;
  }
  const double extent = grid.sizes[way][*place];
  for (int parts = 2; parts <= kMostParts; ++parts)
    for (const std::vector<double>& places : {even(parts, extent), byRatio(stations[worst], parts, extent)}) {
      if (!wideEnough(places) || !keeps(stations, places)) continue;
      BlockGrid split = grid;
      std::vector<double>&sizes = split.sizes[way], &gaps = split.gaps[way];
      const auto at = std::ptrdiff_t(*place);
      sizes.erase(sizes.begin() + at);
      for (int part = parts; part > 0; --part)
        sizes.insert(sizes.begin() + at, places[std::size_t(part)] - places[std::size_t(part) - 1]);
      gaps.insert(gaps.begin() + at, std::size_t(parts) - 1, 0.0);
      return split;
    }
  return {};
}

std::size_t partsOf(const BlockGrid& before, const BlockGrid& split) {
  std::size_t more = 0;
  for (std::size_t way = 0; way < 3; ++way) more += split.sizes[way].size() - before.sizes[way].size();
  return more + 1;
}

std::optional<Design> withSplit(const Design& design, const BlockGrid& before, const BlockGrid& split,
                                const std::string& block) {
  // Blocks are called by their place, and cuts go with the name.
  const std::vector<Cut> own = cutsOf(design, block);
  for (const StockBlock& other : design.stock)
    if (cutsOf(design, other.id) != own) return {};
  Result<Design> changed = withGrid(design, before, split, block);
  if (!changed) return {};
  // What blocks are cut of stays as it is, and so do its expressions.
  changed->sources = design.sources;
  changed = resolved(*changed);
  return changed ? std::optional(std::move(*changed)) : std::nullopt;
}

}  // namespace bw::app
