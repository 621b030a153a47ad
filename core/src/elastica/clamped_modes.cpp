// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/clamped_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/gauss_legendre.h"
#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::elastica {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values at x in [−1, 1] of the bubbles B_j = (P_{j+1} − P_{j−1}) / √(2 (2j + 1)), j = 1 … count, and of
/// what hinged ends add to them: (1 + x)/2 for the end, (1 − x)/2 for the start.
VectorXd basisAt(double x, Index count, Index hinges) {
  VectorXd legendre(count + 2);
  legendre(0) = 1;
  legendre(1) = x;
  for (Index k = 2; k < count + 2; ++k) {
    const double n = double(k);
    legendre(k) = ((2 * n - 1) * x * legendre(k - 1) - (n - 1) * legendre(k - 2)) / n;
  }
  VectorXd result(count + hinges);
  for (Index j = 1; j <= count; ++j)
    result(j - 1) = (legendre(j + 1) - legendre(j - 1)) / std::sqrt(2 * (2 * double(j) + 1));
  if (hinges > 0) result(count) = 0.5 * (1 + x);
  if (hinges > 1) result(count + 1) = 0.5 * (1 - x);
  return result;
}

/// ∫ B_i B_j and ∫ B_i' B_j' over [−1, 1] in that basis.
struct Gram {
  MatrixXd mass, stiffness;
};

Gram gramOf(Index count, Index hinges) {
  const Index all = count + hinges;
  Gram gram{MatrixXd::Zero(all, all), MatrixXd::Identity(all, all)};
  MatrixXd& mass = gram.mass;
  for (Index i = 0; i < count; ++i) {
    const double j = double(i + 1);
    mass(i, i) = (1 / (2 * j + 3) + 1 / (2 * j - 1)) / (2 * j + 1);
    if (i + 2 < count)
      mass(i, i + 2) = mass(i + 2, i) = -1 / (2 * j + 3) / std::sqrt((2 * j + 1) * (2 * j + 5));
  }
  for (Index h = 0; h < hinges; ++h) {
    const Index row = count + h;
    const double side = h == 0 ? 1 : -1;
    mass(row, row) = 2.0 / 3;
    gram.stiffness(row, row) = 0.5;
    mass(row, 0) = mass(0, row) = -1 / std::sqrt(6.0);
    mass(row, 1) = mass(1, row) = -side / (3 * std::sqrt(10.0));
  }
  if (hinges > 1) {
    mass(count, count + 1) = mass(count + 1, count) = 1.0 / 3;
    gram.stiffness(count, count + 1) = gram.stiffness(count + 1, count) = -0.5;
  }
  return gram;
}

/// Values at the nodes of equal panels to the integrals of their interpolants from 0 to each node: on one
/// panel l_i = Σ_k (2k + 1) w_i P_k(x_i) P_k, and P_k integrates to (P_{k+1} − P_{k−1}) / (2k + 1).
MatrixXd integralMatrix(int panels, const detail::GaussRule& rule) {
  const Index n = Index(rule.nodes.size());
  MatrixXd legendre(n + 1, n);
  for (Index i = 0; i < n; ++i) {
    const double x = 2 * rule.nodes[std::size_t(i)] - 1;
    legendre(0, i) = 1;
    legendre(1, i) = x;
    for (Index k = 2; k <= n; ++k)
      legendre(k, i) =
          ((2 * double(k) - 1) * x * legendre(k - 1, i) - (double(k) - 1) * legendre(k - 2, i)) / double(k);
  }
  MatrixXd panel = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      double sum = 1 + legendre(1, i);
      for (Index k = 1; k < n; ++k) sum += legendre(k, j) * (legendre(k + 1, i) - legendre(k - 1, i));
      panel(i, j) = 0.5 * sum * rule.weights[std::size_t(j)] / panels;
    }
  MatrixXd result = MatrixXd::Zero(panels * n, panels * n);
  for (Index p = 0; p < panels; ++p) {
    result.block(p * n, p * n, n, n) = panel;
    for (Index j = 0; j < n; ++j)
      result.block((p + 1) * n, p * n + j, (panels - p - 1) * n, 1)
          .setConstant(rule.weights[std::size_t(j)] / panels);
  }
  return result;
}

