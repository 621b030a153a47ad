// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <mutex>

namespace bw::heavy {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The Gauss–Legendre rule with `total` nodes on [0, 1], from the eigenvalues of its Jacobi matrix (Golub and
/// Welsch 1969).
void gauss(Index total, VectorXd& nodes, VectorXd& weights) {
  VectorXd beside(total - 1);
  for (Index k = 1; k < total; ++k) beside(k - 1) = double(k) / std::sqrt(4 * double(k) * double(k) - 1);
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
  solver.computeFromTridiagonal(VectorXd::Zero(total), beside);
  nodes = 0.5 * (1 + solver.eigenvalues().array());
  weights = solver.eigenvectors().row(0).cwiseAbs2();
}

Modes make(Index count, Index total) {
  Modes modes;
  gauss(total, modes.nodes, modes.weights);
  const Legendre at = legendreAt(modes.nodes.array(), total);
  modes.values = at.integrals.middleCols(1, count).transpose();
  modes.slopes = at.values.middleCols(1, count).transpose();
  modes.polynomials = at.values.transpose() * modes.weights.asDiagonal();
  modes.integral = at.integrals * modes.polynomials;
  modes.squares = modes.values * modes.weights.asDiagonal() * modes.values.transpose();
  const Index places = kPlacesEach * count;
  modes.slopesEvenly = legendreAt(ArrayXd::LinSpaced(places + 1, 0, 1), count + 1).values.rightCols(count);
  return modes;
}

}  // namespace

const LegendreFactors& legendreFactors() {
  static const LegendreFactors factors = [] {
    LegendreFactors result;
    for (std::size_t k = 0; k < LegendreFactors::kMost; ++k) {
      result.a[k] = 2 - 1 / std::max(1.0, double(k));
      result.root[k] = std::sqrt(2 * double(k) + 1);
    }
    return result;
  }();
  return factors;
}

Legendre legendreAt(const ArrayXd& places, Index n) {
  const LegendreFactors& factors = legendreFactors();
  const ArrayXd x = 2 * places - 1;
  MatrixXd p(x.size(), n + 1);
  p.col(0).setOnes();
  p.col(1) = x;
  for (Index k = 2; k <= n; ++k) {
    const double a = factors.a[std::size_t(k)];
    p.col(k).array() = a * x * p.col(k - 1).array() - (a - 1) * p.col(k - 2).array();
  }
  // ∫ P_k = (P_{k+1} − P_{k−1}) / (2k + 1), on [0, 1] half of it.
  Legendre result{MatrixXd(x.size(), n), MatrixXd(x.size(), n)};
  result.integrals.col(0) = places;
  for (Index k = 0; k < n; ++k) {
    const double root = factors.root[std::size_t(k)];
    result.values.col(k) = root * p.col(k);
    if (k > 0) result.integrals.col(k) = 0.5 / root * (p.col(k + 1) - p.col(k - 1));
  }
  return result;
}

const Modes& modesOf(Index count) {
  constexpr std::size_t kLevels = std::size(kModeCounts);
  static std::array<std::once_flag, kLevels> once;
  static std::array<Modes, kLevels> levels;
  std::size_t level = 0;
  while (level + 1 < kLevels && kModeCounts[level] < count) ++level;
  // More nodes than modes: products of cosines with two modes are integrated to 1e-12.
  std::call_once(once[level],
                 [&] { levels[level] = make(kModeCounts[level], kModeCounts[level] * 11 / 8 + 7); });
  return levels[level];
}

}  // namespace bw::heavy
