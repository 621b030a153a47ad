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
#include "scene/render/layers.h"

namespace bw::scene {

/// The values that stand on isolines: each at a fixed place of its line, where it is seen and there is room.
class IsolineLabels {
 public:
  explicit IsolineLabels(Layers& layers) { layers.add(Layer::overlay, canvas_); }
  void clear() { places_.clear(); }
  /// Chooses places on more lines. `text` gives the words of a level; lines shorter than a share of
  /// `diagonal` (mm) get none.
  void add(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
           double diagonal);
  /// Lays them out for a picture. `taken` is what they keep clear of; `seen` tells whether a place is in
  /// sight.
  void update(const Projection& view, int width, int height, double pixelRatio,
              const std::vector<PixelRect>& taken, const std::function<bool(const Eigen::Vector3d&)>& seen);
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  struct Place {
    Eigen::Vector3d point;
    std::string text;
    double rank;
  };
  Canvas canvas_;
  std::vector<Place> places_;  ///< the most important first
};

}  // namespace bw::scene
