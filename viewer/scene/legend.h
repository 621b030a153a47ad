// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"
#include "canvas.h"
#include "color_map.h"
#include "ticks.h"

namespace bw::scene {

/// What is known of a field's values, once.
struct FieldSummary {
  double min = 0, max = 0;     ///< of the finite values
  std::size_t count = 0;       ///< of finite values
};
FieldSummary summarize(const std::vector<double>& values);

/// The legend's range for a field: as wished, or round numbers around the data. Deviation is symmetric and shows at least twice the
/// tolerance, so that the band and both colours beyond it are there to read.
std::pair<double, double> legendRangeOf(const std::string& field, const FieldSummary& summary, const Style& style);

/// The round numbers that stand at a legend, and the isolines at them.
Ticks legendTicks(const std::pair<double, double>& range);

/// The colour bar with title, unit, ticks, tolerance marks and histogram, on the right edge.
class Legend {
 public:
  void addTo(vtkRenderer* renderer) { canvas_.addTo(renderer); }
  /// Lays the legend out for a picture of that size; does nothing where nothing changed. `field` may be null: then it is hidden.
  void update(int width, int height, const Style& style, const Field* field, const FieldSummary& summary, const ColorMap& map,
              unsigned contentVersion);
  const std::optional<PixelRect>& card() const { return card_; }
  const std::optional<PixelRect>& bar() const { return bar_; }
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }
  /// Width in pixels that the legend takes from the right edge of a picture, for a camera that must keep clear of it.
  static double reservedWidth(double pixelRatio) { return 150 * pixelRatio; }

 private:
  void draw(int width, int height, const Style& style, const Field& field, const FieldSummary& summary, const ColorMap& map);

  Canvas canvas_;
  std::optional<PixelRect> card_, bar_;
  std::string key_;
};

}  // namespace bw::scene
