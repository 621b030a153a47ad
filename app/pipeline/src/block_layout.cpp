// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "block_layout.h"

#include <algorithm>
#include <set>
#include <utility>

#include "bw/core/parts/cut_order.h"
#include "bw/pipeline/requests.h"
#include "bw/words/findings.h"

namespace bw::pipeline {

namespace {

constexpr double kLeastMet = 100;  ///< mm² of a surface in a block

constexpr double kLeastOut = 0.5;  ///< mm of a surface beyond its block that are told

/// From the first face of a grid to its last, each way.
Box hullOf(const BlockGrid& grid) {
  return BlockPlacement{grid.origin, Eigen::Vector3d(grid.extent(0), grid.extent(1), grid.extent(2)),
                        grid.rotation}
      .box();
}

const StockBlock& stockBlock(const Design& design, const std::string& id) {
  return *std::ranges::find(design.stock, id, &StockBlock::id);
}

/// True for cuts that keep a surface at a distance, on its one side and on the other: moulds of a panel, of
/// which the lower ones do not go on in the upper ones.
bool onTwoSides(const Design& design, const CutEvaluation& a, const CutEvaluation& b) {
  const auto cut = [&](const CutEvaluation& made) -> const Cut& {
    return *std::ranges::find(design.cuts, made.id, &Cut::id);
  };
  const Cut &one = cut(a), &other = cut(b);
  return one.offset != 0 && other.offset != 0 &&
         keptWay(a.block(), one.keep).dot(keptWay(b.block(), other.keep)) < 0;
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

void lookOutside(Evaluation& e) {
  e.outside.clear();
  e.outsideShare = 0;
  const Design& design = e.design;
  double all = 0, outside = 0;
  std::vector<const geometry::Target*> seen;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& made : block.cuts) {
      const geometry::Target* target = made.target.value.get();
      if (std::ranges::find(seen, target) != seen.end()) continue;
      seen.push_back(target);
      const Cut& own = *std::ranges::find(design.cuts, made.id, &Cut::id);
      std::vector<Box> boxes;
      std::set<std::string> named;
      for (const Cut& cut : design.cuts)
        if (cut.source == own.source && cut.face == own.face && named.insert(cut.block).second) {
          const std::optional<BlockPlacement>& placed = stockBlock(design, cut.block).placement;
          const CutEvaluation* stages = placed ? nullptr : e.find(cut.id);
          if (placed) boxes.push_back(placed->box());
          if (stages && stages->setup) boxes.push_back(stages->block());
        }
      const bool several = boxes.size() > 1;
      if (design.grid && named.size() == design.stock.size()) boxes = {hullOf(*design.grid)};
      const bool drawn = std::ranges::find(design.sources, own.source, &Source::id)->surface.has_value();
      const TriangleMesh& mesh = *made.targetMesh.value;
      const AreaOutside found = areaOutside(mesh, boxes, drawn ? Outside::overOrUnder : Outside::anywhere);
      all += found.all;
      if (found.distance <= std::max(design.process.tolerance, kLeastOut) || found.area < kLeastMet) continue;
      outside += found.area;
      Place where;
      where.point = found.point;
      e.outside.push_back({drawn && block.cuts.size() > 1 ? Severity::info : Severity::warning,
                           OutsideBlocks{found.area, found.area / found.all, found.distance, several},
                           where,
                           {}});
    }
  if (all > 0) e.outsideShare = outside / all;
}

Cut cutToMake(const Design& design, const std::string& id) {
  Cut cut = *std::ranges::find(design.cuts, id, &Cut::id);
  if (design.grid && !cut.direction && !turningOf(design, cut))
    cut.direction =
        lying(BlockPlacement{{}, Eigen::Vector3d::Ones(), design.grid->rotation}.box(), cut.pose).frame.y;
  return cut;
}

Box placedBlock(const Design& design, const CutEvaluation& cut) {
  return placedAs(cut.block(), std::ranges::find(design.cuts, cut.id, &Cut::id)->pose);
}

std::vector<Neighbours> neighboursOf(const Evaluation& e) {
  const std::vector<BlockRow> rows = rowsOf(e);
  std::vector<const CutEvaluation*> cuts;
  std::vector<Box> boxes;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      cuts.push_back(&cut);
      boxes.push_back(cut.block());
    }
  const auto mayMeet = [&](std::size_t i, std::size_t j) {
    return !onTwoSides(e.design, *cuts[i], *cuts[j]);
  };
  std::vector<Neighbours> pairs = neighboursAmong(rows, boxes, jointRequest(e.design).apart, mayMeet);
  // Rows that go on in the other block as what they are have no second partner there.
  const auto ofOne = [&](const Neighbours& pair) {
    return rows[pair.first].surface == rows[pair.second].surface;
  };
  std::set<std::pair<std::size_t, std::string>> meet;
  for (const Neighbours& pair : pairs)
    if (ofOne(pair)) {
      meet.emplace(pair.first, rows[pair.second].block);
      meet.emplace(pair.second, rows[pair.first].block);
    }
  // Each may be as far from one surface as the tolerance allows on the whole.
  const double within = e.design.process.tolerance + e.design.process.jointGap;
  std::erase_if(pairs, [&](const Neighbours& pair) {
    if (ofOne(pair)) return false;
    if (meet.contains({pair.first, rows[pair.second].block}) ||
        meet.contains({pair.second, rows[pair.first].block}))
      return true;
    return !comeTogether({*cuts[pair.first]->targetMesh.value, boxes[pair.first]},
                         {*cuts[pair.second]->targetMesh.value, boxes[pair.second]}, pair.boundary, within);
  });
  return pairs;
}

std::vector<char> joinedCuts(const Evaluation& e, KnownNeighbours& neighbours) {
  std::vector<char> joined;
  for (const BlockEvaluation& block : e.blocks) joined.resize(joined.size() + block.cuts.size());
  if (e.design.process.join == Join::none) return joined;
  for (const Neighbours& pair : neighbours.pairs()) joined[pair.first] = joined[pair.second] = 1;
  return joined;
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

namespace {

Result<void> inPart(const Place& part, const Result<void>& result) {
  const std::string name = words::partName(part);
  if (result || name.empty() || result.error().code == ErrorCode::cancelled) return result;
  Error error = result.error();
  error.message = name + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace

Result<void> inBlock(const Evaluation& e, const std::string& block, const Result<void>& result) {
  return inPart({.block = e.blocks.size() > 1 ? block : ""}, result);
}

Result<void> inCut(const Evaluation& e, const Cut& cut, const Result<void>& result) {
  const bool several = std::ranges::find(e.blocks, cut.block, &BlockEvaluation::id)->cuts.size() > 1;
  return inPart({.block = e.blocks.size() > 1 ? cut.block : "", .cut = several ? cut.id : ""}, result);
}

}  // namespace bw::pipeline
