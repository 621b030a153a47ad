// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"

namespace bw::fit {

/// Points of a curve at equal arc length, ends included, from which the one-sided Hausdorff distance is
/// taken.
inline constexpr int kHausdorffPoints = 1000;

/// A curve that is told by its states at arc lengths in [0, length].
struct Along {
  double length = 1;  ///< mm
  std::function<void(std::span<const double> arcs, std::span<Elastica::State> out)> at;
};

/// The largest distance (mm) of those points to the curve. Cheap: only the points that can be the farthest
/// are looked at closely.
double oneSidedHausdorff(const Along& along, const PlanarCurve& curve);
double oneSidedHausdorff(const Elastica& elastica, const PlanarCurve& curve);

}  // namespace bw::fit
