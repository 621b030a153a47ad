// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>

namespace bw::heavy {

/// What a blade of length 1 held at both ends can add to its tangent angle: φ_j(s) = ∫_0^s p_j with the
/// orthonormal Legendre polynomials p_j of degree j = 1 … count on [0, 1]. They vanish at both ends, and
/// ∫ φ_i' φ_j' = δ_ij. docs/mathematics.md, 9.
struct Modes {
  Eigen::VectorXd nodes, weights;  ///< of a Gauss rule on [0, 1], with more nodes than modes
  Eigen::MatrixXd values;          ///< φ_j at node q in (j, q)
  Eigen::MatrixXd slopes;          ///< φ_j' likewise
  Eigen::MatrixXd polynomials;     ///< values at the nodes to the p_j, j = 0 …, of their interpolant
  Eigen::MatrixXd integral;        ///< values at the nodes to their integrals from 0 to each node
  Eigen::MatrixXd squares;         ///< ∫ φ_i φ_j
  Eigen::MatrixXd slopesEvenly;    ///< φ_j' at kPlacesEach · count + 1 even places in (place, j)

  Eigen::Index count() const { return values.rows(); }
};

/// Even places for each mode at which a curvature is looked at.
inline constexpr int kPlacesEach = 16;

/// At least `count` ≤ kMostModes of them. Computed once; safe from several threads.
const Modes& modesOf(Eigen::Index count);
inline constexpr Eigen::Index kModeCounts[] = {24, 32, 48, 64, 96, 192};
inline constexpr Eigen::Index kMostModes = 192;

/// Of each degree k: P_k = a_k x P_{k−1} − (a_k − 1) P_{k−2} on [−1, 1], where divisions would take most of
/// the time, and √(2k + 1), by which p_k is larger.
struct LegendreFactors {
  static constexpr std::size_t kMost = 2 * kMostModes;
  std::array<double, kMost> a{}, root{};
};
const LegendreFactors& legendreFactors();

/// p_0 … p_{n−1} and their integrals from 0, at places of [0, 1]: (place, degree).
struct Legendre {
  Eigen::MatrixXd values, integrals;
};
Legendre legendreAt(const Eigen::ArrayXd& places, Eigen::Index n);

}  // namespace bw::heavy
