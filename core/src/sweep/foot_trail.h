// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bw/core/surface/surface_sampler.h"

namespace bw::detail {

/// The feet of a grid of points, row after row, and from them where the foot of the next point will about be:
/// on a straight line with its two predecessors in parameters (docs/mathematics.md, closest points).
class FootTrail {
 public:
  using Foot = SurfaceSampler::Foot;

  explicit FootTrail(int columns);

  /// Where to start from for the next point, or null for the first one. Valid until `put`.
  const Foot* seed();
  /// The foot of the next point, in the order of columns and rows.
  void put(const Foot& foot);

 private:
  std::array<std::vector<Foot>, 3> rows_;  ///< the row of the next point, and the two before it
  std::size_t column_ = 0;
  int above_ = 0;  ///< rows before that are known, at most two
  Foot guess_;
};

}  // namespace bw::detail
