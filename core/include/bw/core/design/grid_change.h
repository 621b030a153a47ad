// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design whose blocks are laid out by another grid.
#pragma once

#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw {

/// The grid that the blocks of a design lie in: its own, or one of a single block where the only block of the
/// design lies as it is `placed`. Empty where several blocks are listed one by one.
std::optional<BlockGrid> gridOf(const Design& design, const BlockPlacement& placed);

/// The same with another number of columns (`way` 0), rows (1) or layers (2), of at least one: more of them
/// are as large, and as far apart, as the last; where `divided`, all of them share what there was evenly.
BlockGrid withCount(BlockGrid grid, std::size_t way, int count, bool divided);

/// The design with its blocks laid out by `grid` in place of `before`. Blocks that stay keep their cuts;
/// others get those of the block `like`; a grid of one block is a block of its own. Expressions go with what
/// they tell. Designed surfaces that were told over the whole of `before` as seen from above are told over
/// the whole of `grid`: the rectangle of poles and formulas is another, points of sections and joints of
/// their cubics stay on the boundaries of the blocks on which they lie, as key blades do, and those beyond
/// the last go; a curve that ends elsewhere than it did is cut there (a spline, which ends without curvature,
/// gets one or two points beside its end where it would be more than 0.1 mm off by that); over more columns
/// sections go on in a mirror on each boundary, over more rows the last one, or the last key blade, is
/// repeated. Error `badInput`: more blocks or cuts than a design may have, or a block that is no block.
Result<Design> withGrid(const Design& design, const BlockGrid& before, const BlockGrid& grid,
                        const std::string& like);

}  // namespace bw
