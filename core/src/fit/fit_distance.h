// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw::fit {

/// Points of the elastica at equal arc length, ends included, from which the one-sided Hausdorff distance is
/// taken.
inline constexpr int kHausdorffPoints = 1000;

/// The largest distance (mm) of those points to the curve. Cheap: only the points that can be the farthest
/// are looked at closely.
double oneSidedHausdorff(const Elastica& elastica, const PlanarCurve& curve);

}  // namespace bw::fit
