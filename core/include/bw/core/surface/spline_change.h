// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include "bw/core/surface/spline_surface.h"

namespace bw {

/// The rectangle of parameters (u, v) outside of which, and on whose border, two surfaces are the same with
/// their derivatives up to one less than the degree: where the basis functions of all poles that differ live.
/// Empty where no pole differs; all of `after` where degrees, knots or numbers of poles do.
[[nodiscard]] Eigen::AlignedBox2d changedPart(const SplineSurface& before, const SplineSurface& after);

}  // namespace bw
