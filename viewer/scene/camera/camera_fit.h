// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"

namespace bw::scene {

std::vector<Eigen::Vector3d> cornersOf(const Bounds& bounds);

/// What holds both; those of nothing hold nothing.
Bounds joined(const Bounds& a, const Bounds& b);
/// What holds those of the points that are finite.
Bounds boundsOf(const std::vector<Eigen::Vector3d>& points);

/// The camera that looks the way `from` does and has `points` (at least one) in the picture as large as
/// possible, with some air around. `aspect` is the picture's width by its height, > 0; `rightMargin` is what
/// stays free at the right, as a share of half the width.
Camera fitted(Camera from, const std::vector<Eigen::Vector3d>& points, double aspect, double rightMargin);

/// Depths along the view, mm.
struct DepthRange {
  double near, far;
};

/// The depths between which everything in `bounds` (valid) is drawn, with some slack; a perspective camera
/// keeps the near one in front of itself. `distance` is that of the focus, mm.
DepthRange depthRange(const Projection& view, const Bounds& bounds, double distance);

/// The share of the rectangle that `bounds` (valid) take in a picture of that size which lies inside it; 0
/// where a part of them is behind the eye of a perspective camera.
double seenShare(const Projection& view, const Bounds& bounds, int width, int height);

/// Depths of a part of the scene along the view, without slack.
DepthRange depthsOf(const Projection& view, const Bounds& bounds);

/// The share of the way to the far plane by which depths must move so that whatever lies at the depths of
/// `part` gets at least `back` mm behind its place, as far as there is room before the far plane. `all` are
/// the depths between which is drawn. In [0, 1); an infinite `back` gives the most that is possible.
double shareBehind(const DepthRange& all, const DepthRange& part, double back, bool parallel);

}  // namespace bw::scene
