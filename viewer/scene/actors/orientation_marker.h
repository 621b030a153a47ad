// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"

class vtkTexture;

namespace bw::scene {

/// The cube in the lower left corner that shows how the view is turned; a click on a face, an edge
/// or a corner looks from there.
class OrientationMarker {
 public:
  explicit OrientationMarker(Layers& layers);
  vtkRenderer* renderer() const { return renderer_; }
  void update(const Projection& view, int width, int height, const Style& style);

  static PixelRect place(int height, double pixelRatio);
  /// The direction to look from that lies under a pixel: a face, an edge or a corner (Scene::cubeDirection).
  static std::optional<Eigen::Vector3d> directionAt(double x, double y, const Projection& view, int width,
                                                    int height, double pixelRatio);
  /// Lights up what stands for that direction, or nothing.
  void setHovered(const std::optional<Eigen::Vector3d>& direction);

 private:
  void paintFaces(bool dark, double pixelRatio);

  vtkSmartPointer<vtkRenderer> renderer_;
  std::array<Part, 6> faces_;
  std::array<vtkSmartPointer<vtkTexture>, 6> textures_;
  Part edges_, hovered_;
  std::array<Part, 3> axes_;
  Canvas canvas_;
  std::optional<bool> dark_;
  double pixelRatio_ = 0;
};

}  // namespace bw::scene
