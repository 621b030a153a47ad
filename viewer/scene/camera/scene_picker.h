// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>

#include "scene/camera/picking.h"
#include "scene/render/polyline.h"
#include "scene/things.h"

namespace bw::scene {

/// Finds what of a scene lies under a pixel of its picture: lines before the surfaces they lie on, and
/// neither what something else hides nor what the section takes away.
class ScenePicker {
 public:
  /// What the picture shows; the referred parts are those of the scene. Things stay where they are until the
  /// next reset().
  struct Shown {
    const Things& things;
    const Style& style;
    const Polyline& movingBlade;  ///< empty if it is not shown
    Bounds bounds;                ///< of everything
    double targetSetBack;         ///< mm that targets are drawn behind their place
  };

  /// Forgets the surfaces it was asked about, but for one that may be null; call it when they change.
  void reset(const TriangleMesh* kept);
  /// What lies at the pixel (x, y) from the upper left corner. The first call after a reset sorts the
  /// triangles of the surfaces.
  Pick pick(const Shown& shown, const Projection& view, double x, double y) const;
  /// Whether a point of a cut surface, or of a line on it, is in sight: neither hidden by one nor taken away
  /// by the section.
  bool sees(const Shown& shown, const Projection& view, const Eigen::Vector3d& point) const;

 private:
  /// The first thing of a sort that a ray meets.
  template <class Thing>
  struct Hit : RayHit {
    const Thing* thing;
  };
  std::optional<RayHit> hit(const TriangleMesh& mesh, const Shown& shown, const Ray& ray) const;
  template <class Range>
  auto firstOf(const Range& things, Kind kind, const Shown& shown, const Ray& ray) const;
  Pick pickFace(const Shown& shown, const Ray& ray) const;

  mutable std::map<const TriangleMesh*, TriangleTree> trees_;
};

}  // namespace bw::scene
