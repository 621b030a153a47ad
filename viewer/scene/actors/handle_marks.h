// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"

namespace bw::scene {

/// The handles over a picture: discs at their places, thin lines between and beside them, the ways of those
/// that are moved, and words beside the one that is lit.
class HandleMarks {
 public:
  explicit HandleMarks(Layers& layers) { layers.add(Layer::handles, canvas_); }
  void update(const Projection& view, int width, int height, const Style& style,
              const std::vector<PixelRect>& taken);
  const std::optional<PixelRect>& card() const { return card_; }
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  Canvas canvas_;
  std::optional<PixelRect> card_;
};

/// The handle at a pixel, the nearest to the eye of those within reach; −1 if there is none.
int handleAt(const Handles& handles, const Projection& view, double x, double y, double pixelRatio);

}  // namespace bw::scene
