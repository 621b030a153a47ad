// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/duck_equations.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::constructions {

namespace {

/// All equations, dimensionless, must hold to this.
constexpr double kSolved = 1e-11;
constexpr int kIterations = 100;
/// Of Levenberg and Marquardt, over what the equations miss: at first, at least, and where to give up.
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-9, kHopeless = 1e8;
/// Steps of the unknowns, in units of the mean chord and in rad.
constexpr double kLongestStep = 0.5;
/// Work (`WorkMeter`) of a solution, for each unknown.
constexpr std::int64_t kUnknownWork = 20;

}  // namespace

Result<Elastica> DuckEquations::piece(const Eigen::VectorXd& u, std::size_t i) const {
  const Eigen::Index k = 4 * Eigen::Index(i);
  return Elastica::make(ducks_[i], u[angleAt(i)], u[k], u.segment<2>(k + 1), u[k + 3]);
}

std::optional<double> DuckEquations::askedAngle(std::size_t duck) const {
  if (!options_.tangents.empty()) return options_.tangents[duck];
  if (duck == 0) return options_.startAngle;
  return duck == std::size_t(pieces_) ? options_.endAngle : std::nullopt;
}

void DuckEquations::settleAngles(const Eigen::VectorXd& u) {
  given_.assign(std::size_t(pieces_) + 1, std::nullopt);
  for (std::size_t duck = 0; duck < given_.size(); ++duck) {
    const double here = u[angleAt(duck)];
    if (const std::optional<double> angle = askedAngle(duck))
      given_[duck] = here + std::remainder(*angle - here, 2 * kPi);
  }
}

bool DuckEquations::evaluate(const Eigen::VectorXd& u, Eigen::VectorXd& f,
                             Eigen::SparseMatrix<double>* jacobian) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto set = [&](Eigen::Index row, Eigen::Index column, double value) {
    if (jacobian) entries.emplace_back(row, column, value);
  };
  f.resize(size());
  Eigen::VectorXd endCurvature(pieces_);
  std::vector<Eigen::Matrix<double, 1, 5>> endRow{std::size_t(pieces_)};
  double sum = 0;
  for (Eigen::Index k = 0; k < pieces_; ++k) {
    const std::size_t i = std::size_t(k);
    const Result<Elastica> elastica = piece(u, i);
    if (!elastica) return false;
    const double length = elastica->length();
    const Eigen::Vector2d force = elastica->force();
    Elastica::Jacobian d;
    const Elastica::State end = elastica->at(length, d);
    f.segment<2>(3 * k) = end.point - ducks_[i + 1];
    f[3 * k + 2] = end.angle - u[angleAt(i + 1)];
    endCurvature[k] = end.curvature;
    // Columns: κ0, λ1, λ2, length, angle.
    Eigen::Matrix<double, 4, 5> all;
    all << d.col(3), d.col(4), d.col(5),
        Eigen::Vector4d(std::cos(end.angle), std::sin(end.angle), end.curvature,
                        force.y() * std::cos(end.angle) - force.x() * std::sin(end.angle)),
        d.col(2);
    endRow[i] = all.row(3);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) set(3 * k + r, 4 * k + c, all(r, c));
      set(3 * k + r, angleAt(i), all(r, 4));
    }
    set(3 * k + 2, angleAt(i + 1), -1);
    // Length: its value, or the Hamiltonian ½κ² − λ·t, which the free length makes 0 and the sliding one
    // equal in all pieces.
    const Eigen::Index row = 3 * pieces_ + k;
    sum += length;
    const auto hamiltonian = [&](Eigen::Index p, double sign) {
      const double a = u[angleAt(std::size_t(p))], c = std::cos(a), s = std::sin(a);
      set(row, 4 * p, sign * u[4 * p]);
      set(row, 4 * p + 1, -sign * c);
      set(row, 4 * p + 2, -sign * s);
      set(row, angleAt(std::size_t(p)), sign * (u[4 * p + 1] * s - u[4 * p + 2] * c));
      return sign * (0.5 * u[4 * p] * u[4 * p] - u[4 * p + 1] * c - u[4 * p + 2] * s);
    };
    if (options_.mode == DuckOptions::Lengths::given) {
      f[row] = length - lengths[i];
      set(row, 4 * k + 3, 1);
    } else if (options_.mode == DuckOptions::Lengths::free) {
      f[row] = hamiltonian(k, 1);
    } else if (k + 1 < pieces_) {
      f[row] = hamiltonian(k, 1);
      f[row] += hamiltonian(k + 1, -1);
    } else {
      f[row] = sum - total;
      for (Eigen::Index p = 0; p < pieces_; ++p) set(row, 4 * p + 3, 1);
    }
  }
  for (Eigen::Index duck = 0; duck <= pieces_; ++duck) {
    const Eigen::Index row = 4 * pieces_ + duck;
    if (const std::optional<double> given = given_[std::size_t(duck)]) {
      // The turn of the given angle nearest to the present one was fixed at the start.
      f[row] = u[angleAt(std::size_t(duck))] - *given;
      set(row, angleAt(std::size_t(duck)), 1);
      continue;
    }
    f[row] = 0;
    if (duck > 0) {
      const Eigen::Index k = duck - 1;
      f[row] += endCurvature[k];
      for (int c = 0; c < 4; ++c) set(row, 4 * k + c, endRow[std::size_t(k)][c]);
      set(row, angleAt(std::size_t(k)), endRow[std::size_t(k)][4]);
    }
    if (duck < pieces_) {
      f[row] -= u[4 * duck];
      set(row, 4 * duck, -1);
    }
  }
  if (jacobian) {
    jacobian->resize(size(), size());
    jacobian->setFromTriplets(entries.begin(), entries.end());
  }
  return f.allFinite();
}

bool DuckEquations::solve(Eigen::VectorXd& u, int& iterations) const {
  Eigen::VectorXd f, trial;
  Eigen::SparseMatrix<double> jacobian;
  if (!evaluate(u, f, &jacobian)) return false;
  double damping = kFirstDamping;
  for (int i = 0; i < kIterations; ++i) {
    if (f.lpNorm<Eigen::Infinity>() < kSolved) return true;
    if (detail::workExhausted()) break;
    detail::chargeWork(kUnknownWork * size());
    ++iterations;
    Eigen::SparseMatrix<double> normal = jacobian.transpose() * jacobian;
    for (Eigen::Index d = 0; d < normal.cols(); ++d) normal.coeffRef(d, d) += damping * f.norm();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
    Eigen::VectorXd step = solver.solve(-(jacobian.transpose() * f));
    if (solver.info() != Eigen::Success || !step.allFinite()) {
      damping *= 10;
      continue;
    }
    if (const double longest = step.lpNorm<Eigen::Infinity>(); longest > kLongestStep)
      step *= kLongestStep / longest;
    const Eigen::VectorXd next = u + step;
    if (evaluate(next, trial, nullptr) && trial.norm() < f.norm()) {
      u = next;
      if (!evaluate(u, f, &jacobian)) return false;
      damping = std::max(kLeastDamping, damping / 5);
    } else {
      damping *= 4;
      if (damping > kHopeless) break;
    }
  }
  return f.lpNorm<Eigen::Infinity>() < kSolved;
}

}  // namespace bw::constructions
