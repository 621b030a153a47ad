// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "bw/core/base/frame.h"
#include "bw/core/sweep/sweep.h"

namespace bw::detail {

/// Distance of a point to a box in mm, negative inside (docs/mathematics.md, clearance).
[[nodiscard]] double boxDistance(const Box& box, const Eigen::Vector3d& point);

/// What a longer blade would do for grips that lie in or near the block.
struct GripReach {
  std::optional<double> length = std::nullopt;  ///< mm, whole; empty if no length up to Blade::kLongest does
  bool holds = false;  ///< at that length, no blade bends below its radius, snaps or leaves its plane
};

/// The shortest blade, to a hundredth of its length, with which both grips of all stations keep `clearance`
/// mm to the block if their curves are continued as they are. `worst` is the station whose grip is deepest.
/// Cost: some ten evaluations a station, and one of its stability.
[[nodiscard]] GripReach lengthThatClears(const Sweep& sweep, const BladePose& worst, double clearance);

}  // namespace bw::detail
