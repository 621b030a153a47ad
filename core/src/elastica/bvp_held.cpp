// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_held.h"

#include <cmath>

#include "bw/core/base/units.h"
#include "elastica/bvp_taut.h"

namespace bw::detail {

namespace {

/// A blade is between its grips if it misses them by no more than this, in lengths and rad; at hinges, of the
/// curvature against its size.
constexpr double kBetween = 1e-7;
/// A shape that moved by more than this, in parts of its size, is another one.
constexpr double kSameShape = 1e-4;

bool sameShape(const UnitShape& a, const UnitShape& b) {
  return (a - b).norm() <= kSameShape * (1 + a.norm());
}

}  // namespace

std::optional<UnitSolution> heldAlready(const Elastica& blade, const ClampedProblem& problem,
                                        const CheckedProblem& checked) {
  const double length = blade.length();
  const Elastica::State end = blade.at(length);
  const double turning = end.angle - blade.startAngle();
  const double turns = turning - checked.turning;
  const double size = 1 / length + std::sqrt(blade.force().norm());
  const double misses[] = {length / problem.length - 1, (blade.start() - problem.start).norm() / length,
                           (end.point - problem.end).norm() / length,
                           problem.startAngle
                               ? std::remainder(blade.startAngle() - *problem.startAngle, 2 * kPi)
                               : blade.at(0).curvature / size,
                           !problem.endAngle      ? end.curvature / size
                           : checked.fixedTurning ? turns
                                                  : std::remainder(turns, 2 * kPi)};
  for (const double miss : misses)
    if (!(std::abs(miss) <= kBetween)) return std::nullopt;

  const double whole = 2 * kPi * std::round((turning - checked.turning) / (2 * kPi));
  const bool both = checked.ends == HeldEnds::both;
  const UnitProblem unit{checked.end, both ? checked.turning + whole : 0, checked.ends};
  const Elastica scaled = blade.transformed(-blade.startAngle(), 1 / length, {0, 0});
  UnitSolution own;
  own.shape << scaled.startCurvature(), scaled.force();
  own.turning = both ? unit.turning : turning;
  own.ends = checked.ends;
  if (!blade.anchor()) return settle(unit, own.shape, 6);
  for (const TautBends& bends : checked.ends == HeldEnds::none ? std::vector<TautBends>() : tautBends(unit))
    if (const std::optional<UnitSolution> taut = tautShape(unit, bends);
        taut && sameShape(taut->shape, own.shape))
      return taut;
  const Elastica moved = scaled.transformed(0, 1, -scaled.start());
  own.anchor = *moved.anchor();
  own.error = (moved.at(1).point - unit.end).norm();
  return own;
}

}  // namespace bw::detail
