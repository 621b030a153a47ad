// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/duck_descent.h"

#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "constructions/duck_stability.h"
#include "optimise/bounded_newton.h"

namespace bw::constructions {

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
