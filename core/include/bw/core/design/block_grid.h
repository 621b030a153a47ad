// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bw/core/base/frame.h"

namespace bw {

/// Blocks of foam side by side, in columns along the x of the grid, rows along its y and layers along its z,
/// each with a size of its own and gaps between.
struct BlockGrid {
  static constexpr int kMost = 100;         ///< columns, rows or layers
  static constexpr int kMostBlocks = 2500;  ///< of them all
  static constexpr double kMostGap = 1000;  ///< mm

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< the corner of the first block, mm
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rad, as that of a block
  /// mm, of the columns, the rows and the layers: one each at least.
  std::array<std::vector<double>, 3> sizes = {{{600}, {800}, {500}}};
  /// mm between neighbours: one fewer.
  std::array<std::vector<double>, 3> gaps = {};
  /// Of blocks that have one, by what their place calls them.
  std::map<std::string, std::string> names = {};
  bool operator==(const BlockGrid&) const = default;

  struct Cell {
    std::string id;     ///< its name, or what its place calls it
    std::string place;  ///< "column-2", "column-2-row-1": of the ways that have more than one
    BlockPlacement placement;
  };
  /// All blocks: columns first, then rows, then layers.
  std::vector<Cell> cells() const;
  /// What the place of a block calls it, by its column, row and layer from 0.
  std::string placeName(const std::array<std::size_t, 3>& index) const;
  std::size_t count() const { return sizes[0].size() * sizes[1].size() * sizes[2].size(); }
  /// mm from its first face along a way (0 columns, 1 rows, 2 layers) to its last.
  double extent(std::size_t way) const;
  /// mm, the widest of its gaps.
  double widestGap() const;
};

/// The words of the three ways in files and ids, in the order of `BlockGrid::sizes`.
inline constexpr std::array<const char*, 3> kGridWays = {"columns", "rows", "layers"};

}  // namespace bw
