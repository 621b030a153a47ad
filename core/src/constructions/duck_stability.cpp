// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/duck_stability.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "bw/core/elastica/elastica_stability.h"

namespace bw::constructions {

Eigen::Matrix3d pieceHessian(const Elastica& piece) {
  Elastica::Jacobian d;
  const Elastica::State end = piece.at(piece.length(), d);
  const double c = std::cos(piece.startAngle()), s = std::sin(piece.startAngle());
  const double c1 = std::cos(end.angle), s1 = std::sin(end.angle);
  const Eigen::Vector2d force = piece.force();
  const double bend = piece.startCurvature(), slope = force.y() * c1 - force.x() * s1;
  // By the start curvature and force, and by the start angle, length and end angle: the conditions at the end
  // …
  Eigen::Matrix3d byInner = d.topRightCorner<3, 3>(), byOuter;
  byOuter << d(0, 2), c1, 0, d(1, 2), s1, 0, d(2, 2), end.curvature, -1;
  // … and the energy's gradient −κ(0), −H, κ(L).
  Eigen::Matrix3d gradientInner, gradientOuter;
  gradientInner << -1, 0, 0, -bend, c, s, d(3, 3), d(3, 4), d(3, 5);
  gradientOuter << 0, 0, 0, force.y() * c - force.x() * s, 0, 0, d(3, 2), slope, 0;
  const Eigen::Matrix3d moved = byInner.fullPivLu().solve(byOuter);
  return gradientOuter - gradientInner * moved;
}

bool isChainStable(const std::vector<Elastica>& pieces, const std::vector<char>& turns,
                   DuckOptions::Lengths mode) {
  // A chain without bending has the least energy there is.
  constexpr double kStraight = 1e-9;
  if (std::all_of(pieces.begin(), pieces.end(),
                  [](const Elastica& piece) { return piece.maxCurvature() * piece.length() < kStraight; }))
    return true;
  // Unknowns: angle at duck 0, length 0, angle at duck 1, length 1, …; those that are held have a 1 alone.
  const Eigen::Index size = 2 * Eigen::Index(pieces.size()) + 1;
  const bool slides = mode != DuckOptions::Lengths::given, total = mode == DuckOptions::Lengths::total;
  const auto moves = [&](Eigen::Index i) { return i % 2 == 0 ? turns[std::size_t(i / 2)] != 0 : slides; };
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!isClampedStable(pieces[k])) return false;
    const Eigen::Matrix3d h = pieceHessian(pieces[k]);
    if (!h.allFinite()) return false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) {
        const Eigen::Index row = 2 * Eigen::Index(k) + i, column = 2 * Eigen::Index(k) + j;
        if (moves(row) && moves(column)) entries.emplace_back(row, column, (h(i, j) + h(j, i)) / 2);
      }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    if (!moves(i)) entries.emplace_back(i, i, 1);
    // The whole length is kept: a minimum on that plane has exactly one negative pivot with the plane as a
    // border.
    if (total && i % 2 == 1) entries.emplace_back(size, i, 1);
  }
  if (total) entries.emplace_back(size, size, 0);
  Eigen::SparseMatrix<double> matrix(size + (total ? 1 : 0), size + (total ? 1 : 0));
  matrix.setFromTriplets(entries.begin(), entries.end());
  // In the order of the chain: the border's diagonal is zero and must come last.
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(
      matrix);
  if (solver.info() != Eigen::Success) return false;
  const Eigen::VectorXd pivots = solver.vectorD();
  return (pivots.array() == 0).count() == 0 && (pivots.array() < 0).count() == (total ? 1 : 0);
}

}  // namespace bw::constructions
