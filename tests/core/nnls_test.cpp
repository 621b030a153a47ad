// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "optimise/active_set_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using bw::optimise::nonNegativeLeastSquares;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The conditions of Karush, Kuhn and Tucker, which are sufficient here.
void expectOptimal(const MatrixXd& A, const VectorXd& b) {
  const VectorXd u = nonNegativeLeastSquares(A, b);
  ASSERT_EQ(u.size(), A.cols());
  const VectorXd gain = A.transpose() * (b - A * u);
  for (Index i = 0; i < u.size(); ++i) {
    EXPECT_GE(u[i], 0);
    EXPECT_LE(gain[i], 1e-11);
    if (u[i] > 0) {
      EXPECT_NEAR(gain[i], 0, 1e-11);
    }
  }
}

TEST(NonNegativeLeastSquares, CutsOffNegativePartsOfTheIdentity) {
  const VectorXd b = VectorXd::LinSpaced(5, -2, 3);
  EXPECT_TRUE(nonNegativeLeastSquares(MatrixXd::Identity(5, 5), b).isApprox(b.cwiseMax(0), 1e-15));
}

// The example of MATLAB's lsqnonneg.
TEST(NonNegativeLeastSquares, LeavesOutAColumnThatWouldBeNegative) {
  MatrixXd A(4, 2);
  A << 0.0372, 0.2868, 0.6861, 0.7071, 0.6233, 0.6245, 0.6344, 0.6170;
  const VectorXd b = Eigen::Vector4d(0.8587, 0.1781, 0.0747, 0.8405);
  const VectorXd u = nonNegativeLeastSquares(A, b);
  EXPECT_EQ(u[0], 0);
  EXPECT_NEAR(u[1], 0.6929, 5e-5);
  EXPECT_NEAR((A * u - b).squaredNorm(), 0.8315, 5e-5);
}

TEST(NonNegativeLeastSquares, MeetsTheOptimalityConditionsOfRandomProblems) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  const auto number = [&] { return normal(engine); };
  for (int n = 0; n < 200; ++n) {
    const Index rows = 2 + n % 7, columns = 1 + n % 11;
    expectOptimal(MatrixXd::NullaryExpr(rows, columns, number), VectorXd::NullaryExpr(rows, number));
  }
}

TEST(NonNegativeLeastSquares, TakesEqualColumnsAndColumnsOfZeros) {
  MatrixXd A(3, 4);
  A << 1, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1;
  expectOptimal(A, Eigen::Vector3d(2, 1, 3));
  expectOptimal(A, Eigen::Vector3d(-2, -1, 3));
}

TEST(NonNegativeLeastSquares, GivesZeroWhereNothingIsToBeGained) {
  EXPECT_TRUE(nonNegativeLeastSquares(MatrixXd::Zero(3, 2), VectorXd::Ones(3)).isZero(0));
  EXPECT_TRUE(nonNegativeLeastSquares(MatrixXd::Ones(3, 2), VectorXd::Zero(3)).isZero(0));
  EXPECT_TRUE(nonNegativeLeastSquares(MatrixXd::Ones(3, 2), -VectorXd::Ones(3)).isZero(0));
  EXPECT_EQ(nonNegativeLeastSquares(MatrixXd(3, 0), VectorXd::Ones(3)).size(), 0);
}

}  // namespace
