// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "design/grid_cuts.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string>
#include <utility>

#include "bw/core/design/cut_list.h"

namespace bw::detail {

std::optional<std::vector<Cut>> cutsUnderGrid(const Design& design) {
  if (!design.grid || design.stock != stockOf(*design.grid)) return {};
  const std::string& first = design.stock.front().id;
  std::vector<Cut> each, own;
  std::set<std::pair<std::string, std::string>> there;  // ids, and their blocks
  for (const Cut& cut : design.cuts) there.insert({cut.id, cut.block});
  const auto isOfAll = [&](const std::string& stem) {
    return std::ranges::all_of(design.stock, [&](const StockBlock& block) {
      return there.contains({stem + "-" + block.id, block.id});
    });
  };
  for (Cut cut : design.cuts)
    if (std::string stem = stemOf(cut.id, first); cut.block == first && !stem.empty() && isOfAll(stem)) {
      cut.id = std::move(stem);
      cut.block.clear();
      each.push_back(std::move(cut));
    }
  std::map<std::string, Cut> made;
  for (Cut& cut : cutsOf(design.stock, each, {})) made.emplace(cut.id, cut);
  for (const Cut& cut : design.cuts)
    if (const auto found = made.find(cut.id); found == made.end() || found->second != cut) own.push_back(cut);
  if (cutsOf(design.stock, each, own) != design.cuts) return {};
  each.insert(each.end(), own.begin(), own.end());
  return each;
}

std::vector<Cut> listedCuts(const Design& design) { return cutsUnderGrid(design).value_or(design.cuts); }

void moveCutBindings(std::map<std::string, BoundNumber>& bindings, const std::vector<Cut>& from,
                     const std::vector<Cut>& to) {
  const std::string list = "/cuts/";
  std::map<std::string, BoundNumber> moved;
  for (auto& [pointer, bound] : bindings) {
    if (!pointer.starts_with(list)) {
      moved.emplace(pointer, std::move(bound));
      continue;
    }
    std::size_t index = 0;
    const char* const last = pointer.data() + pointer.size();
    const auto [end, error] = std::from_chars(pointer.data() + list.size(), last, index);
    if (error != std::errc{} || index >= from.size()) continue;
    const auto now = std::ranges::find_if(
        to, [&](const Cut& cut) { return cut.id == from[index].id && cut.block == from[index].block; });
    if (now != to.end())
      moved.emplace(list + std::to_string(now - to.begin()) + std::string(end, last), std::move(bound));
  }
  bindings = std::move(moved);
}

}  // namespace bw::detail
