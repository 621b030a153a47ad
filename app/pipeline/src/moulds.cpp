// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/moulds.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/text/number_text.h"

namespace bw::pipeline {

namespace {

constexpr const char* kUpper = "-upper";
constexpr const char* kOfGrid = "/grid/";

/// Has the numbers of an entry of a list of the design's file hang on the expressions of those of another,
/// as far as they are the same.
void bindAlike(std::map<std::string, BoundNumber>& bindings, const std::string& list, std::size_t entry,
               std::size_t other) {
  const std::string from = list + std::to_string(entry) + "/", to = list + std::to_string(other) + "/";
  std::map<std::string, BoundNumber> copies;
  for (auto bound = bindings.lower_bound(from); bound != bindings.end() && bound->first.starts_with(from);
       ++bound)
    copies[to + bound->first.substr(from.size())] = bound->second;
  bindings.merge(copies);
}

Result<void> check(const Design& design, double thickness) {
  if (!(thickness > 0) || thickness > 2 * Cut::kMostOffset)
    return fail(ErrorCode::badInput,
                "a panel is " + shortText(thickness) + " mm thick; it must be above 0 and at most " +
                    shortText(2 * Cut::kMostOffset) + " mm",
                "thickness", thickness, 2 * Cut::kMostOffset);
  if (2 * design.stock.size() > std::size_t(Design::kMostBlocks))
    return fail(ErrorCode::badInput,
                std::to_string(2 * design.stock.size()) + " blocks are too many; there may be " +
                    std::to_string(Design::kMostBlocks),
                "thickness", double(2 * design.stock.size()), double(Design::kMostBlocks));
  for (const StockBlock& block : design.stock) {
    const auto of = [&](const Cut& cut) { return cut.block == block.id; };
    if (std::ranges::count_if(design.cuts, of) != 1)
      return fail(ErrorCode::badInput,
                  "the block " + block.id + " has " + std::to_string(std::ranges::count_if(design.cuts, of)) +
                      " cuts; two moulds are made of blocks with one cut each: where two cuts leave a ridge, "
                      "the other mould has a valley, into which no blade reaches from side to side",
                  "cuts");
    const Cut& cut = *std::ranges::find_if(design.cuts, of);
    if (cut.pose != CutPose{} || cut.offset != 0)
      return fail(
          ErrorCode::badInput,
          "the cut " + cut.id +
              " has a block that is turned for it, or an offset; two moulds are made of blocks that lie "
              "as they are placed, and of the surface itself",
          "cuts");
  }
  return {};
}

/// How high the surface lies in its block, mm above the bottom: the middle between its lowest and its highest
/// place; empty where the block does not meet it.
std::optional<double> middleHeight(const CutEvaluation& cut) {
  if (!cut.setup || !cut.sections.value) return {};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Section& section : *cut.sections.value) {
    if (section.chosen < 0) continue;
    for (const Eigen::Vector2d& p : section.curve().sample(33)) {
      const double z = cut.block().frame.toLocal(section.frame.toWorld(p)).z();
      low = std::min(low, z);
      high = std::max(high, z);
    }
  }
  if (!(low <= high)) return {};
  return (low + high) / 2;
}

}  // namespace

int gridExpressions(const Design& design) {
  return int(std::ranges::count_if(design.bindings,
                                   [](const auto& bound) { return bound.first.starts_with(kOfGrid); }));
}

Result<Design> withUpperMoulds(const Evaluation& evaluation, double thickness) {
  Design design = evaluation.design;
  if (Result<void> ok = check(design, thickness); !ok) return tl::unexpected<Error>(ok.error());
  design.grid.reset();
  std::erase_if(design.bindings, [](const auto& bound) { return bound.first.starts_with(kOfGrid); });
  std::vector<StockBlock> upper;
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < design.stock.size(); ++i) {
    StockBlock& block = design.stock[i];
    const auto of = std::ranges::find(design.cuts, block.id, &Cut::block);
    Cut& cut = *of;
    const CutEvaluation* made = evaluation.find(cut.id);
    const std::optional<double> middle = made ? middleHeight(*made) : std::nullopt;
    if (!middle) continue;  // the surface does not come there
    const Box& lower = made->block();
    block.placement = placementOf(lower);
    // Planes that turn are those of the surface for both.
    if (!made->setup->planes.turns()) cut.direction = made->setup->planes.direction();
    cut.offset = thickness / 2;
    Box above = lower;
    above.frame.origin += (2 * *middle - lower.size.z()) * lower.frame.normal;
    StockBlock twin{block.id + kUpper, placementOf(above)};
    Cut other = cut;
    other.id += kUpper;
    other.block = twin.id;
    other.keep = cut.keep == KeptSide::below ? KeptSide::above : KeptSide::below;
    bindAlike(design.bindings, "/stock/", i, design.stock.size() + upper.size());
    bindAlike(design.bindings, "/cuts/", std::size_t(of - design.cuts.begin()),
              design.cuts.size() + cuts.size());
    upper.push_back(std::move(twin));
    cuts.push_back(std::move(other));
  }
  for (StockBlock& block : upper) {
    if (std::ranges::find(design.stock, block.id, &StockBlock::id) != design.stock.end())
      return fail(ErrorCode::badInput, "there is a block " + block.id + " already; the design has its moulds",
                  "stock");
    design.stock.push_back(std::move(block));
  }
  for (Cut& cut : cuts) design.cuts.push_back(std::move(cut));
  return design;
}

}  // namespace bw::pipeline
