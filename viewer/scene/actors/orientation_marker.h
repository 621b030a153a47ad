// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/canvas.h"
#include "scene/render/vtk_tools.h"

class vtkRenderer;
class vtkTexture;

namespace bw::scene {

/// The cube in the lower left corner that shows how the view is turned; a click on a face takes that view.
class OrientationMarker {
 public:
  OrientationMarker();
  vtkRenderer* renderer() const { return renderer_; }
  void addTo(vtkRenderer* overlay) { canvas_.addTo(overlay); }
  void update(const Projection& view, int width, int height, const Style& style);

  static PixelRect place(int width, int height, double pixelRatio);
  /// The face under a pixel; its corner towards the viewer of the standard oblique view gives that view.
  static std::optional<View> viewAt(double x, double y, const Projection& view, int width, int height,
                                    double pixelRatio);

 private:
  void paintFaces(bool dark, double pixelRatio);

  vtkSmartPointer<vtkRenderer> renderer_;
  std::array<Part, 6> faces_;
  std::array<vtkSmartPointer<vtkTexture>, 6> textures_;
  Part edges_;
  std::array<Part, 3> axes_;
  Canvas canvas_;
  std::optional<bool> dark_;
  double pixelRatio_ = 0;
};

}  // namespace bw::scene
