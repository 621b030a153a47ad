// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/block_grid.h"

#include <algorithm>

namespace bw {

namespace {

/// Where each column, row or layer begins, mm.
std::vector<double> beginnings(const std::vector<double>& sizes, const std::vector<double>& gaps) {
  std::vector<double> places = {0};
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i)
    places.push_back(places.back() + sizes[i] + (i < gaps.size() ? gaps[i] : 0));
  return places;
}

}  // namespace

std::vector<BlockGrid::Cell> BlockGrid::cells() const {
  std::array<std::vector<double>, 3> places;
  for (std::size_t way = 0; way < 3; ++way) places[way] = beginnings(sizes[way], gaps[way]);
  const Eigen::Matrix3d turn = rotationFromAngles(rotation);
  std::vector<Cell> all;
  for (std::size_t layer = 0; layer < sizes[2].size(); ++layer)
    for (std::size_t row = 0; row < sizes[1].size(); ++row)
      for (std::size_t column = 0; column < sizes[0].size(); ++column) {
        const std::array index = {column, row, layer};
        Cell& cell = all.emplace_back();
        Eigen::Vector3d corner, size;
        for (std::size_t way = 0; way < 3; ++way) {
          corner(Eigen::Index(way)) = places[way][index[way]];
          size(Eigen::Index(way)) = sizes[way][index[way]];
        }
        cell.place = placeName(index);
        const auto named = names.find(cell.place);
        cell.id = named == names.end() ? cell.place : named->second;
        cell.placement = {origin + turn * corner, size, rotation};
      }
  return all;
}

std::string BlockGrid::placeName(const std::array<std::size_t, 3>& index) const {
  constexpr std::array kOne = {"column-", "row-", "layer-"};
  std::string name;
  for (std::size_t way = 0; way < 3; ++way)
    if (sizes[way].size() > 1)
      name += (name.empty() ? "" : "-") + std::string(kOne[way]) + std::to_string(index[way] + 1);
  return name.empty() ? "block-1" : name;
}

double BlockGrid::extent(std::size_t way) const {
  return beginnings(sizes[way], gaps[way]).back() + sizes[way].back();
}

double BlockGrid::widestGap() const {
  double widest = 0;
  for (const std::vector<double>& way : gaps)
    for (const double gap : way) widest = std::max(widest, gap);
  return widest;
}

}  // namespace bw
