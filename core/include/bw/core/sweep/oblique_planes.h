// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"
#include "bw/core/sweep/plane_family.h"

namespace bw {

/// True of planes that are parallel to no face of the block, where they are those of the direction.
[[nodiscard]] inline bool areOblique(const PlaneFamily& planes, const Box& block) {
  constexpr double kAlongEdge = 1e-12;  // by which the cosine to an edge of the block may lack 1
  const Eigen::Vector3d along = block.frame.toLocal(block.frame.origin + planes.direction());
  return along.cwiseAbs().maxCoeff() < 1 - kAlongEdge;
}

}  // namespace bw
