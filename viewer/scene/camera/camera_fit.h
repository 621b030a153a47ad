// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"

namespace bw::scene {

/// The camera that looks the way `from` does and has `bounds` (valid) in the picture as large as possible,
/// with some air around. `aspect` is the picture's width by its height, > 0; `rightMargin` is what stays free
/// at the right, as a share of half the width.
Camera fitted(Camera from, const Bounds& bounds, double aspect, double rightMargin);

/// Depths along the view, mm.
struct DepthRange {
  double near, far;
};

/// The depths between which everything in `bounds` (valid) is drawn, with some slack; a perspective camera
/// keeps the near one in front of itself. `distance` is that of the focus, mm.
DepthRange depthRange(const Projection& view, const Bounds& bounds, double distance);

}  // namespace bw::scene
