// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

#include "elastica/bvp_unit.h"

namespace bw::elastica {

inline constexpr int kSketchModes = 10;

/// A blade between its grips in few unknowns: tangent angle turning · s + Σ c_j φ_j(s).
/// docs/mathematics.md, 6.
struct Sketch {
  using Coefficients = Eigen::Matrix<double, kSketchModes, 1>;
  Coefficients coefficients = Coefficients::Zero();
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double energy = 0;
};

/// Where descents start: the two stable blades of the theory of small angles first, then shapes of two modes,
/// by energy.
std::vector<Sketch> firstSketches(const UnitProblem& problem);

/// Descends from a sketch to a blade of locally least energy that ends where it should. False if it finds
/// none.
bool descend(const UnitProblem& problem, Sketch& sketch);

/// The sketch as a start for Newton's method.
UnitShape shapeOf(const UnitProblem& problem, const Sketch& sketch);

}  // namespace bw::elastica
