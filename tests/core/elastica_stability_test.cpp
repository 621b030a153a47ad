// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/elastica/elastica_stability.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <random>

#include "bw/core/base/units.h"

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

/// Smallest eigenvalue, over 4π²/L², of the second variation out of the plane with both rotations kept: α
/// about the tangent, β about the normal, by finite differences on ∫ (β' + κα)² + c (α' − κβ)² − κ(αβ' − βα')
/// − κ²(α² + β²) + (λ·n) αβ − (λ·t) β².
double outOfPlaneEigenvalue(const Elastica& e, double c, int n = 120) {
  const double h = 1.0 / n, length = e.length();
  const int free = 2 * (n - 1);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(free, free);
  for (int i = 0; i < n; ++i) {
    // Rows: α, α', β, β' at the middle of cell i over the unknowns (α, β) at its ends.
    const Elastica::State state = e.at((i + 0.5) * h * length);
    const Eigen::Vector2d t(std::cos(state.angle), std::sin(state.angle)), normal(-t.y(), t.x());
    const double kappa = state.curvature * length;
    const double lt = e.force().dot(t) * length * length, ln = e.force().dot(normal) * length * length;
    Eigen::Matrix4d rows = Eigen::Matrix4d::Zero();
    rows(0, 0) = rows(0, 2) = rows(2, 1) = rows(2, 3) = 0.5;
    rows(1, 0) = rows(3, 1) = -1 / h;
    rows(1, 2) = rows(3, 3) = 1 / h;
    const Eigen::RowVector4d a = rows.row(0), da = rows.row(1), b = rows.row(2), db = rows.row(3);
    Eigen::Matrix4d local = (db + kappa * a).transpose() * (db + kappa * a) +
                            c * (da - kappa * b).transpose() * (da - kappa * b) -
                            kappa * (a.transpose() * db - b.transpose() * da) -
                            kappa * kappa * (a.transpose() * a + b.transpose() * b) + ln * a.transpose() * b -
                            lt * b.transpose() * b;
    local = (0.5 * h * (local + local.transpose())).eval();
    for (int r = 0; r < 4; ++r)
      for (int k = 0; k < 4; ++k) {
        const int row = 2 * (i - 1) + r, column = 2 * (i - 1) + k;
        if (row >= 0 && row < free && column >= 0 && column < free) hessian(row, column) += local(r, k);
      }
  }
  Eigen::MatrixXd constraint = Eigen::MatrixXd::Zero(free, 1);
  for (int i = 0; i < n - 1; ++i) constraint(2 * i + 1, 0) = 1;
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(constraint).householderQ();
  const Eigen::MatrixXd null = q.rightCols(free - 1);
  const Eigen::MatrixXd projected = null.transpose() * hessian * null / h;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(projected, Eigen::EigenvaluesOnly).eigenvalues()(0) /
         (4 * kPi * kPi);
}

}  // namespace

TEST(StabilityMargin, IsOneForAStraightBladeAndOneMinusTheForceOverTheBucklingForceBeforeIt) {
  EXPECT_DOUBLE_EQ(stabilityMargin(*Elastica::make({0, 0}, 0.3, 0, {0, 0}, 800)), 1);
  // Nearly straight under a compressive force P: the mode that shortens the blade is held by its length, so
  // that the next one decides, at the first root of tan(x/2) = x/2, x = 8.98682: eigenvalue x² − P.
  const double half = 0.5 * 8.986818915818128;
  for (const double pressure : {0.0, 10.0, 25.0}) {
    // A blade between slightly turned grips, antisymmetric about its middle: κ = a cos(√P (s − ½)) …
    const double root = std::sqrt(std::max(pressure, 1e-9)), a = 2e-3;
    const Result<Elastica> e =
        Elastica::make({0, 0}, -a * std::sin(root / 2) / root, a * std::cos(root / 2), {pressure, 0}, 1);
    ASSERT_TRUE(e);
    EXPECT_NEAR(stabilityMargin(*e), (4 * half * half - pressure) / (4 * kPi * kPi), 2e-5) << pressure;
  }
}

