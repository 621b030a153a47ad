// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"
#include "scene/render/polyline.h"

namespace bw::scene {

/// The hot blade: a glowing tube that keeps its width on the screen, with a dark grip at each end.
class MovingBlade {
 public:
  explicit MovingBlade(Layers& layers);
  vtkActor* tube() const { return tube_.actor(); }
  vtkActor* grips() const { return grips_.actor(); }
  void setLine(Polyline line);
  void setStyle(const Style& style, const Rgb& background);
  /// Gives the tube its width for that view.
  void update(const Projection& view, double depthShift);
  const Polyline& line() const { return line_; }

 private:
  Part tube_, grips_, glow_;
  Polyline line_;
  double pixelRatio_ = 1;
};

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
