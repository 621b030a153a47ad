// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/actors/isolines.h"
#include "scene/camera/picking.h"
#include "scene/render/canvas.h"

class vtkRenderer;

namespace bw::scene {

/// The values that stand on isolines: each at a fixed place of its line, where it is seen and there is room.
class IsolineLabels {
 public:
  void addTo(vtkRenderer* renderer) { canvas_.addTo(renderer); }
  /// Chooses the places. `text` gives the words of a level; lines shorter than a share of `diagonal` (mm) get
  /// none.
  void setLines(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
                double diagonal);
  void setVisible(bool on) { visible_ = on; }
  /// Lays them out for a picture. `taken` is what they keep clear of; `seen` tells whether a place is in
  /// sight.
  void update(const Projection& view, int width, int height, double pixelRatio,
              const std::vector<PixelRect>& taken, const std::function<bool(const Eigen::Vector3d&)>& seen);
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  struct Place {
    Eigen::Vector3d point;
    std::string text;
  };
  Canvas canvas_;
  std::vector<Place> places_;  ///< the most important first
  bool visible_ = false;
};

}  // namespace bw::scene
