// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/grid_change.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace bw {

namespace {

constexpr double kSame = 1e-6;  // mm

/// The cuts of a block without its name in theirs.
std::vector<Cut> cutsLike(const Design& design, const std::string& block) {
  std::vector<Cut> like;
  for (Cut cut : design.cuts) {
    if (cut.block != block) continue;
    if (cut.id.size() > block.size() + 1 && cut.id.ends_with("-" + block))
      cut.id.resize(cut.id.size() - block.size() - 1);
    like.push_back(std::move(cut));
  }
  return like;
}

Rectangle* rectangleOf(DesignedSurface& surface) {
  if (auto* poles = std::get_if<PolesSurface>(&surface.shape)) return &poles->over;
  if (auto* formula = std::get_if<FormulaSurface>(&surface.shape)) return &formula->over;
  return nullptr;
}

/// A surface that reached over all of a grid reaches over all of another one.
void reachOver(DesignedSurface& surface, const BlockGrid& before, const BlockGrid& grid) {
  Rectangle* over = rectangleOf(surface);
  if (!over || surface.rotation != before.rotation || grid.rotation != before.rotation) return;
  const Eigen::Matrix3d turn = rotationFromAngles(before.rotation);
  const auto from = [&](const BlockGrid& of) -> Eigen::Vector2d {
    return (turn.transpose() * (of.origin - surface.origin)).head<2>();
  };
  const auto extent = [](const BlockGrid& of) { return Eigen::Vector2d(of.extent(0), of.extent(1)); };
  const Eigen::Vector2d first = from(before), last = first + extent(before);
  if ((over->min - first).cwiseAbs().maxCoeff() > kSame || (over->max - last).cwiseAbs().maxCoeff() > kSame)
    return;
  over->min = from(grid);
  over->max = from(grid) + extent(grid);
}

Result<void> judge(const BlockGrid& grid, std::size_t cutsEach) {
  const std::size_t blocks = grid.count();
  if (blocks > std::size_t(BlockGrid::kMostBlocks))
    return fail(ErrorCode::badInput,
                std::to_string(blocks) + " blocks are too many; there may be " +
                    std::to_string(BlockGrid::kMostBlocks),
                "grid", double(blocks), double(BlockGrid::kMostBlocks));
  if (blocks * cutsEach > std::size_t(Design::kMostCuts))
    return fail(ErrorCode::badInput,
                std::to_string(blocks) + " blocks with " + std::to_string(cutsEach) +
                    " cuts each are too many; there may be " + std::to_string(Design::kMostCuts) + " cuts",
                "cuts", double(blocks * cutsEach), double(Design::kMostCuts));
  return {};
}

/// Expressions of parts that are counted otherwise now.
void dropBindings(Design& design, const BlockGrid& before, const BlockGrid& grid) {
  const bool counted = before.count() != grid.count();
  std::erase_if(design.bindings, [&](const auto& bound) {
    const auto in = [&](const std::string& part) { return bound.first.starts_with(part); };
    if (counted && (in("/cuts/") || in("/stock/"))) return true;
    if (!design.grid) return in("/grid/");
    for (std::size_t way = 0; way < 3; ++way)
      if (before.sizes[way].size() != grid.sizes[way].size() &&
          (in(std::string("/grid/sizes/") + kGridWays[way]) ||
           in(std::string("/grid/gaps/") + kGridWays[way])))
        return true;
    return false;
  });
}

}  // namespace

std::optional<BlockGrid> gridOf(const Design& design, const BlockPlacement& placed) {
  if (design.grid) return design.grid;
  if (design.stock.size() > 1) return std::nullopt;
  BlockGrid one;
  one.origin = placed.origin;
  one.rotation = placed.rotation;
  for (std::size_t way = 0; way < 3; ++way) one.sizes[way] = {placed.size[Eigen::Index(way)]};
  return one;
}

BlockGrid withCount(BlockGrid grid, std::size_t way, int count, bool divided) {
  std::vector<double>&sizes = grid.sizes[way], &gaps = grid.gaps[way];
  if (divided) {
    const double whole = grid.extent(way);
    sizes.assign(std::size_t(count), whole / count);
    gaps.assign(std::size_t(count) - 1, 0);
    return grid;
  }
  const double gap = gaps.empty() ? 0 : gaps.back();
  sizes.resize(std::size_t(count), sizes.back());
  gaps.resize(std::size_t(count) - 1, gap);
  return grid;
}

Result<Design> withGrid(const Design& design, const BlockGrid& before, const BlockGrid& grid,
                        const std::string& like) {
  const std::vector<Cut> each = cutsLike(design, like);
  if (Result<void> ok = judge(grid, each.size()); !ok) return tl::unexpected<Error>(ok.error());
  for (const auto& way : grid.sizes)
    for (const double size : way)
      if (!(size > 0)) return fail(ErrorCode::badInput, "a block must be larger than 0 mm", "grid", size, 0);
  Design changed = design;
  for (Source& source : changed.sources)
    if (source.surface) reachOver(*source.surface, before, grid);
  changed.stock = stockOf(grid);
  if (grid.count() == 1) {
    changed.grid.reset();
    changed.cuts = each;
    for (Cut& cut : changed.cuts) cut.block = changed.block().id;
  } else {
    changed.grid = grid;
    std::set<std::string> blocks;
    for (const StockBlock& block : changed.stock) blocks.insert(block.id);
    std::vector<Cut> own;
    std::ranges::copy_if(design.cuts, std::back_inserter(own),
                         [&](const Cut& cut) { return blocks.contains(cut.block); });
    changed.cuts = cutsOf(changed.stock, each, own);
  }
  dropBindings(changed, before, grid);
  return changed;
}

}  // namespace bw
