// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace bw::scene
