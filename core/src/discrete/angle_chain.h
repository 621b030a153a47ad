// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <vector>

namespace bw::discrete {

/// A chain of N segments of length 1/N in the unit of its length. Minimises ½ Σ (turning)²/(length) over the
/// segments' angles, with its end point and its end angles given. docs/mathematics.md, discrete elastica.
struct AngleChain {
  int segments = 0;
  bool halfEnds = false;  ///< else the first and the last segment lie along the end tangents
  double startAngle = 0;
  double endAngle = 0;
  Eigen::Vector2d chord = Eigen::Vector2d::Zero();  ///< from start to end, over the length
};

struct ChainSolution {
  std::vector<double> angles;                       ///< one a segment
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< multipliers of the end position
  double energy = 0;
  double closure = 0;
  bool converged = false;
  bool minimum = false;  ///< the second variation is positive under the constraints
  int iterations = 0;
};

/// Newton's method from these angles (one a segment). Each step costs O(N).
ChainSolution solveChain(const AngleChain& chain, std::vector<double> angles);

}  // namespace bw::discrete