ClampedModes make(Index count, int panels, int nodesPerPanel, HeldEnds ends = HeldEnds::both) {
  const Index hinges = hingesOf(ends);
  const Gram gram = gramOf(count, hinges);
  // On [0, 1] masses are half and stiffnesses twice those on [−1, 1]. ν = 1/(μ + shift) keeps the digits of
  // small μ; with both ends hinged μ = 0 is among them.
  const double shift = hinges > 1 ? 1 : 0;
  const MatrixXd mass = 0.5 * gram.mass, shifted = 2 * gram.stiffness + shift * mass;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(mass, shifted);
  ClampedModes modes;
  modes.ends = ends;
  modes.stiffness = (solver.eigenvalues().cwiseInverse().array() - shift).matrix().reverse();
  const MatrixXd vectors =
      (solver.eigenvectors() * solver.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal())
          .rowwise()
          .reverse();
  const detail::GaussRule rule = detail::gaussRule(nodesPerPanel);
  const Index total = Index(panels) * nodesPerPanel;
  modes.nodes.resize(total);
  modes.weights.resize(total);
  modes.values.resize(count + hinges, total);
  for (int p = 0; p < panels; ++p)
    for (int i = 0; i < nodesPerPanel; ++i) {
      const Index q = Index(p) * nodesPerPanel + i;
      modes.nodes(q) = (p + rule.nodes[std::size_t(i)]) / panels;
      modes.weights(q) = rule.weights[std::size_t(i)] / panels;
      modes.values.col(q) = vectors.transpose() * basisAt(2 * modes.nodes(q) - 1, count, hinges);
    }
  modes.integral = integralMatrix(panels, rule);
  // The slope of bubble j at the start is 2 √((2j + 1)/2) P_j(−1).
  VectorXd slopes(count + hinges);
  for (Index j = 1; j <= count; ++j) slopes(j - 1) = (j % 2 ? -2 : 2) * std::sqrt(0.5 * (2 * double(j) + 1));
  for (Index h = 0; h < hinges; ++h) slopes(count + h) = h == 0 ? 1 : -1;
  modes.startSlope = vectors.transpose() * slopes;
  return modes;
}

/// A constraint whose part apart from the others is smaller than this is one of them.
constexpr double kSameConstraint = 1e-9;

template <HeldEnds ends>
const ClampedModes& modesFor(double phase) {
  // Each as soon as one needs it: the finest take as long to make as a hundred blades to find.
  if (phase < 14) {
    static const ClampedModes few = make(16, 1, 26, ends);
    return few;
  }
  if (phase < 40) {
    static const ClampedModes some = make(32, 2, 26, ends);
    return some;
  }
  if (phase < 100) {
    static const ClampedModes many = make(64, 4, 26, ends);
    return many;
  }
  static const ClampedModes most = make(128, 8, 26, ends);
  return most;
}

}  // namespace

const ClampedModes& sketchModes() {
  static const ClampedModes modes = make(10, 1, 18);
  return modes;
}

const ClampedModes& clampedModesFor(double phase, HeldEnds ends) {
  constexpr std::array kModes = {modesFor<HeldEnds::both>, modesFor<HeldEnds::start>,
                                 modesFor<HeldEnds::none>};
  return kModes[std::size_t(ends)](phase);
}

double straightEigenvalue(HeldEnds ends) {
  // φ = sin 2πs; cos q(1 − s) − cos q with tan q = q, the blade held at one end; cos πs.
  constexpr double kHalfHeld = 4.493409457909064;
  return std::array{4 * kPi * kPi, kHalfHeld * kHalfHeld, kPi * kPi}[std::size_t(ends)];
}

double smallestEigenvalue(const ClampedModes& modes, const ClampedForm& form) {
  const Index count = modes.count();
  // About half a microsecond for a hundred products.
  detail::chargeWork(count * count * (count + modes.nodes.size()) / 200);
  MatrixXd matrix = MatrixXd::Zero(count, count);
  {
    const MatrixXd weighted = modes.values * modes.weights.cwiseProduct(*form.potential).asDiagonal();
    matrix.noalias() -= weighted * modes.values.transpose();
    matrix.diagonal() += modes.stiffness;
  }
  const auto moments = [&](const VectorXd& f) -> VectorXd {
    return modes.values * modes.weights.cwiseProduct(f);
  };
  if (form.coupling) {
    const VectorXd b = moments(*form.coupling);
    matrix += form.couplingWeight * b * b.transpose();
  }
  // Reflections turn the constraints into the last coordinates, one by one.
  Index free = count;
  std::vector<VectorXd> taken;
  for (const VectorXd* constraint : form.constraints) {
    if (!constraint) continue;
    VectorXd u = moments(*constraint);
    const double size = u.norm();
    for (const VectorXd& v : taken) u -= 2 * v.dot(u) * v;
    u.tail(count - free).setZero();
    const double rest = u.norm();
    if (!(rest > kSameConstraint * std::max(size, 1e-3))) continue;
    VectorXd v = u / rest;
    v(free - 1) += v(free - 1) < 0 ? -1.0 : 1.0;
    v.normalize();
    const VectorXd row = matrix * v;
    const double twice = 2 * v.dot(row);
    matrix += 2 * (twice * v * v.transpose() - row * v.transpose() - v * row.transpose());
    taken.push_back(v);
    --free;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix.topLeftCorner(free, free),
                                                       Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0);
}

}  // namespace bw::elastica
