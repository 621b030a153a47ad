// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "heavy/heavy_path.h"

namespace bw {

using heavy::Equations;
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
  constexpr int kSteps = 8;
  constexpr double kLeastPart = 1.0 / 32;  // of the way
  HeavyBlade::Numbers next = pass.numbers();
  const double length = next.length, squared = length * length;
  const auto nearest = [](double angle, double to) {
    return angle + 2 * kPi * std::round((to - angle) / (2 * kPi));
  };
  Shape shape{next.coefficients, next.endForce * squared};
  next.start = held.grips.start;
  next.startAngle = nearest(*held.grips.startAngle, next.startAngle);
  next.turning = nearest(*held.grips.endAngle - *held.grips.startAngle, next.turning);
  next.load = held.weight / held.stiffness;
  const heavy::Way way{heavy::equationsOf(pass).hold(),
                       {(held.grips.end - next.start) / length, next.startAngle, next.turning,
                        next.load * (squared * length)}};
  heavy::Settling seen;
  double reached = 0, part = 1;
  while (reached < 1) {
    const double aim = std::min(1.0, reached + part);
    std::optional<Shape> there = heavy::settle(way.at(aim), shape, kSteps, &seen);
    if (there) {
      shape = std::move(*there);
      reached = aim;
    } else if ((part /= 2) < kLeastPart) {
      return {};
    }
  }
  const std::optional<Shape> fine = heavy::refined(way.to, shape, heavy::kExact);
  if (!fine) return {};
  // Most passes fall along one direction.
  if (!seen.fallsOddly.value_or(false) &&
      heavy::isStable(Equations(heavy::modesOf(fine->count()), way.to, *fine)))
    return {};
  next.coefficients = fine->coefficients;
  next.endForce = fine->force / squared;
  return HeavyBlade(std::move(next));
}

std::vector<HeavyPass> passesOver(std::span<const HeavyBlade> passes, const HeavyBlade& blade,
                                  double stiffness) {
  const HeavyProblem held = holdOf(blade, stiffness);
  std::vector<HeavyPass> over;
  for (const HeavyBlade& pass : passes)
    if (std::optional<HeavyBlade> there = passAt(pass, held)) {
      const double height = heightOf(*there, blade, stiffness).energy;
      over.push_back({std::move(*there), height});
    }
  return over;
}

}  // namespace bw
