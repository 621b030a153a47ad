// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// How the blocks of the design at work are laid out side by side.
#pragma once

#include <QString>

#include <optional>

#include "bw/core/design/block_grid.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Where the block selected stands: as it is placed, or as it was found around its surface; empty before that
/// is known.
std::optional<BlockPlacement> placementOf(const Workbench& bench);

/// The grid that the blocks lie in; empty where they are a list, or where a single block is not yet placed.
std::optional<BlockGrid> gridOf(const Workbench& bench);

/// Lays the blocks of `from`, which lie in `before`, out by `next` and makes that the design, as one undoable
/// step; other blocks get the cuts of the block selected. What cannot be is told, and false returned.
/// `mergeId` and `live` as `Workbench::editDesign` takes them.
bool layOut(Workbench& bench, const QString& text, const Design& from, const BlockGrid& before,
            const BlockGrid& next, int mergeId = -1, bool live = false);

}  // namespace bw::app
