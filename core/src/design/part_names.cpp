// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/part_names.h"

#include <algorithm>
#include <vector>

namespace bw {

namespace {

template <class Part>
std::map<std::string, std::string> namesIn(const std::vector<Part>& from, const std::vector<Part>& to) {
  std::map<std::string, std::string> names;
  if (from.size() != to.size()) return names;
  const auto has = [](const std::vector<Part>& list, const std::string& id) {
    return std::ranges::find(list, id, &Part::id) != list.end();
  };
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i].id != to[i].id && !has(to, from[i].id) && !has(from, to[i].id))
      names.emplace(from[i].id, to[i].id);
  return names;
}

}  // namespace

NewNames newNames(const Design& before, const Design& after) {
  return {namesIn(before.stock, after.stock), namesIn(before.cuts, after.cuts),
          namesIn(before.sources, after.sources)};
}

void followName(const std::map<std::string, std::string>& names, std::string& name) {
  if (const auto found = names.find(name); found != names.end()) name = found->second;
}

Design calledSo(Design design, const NewNames& names) {
  for (Source& source : design.sources) followName(names.sources, source.id);
  for (StockBlock& block : design.stock) followName(names.blocks, block.id);
  for (Cut& cut : design.cuts) {
    followName(names.cuts, cut.id);
    followName(names.blocks, cut.block);
    followName(names.sources, cut.source);
  }
  return design;
}

}  // namespace bw
