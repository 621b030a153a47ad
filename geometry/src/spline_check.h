// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// Whether a file can hold the surface: counts that fit together, knots in order and clamped, finite poles.
/// The error says what does not fit.
Result<void> checkSplineSurface(const SplineSurface& surface);

}  // namespace bw::geometry
