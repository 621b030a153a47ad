// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/block_grid.h"
#include "bw/core/design/design.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::pipeline {

/// A grid with one of its columns, rows or layers in parts.
struct BlockSplit {
  static constexpr int kMostParts = 4;
  static constexpr double kNarrowest = 100;  ///< mm of a part along the blade

  BlockGrid grid;              ///< with the parts
  std::size_t way = 0;         ///< 0 columns, 1 rows, 2 layers: along that edge of the block it is split
  std::size_t place = 0;       ///< which of these, of the first part
  std::vector<double> places;  ///< mm from the block's corner: of its faces and of those between its parts

  std::size_t parts() const { return places.size() - 1; }
  /// Which of the parts a block of that grid is; empty for those beside them.
  std::optional<std::size_t> partOf(const BlockPlacement& block) const;
};

/// The splits of the block of that id, and of those in line with it, across the blade of its row into as few
/// parts as it takes for the slowest point of the blade to keep kSpeedRatioLimit of the fastest within each,
/// at every station, as fast as the row's points are now: at equal distances, or where the worst of its
/// stations has the speeds in equal ratios. Fewer parts come first; none where no split into kMostParts, each
/// kNarrowest wide, does.
std::vector<BlockSplit> splitsForSpeed(const BlockGrid& grid, const std::string& block, const Sweep& row,
                                       const SweepCheck& check);

/// The design whose blocks lie in `before`, in those of the split; surfaces stay where they are, and each
/// part has the cuts of its block. Empty where that would be more blocks than a design may have, and where
/// the cuts differ from block to block.
std::optional<Design> withSplit(const Design& design, const BlockGrid& before, const BlockGrid& split,
                                const std::string& block);

}  // namespace bw::pipeline
