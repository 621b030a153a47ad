// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/in_foam.h"

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

/// Fits station `i` of a row, beside a neighbour's fit or on its own (null): its pose gets the blade that
/// continues the fit. Errors name the station; a section that is longer than the blade is one.
[[nodiscard]] Result<void> fitInto(Sweep& sweep, std::size_t i, const StationFit* neighbour);

/// Lets the blade of station `i` hang between its grips, where it has weight.
void hangInto(Sweep& sweep, std::size_t i);

/// How far the blade of a pose lies from its section: R4, and in the block the distance of its fit.
void compare(const BladePose& pose, const InFoam& foam, StationFit& fit);

/// A section that the blade of the request is too short for: what is `longest` mm needs its clearance
/// besides. Of one that mostly bends sharper than the blade may no longer blade is advised.
[[nodiscard]] Error tooShort(const FitRequest& request, const PlanarCurve& section, const std::string& where,
                             double longest);

/// Calls `find(i, from)` for each station of a row, in two threads: the one with the longest section first,
/// which tells most of the blade (`from` is empty), and then to both ends, each from its neighbour.
[[nodiscard]] Result<void> fromLongest(
    const Sweep& sweep, const RunContext& context,
    const std::function<Result<void>(std::size_t i, std::optional<std::size_t> from)>& find);

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
