// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_modes.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <iterator>
#include <mutex>

namespace bw::heavy {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// P_0 … P_{n−1} at x in [−1, 1].
VectorXd legendre(double x, Index n) {
  // P_k = a_k x P_{k−1} − (a_k − 1) P_{k−2}; divisions would take most of the time.
  constexpr Index kMost = 2 * kMostModes;
  static const std::array<double, kMost> a = [] {
    std::array<double, kMost> factors{};
    for (std::size_t k = 1; k < factors.size(); ++k) factors[k] = 2 - 1 / double(k);
    return factors;
  }();
  VectorXd p(n);
  p(0) = 1;
  if (n > 1) p(1) = x;
  for (Index k = 2; k < n; ++k) p(k) = a[std::size_t(k)] * x * p(k - 1) - (a[std::size_t(k)] - 1) * p(k - 2);
  return p;
}

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
  modes.values.resize(count, total);
  modes.slopes.resize(count, total);
  modes.polynomials.resize(total, total);
  MatrixXd integrals(total, total);
  for (Index q = 0; q < total; ++q) {
    modes.values.col(q) = integratedLegendre(modes.nodes(q), count + 1).tail(count);
    modes.slopes.col(q) = orthonormalLegendre(modes.nodes(q), count + 1).tail(count);
    modes.polynomials.col(q) = orthonormalLegendre(modes.nodes(q), total) * modes.weights(q);
    integrals.row(q) = integratedLegendre(modes.nodes(q), total);
  }
  modes.integral = integrals * modes.polynomials;
  const Index places = kPlacesEach * count;
  modes.slopesEvenly.resize(places + 1, count);
  for (Index i = 0; i <= places; ++i)
    modes.slopesEvenly.row(i) = orthonormalLegendre(double(i) / double(places), count + 1).tail(count);
  return modes;
}

}  // namespace

VectorXd orthonormalLegendre(double s, Index n) {
  VectorXd p = legendre(2 * s - 1, n);
  for (Index k = 0; k < n; ++k) p(k) *= std::sqrt(2 * double(k) + 1);
  return p;
}

VectorXd integratedLegendre(double s, Index n) {
  // ∫ P_k = (P_{k+1} − P_{k−1}) / (2k + 1), on [0, 1] half of it.
  const VectorXd p = legendre(2 * s - 1, n + 1);
  VectorXd result(n);
  for (Index k = 0; k < n; ++k)
    result(k) = k == 0 ? s : 0.5 * (p(k + 1) - p(k - 1)) / std::sqrt(2 * double(k) + 1);
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
