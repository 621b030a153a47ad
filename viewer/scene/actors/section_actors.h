// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkPlane.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <span>

#include "bw/scene/scene.h"
#include "scene/render/vtk_tools.h"

class vtkRenderer;

namespace bw::scene {

/// The plane that cuts a scene open, and what it lays bare: the hatched foam, its outline, and the line of
/// the cut surface in it.
class SectionActors {
 public:
  SectionActors();
  void addTo(vtkRenderer* renderer);

  /// The content is another: what was laid bare is no longer valid.
  void invalidate() { valid_ = false; }
  /// Cuts `clipped` open where the style's section wants it, and makes the cap anew if plane or content
  /// changed. `diagonal` is the size of what is shown, mm: it gives the hatching its distance.
  void setSection(const Content& content, const TriangleMesh& cutMesh,
                  const std::optional<SectionPlane>& plane, std::span<Part* const> clipped, double diagonal);
  void setStyle(const Content& content, const Style& style, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on.
  void update(double line);

 private:
  Part fill_, hatch_, cut_, outline_;
  vtkSmartPointer<vtkPlane> plane_;
  std::optional<SectionPlane> section_;  ///< that the cap was made for
  bool valid_ = false;
};

}  // namespace bw::scene
