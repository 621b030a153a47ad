// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "bw/core/base/units.h"
#include "bw/core/text/printable.h"
#include "design/design_keys.h"

namespace bw::detail {

using nlohmann::json;

namespace {

constexpr double kFarthest = 1e7;                ///< mm
constexpr double kSmallest = 1, kLargest = 1e6;  ///< mm, of a block

std::string counted(std::size_t count, const char* way) { return std::to_string(count) + " " + way; }

/// Lengths along one way of the grid: one for all of them, or one each. `count` is how many there must be.
void readLengths(ObjectReader& reader, std::size_t way, std::size_t count, double least, double most,
                 std::vector<double>& lengths) {
  const std::string key = kGridWays[way];
  const json* value = reader.member(key);
  if (!value) return;
  if (!value->is_array()) {
    double all = 0;
    if (reader.number(key, key, *value, all, least, most)) lengths.assign(count, all);
    return;
  }
  if (value->size() != count)
    return reader.complain(key,
                           reader.path() + "." + key + " has " + std::to_string(value->size()) +
                               " numbers but must have " + std::to_string(count) +
                               ", or be one number for all",
                           double(value->size()), double(count));
  for (std::size_t i = 0; i < count; ++i)
    if (!reader.number(key, key + "[" + std::to_string(i) + "]", (*value)[i], lengths[i], least, most))
      return;
}

/// How many columns, rows and layers there are: told, or as many as they have sizes.
std::array<std::size_t, 3> readCounts(ObjectReader& reader) {
  const json* sizes = reader.member("sizes");
  std::array<std::size_t, 3> counts = {};
  for (std::size_t way = 0; way < 3; ++way) {
    int count = 1;
    if (sizes && sizes->is_object())
      if (const auto list = sizes->find(kGridWays[way]); list != sizes->end() && list->is_array())
        count = int(std::min<std::size_t>(list->size(), BlockGrid::kMost + 1));
    reader.integer(kGridWays[way], count, 1, BlockGrid::kMost);
    if (count < 1 || count > BlockGrid::kMost)
      reader.complain("sizes",
                      reader.path() + ".sizes." + kGridWays[way] + " tells " +
                          (count < 1 ? "no " : "more than " + std::to_string(BlockGrid::kMost) + " ") +
                          kGridWays[way] + "; there are 1 to " + std::to_string(BlockGrid::kMost),
                      count, count < 1 ? 1 : BlockGrid::kMost);
    counts[way] = std::size_t(std::clamp(count, 1, BlockGrid::kMost));
  }
  return counts;
}

/// Names of blocks, by what their places call them.
void readNames(ObjectReader& reader, BlockGrid& grid) {
  const json* value = reader.member("names");
  if (!value) return;
  const std::string path = reader.path() + ".names";
  if (!value->is_object())
    return reader.complain("names",
                           path + " must tell names by the places of blocks, as {\"column-2\": \"A2\"}");
  std::set<std::string> ids;
  for (const BlockGrid::Cell& cell : grid.cells()) ids.insert(cell.place);
  for (const auto& [place, name] : value->items())
    if (!ids.contains(place))
      return reader.complain("names", path + " names the block \"" + printable(place) +
                                          "\", but the grid has none of that place; take it out");
  for (const auto& [place, name] : value->items()) ids.erase(place);
  for (const auto& [place, name] : value->items()) {
    const std::string entry = path + "." + printable(place);
    if (!name.is_string()) return reader.complain("names", entry + " must be a text");
    const std::string text = name.get<std::string>();
    if (const std::string why = whyNoFileName(text); !why.empty())
      return reader.complain("names", entry + ": " + why);
    if (!ids.insert(text).second)
      return reader.complain(
          "names", entry + " is \"" + text + "\", as another block is called; give each its own name");
    grid.names[place] = text;
  }
}

}  // namespace

void readGrid(ObjectReader& reader, std::optional<BlockGrid>& grid) {
  const json* value = reader.given("grid");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".grid", reader.scope());
  BlockGrid read;
  Eigen::Vector3d degrees = Eigen::Vector3d::Zero();
  inner.vector3("origin", read.origin, -kFarthest, kFarthest);
  inner.vector3("rotation_deg", degrees, -360, 360);
  read.rotation = degrees * kDegree;
  const std::array<std::size_t, 3> counts = readCounts(inner);
  const std::size_t all = counts[0] * counts[1] * counts[2];
  if (all > std::size_t(BlockGrid::kMostBlocks))
    inner.complain("columns",
                   inner.path() + " has " + std::to_string(all) + " blocks (" +
                       counted(counts[0], "columns") + ", " + counted(counts[1], "rows") + ", " +
                       counted(counts[2], "layers") + "); there may be " +
                       std::to_string(BlockGrid::kMostBlocks),
                   double(all), BlockGrid::kMostBlocks);
  for (std::size_t way = 0; way < 3; ++way) {
    read.sizes[way].assign(counts[way], read.sizes[way].front());
    read.gaps[way].assign(counts[way] - 1, 0);
  }
  if (const json* sizes = inner.member("sizes")) {
    ObjectReader part(*sizes, inner.path() + ".sizes", reader.scope());
    for (std::size_t way = 0; way < 3; ++way)
      readLengths(part, way, counts[way], kSmallest, kLargest, read.sizes[way]);
    inner.adopt(part.finish());
  }
  if (const json* gaps = inner.member("gaps")) {
    ObjectReader part(*gaps, inner.path() + ".gaps", reader.scope());
    for (std::size_t way = 0; way < 3; ++way)
      readLengths(part, way, counts[way] - 1, 0, BlockGrid::kMostGap, read.gaps[way]);
    inner.adopt(part.finish());
  }
  if (all <= std::size_t(BlockGrid::kMostBlocks)) readNames(inner, read);
  if (reader.adopt(inner.finish())) grid = std::move(read);
}

json gridJson(const BlockGrid& grid, const BoundBelow& isBound) {
  const auto vector = [](const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); };
  json object = {{"origin", vector(grid.origin)}, {"rotation_deg", vector(degreesThatRead(grid.rotation))}};
  const auto lengths = [&](const std::vector<double>& list, const std::string& place) -> json {
    const bool same = std::ranges::all_of(list, [&](double length) { return length == list.front(); });
    if (list.empty()) return 0;
    return same && !isBound(place + "/") ? json(list.front()) : json(list);
  };
  for (std::size_t way = 0; way < 3; ++way) {
    const std::string name = kGridWays[way];
    object[name] = grid.sizes[way].size();
    object["sizes"][name] = lengths(grid.sizes[way], "/grid/sizes/" + name);
    if (!grid.gaps[way].empty()) object["gaps"][name] = lengths(grid.gaps[way], "/grid/gaps/" + name);
  }
  if (!grid.names.empty()) object["names"] = grid.names;
  return object;
}

}  // namespace bw::detail
