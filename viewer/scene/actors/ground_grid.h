// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"

namespace bw::scene {

/// The ground below the content: lines at round distances that fade outwards, with coordinates in mm along
/// the two edges that face the camera.
class GroundGrid {
 public:
  explicit GroundGrid(Layers& layers);
  void setBounds(const Bounds& bounds);
  void setStyle(const Style& style);
  /// Places the labels for that view, clear of what is `taken`.
  void update(const Projection& view, int width, int height, const std::vector<PixelRect>& taken);
  const std::vector<Overlay::Text>& texts() const { return labels_.texts(); }
  Bounds bounds() const;  ///< of the lines

 private:
  void rebuild();
  /// Numbers along the edge that runs in the direction of x (`axis` 0) or y (1).
  void labelEdge(int axis, const Projection& view, int width, int height, std::vector<PixelRect>& occupied);

  Part lines_;
  Canvas labels_{true};
  Bounds content_;
  bool visible_ = true, dark_ = false;
  double pixelRatio_ = 1;
  double step_ = 100, z_ = 0, reach_ = 0;
  Eigen::Array2d low_ = Eigen::Array2d::Zero(), high_ = low_;  ///< of the lines that do not fade yet
};

}  // namespace bw::scene
