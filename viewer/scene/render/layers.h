// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkPropCollection.h>
#include <vtkRenderer.h>

#include <map>

#include "scene/render/canvas.h"
#include "scene/render/vtk_tools.h"

namespace bw::scene {

/// What is drawn after what. Things of the world come first: what is solid, then what lets light through,
/// from the back to the front. Over the world lies what tells of it, and over all of it stand the handles:
/// what marks or moves a place.
enum class Layer {
  ground,
  cut,
  section,
  blade,
  travel,
  blockBack,
  faces,
  target,
  stations,
  glow,
  blockFront,
  overlay,
  handles
};

/// Draws parts and canvases in the order of their layers, and in the order in which they came within one.
/// What was added stays: what VTK holds in the graphics card for it goes with the context.
class Layers {
 public:
  explicit Layers(vtkRenderer* renderer) : renderer_(renderer) {}
  void add(Layer layer, Part& part) { place(parts_, layer, part.actor()); }
  /// Canvases are added before the first picture: their texts come into being with what they show.
  void add(Layer layer, Canvas& canvas) { place(canvases_, layer, canvas.drawnBy(renderer_)); }

 private:
  using Props = std::multimap<Layer, vtkProp*>;
  void place(Props& props, Layer layer, vtkProp* prop) {
    // What comes after it moves to the end of VTK's list, past the new one.
    for (auto next = props.emplace(layer, prop); next != props.end(); ++next) {
      renderer_->GetViewProps()->RemoveItem(next->second);
      renderer_->AddViewProp(next->second);
    }
  }

  vtkRenderer* renderer_;
  Props parts_, canvases_;
};

}  // namespace bw::scene
