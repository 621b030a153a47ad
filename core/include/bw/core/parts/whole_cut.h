// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/blade_pose.h"
#include "bw/core/sweep/plane_family.h"

namespace bw {

/// All that a blade sweeps of a block, from grip to grip and with its straight travel before and after.
struct WholeCut {
  SurfaceGrid grid;                 ///< rows along the travel, each a blade
  std::vector<double> travel = {};  ///< mm, of each row; ascending
};

/// The blades of a course, and what leads out of the block before and behind: where a course ends in a face
/// of the block it goes on as it comes, where it ends inside the blade is carried straight on. The grid comes
/// out of the block all around, as far as the grips are outside of it. Error `badInput`: fewer than two
/// blades.
[[nodiscard]] Result<WholeCut> wholeCut(const std::vector<BladePose>& course, const PlaneFamily& planes);

}  // namespace bw
