// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "heavy/heavy_equations.h"

namespace bw {

using heavy::Equations;
using heavy::Hold;
using heavy::Shape;

HeavyPassHeight heightOf(const HeavyBlade& pass, const HeavyBlade& blade, double stiffness) {
  const double length = blade.length();
  const Eigen::Vector2d force = pass.numbers().endForce - blade.numbers().endForce;
  const auto moment = [&](double s) { return pass.at(s).curvature - blade.at(s).curvature; };
  HeavyPassHeight height{stiffness * (pass.energy() - blade.energy())};
  height.byGrips << -force.transpose(), -moment(0), force.transpose(), moment(length);
  height.byGrips *= stiffness;
  return height;
}

std::optional<HeavyBlade> passAt(const HeavyBlade& pass, const HeavyProblem& held) {
  constexpr int kSteps = 12;
  const HeavyBlade::Numbers& before = pass.numbers();
  const double length = before.length, squared = length * length;
  HeavyBlade::Numbers next = before;
  next.start = held.grips.start;
  next.startAngle = *held.grips.startAngle;
  const double turns = *held.grips.endAngle - *held.grips.startAngle;
  next.turning = turns + 2 * kPi * std::round((before.turning - turns) / (2 * kPi));
  next.load = held.weight / held.stiffness;
  const Hold hold{(held.grips.end - next.start) / length, next.startAngle, next.turning,
                  next.load * (squared * length)};
  std::optional<Shape> shape = heavy::settle(hold, {before.coefficients, before.endForce * squared}, kSteps);
  if (shape) shape = heavy::refined(hold, *shape, heavy::kExact);
  if (!shape || heavy::isStable(Equations(heavy::modesOf(shape->count()), hold, *shape))) return {};
  next.coefficients = shape->coefficients;
  next.endForce = shape->force / squared;
  return HeavyBlade(std::move(next));
}

}  // namespace bw
