// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>

#include "bw/core/base/frame.h"

namespace bw {

/// The faces of a block, by its axes: top and bottom ±z, right and left ±x, back and front ±y.
enum class BlockFace { top, bottom, left, right, front, back };
/// Their words in files, by value.
inline constexpr std::array<const char*, 6> kBlockFaces = {"top", "bottom", "left", "right", "front", "back"};

/// How a block lies while a cut is made: turned so that one of its faces is on top, then about the vertical.
/// The left and the right face come up by a turn about the block's y, all others by one about its x.
struct CutPose {
  BlockFace up = BlockFace::top;
  int quarters = 0;  ///< quarter turns about the vertical then, counter-clockwise seen from above; 0 to 3
  bool operator==(const CutPose&) const = default;

  /// True where the block lies as it is placed.
  bool asPlaced() const { return *this == CutPose(); }
};

/// Which foam stays, seen from the surface of a cut as the block lies for it.
enum class KeptSide { below, above, left, right, front, back };
/// Their words in files, by value.
inline constexpr std::array<const char*, 6> kKeptSides = {"below", "above", "left", "right", "front", "back"};

/// What the turn makes of coordinates of the block: a signed permutation, det 1.
[[nodiscard]] Eigen::Matrix3d turnOf(const CutPose& pose);

/// The same block, told as it lies: its corner is the one at its left, in front and below then, its z the way
/// up. Targets of a program are in that frame.
[[nodiscard]] Box lying(const Box& placed, const CutPose& pose);
/// The block that lies so, as it is placed.
[[nodiscard]] Box placedAs(const Box& lying, const CutPose& pose);

/// The way up, in the file's frame, while the block `lies` so; `up` is that of the design.
[[nodiscard]] Eigen::Vector3d upAs(const Box& lies, const CutPose& pose, const Eigen::Vector3d& up);

/// The way from the surface to the foam that stays: unit, in the file's frame.
[[nodiscard]] Eigen::Vector3d keptWay(const Box& lies, KeptSide side);

}  // namespace bw
