// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "bw/core/elastica/elastica.h"
#include "elastica/clamped_modes.h"
#include "elastica/elastica_flow.h"

namespace bw::elastica {

/// A boundary value problem in the frame of its start, the length its unit.
struct UnitProblem {
  Eigen::Vector2d end;  ///< where the blade ends; if it holds no tangent, only the distance counts
  double turning = 0;   ///< from the start tangent to the end tangent, rad, if both are held
  HeldEnds ends = HeldEnds::both;

  UnitProblem mirrored() const { return {{end.x(), -end.y()}, -turning, ends}; }
};

/// κ, f_t, f_n at the start of a segment of length 1 (docs/mathematics.md, 1).
using UnitShape = Eigen::Vector3d;

inline UnitShape mirrored(const UnitShape& q) { return {-q(0), q(1), -q(2)}; }

/// The flow of a shape, and the unit of its lengths: a power of two that fits it.
template <int Directions, std::size_t Order = 22>
std::pair<ElasticaFlow<Directions, Order>, double> flowOf(const UnitShape& q) {
  const double rate = std::max({std::abs(q(0)), std::sqrt(std::hypot(q(1), q(2))), 1.0});
  const double unit = std::ldexp(1.0, -std::ilogb(rate) - 1);
  const FlowParameters p{q(0) * unit, q(1) * unit * unit, q(2) * unit * unit};
  return {ElasticaFlow<Directions, Order>(p, invariants(p.curvature, p.tangential, p.normal), 1), unit};
}

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

/// What the ends hold of a shape: x, y and ψ of its end; with a hinged end x, y and κ there; with both hinged
/// the distance of the ends and κ at both.
struct Held {
  Eigen::Vector3d value;
  Eigen::Matrix3d slope;  ///< by (κ, f_t, f_n)
};

/// Of a shape that ends at (x, y, ψ) with this Jacobian.
Held heldAt(const UnitShape& shape, const Eigen::Vector3d& end, const Eigen::Matrix3d& jacobian,
            HeldEnds ends);
/// What the problem's ends hold.
Eigen::Vector3d heldBy(const UnitProblem& problem);

/// A blade pulled taut: a bend at each grip, against the straight stretch between them.
struct TautBends {
  double first = 0, second = 0;  ///< tangent angles at the grips against the stretch, rad; 0 at a hinge
  double root = 0;               ///< √f L
};

/// A shape that meets its problem.
struct UnitSolution {
  UnitShape shape = UnitShape::Zero();
  double turning = 0;
  double error = 0;  ///< largest of the end's misses, in lengths and rad
  HeldEnds ends = HeldEnds::both;
  /// What holds the curve where the start does not, in the frame of the start with the length as unit.
  std::optional<Elastica::Anchor> anchor = std::nullopt;
  std::optional<TautBends> bends = std::nullopt;  ///< where they do not know of each other
};

/// Newton's method from `shape`; empty if it does not settle within `iterations`, or comes so near to one of
/// `known` that it becomes that.
[[nodiscard]] std::optional<UnitSolution> settle(const UnitProblem& problem, UnitShape shape, int iterations,
                                                 std::span<const UnitSolution> known = {});

/// The same on κ, f_t, f_n at the middle, from where both grips are aimed at: for blades so taut that their
/// start does not tell their end. Both tangents held; the curve is told by an anchor in the middle.
[[nodiscard]] std::optional<UnitSolution> settleFromMiddle(const UnitProblem& problem, UnitShape middle);

}  // namespace bw::elastica
