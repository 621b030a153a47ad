// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>

#include "bw/core/base/frame.h"

namespace bw {

/// Where a blade that moves comes into a block.
struct BlockContact {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< in the file's frame, where it first meets it
  double share = 0;                                 ///< of the move, when it does; 0: it begins in the block
  double depth = 0;                                 ///< mm below the nearest face, at most
};

/// That of a blade told by points at equal arc lengths, in the file's frame, each of which goes straight from
/// its place in `from` to that in `to`; none where it stays within 0.05 mm of the outside. What is not moved
/// is looked at where it is. Some µs where it stays away from the block, else 1 ms for 100 mm.
[[nodiscard]] std::optional<BlockContact> contactOnWay(const Box& block,
                                                       std::span<const Eigen::Vector3d> from,
                                                       std::span<const Eigen::Vector3d> to);

}  // namespace bw
