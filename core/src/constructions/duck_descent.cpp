// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/duck_descent.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "constructions/duck_stability.h"

namespace bw::detail {

namespace {

constexpr int kIterations = 60;
/// Longest step, in rad and in units of the mean chord.
constexpr double kLongestStep = 0.5;
/// Rest, in units of one over the mean chord: the equations are solved from here.
constexpr double kAtRest = 1e-8;
/// Curvatures of the energy below this part of the largest count as this.
constexpr double kFlattest = 1e-6;
constexpr int kHalvings = 20;
/// Work (`WorkMeter`) of the eigenvalues, in cubes of the number of unknowns.
constexpr std::int64_t kCubesPerUnit = 20;

std::optional<ClampedChain> clampedChain(const std::vector<Eigen::Vector2d>& ducks,
                                         const std::vector<double>& angles,
                                         const std::vector<double>& lengths) {
  ClampedChain chain;
  chain.angles = {angles.front()};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (workExhausted()) return std::nullopt;
    const Result<ClampedAnswer> answer = solveClamped({.start = ducks[i],
                                                       .end = ducks[i + 1],
                                                       .startAngle = angles[i],
                                                       .endAngle = angles[i + 1],
                                                       .length = lengths[i]});
    if (!answer) return std::nullopt;
    const ClampedSolution& blade = answer->solutions.front();
    chain.angles.push_back(chain.angles.back() + blade.turning);
    chain.pieces.push_back(blade.elastica);
    chain.energy += blade.energy;
  }
  return chain;
}

/// The energy's gradient and second derivatives by angle at duck 0, length 0, angle at duck 1, length 1, …
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
                                         std::vector<double> angles, std::vector<double> lengths) {
  std::optional<ClampedChain> chain = clampedChain(ducks, angles, lengths);
  if (!chain) return std::nullopt;
  const bool slides = mode == DuckOptions::Lengths::total;
  std::vector<Eigen::Index> moving;
  for (std::size_t i = 0; i < ducks.size(); ++i) {
    if (turns[i]) moving.push_back(2 * Eigen::Index(i));
    if (slides && i < lengths.size()) moving.push_back(2 * Eigen::Index(i) + 1);
  }
  if (moving.empty()) return chain;
  // The direction that would change the whole length.
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(Eigen::Index(moving.size()));
  for (std::size_t j = 0; j < moving.size(); ++j)
    if (moving[j] % 2 == 1) whole[Eigen::Index(j)] = 1 / std::sqrt(double(lengths.size()));
  const std::int64_t unknowns = std::ssize(moving);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Told before it is done, so that no single decomposition exceeds the limit.
    chargeWork(unknowns * unknowns * unknowns / kCubesPerUnit);
    if (workExhausted()) break;
    Eigen::VectorXd all;
    Eigen::MatrixXd allHessian;
    differentiate(*chain, all, allHessian);
    Eigen::VectorXd gradient = all(moving);
    Eigen::MatrixXd hessian = allHessian(moving, moving);
    gradient -= whole * whole.dot(gradient);
    if (!gradient.allFinite() || !hessian.allFinite() || gradient.lpNorm<Eigen::Infinity>() < kAtRest) break;
    const Eigen::VectorXd along = hessian * whole;
    hessian += (whole.dot(along)) * whole * whole.transpose() - along * whole.transpose() -
               whole * along.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hessian);
    const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs();
    const Eigen::VectorXd parts = (solver.eigenvectors().transpose() * gradient)
                                      .cwiseQuotient(sizes.cwiseMax(kFlattest * (1 + sizes.maxCoeff())));
    Eigen::VectorXd step = -(solver.eigenvectors() * parts);
    step -= whole * whole.dot(step);
    if (const double longest = step.lpNorm<Eigen::Infinity>(); longest > kLongestStep)
      step *= kLongestStep / longest;
    std::optional<ClampedChain> next;
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
      std::vector<double> nextAngles = chain->angles, nextLengths = lengths;
      for (std::size_t j = 0; j < moving.size(); ++j) {
        const std::size_t i = std::size_t(moving[j] / 2);
        (moving[j] % 2 == 0 ? nextAngles : nextLengths)[i] += step[Eigen::Index(j)];
      }
      next = clampedChain(ducks, nextAngles, nextLengths);
      if (next && next->energy < chain->energy) {
        lengths = nextLengths;
        break;
      }
      next.reset();
    }
    if (!next) break;
    chain = std::move(next);
  }
  return chain;
}

}  // namespace bw::detail
