// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "bw/core/shape/designed_surface.h"
#include "workflow/bound_number.h"

namespace bw::app {

/// What a handle of a designed surface moves: a pole its height, a point of a section and the middle of a key
/// blade its place in their plane, an end of a key blade its height, about which the blade turns as it is
/// about its other end. Handles are counted row by row, section by section, and the ends of key blades after
/// all middles, left and right of each.
enum class HandleNumber { across, height };

/// The designed surface at work; null where that is a file's.
const DesignedSurface* surfaceOf(const Workbench& bench);
/// Where its handles lie, mm in the file's frame.
std::vector<Eigen::Vector3d> placesOf(const DesignedSurface& surface);

/// The number of a handle; nothing if it has none.
std::optional<double> numberOf(const DesignedSurface& surface, int handle, HandleNumber number);

/// Gives a number that a handle has another value.
void setNumber(DesignedSurface& surface, int handle, HandleNumber number, double to);

/// The key blade that a handle is of; nothing where it is none.
std::optional<int> bladeOf(const DesignedSurface& surface, int handle);
/// Whether it is an end of one, and which: 0 left, 1 right.
std::optional<int> endOf(const DesignedSurface& surface, int handle);
/// The ends of a key blade, in its plane; its middle for both where it makes no curve.
std::array<Eigen::Vector2d, 2> endsOf(const KeyBlade& blade);

/// The section and the point of it that a handle is; nothing where it is none.
struct SectionPoint {
  int section = 0, point = 0;
};
std::optional<SectionPoint> sectionPointOf(const DesignedSurface& surface, int handle);
/// The handle that such a point is.
int handleOf(const DesignedSurface& surface, const SectionPoint& point);

/// What a handle is of, counted along the travel: its row of poles, its section or its key blade.
std::optional<int> entryOf(const DesignedSurface& surface, int handle);

/// The mirror image of a handle, left and right across the travel: itself in the middle, −1 without one.
int mirrorOf(const DesignedSurface& surface, int handle);

/// Where the height of an end of a key blade, 0 left, 1 right, stands in the file of the design if it is told
/// by an expression.
NumberPlace placeOfEnd(const Workbench& bench, int blade, int end);
/// Where a number of a handle of the surface at work stands there.
NumberPlace placeOf(const Workbench& bench, int handle, HandleNumber number);

/// Whether the points of sections stand across the travel in the order in which they stood: none has come
/// nearer than 1 mm to its neighbour that was not.
bool keepsOrder(const DesignedSurface& was, const DesignedSurface& now);

/// The surface with some of its handles moved by so many mm: across and up. Cubics of a chain stay in line.
/// `symmetric`: their mirror images with them.
DesignedSurface movedBy(const DesignedSurface& surface, const std::vector<int>& handles,
                        const Eigen::Vector2d& by, bool symmetric);

}  // namespace bw::app
