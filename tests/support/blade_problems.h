// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"

/// Boundary value problems of a blade, and what every answer to one must hold.
namespace bw::test {

constexpr double kBlade = 800;  ///< mm
const std::optional<double> kHinged = std::nullopt;

/// A blade whose grips are a share of its length apart, angles in rad from the line between them.
inline ClampedProblem across(double share, std::optional<double> startAngle, std::optional<double> endAngle,
                             double length = kBlade) {
  return {{0, 0}, {share * length, 0}, startAngle, endAngle, length, {}};
}

inline ClampedOptions from(const Elastica& blade) {
  ClampedOptions options;
  options.initial = blade;
  return options;
}

/// Whether nine points of two blades agree to a share of the length.
inline bool same(const Elastica& a, const Elastica& b, double tolerance) {
  for (int i = 0; i <= 8; ++i) {
    const double s = i / 8.0;
    if ((a.point(s * a.length()) - b.point(s * b.length())).norm() > tolerance * a.length()) return false;
  }
  return true;
}

/// Ends to 1e-9 of the length, angles that are held to 1e-9, curvatures at hinges to 1e-8 of the blade's
/// size.
inline void expectSolves(const ClampedSolution& solution, const ClampedProblem& problem) {
  const Elastica& e = solution.elastica;
  const Elastica::State start = e.at(0), end = e.at(e.length());
  EXPECT_EQ(e.length(), problem.length);
  EXPECT_NEAR((start.point - problem.start).norm(), 0, 1e-9 * e.length());
  EXPECT_NEAR((end.point - problem.end).norm(), 0, 1e-9 * e.length());
  const double size = 1 / e.length() + std::sqrt(e.force().norm());
  if (problem.startAngle) {
    EXPECT_NEAR(std::remainder(start.angle - *problem.startAngle, 2 * kPi), 0, 1e-9);
  } else {
    EXPECT_NEAR(start.curvature, 0, 1e-8 * size);
  }
  if (problem.endAngle) {
    EXPECT_NEAR(std::remainder(end.angle - *problem.endAngle, 2 * kPi), 0, 1e-9);
  } else {
    EXPECT_NEAR(end.curvature, 0, 1e-8 * size);
  }
  EXPECT_NEAR(solution.turning, end.angle - start.angle, 1e-9);
}

/// The sensitivity of the blade at rest against that of blades whose grips moved by 1 µm and turned by
/// 0.001°.
inline void expectSensitivity(const ClampedProblem& problem) {
  const ClampedSolution reference = solveClamped(problem)->solutions[0];
  const ClampedOptions near = from(reference.elastica);
  std::vector<std::optional<double> ClampedProblem::*> turned;
  for (const auto angle : {&ClampedProblem::startAngle, &ClampedProblem::endAngle})
    if (problem.*angle) turned.push_back(angle);
  const int points = 400, turns = int(turned.size());
  Eigen::MatrixXd moved(2 * points, 4 + turns);
  const double step = 1e-3;
  for (int column = 0; column < 4 + turns; ++column) {
    std::vector<Eigen::Vector2d> side[2];
    for (const int sign : {0, 1}) {
      ClampedProblem other = problem;
      const double change = sign ? step : -step;
      if (column < 2)
        other.start(column) += change;
      else if (column < 4)
        other.end(column - 2) += change;
      else
        *(other.*turned[std::size_t(column - 4)]) += change * kDegree;
      const Result<ClampedAnswer> answer = solveClamped(other, near);
      ASSERT_TRUE(answer);
      for (int i = 0; i < points; ++i)
        side[sign].push_back(answer->solutions[0].elastica.point(problem.length * (i + 0.5) / points));
    }
    for (int i = 0; i < points; ++i)
      moved.block<2, 1>(2 * i, column) = (side[1][std::size_t(i)] - side[0][std::size_t(i)]) / (2 * step);
  }
  const auto largest = [&](int first, int count) {
    if (count == 0) return 0.0;
    const Eigen::MatrixXd gram =
        moved.middleCols(first, count).transpose() * moved.middleCols(first, count) / points;
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram).eigenvalues().maxCoeff());
  };
  EXPECT_NEAR(reference.sensitivity.perMm, largest(0, 4), 1e-4 * largest(0, 4));
  EXPECT_NEAR(reference.sensitivity.perDegree, largest(4, turns), 1e-4 * largest(4, turns));
}

}  // namespace bw::test
