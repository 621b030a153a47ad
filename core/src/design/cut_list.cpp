// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/cut_list.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>

#include "design/grid_cuts.h"

namespace bw {

namespace {

/// A name that none of the parts has: "surface-2".
template <class Part>
std::string freeId(const std::vector<Part>& parts, const std::string& stem) {
  for (std::size_t number = parts.size() + 1;; ++number) {
    std::string id = stem + "-" + std::to_string(number);
    if (std::ranges::find(parts, id, &Part::id) == parts.end()) return id;
  }
}

/// Poles over a block that fall along its y.
DesignedSurface fallingOver(const BlockPlacement& block) {
  PolesSurface poles;
  poles.over = {{0, 0}, {block.size.x(), block.size.y()}};
  for (int row = 0; row < poles.rows; ++row)
    for (int column = 0; column < poles.columns; ++column)
      poles.at(row, column).height = block.size.z() * (0.75 - 0.5 * row / (poles.rows - 1));
  return {poles, block.origin, block.rotation};
}

/// Expressions of the sources from which one was taken.
std::map<std::string, BoundNumber> withoutSource(const std::map<std::string, BoundNumber>& bindings,
                                                 std::size_t taken) {
  const std::string list = "/sources/";
  std::map<std::string, BoundNumber> kept;
  for (const auto& [pointer, bound] : bindings) {
    std::size_t index = 0;
    const char *from = pointer.data() + list.size(), *to = pointer.data() + pointer.size();
    if (!pointer.starts_with(list)) {
      kept.emplace(pointer, bound);
      continue;
    }
    const auto [end, error] = std::from_chars(from, to, index);
    if (error != std::errc{} || index == taken) continue;
    kept.emplace(list + std::to_string(index > taken ? index - 1 : index) + std::string(end, to), bound);
  }
  return kept;
}

}  // namespace

Result<AnotherCut> withAnotherCut(const Design& design, const Cut& beside, const BlockPlacement& placed) {
  AnotherCut another{design, {}};
  Design& changed = another.design;
  // A surface made for it lies over this block alone; a file may be cut in each of them.
  const bool own = design.sourceOf(beside).surface.has_value();
  const std::size_t more = design.grid && !own ? design.stock.size() : 1;
  if (design.cuts.size() + more > std::size_t(Design::kMostCuts))
    return fail(ErrorCode::badInput,
                "the design has " + std::to_string(design.cuts.size()) + " cuts; there may be " +
                    std::to_string(Design::kMostCuts),
                "cuts", double(design.cuts.size() + more), double(Design::kMostCuts));
  Cut cut = beside;
  cut.face = {};
  cut.order.reset();
  if (own) {
    if (design.sources.size() >= std::size_t(Design::kMostSources))
      return fail(ErrorCode::badInput,
                  "the design has " + std::to_string(design.sources.size()) + " sources; there may be " +
                      std::to_string(Design::kMostSources),
                  "sources", double(design.sources.size() + 1), double(Design::kMostSources));
    Source source;
    source.id = cut.source = freeId(design.sources, "surface");
    source.surface = fallingOver(placed);
    changed.sources.push_back(std::move(source));
  }
  // Its numbers are told as those of the one beside.
  const auto place = std::size_t(std::ranges::find(design.cuts, beside.id, &Cut::id) - design.cuts.begin());
  const auto tell = [&] {
    changed.bindings = detail::withCutBindings(
        design.bindings, changed.cuts.size(), [&](std::size_t index) -> std::optional<std::size_t> {
          const auto was = std::ranges::find(design.cuts, changed.cuts[index].id, &Cut::id);
          return was == design.cuts.end() ? place : std::size_t(was - design.cuts.begin());
        });
  };
  if (!design.grid) {
    another.id = cut.id = freeId(design.cuts, "cut");
    changed.cuts.push_back(std::move(cut));
    tell();
    return another;
  }
  // By a name that no cut begins with.
  for (int number = 2;; ++number) {
    cut.id = "cut" + std::to_string(number);
    const std::vector<Cut> made = cutsOf(design.stock, {cut}, {});
    if (std::ranges::any_of(made, [&](const Cut& one) {
          return std::ranges::find(design.cuts, one.id, &Cut::id) != design.cuts.end();
        }))
      continue;
    another.id = cut.id + "-" + beside.block;
    // The cuts of a grid stand block by block, those of one block alone behind them.
    if (own) {
      changed.cuts.push_back(*std::ranges::find(made, beside.block, &Cut::block));
    } else {
      changed.cuts.clear();
      for (const StockBlock& block : design.stock) {
        std::ranges::copy_if(design.cuts, std::back_inserter(changed.cuts),
                             [&](const Cut& one) { return one.block == block.id; });
        changed.cuts.push_back(*std::ranges::find(made, block.id, &Cut::block));
      }
    }
    tell();
    return another;
  }
}

std::string stemOf(const std::string& id, const std::string& block) {
  const std::string end = "-" + block;
  return id.size() > end.size() && id.ends_with(end) ? id.substr(0, id.size() - end.size()) : std::string();
}

std::vector<Cut> cutsTogether(const Design& design, const Cut& cut) {
  const std::string stem = stemOf(cut.id, cut.block);
  if (!design.grid || stem.empty()) return {cut};
  std::vector<Cut> all;
  std::ranges::copy_if(design.cuts, std::back_inserter(all),
                       [&](const Cut& one) { return one.id == stem + "-" + one.block; });
  return all;
}

bool mayGo(const Design& design, const Cut& cut) {
  std::map<std::string, int> counts;
  for (const Cut& one : design.cuts) ++counts[one.block];
  return std::ranges::all_of(cutsTogether(design, cut),
                             [&](const Cut& one) { return counts[one.block] > 1; });
}

Design withoutCut(const Design& design, const Cut& cut) {
  Design changed = design;
  for (const Cut& gone : cutsTogether(design, cut))
    std::erase_if(changed.cuts, [&](const Cut& one) { return one.id == gone.id; });
  detail::moveCutBindings(changed.bindings, design.cuts, changed.cuts);
  if (std::ranges::find(changed.cuts, cut.source, &Cut::source) != changed.cuts.end()) return changed;
  const auto source = &design.sourceOf(cut) - design.sources.data();
  if (!design.sources[std::size_t(source)].surface) return changed;  // a file may be cut again
  changed.sources.erase(changed.sources.begin() + source);
  changed.bindings = withoutSource(changed.bindings, std::size_t(source));
  return changed;
}

}  // namespace bw
