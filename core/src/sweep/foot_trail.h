// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "bw/core/surface/surface_sampler.h"

namespace bw::sweep {

/// The feet of a grid of points, row after row, and from them where the foot of the next point will about be:
/// on a straight line with its two predecessors in parameters (docs/mathematics.md, closest points).
class FootTrail {
 public:
  using Foot = SurfaceSampler::Foot;

  explicit FootTrail(int columns) {
    for (std::vector<Foot>& row : rows_) row.resize(std::size_t(columns));
  }

  /// Where to start from for the next point, or null for the first one. Valid until `put`.
  const Foot* seed() {
    const auto& [now, up, farUp] = rows_;
    const std::size_t c = column_;
    if (above_ == 0 && c == 0) return nullptr;
    guess_ = above_ > 0 ? up[c] : now[c - 1];
    // A step over to another face has no parameters in common; one around a closed face is a whole period,
    // which the sampler takes back.
    const auto moved = [&](const Foot& to, const Foot& from) {
      if (to.face == guess_.face && from.face == guess_.face) guess_.uv += to.uv - from.uv;
    };
    if (above_ == 2) {
      moved(up[c], farUp[c]);
    } else if (above_ == 1) {
      if (c > 0) moved(now[c - 1], up[c - 1]);
    } else if (c > 1) {
      moved(now[c - 1], now[c - 2]);
    }
    return &guess_;
  }
  /// The foot of the next point, in the order of columns and rows.
  void put(const Foot& foot) {
    rows_[0][column_] = foot;
    if (++column_ < rows_[0].size()) return;
    column_ = 0;
    above_ = std::min(above_ + 1, 2);
    std::swap(rows_[1], rows_[2]);
    std::swap(rows_[0], rows_[1]);
  }

 private:
  std::array<std::vector<Foot>, 3> rows_;  ///< the row of the next point, and the two before it
  std::size_t column_ = 0;
  int above_ = 0;  ///< rows before that are known, at most two
  Foot guess_;
};

}  // namespace bw::sweep