TEST(StabilityMargin, AgreesWithFiniteDifferencesAndWithConjugatePoints) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int stable = 0, unstable = 0;
  for (int i = 0; i < 200; ++i) {
    const double scale = 250 * std::abs(unit(engine));
    const Result<Elastica> e = Elastica::make({0, 0}, 3 * unit(engine), 6 * unit(engine),
                                              {scale * unit(engine), scale * unit(engine)}, 1.0);
    ASSERT_TRUE(e);
    const double margin = stabilityMargin(*e);
    const double other = smallestEigenvalue(*e, 80) / (4 * kPi * kPi),
                 finer = smallestEigenvalue(*e, 160) / (4 * kPi * kPi);
    EXPECT_NEAR(margin, finer + (finer - other) / 3, 2e-3 * (1 + std::abs(margin))) << i;
    if (std::abs(margin) < 0.02) continue;
    EXPECT_EQ(isClampedStable(*e), margin > 0) << i << " " << margin;
    (margin > 0 ? stable : unstable)++;
  }
  EXPECT_GT(stable, 30);
  EXPECT_GT(unstable, 30);
}

TEST(StabilityMargin, DoesNotChangeWithPlaceScaleMirrorOrDirection) {
  const Elastica e = *Elastica::make({3, 4}, 0.4, 0.003, {4e-6, -9e-6}, 900);
  const double in = stabilityMargin(e), out = outOfPlaneMargin(e);
  for (const Elastica& other : {e.transformed(2.1, 0.03, {-70, 5}), e.mirrored(), e.reversed()}) {
    EXPECT_NEAR(stabilityMargin(other), in, 1e-8);
    EXPECT_NEAR(outOfPlaneMargin(other), out, 1e-8);
  }
}

TEST(StabilityMargin, ConvergesWithinItsAccuracyOverShapes) {
  // The same curve at two resolutions of the modes: a longer blade of which it is a part never tells, so
  // compare with fine differences, extrapolated.
  for (const double root : {3.0, 8.0, 13.5, 20.0}) {
    const Elastica e = *Elastica::make({0, 0}, 0.7, 2, {-root * root, 0.3 * root}, 1.0);
    const double coarse = smallestEigenvalue(e, 150), fine = smallestEigenvalue(e, 300);
    EXPECT_NEAR(stabilityMargin(e) * 4 * kPi * kPi, fine + (fine - coarse) / 3, 1e-5 * (40 + root * root))
        << root;
  }
}

TEST(OutOfPlaneMargin, AgreesWithTheFormInBothRotations) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 12; ++i) {
    const double scale = 100 * std::abs(unit(engine)), c = 0.2 + std::abs(unit(engine));
    const Result<Elastica> e = Elastica::make({0, 0}, 3 * unit(engine), 5 * unit(engine),
                                              {scale * unit(engine), scale * unit(engine)}, 1.0);
    ASSERT_TRUE(e);
    const double other = outOfPlaneEigenvalue(*e, c);
    // Against ∫ β² alone the eigenvalue is another number of the same sign.
    if (std::abs(other) < 0.02) continue;
    EXPECT_EQ(outOfPlaneMargin(*e, c) > 0, other > 0) << i << " " << other;
  }
}

TEST(OutOfPlaneMargin, ShallowArchesStayInPlaneAndDeepOnesLeaveIt) {
  // A clamped ring turned through 2π leaves its plane if torsion is soft enough; a straight blade never does.
  EXPECT_DOUBLE_EQ(outOfPlaneMargin(*Elastica::make({0, 0}, 0, 0, {0, 0}, 800)), 1);
  EXPECT_GT(outOfPlaneMargin(*Elastica::make({0, 0}, 0, 1, {0, 0}, 1)), 0.9);
  const double free = outOfPlaneMargin(*Elastica::make({0, 0}, 0, 7, {0, 0}, 1), 0);
  // κ constant: sin 2πs has no mean and no net turn: 4π² − κ².
  EXPECT_NEAR(free, (4 * kPi * kPi - 49) / (4 * kPi * kPi), 1e-6);
}

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
