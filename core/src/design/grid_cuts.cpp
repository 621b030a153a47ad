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

namespace {

constexpr std::string_view kCuts = "/cuts/";

using Bindings = std::map<std::string, BoundNumber>;

/// Expressions of cuts by their place in a list, and what stands behind that in their pointers.
std::map<std::size_t, Bindings> byCut(const Bindings& bindings) {
  std::map<std::size_t, Bindings> cuts;
  for (auto bound = bindings.lower_bound(std::string(kCuts));
       bound != bindings.end() && bound->first.starts_with(kCuts); ++bound) {
    std::size_t index = 0;
    const std::string& pointer = bound->first;
    const char* const last = pointer.data() + pointer.size();
    const auto [end, error] = std::from_chars(pointer.data() + kCuts.size(), last, index);
    if (error == std::errc{}) cuts[index].emplace(std::string(end, last), bound->second);
  }
  return cuts;
}

}  // namespace

std::optional<CutsUnderGrid> cutsUnderGrid(const Design& design) {
  if (!design.grid || design.stock != stockOf(*design.grid)) return {};
  const std::string& first = design.stock.front().id;
  const std::map<std::size_t, Bindings> bound = byCut(design.bindings);
  const auto expressions = [&bound](std::size_t cut) {
    const auto found = bound.find(cut);
    return found == bound.end() ? Bindings() : found->second;
  };
  CutsUnderGrid told;
  std::vector<Cut> each, own;
  std::vector<std::size_t> ofOwn;
  std::set<std::pair<std::string, std::string>> there;  // ids, and their blocks
  for (const Cut& cut : design.cuts) there.insert({cut.id, cut.block});
  const auto isOfAll = [&](const std::string& stem) {
    return std::ranges::all_of(design.stock, [&](const StockBlock& block) {
      return there.contains({stem + "-" + block.id, block.id});
    });
  };
  for (std::size_t i = 0; i < design.cuts.size(); ++i)
    if (std::string stem = stemOf(design.cuts[i].id, first);
        design.cuts[i].block == first && !stem.empty() && isOfAll(stem)) {
      Cut cut = design.cuts[i];
      cut.id = std::move(stem);
      cut.block.clear();
      each.push_back(std::move(cut));
      told.of.push_back(i);
    }
  // What the file would make of those alone, and by which of them.
  std::map<std::string, std::pair<Cut, std::size_t>> made;
  const std::vector<Cut> plain = cutsOf(design.stock, each, {});
  for (std::size_t i = 0; i < plain.size(); ++i)
    made.emplace(plain[i].id, std::pair(plain[i], i % each.size()));
  for (std::size_t i = 0; i < design.cuts.size(); ++i) {
    const auto found = made.find(design.cuts[i].id);
    if (found != made.end() && found->second.first == design.cuts[i] &&
        expressions(i) == expressions(told.of[found->second.second]))
      continue;
    own.push_back(design.cuts[i]);
    ofOwn.push_back(i);
  }
  if (cutsOf(design.stock, each, own) != design.cuts) return {};
  told.cuts = std::move(each);
  told.cuts.insert(told.cuts.end(), own.begin(), own.end());
  told.of.insert(told.of.end(), ofOwn.begin(), ofOwn.end());
  return told;
}

Bindings withCutBindings(const Bindings& bindings, std::size_t count,
                         const std::function<std::optional<std::size_t>(std::size_t)>& from) {
  const std::map<std::size_t, Bindings> cuts = byCut(bindings);
  Bindings moved;
  for (const auto& [pointer, bound] : bindings)
    if (!pointer.starts_with(kCuts)) moved.emplace(pointer, bound);
  if (cuts.empty()) return moved;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::optional<std::size_t> was = from(i))
      if (const auto told = cuts.find(*was); told != cuts.end())
        for (const auto& [key, bound] : told->second)
          moved.emplace(std::string(kCuts) + std::to_string(i) + key, bound);
  return moved;
}

void moveCutBindings(Bindings& bindings, const std::vector<Cut>& from, const std::vector<Cut>& to) {
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (std::size_t i = 0; i < from.size(); ++i) places.try_emplace({from[i].id, from[i].block}, i);
  bindings = withCutBindings(bindings, to.size(), [&](std::size_t cut) -> std::optional<std::size_t> {
    const auto was = places.find({to[cut].id, to[cut].block});
    return was == places.end() ? std::nullopt : std::optional(was->second);
  });
}

}  // namespace bw::detail
