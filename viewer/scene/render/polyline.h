// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "bw/scene/scene.h"

namespace bw::scene {

using Segments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// At least two points, all of them finite.
bool usable(const Polyline& line);

/// Along its points.
double lengthOf(const Polyline& line);

/// The twelve edges of a box.
Segments edgesOf(const Box& box);

/// The share [first, second] of the way `along` from `from`, both in the frame of a box of that size, which
/// lies in the box and within [least, most]; first > second where there is none.
std::pair<double, double> shareInBox(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                                     const Eigen::Vector3d& size, double least, double most);

/// Cuts a polyline into dashes. Lengths in mm; it begins with a dash.
Segments dashes(const Polyline& line, double dash, double gap);

/// The two extensions of a blade beyond the ends of its station, each from the station outwards; the whole
/// blade if the station is not usable.
std::vector<Polyline> beyondStation(const Polyline& blade, const Polyline& station);

/// The pieces of a line inside or outside a box, cut at its faces.
enum class Side { inside, outside };
std::vector<Polyline> clipped(const Polyline& line, const Box& box, Side side);

/// The blade's line at a fractional station, linear between neighbours. Lines with different numbers of
/// points are joined at equal shares of their length.
Polyline bladeAt(const std::vector<Polyline>& blades, double playhead);

}  // namespace bw::scene
