// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

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

/// Where a section tells little of a blade that is much longer, its nearest curve may swing the blade's ends
/// about although the section hardly changes. Then the shape of the blade moves from the neighbour's towards
/// the nearest one only as far as the ends may turn, if it stays within the tolerance of the section (or as
/// near as the nearest curve, where that is farther); its status then says that a bound is active. Otherwise
/// `nearest` comes back as it is. docs/mathematics.md, sweep.
[[nodiscard]] StationFit besideNeighbour(StationFit nearest, const StationFit& neighbour,
                                         const PlanarCurve& section, const FitRequest& request);

/// The curvature to which a blade is fitted at most, 1/mm: a little less than it bends to.
[[nodiscard]] double curvatureLimit(const FitRequest& request);

/// True if the blade that continues this curve keeps its radius and rests in its shape.
[[nodiscard]] bool bladeHolds(const Elastica& cut, const Blade& blade);

/// `fitted` continued at both ends to the length of the blade; itself where the blade is not longer.
[[nodiscard]] Result<Elastica> extendedBlade(const Elastica& fitted, double bladeLength);

/// A section as 101 points at equal arc length, onto which given shapes are laid.
class Places {
 public:
  explicit Places(const PlanarCurve& section);

  /// `elastica` moved to where its points, equal shares of its length, lie nearest to those of the section,
  /// by least squares (docs/mathematics.md, sweep).
  [[nodiscard]] Elastica laid(const Elastica& elastica) const;
  /// R4 of thesis (3.2) by the trapezoidal rule.
  [[nodiscard]] double residual(const Elastica& elastica) const;
  /// The same of the part of a blade that cuts, with its weight.
  [[nodiscard]] double residual(const BladePose& pose) const;

 private:
  [[nodiscard]] double residual(const std::vector<Eigen::Vector2d>& own, double length) const;

  std::vector<Eigen::Vector2d> points_;
  Eigen::Vector2d centre_;
};

}  // namespace bw::sweep
