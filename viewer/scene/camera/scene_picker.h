// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "bw/scene/scene.h"
#include "scene/camera/picking.h"
#include "scene/render/polyline.h"

namespace bw::scene {

/// Finds what of a scene lies under a pixel of its picture: lines before the surfaces they lie on, and
/// neither what something else hides nor what the section takes away.
class ScenePicker {
 public:
  /// What the picture shows; the referred parts are those of the scene. Content and cut mesh stay where they
  /// are until the next reset().
  struct Shown {
    const Content& content;
    const TriangleMesh& cutMesh;  ///< of content.cut
    const Style& style;
    const Field* field;           ///< one of content.cut, for the value under the pixel; or null
    const Polyline& movingBlade;  ///< empty if it is not shown
    Bounds bounds;                ///< of everything
    double targetSetBack;         ///< mm that the target is drawn behind its place
  };

  /// Forgets the surfaces it was asked about; call it when they change. The faces of the file often stay.
  void reset(bool facesToo);
  /// What lies at the pixel (x, y) from the upper left corner. The first call after a reset sorts the
  /// triangles of the surfaces.
  Pick pick(const Shown& shown, const Projection& view, double x, double y) const;
  /// Whether a point of the cut surface, or of a line on it, is in sight: neither hidden by the surface nor
  /// taken away by the section.
  bool sees(const Shown& shown, const Projection& view, const Eigen::Vector3d& point) const;

 private:
  std::optional<RayHit> cutHit(const Shown& shown, const Ray& ray) const;
  std::optional<RayHit> targetHit(const Shown& shown, const Ray& ray) const;

  Pick pickFace(const Shown& shown, const Ray& ray) const;

  mutable std::unique_ptr<TriangleTree> cutTree_, targetTree_, faceTree_;
};

}  // namespace bw::scene
