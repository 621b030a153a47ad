// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QPointF>

#include <optional>

#include "bw/core/base/frame.h"
#include "bw/view/scene_view.h"

namespace bw::app {

/// Where the ray through a place of the view comes nearest to a line: mm from `through` along `way` (unit).
/// Nothing where the view looks along it.
std::optional<double> alongWay(const view::SceneView& view, const QPointF& position,
                               const Eigen::Vector3d& through, const Eigen::Vector3d& way);

/// Where the ray through a place of the view meets the plane of a frame's x and y, mm from its origin.
/// Nothing where the view looks along the plane.
std::optional<Eigen::Vector2d> inPlane(const view::SceneView& view, const QPointF& position,
                                       const Frame& frame);
/// The angle there about its origin from x on, degrees.
std::optional<double> angleIn(const view::SceneView& view, const QPointF& position, const Frame& frame);

/// Pixels within which a handle that a hand moves is brought in line with what lies there.
inline constexpr double kMeetingReach = 6;

/// How many mm of a way (unit) from there are seen as one pixel.
double mmOfPixel(const view::SceneView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& way);

/// A square on its corner about a place, as it is seen: what lies there was brought in line with something.
scene::Polyline meetingMark(const view::SceneView& view, const Eigen::Vector3d& at);

}  // namespace bw::app
