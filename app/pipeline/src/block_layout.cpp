// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "block_layout.h"

#include <algorithm>

#include "bw/core/parts/cut_order.h"

namespace bw::pipeline {

namespace {

constexpr double kLeastMet = 100;  ///< mm² of a surface in a block

const StockBlock& stockBlock(const Design& design, const std::string& id) {
  return *std::ranges::find(design.stock, id, &StockBlock::id);
}

}  // namespace

Result<void> leaveOutMissed(Evaluation& e) {
  BlocksMissed missed;
  missed.of = int(e.blocks.size());
  std::vector<BlockEvaluation> met;
  for (BlockEvaluation& block : e.blocks) {
    if (const std::optional<BlockPlacement>& placement = stockBlock(e.design, block.id).placement)
      std::erase_if(block.cuts, [box = placement->box()](const CutEvaluation& cut) {
        return areaInBox(*cut.targetMesh.value, box).area < kLeastMet;
      });
    if (block.cuts.empty())
      missed.blocks.push_back(block.id);
    else
      met.push_back(std::move(block));
  }
  e.blocks = std::move(met);
  if (e.blocks.empty()) {
    e.blocks.resize(1);
    return fail(ErrorCode::badInput,
                "none of the " + std::to_string(missed.of) +
                    " blocks is met by the surface; move or enlarge the blocks (grid or stock)",
                "stock");
  }
  if (e.blocks.size() > std::size_t(kMostBlocksMet))
    return fail(ErrorCode::badInput,
                "the surface comes through " + std::to_string(e.blocks.size()) + " blocks; at most " +
                    std::to_string(kMostBlocksMet) +
                    " are evaluated together: take larger blocks, or split the design",
                "stock", double(e.blocks.size()), kMostBlocksMet);
  if (!missed.blocks.empty())
    e.missed = {{e.design.grid ? Severity::info : Severity::warning, std::move(missed)}};
  return {};
}

Cut cutToMake(const Design& design, const std::string& id) {
  Cut cut = *std::ranges::find(design.cuts, id, &Cut::id);
  if (design.grid && !cut.direction)
    cut.direction =
        lying(BlockPlacement{{}, Eigen::Vector3d::Ones(), design.grid->rotation}.box(), cut.pose).frame.y;
  return cut;
}

Box placedBlock(const Design& design, const CutEvaluation& cut) {
  return placedAs(cut.setup->block, std::ranges::find(design.cuts, cut.id, &Cut::id)->pose);
}

std::vector<char> joinedCuts(const Evaluation& e) {
  std::vector<BlockRow> rows;
  std::vector<Box> boxes;
  std::vector<const geometry::Target*> surfaces;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      surfaces.push_back(cut.target.value.get());
      const auto first = std::ranges::find(surfaces, surfaces.back());
      rows.push_back({block.id, cut.id, nullptr, int(first - surfaces.begin())});
      boxes.push_back(cut.setup->block);
    }
  if (e.design.process.join == Join::none) return std::vector<char>(rows.size(), 0);
  return joined(rows, boxes, jointRequest(e.design).apart);
}

std::vector<BlockRow> rowsOf(const Evaluation& e) {
  std::vector<BlockRow> rows;
  std::vector<const geometry::Target*> surfaces;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      surfaces.push_back(cut.target.value.get());
      const auto first = std::ranges::find(surfaces, surfaces.back());
      rows.push_back({block.id, cut.id, cut.sweep.value.get(), int(first - surfaces.begin())});
    }
  return rows;
}

Result<void> inBlock(const Evaluation& e, const std::string& block, const Result<void>& result) {
  if (result || e.blocks.size() < 2 || result.error().code == ErrorCode::cancelled) return result;
  Error error = result.error();
  error.message = block + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace bw::pipeline
