// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"

namespace bw::scene {

/// The place of a finding over the picture: a ring at the point and a card with its words beside it, joined
/// by a line.
class PlaceMarker {
 public:
  explicit PlaceMarker(Layers& layers) { layers.add(Layer::handles, canvas_); }
  /// Lays it out; the card keeps clear of `taken` where it can. Hidden without a marker, and where the point
  /// lies behind the eye or outside the picture.
  void update(const Projection& view, int width, int height, const Style& style,
              const std::vector<PixelRect>& taken);
  const std::optional<PixelRect>& ring() const { return ring_; }
  const std::optional<PixelRect>& card() const { return card_; }
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  Canvas canvas_;
  std::optional<PixelRect> ring_, card_;
};

}  // namespace bw::scene
