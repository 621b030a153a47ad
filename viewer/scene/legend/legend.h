// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// The colour bar with title, unit, ticks, tolerance marks and histogram, on the right edge.
class Legend {
 public:
  explicit Legend(Layers& layers) { layers.add(Layer::overlay, canvas_); }
  /// Lays the legend out for a picture of that size; does nothing where nothing changed. `map` may be null:
  /// then it is hidden. `covered`: share of the targets that is cut, said beside their deviation.
  void update(int width, int height, const Style& style, const ShownMap* map,
              const std::optional<double>& covered, unsigned contentVersion);
  const std::optional<PixelRect>& card() const { return card_; }
  const std::optional<PixelRect>& bar() const { return bar_; }
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }
  /// Width in pixels that the legend takes from the right edge of a picture, for a camera that must keep
  /// clear of it.
  static double reservedWidth(double pixelRatio) { return 150 * pixelRatio; }

 private:
  void draw(int width, int height, const Style& style, const ShownMap& shown,
            const std::optional<double>& covered);

  Canvas canvas_;
  std::optional<PixelRect> card_, bar_;
  /// What it was laid out for: size, theme, pixel ratio, map, rows and content.
  std::optional<std::tuple<int, int, bool, double, ColorMap, std::vector<ItemId>, unsigned>> key_;
};

}  // namespace bw::scene
