// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// Whether a file can hold the surface: counts that fit together, knots in order and clamped, finite poles.
/// The error says what does not fit.
Result<void> checkSplineSurface(const SplineSurface& surface);

/// Adds the distinct knots of a flat list and how often each stands there.
void packKnots(const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& counts);

}  // namespace bw::geometry
