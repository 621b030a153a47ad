// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>

namespace bw::detail {

/// A boundary value problem in the frame of its start, the length its unit.
struct UnitProblem {
  Eigen::Vector2d end;  ///< where the blade ends
  double turning = 0;   ///< from the start tangent to the end tangent, rad

  UnitProblem mirrored() const { return {{end.x(), -end.y()}, -turning}; }
};

/// κ, f_t, f_n at the start of a segment of length 1 (docs/mathematics.md, 1).
using UnitShape = Eigen::Vector3d;

inline UnitShape mirrored(const UnitShape& q) { return {-q(0), q(1), -q(2)}; }

/// Twice the largest |κ| of the whole curve's halves and √f: what decides how many modes resolve it.
double phaseOf(const UnitShape& shape);

/// Where a shape ends: x, y, ψ with the derivatives by (κ, f_t, f_n).
struct UnitShot {
  Eigen::Vector3d end;
  Eigen::Matrix3d jacobian;
  double curvature = 0;  ///< at the end
};

/// Largest (|κ| + √f) L that is shot at.
inline constexpr double kLargestShot = 60;

UnitShot shoot(const UnitShape& shape);

/// A shape that meets its problem, as seen from either end: a taut blade forgets its start on the way to its
/// end.
struct UnitSolution {
  UnitShape shape = UnitShape::Zero();
  UnitShape back = UnitShape::Zero();  ///< of the same curve run backwards
  double turning = 0;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  double error = 0;  ///< largest of the end's misses, in lengths and rad
  /// Tangent angle of the straight stretch between the bends at the grips, where the blade is so taut that
  /// there is one.
  std::optional<double> straightAngle = std::nullopt;
};

/// Newton's method from `shape`; empty if it does not settle within `iterations`.
[[nodiscard]] std::optional<UnitSolution> settle(const UnitProblem& problem, UnitShape shape, int iterations);

/// The shape of the same curve run backwards, from what it has at its end.
UnitShape backOf(const UnitShape& shape, double turning, double endCurvature);

/// How far the halves of a solution, each shot from its own end, miss each other in the middle: lengths and
/// rad.
double gapInTheMiddle(const UnitProblem& problem, const UnitSolution& solution);

}  // namespace bw::detail
