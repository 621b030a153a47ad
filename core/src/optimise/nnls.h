// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace bw::optimise {

/// Non-negative least squares: the u ≥ 0 that minimises |A u − b|, by the active sets of Lawson and Hanson
/// (Solving Least Squares Problems, 1974, chapter 23). Columns of A of like size, so that the choice of the
/// entering one is fair. Of several solutions one with linearly independent columns.
Eigen::VectorXd nonNegativeLeastSquares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace bw::optimise
