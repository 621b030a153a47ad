// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bw/core/design/block_grid.h"
#include "bw/core/design/design.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw::app {

/// The grid with the block of that id, and those in line with it, split across the blade of its row into as
/// few parts as it takes for the slowest point of the blade to keep kSpeedRatioLimit of the fastest within
/// each, at every station, as fast as the row's points are now: at equal distances, or where the worst of its
/// stations has the speeds in equal ratios. Empty where no split into four parts, of a tenth of a metre each
/// at least, does.
std::optional<BlockGrid> splitForSpeed(const BlockGrid& grid, const std::string& block, const Sweep& row,
                                       const SweepCheck& check);

/// How many blocks stand in the place of one.
std::size_t partsOf(const BlockGrid& before, const BlockGrid& split);

/// The design whose blocks lie in `before`, in those of the split; surfaces stay where they are, and each
/// part has the cuts of its block. Empty where that would be more blocks than a design may have, and where
/// the cuts differ from block to block.
std::optional<Design> withSplit(const Design& design, const BlockGrid& before, const BlockGrid& split,
                                const std::string& block);

}  // namespace bw::app
