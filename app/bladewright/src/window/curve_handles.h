// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "bw/core/shape/designed_surface.h"
#include "bw/scene/scene.h"
#include "workbench/workbench.h"

namespace bw::app {

// The curves that tell a designed surface (`bw/core/design/surface_curves.h`) and their handles; both count
// from 0.

/// All handles of a curve; of a key blade its middle comes last.
std::vector<int> handlesOf(const DesignedSurface& surface, int curve);

/// The curve that handles are of; nothing if they are of several, or there are none.
std::optional<int> curveOf(const DesignedSurface& surface, const std::vector<int>& handles);

/// Of the handles of the surface at work, which stand in a style, leaves out those of curves that are hidden,
/// and tells beside the one that is lit where it is locked.
void markCurves(const Workbench& bench, scene::Handles& handles);

}  // namespace bw::app
