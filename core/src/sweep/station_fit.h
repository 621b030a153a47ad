// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/sweep/sweep.h"

namespace bw::detail {

/// How far beyond the tolerance a curve may lie for the sake of a blade that holds.
inline constexpr double kAllowance = 2.0;

/// The fit of one section under a request. It starts from the shape of the neighbour (null for the
/// first section) and, where that looks like the wrong branch, from scratch as well. The blade as a whole has
/// at most two periods. Where the blade that continues the best curve would bend below its radius or not
/// rest, the curvature, and with it more and more tightly the number of periods, are bounded as long as the
/// curve stays within twice the tolerance (docs/mathematics.md, sweep); the status then says that a bound is
/// active. If no such curve is found, the best one.
[[nodiscard]] Result<StationFit> fitStation(const PlanarCurve& section, const FitRequest& request,
                                            const StationFit* neighbour);

/// True if the blade that continues this curve keeps its radius and rests in its shape.
[[nodiscard]] bool bladeHolds(const Elastica& cut, const Blade& blade);

/// `fitted` continued at both ends to the length of the blade; itself where the blade is not longer.
[[nodiscard]] Result<Elastica> extendedBlade(const Elastica& fitted, double bladeLength);

}  // namespace bw::detail
