// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/scene/scene.h"
#include "scene/render/vtk_tools.h"

namespace bw::scene {

/// The way the blade goes through the block: an arrow on the ground beside it, on the side that the usual
/// view shows.
class TravelArrow {
 public:
  TravelArrow();
  void addSolidTo(vtkRenderer* renderer);
  /// Hidden without a block or a direction.
  void setContent(const Content& content);
  void setStyle(const Style& style, const Rgb& background);
  /// Where it lies; not valid while it is hidden.
  Bounds bounds() const { return visible_ ? bounds_ : Bounds(); }

 private:
  Part part_;
  Bounds bounds_;  ///< not valid where there is none
  bool visible_ = false;
};

}  // namespace bw::scene
