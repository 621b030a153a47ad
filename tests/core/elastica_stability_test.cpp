// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/elastica_stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <random>

#include "bw/core/units.h"

namespace bw {

namespace {

/// Smallest eigenvalue (times L²) of the second variation ∫ φ'² − (λ1 cos θ + λ2 sin θ) φ² ds over φ(0) =
/// φ(L) = 0, ∫ φ sin θ = ∫ φ cos θ = 0, by finite differences: the other route.
double smallestEigenvalue(const Elastica& e, int n = 160) {
  const double h = e.length() / n;
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n - 1, n - 1);
  Eigen::MatrixXd constraints(n - 1, 2);
  for (int i = 1; i < n; ++i) {
    const double theta = e.at(i * h).angle;
    hessian(i - 1, i - 1) = 2 / (h * h) - (e.force().x() * std::cos(theta) + e.force().y() * std::sin(theta));
    if (i + 1 < n) hessian(i - 1, i) = hessian(i, i - 1) = -1 / (h * h);
    constraints.row(i - 1) << std::sin(theta), std::cos(theta);
  }
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(constraints).householderQ();
  const Eigen::MatrixXd null = q.rightCols(n - 3);
  const Eigen::MatrixXd projected = null.transpose() * hessian * null;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected, Eigen::EigenvaluesOnly).eigenvalues()(0) *
         e.length() * e.length();
}

}  // namespace

TEST(ElasticaStability, CirclesAreStableHoweverFarTheyTurn) {
  for (const double turning : {0.01, 1.0, 5.0, 12.0})
    EXPECT_TRUE(isClampedStable(*Elastica::make({0, 0}, 0.2, turning / 800, {0, 0}, 800))) << turning;
}

TEST(ElasticaStability, TautStraightBladesAreStableWhateverTheForce) {
  for (const double force : {0.0, 1e-3, -1e-3})
    EXPECT_TRUE(isClampedStable(*Elastica::make({0, 0}, 0, 1e-9, {force, 0}, 800))) << force;
}

TEST(ElasticaStability, HigherBucklingModesAreUnstable) {
  // The clamped column bent into its first mode rests; bent into higher ones it snaps. Whole periods between
  // parallel ends: θ starts and ends at zero with the curvature at its extreme.
  const auto mode = [](int periods) {
    const Result<Elastica> e = Elastica::fromControlParameters({0.3, 0, 1, 100, 0, 0, 0});
    const double period = *e->period();
    return *e->segment(0, periods * period);
  };
  EXPECT_TRUE(isClampedStable(mode(1)));
  EXPECT_FALSE(isClampedStable(mode(2)));
  EXPECT_FALSE(isClampedStable(mode(3)));
}

TEST(ElasticaStability, AgreesWithTheProjectedHessian) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  int stable = 0, unstable = 0;
  for (int i = 0; i < 300; ++i) {
    const double scale = 250 * std::abs(unit(engine));
    const Result<Elastica> e = Elastica::make({0, 0}, 3 * unit(engine), 6 * unit(engine),
                                              {scale * unit(engine), scale * unit(engine)}, 1.0);
    ASSERT_TRUE(e);
    const double eigenvalue = smallestEigenvalue(*e);
    if (std::abs(eigenvalue) < 1.0) continue;  // too near the border for either route's resolution
    EXPECT_EQ(isClampedStable(*e), eigenvalue > 0) << i << " " << eigenvalue;
    (eigenvalue > 0 ? stable : unstable)++;
  }
  EXPECT_GT(stable, 50);
  EXPECT_GT(unstable, 50);
}

}  // namespace bw
