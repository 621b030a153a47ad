// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/ducks.h"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"
#include "optimise/bounded_newton.h"

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

namespace {

constexpr int kIterations = 60;
/// Longest step, in rad and in units of the mean chord.
constexpr double kLongestStep = 0.5;
/// Rest, in units of one over the mean chord: the equations are solved from here.
constexpr double kAtRest = 1e-8;

/// The chain at angle of duck 0, length 0, angle of duck 1, length 1, …
std::optional<ClampedChain> clampedChain(const std::vector<Eigen::Vector2d>& ducks,
                                         const Eigen::VectorXd& place) {
  ClampedChain chain;
  chain.angles = {place[0]};
  for (std::size_t i = 0; i + 1 < ducks.size(); ++i) {
    if (detail::workExhausted()) return std::nullopt;
    const Eigen::Index k = 2 * Eigen::Index(i);
    const Result<ClampedAnswer> answer = solveClamped({.start = ducks[i],
                                                       .end = ducks[i + 1],
                                                       .startAngle = place[k],
                                                       .endAngle = place[k + 2],
                                                       .length = place[k + 1]});
    if (!answer) return std::nullopt;
    const ClampedSolution& blade = answer->solutions.front();
    chain.angles.push_back(chain.angles.back() + blade.turning);
    chain.pieces.push_back(blade.elastica);
    chain.energy += blade.energy;
  }
  return chain;
}

/// The energy's gradient and Hessian by these.
void differentiate(const ClampedChain& chain, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
  const Eigen::Index size = 2 * Eigen::Index(chain.pieces.size()) + 1;
  gradient.setZero(size);
  hessian.setZero(size, size);
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const Elastica& piece = chain.pieces[i];
    const double angle = piece.startAngle(), bend = piece.startCurvature();
    const double hamiltonian =
        0.5 * bend * bend - piece.force().dot(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    const Eigen::Index k = 2 * Eigen::Index(i);
    gradient.segment<3>(k) += Eigen::Vector3d(-bend, -hamiltonian, piece.at(piece.length()).curvature);
    const Eigen::Matrix3d h = pieceHessian(piece);
    hessian.block<3, 3>(k, k) += 0.5 * (h + h.transpose());
  }
}

}  // namespace

std::optional<ClampedChain> descendChain(const std::vector<Eigen::Vector2d>& ducks,
                                         const std::vector<char>& turns, DuckOptions::Lengths mode,
                                         const std::vector<double>& angles,
                                         const std::vector<double>& lengths) {
  Eigen::VectorXd place(2 * Eigen::Index(lengths.size()) + 1);
  std::vector<Eigen::Index> moving;
  for (Eigen::Index k = 0; k < place.size(); ++k) {
    const std::size_t i = std::size_t(k / 2);
    place[k] = k % 2 == 0 ? angles[i] : lengths[i];
    if (k % 2 == 0 ? turns[i] != 0 : mode == DuckOptions::Lengths::total) moving.push_back(k);
  }
  std::optional<ClampedChain> chain = clampedChain(ducks, place), rest = chain;
  if (!chain || moving.empty()) return chain;
  for (std::size_t i = 0; i < ducks.size(); ++i) place[2 * Eigen::Index(i)] = chain->angles[i];
  // The direction that would change the whole length: the energy is taken as constant along it.
  const Eigen::Index unknowns = std::ssize(moving);
  Eigen::VectorXd whole(unknowns);
  for (Eigen::Index j = 0; j < unknowns; ++j)
    whole[j] = moving[std::size_t(j)] % 2 == 1 ? 1 / std::sqrt(double(lengths.size())) : 0;
  const auto energy = [&](const Eigen::VectorXd& x, bool derivatives) {
    if (x != place(moving)) {
      place(moving) = x;
      chain = clampedChain(ducks, place);
    }
    optimise::SmoothValue now;
    now.value = chain ? chain->energy : std::numeric_limits<double>::infinity();
    if (!derivatives) return now;
    rest = chain;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
    differentiate(*chain, gradient, hessian);
    now.gradient = gradient(moving) - whole * whole.dot(gradient(moving));
    now.hessian = hessian(moving, moving);
    const Eigen::VectorXd along = now.hessian * whole;
    now.hessian +=
        whole.dot(along) * whole * whole.transpose() - along * whole.transpose() - whole * along.transpose();
    return now;
  };
  const Eigen::VectorXd bound = Eigen::VectorXd::Constant(unknowns, std::numeric_limits<double>::infinity());
  optimise::boundedNewton(energy, place(moving), -bound, bound,
                          {.gradient = kAtRest,
                           .iterations = kIterations,
                           .indefinite = optimise::Indefinite::reflect,
                           .longestStep = kLongestStep});
  return rest;
}

}  // namespace bw::constructions
