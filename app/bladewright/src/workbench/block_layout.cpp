// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/block_layout.h"

#include <utility>

#include "bw/core/design/grid_change.h"

namespace bw::app {

std::optional<BlockPlacement> placementOf(const Workbench& bench) {
  if (const auto& placed = bench.block().placement) return placed;
  const pipeline::CutEvaluation* cut = bench.shownCut();
  if (!cut || !cut->setup) return std::nullopt;
  return bw::placementOf(placedAs(cut->block(), bench.cut().pose));
}

std::optional<BlockGrid> gridOf(const Workbench& bench) {
  const Design& design = bench.design();
  if (design.grid) return design.grid;
  const std::optional<BlockPlacement> placed = placementOf(bench);
  if (!placed || (!bench.block().placement && design.stock.size() > 1)) return std::nullopt;
  return bw::gridOf(design, *placed);
}

bool layOut(Workbench& bench, const QString& text, const Design& from, const BlockGrid& before,
            const BlockGrid& next, int mergeId, bool live) {
  Result<Design> changed = withGrid(from, before, next, bench.cut().block);
  if (changed) changed = resolved(*changed);
  if (!changed) {
    bench.tell(Topic::declined, changed.error());
    return false;
  }
  bench.editDesign(
      text, [&changed](Design& design) { design = std::move(*changed); }, mergeId, live);
  return true;
}

}  // namespace bw::app
