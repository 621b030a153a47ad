// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/layers.h"

#include <vtkPropCollection.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace bw::scene {

void Layers::place(Props& props, Layer layer, vtkProp* prop) {
  const auto after = std::upper_bound(props.begin(), props.end(), layer,
                                      [](Layer l, const auto& other) { return l < other.first; });
  // What comes after it moves to the end of VTK's list, past the new one.
  for (auto next = props.insert(after, {layer, prop}); next != props.end(); ++next) {
    renderer_->GetViewProps()->RemoveItem(next->second);
    renderer_->AddViewProp(next->second);
  }
}

}  // namespace bw::scene
