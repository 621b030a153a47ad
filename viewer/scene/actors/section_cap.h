// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/frame.h"
#include "bw/core/surface/mesh.h"
#include "bw/scene/scene.h"
#include "scene/render/polyline.h"

namespace bw::scene {

/// What a plane meets: the foam it cuts through and the line of the cut surface in it.
struct SectionCap {
  Polyline outline;  ///< of the block, closed without repeating its first point; empty if the plane misses it
  Segments cut;      ///< of the cut surface
  Segments hatch;    ///< the two pieces of foam on either side of the cut, hatched across each other
};

/// Cuts block and surface by a plane. `spacing` is the distance of the hatching's lines, mm. A surface that
/// ends inside the block by less than a hundredth of its diagonal counts as cutting it through.
SectionCap sectionCap(const Box& block, const TriangleMesh& cut, const SectionPlane& plane, double spacing);

}  // namespace bw::scene
