// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/pipeline/split_block.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/grid_change.h"

namespace bw::pipeline {

namespace {

constexpr double kPlaceStep = 5;     // mm: places are told no finer
constexpr double kAcrossEdge = 0.9;  // cosine between the blade and the edge of the block that is split

/// A point of a blade: how far along the edge it lies, and how fast it is.
struct PointSpeed {
  double at = 0, speed = 0;
};
using StationSpeeds = std::vector<PointSpeed>;

/// Whether the slowest point keeps the limit between any two of the places, at every station.
bool keepSpeeds(const std::vector<StationSpeeds>& stations, const std::vector<double>& places) {
  for (const StationSpeeds& station : stations)
    for (std::size_t part = 0; part + 1 < places.size(); ++part) {
      double least = std::numeric_limits<double>::infinity(), most = 0;
      for (const PointSpeed& point : station) {
        if (point.at < places[part] || point.at > places[part + 1]) continue;
        least = std::min(least, point.speed);
        most = std::max(most, point.speed);
      }
      if (most > 0 && least < kSpeedRatioLimit * most) return false;
    }
  return true;
}

/// Where the speeds of a station, from its slower end to its faster one, come to equal ratios; a part that
/// would be too narrow is as wide as it must be, and those after it share what is left.
std::vector<double> placesByRatio(StationSpeeds points, int parts, double extent) {
  std::ranges::sort(points, {}, &PointSpeed::at);
  const bool rises = points.front().speed < points.back().speed;
  if (!rises) {
    std::ranges::reverse(points);
    for (PointSpeed& point : points) point.at = extent - point.at;
  }
  const double fastest = std::ranges::max(points, {}, &PointSpeed::speed).speed;
  double slow = std::ranges::min(points, {}, &PointSpeed::speed).speed;
  std::vector<double> places = {0};
  for (int left = parts; left > 1; --left) {
    const double speed = slow * std::pow(fastest / slow, 1.0 / left);
    const auto beyond = [&](auto&& is) { return std::ranges::find_if(points, is); };
    const auto met = beyond([&](const PointSpeed& point) { return point.speed >= speed; });
    if (met == points.end()) return {};
    double at = std::round(met->at / kPlaceStep) * kPlaceStep;
    at = std::max(at, places.back() + BlockSplit::kNarrowest);
    places.push_back(at);
    const auto next = beyond([&](const PointSpeed& point) { return point.at >= at; });
    if (next == points.end()) return {};
    slow = next->speed;
  }
  places.push_back(extent);
  if (!rises) {
    std::ranges::reverse(places);
    for (double& place : places) place = extent - place;
  }
  return places;
}

std::vector<double> evenPlaces(int parts, double extent) {
  std::vector<double> places;
  for (int part = 0; part <= parts; ++part) places.push_back(extent * part / parts);
  return places;
}

bool wideEnough(const std::vector<double>& places) {
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    if (places[i + 1] - places[i] < BlockSplit::kNarrowest) return false;
  return places.size() > 1;
}

/// Which of the columns, rows or layers a block is in.
std::optional<std::size_t> placeAlong(const BlockGrid& grid, std::size_t way, const Box& box) {
  const double from = (box.frame.origin - grid.origin).dot(rotationFromAngles(grid.rotation).col(int(way)));
  double at = 0;
  for (std::size_t i = 0; i < grid.sizes[way].size(); ++i) {
    if (std::abs(from - at) < 0.5 * grid.sizes[way][i]) return i;
    at += grid.sizes[way][i] + (i < grid.gaps[way].size() ? grid.gaps[way][i] : 0);
  }
  return {};
}

/// The cuts of a block, without what tells them from those of others.
std::vector<Cut> cutsAlike(const Design& design, const std::string& block) {
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

namespace {

/// Blocks keep their names where others come before them; the one that is split has none any more.
std::map<std::string, std::string> namesAfter(const BlockGrid& before, const BlockSplit& split) {
  std::map<std::string, std::string> names;
  std::array<std::size_t, 3> at;
  for (at[2] = 0; at[2] < before.sizes[2].size(); ++at[2])
    for (at[1] = 0; at[1] < before.sizes[1].size(); ++at[1])
      for (at[0] = 0; at[0] < before.sizes[0].size(); ++at[0]) {
        const auto named = before.names.find(before.placeName(at));
        if (named == before.names.end() || at[split.way] == split.place) continue;
        std::array<std::size_t, 3> next = at;
        if (next[split.way] > split.place) next[split.way] += split.parts() - 1;
        names[split.grid.placeName(next)] = named->second;
      }
  return names;
}

}  // namespace

std::optional<std::size_t> BlockSplit::partOf(const BlockPlacement& block) const {
  const std::optional<std::size_t> at = placeAlong(grid, way, block.box());
  if (!at || *at < place || *at >= place + parts()) return {};
  return *at - place;
}

std::vector<BlockSplit> splitsForSpeed(const BlockGrid& grid, const std::string& block, const Sweep& row,
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
  const std::optional<std::size_t> place = placeAlong(grid, way, box);
  if (along(way) < kAcrossEdge || !place) return {};
  std::vector<StationSpeeds> stations;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < row.poses.size(); ++i) {
    const std::vector<double>& speeds = check.velocities[i].relative;
    if (speeds.size() < 2) return {};
    const std::vector<Eigen::Vector3d> points = row.poses[i].cutPoints(int(speeds.size()));
    StationSpeeds& station = stations.emplace_back();
    for (std::size_t k = 0; k < speeds.size(); ++k)
      station.push_back({axes[way].dot(points[k] - box.frame.origin), speeds[k]});
    if (check.stations[i].speedRatio < check.stations[worst].speedRatio) worst = i;
  }
  const double extent = grid.sizes[way][*place];
  std::vector<BlockSplit> splits;
  for (int parts = 2; parts <= BlockSplit::kMostParts; ++parts)
    for (const std::vector<double>& places :
         {evenPlaces(parts, extent), placesByRatio(stations[worst], parts, extent)}) {
      if (!wideEnough(places) || !keepSpeeds(stations, places)) continue;
      BlockSplit& split = splits.emplace_back(BlockSplit{grid, way, *place, places});
      std::vector<double>&sizes = split.grid.sizes[way], &gaps = split.grid.gaps[way];
      const auto at = std::ptrdiff_t(*place);
      sizes.erase(sizes.begin() + at);
      for (int part = parts; part > 0; --part)
        sizes.insert(sizes.begin() + at, places[std::size_t(part)] - places[std::size_t(part) - 1]);
      gaps.insert(gaps.begin() + at, std::size_t(parts) - 1, 0.0);
      split.grid.names = namesAfter(grid, split);
    }
  return splits;
}

std::optional<Design> withSplit(const Design& design, const BlockGrid& before, const BlockGrid& split,
                                const std::string& block) {
  // Blocks are called by their place, and cuts go with the name.
  const std::vector<Cut> own = cutsAlike(design, block);
  for (const StockBlock& other : design.stock)
    if (cutsAlike(design, other.id) != own) return {};
  Result<Design> changed = withGrid(design, before, split, block);
  if (!changed) return {};
  // What blocks are cut of stays as it is, and so do its expressions.
  changed->sources = design.sources;
  changed = resolved(*changed);
  return changed ? std::optional(std::move(*changed)) : std::nullopt;
}

}  // namespace bw::pipeline
