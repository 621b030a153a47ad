// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "bw/core/shape/designed_surface.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// What a handle of a designed surface moves: a pole its height, a point of a section and the middle of a key
/// blade its place in their plane. Handles are counted row by row, and section by section.
enum class HandleNumber { across, height };

/// The number of a handle; null if it has none.
double* numberOf(DesignedSurface& surface, int handle, HandleNumber number);
std::optional<double> numberOf(const DesignedSurface& surface, int handle, HandleNumber number);

/// The section and the point of it that a handle is; nothing where it is none.
struct SectionPoint {
  int section = 0, point = 0;
};
std::optional<SectionPoint> sectionPointOf(const DesignedSurface& surface, int handle);
/// The handle that such a point is.
int handleOf(const DesignedSurface& surface, const SectionPoint& point);

/// The mirror image of a handle, left and right across the travel: itself in the middle, −1 without one.
int mirrorOf(const DesignedSurface& surface, int handle);

/// Where a number of a handle of the surface at work stands in the file of the design.
NumberPlace placeOf(const Workbench& bench, int handle, HandleNumber number);

/// The surface with some of its handles moved by so many mm: across and up. Cubics of a chain stay in line.
/// `symmetric`: their mirror images with them.
DesignedSurface movedBy(const DesignedSurface& surface, const std::vector<int>& handles,
                        const Eigen::Vector2d& by, bool symmetric);

}  // namespace bw::app
