// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/render/layers.h"
#include "scene/things.h"

namespace bw::scene {

/// The way the blade goes through the block: an arrow on the ground beside it, on the side that the usual
/// view shows.
class TravelArrow {
 public:
  explicit TravelArrow(Layers& layers);
  /// Hidden without a block or a direction; the stock stays where it is until the next call.
  void setContent(const Stock* stock);
  void setStyle(const Style& style, const Rgb& background);
  /// Where it lies; not valid while it is hidden.
  Bounds bounds() const { return visible_ ? bounds_ : Bounds(); }

 private:
  Part part_;
  ItemId id_;
  Bounds bounds_;  ///< not valid where there is none
  bool visible_ = false;
};

}  // namespace bw::scene
