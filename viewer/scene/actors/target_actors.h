// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// A target surface and its borders.
class TargetActors {
 public:
  explicit TargetActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 2> parts() { return {&surface_, &edges_}; }
  /// Shares the arrays of the mesh; null hides it.
  void setContent(const ShownTarget* target);
  void setStyle(const Style& style);
  /// Depths of what lies behind its place, as Part::setDepthBehind, and of a line on the surface.
  void update(double behind, double line);

 private:
  Part surface_, edges_;
  std::vector<Eigen::Vector3d> normals_;  ///< where the mesh has none
  const ShownTarget* target_ = nullptr;
};

}  // namespace bw::scene
