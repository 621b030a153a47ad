// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "bw/scene/scene.h"

/// Camera moves as CAD people know them, as plain functions. The horizon stays level: world z is up.
namespace bw::scene {

/// Turns the camera about `pivot`: `azimuth` (rad) about world z, `elevation` (rad) about the horizontal axis
/// of the picture, stopping where the camera looks straight down or up. Positive azimuth moves the camera
/// counter-clockwise seen from above, positive elevation lifts it.
Camera orbit(const Camera& camera, const Eigen::Vector3d& pivot, double azimuth, double elevation);

/// Moves the camera so that `from` comes to lie where `to` was; both on a plane that faces the camera.
Camera pan(const Camera& camera, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Scales the picture about `anchor`, which keeps its place on the screen. `factor` > 1 comes nearer. The
/// distance stays within [minDistance, maxDistance] (mm).
Camera zoom(const Camera& camera, const Eigen::Vector3d& anchor, double factor, double minDistance,
            double maxDistance);

/// The camera at `t` in [0, 1] on the way from `a` to `b`: the distance changes evenly in ratio, the
/// direction on the shorter way round, the horizon stays level.
Camera between(const Camera& a, const Camera& b, double t);

/// Ease-in-ease-out of [0, 1] onto itself with zero slope at both ends.
double eased(double t);

/// The same view as a parallel or a perspective picture; sizes at the focus stay.
Camera withProjection(const Camera& camera, bool parallel);

/// Millimetres that one pixel covers at the focus, in a picture of that height in pixels.
double pixelSize(const Camera& camera, int height);

}  // namespace bw::scene
