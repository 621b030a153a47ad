// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/curve/planar_curve.h"

namespace bw {

/// All that a plane cuts of the target, in the coordinates of `frame`. `travel` is the position (mm) along
/// the cutting direction.
struct Section {
  int index = 0;
  double travel = 0;
  Frame frame;
  std::vector<PlanarCurve> branches;  ///< splines where the blade may follow them, else chains of points
  int chosen = 0;                     ///< the branch that the blade follows; −1 where none is clearly meant
  /// That branch with the surface beyond the block at both ends; empty where nobody asked for it.
  std::optional<PlanarCurve> beyond = std::nullopt;

  const PlanarCurve& curve() const { return branches[std::size_t(chosen)]; }
  PlanarCurve& curve() { return branches[std::size_t(chosen)]; }
};

}  // namespace bw
