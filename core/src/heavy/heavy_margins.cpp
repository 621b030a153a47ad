// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_margins.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/base/units.h"

namespace bw::heavy {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Total |κ| L below which the blade counts as straight, as of the weightless one.
constexpr double kStraight = 1e-3;

/// The smallest eigenvalue of a form against ∫ φ² where ∫ φ times some functions vanishes, over 4π²; its
/// function, ∫ φ² = 1, is put into `function`.
double smallest(const Modes& modes, const MatrixXd& form, const MatrixXd& constraints,
                VectorXd* function = nullptr) {
  const Eigen::HouseholderQR<MatrixXd> qr(constraints);
  const Index free = modes.count() - constraints.cols();
  const auto reduced = [&](MatrixXd matrix) -> MatrixXd {
    matrix.applyOnTheLeft(qr.householderQ().adjoint());
    matrix.applyOnTheRight(qr.householderQ());
    return matrix.bottomRightCorner(free, free);
  };
  const MatrixXd mass = modes.values * modes.weights.asDiagonal() * modes.values.transpose();
  // 1/λ are the largest: they keep their digits, those of the stiff modes need none.
  const double shift = 4 * kPi * kPi * 64;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(
      reduced(mass), reduced(form + shift * mass),
      (function ? Eigen::ComputeEigenvectors : Eigen::EigenvaluesOnly) | Eigen::Ax_lBx);
  if (function) {
    // Of unit length in the second form.
    const double scale = 1 / std::sqrt(solver.eigenvalues()(free - 1));
    *function = VectorXd::Zero(modes.count());
    function->tail(free) = scale * solver.eigenvectors().col(free - 1);
    function->applyOnTheLeft(qr.householderQ());
  }
  return (1 / solver.eigenvalues()(free - 1) - shift) / (4 * kPi * kPi);
}

}  // namespace

Margins marginsOf(const Equations& equations, double torsionRatio, double across) {
  const Modes& modes = equations.modes();
  const ArrayXd curvature =
      (modes.slopes.transpose() * equations.shape().coefficients).array() + equations.hold().turning;
  const auto moments = [&](const ArrayXd& f) -> VectorXd {
    return modes.values * (modes.weights.array() * f).matrix();
  };
  MatrixXd outOfPlane = equations.hessian();
  outOfPlane -= modes.values * (modes.weights.array() * curvature.square()).matrix().asDiagonal() *
                modes.values.transpose();
  const VectorXd coupling = moments(curvature);
  outOfPlane += torsionRatio * coupling * coupling.transpose();
  const VectorXd closed = moments(ArrayXd::Ones(modes.nodes.size()));
  Margins margins;
  if (curvature.abs().maxCoeff() >= kStraight) {
    margins.inPlane = smallest(modes, equations.hessian(), equations.closure());
    margins.outOfPlane = smallest(modes, outOfPlane, closed);
  }
  if (across == 0) return margins;
  // The angles φ out of the plane minimise ½ φ·(form) φ − across ∫ z with z' = φ, which ends where it begins.
  const Index n = modes.count();
  MatrixXd system(n + 1, n + 1);
  system << outOfPlane, closed, closed.transpose(), 0.0;
  VectorXd load(n + 1);
  load << across * moments(1 - modes.nodes.array()), 0.0;
  const VectorXd angles = modes.values.transpose() * system.partialPivLu().solve(load).head(n);
  const VectorXd places = modes.polynomials * (modes.integral * angles);
  constexpr int kPlaces = 50;
  for (int i = 0; i <= kPlaces; ++i)
    margins.sideways = std::max(
        margins.sideways, std::abs(places.dot(orthonormalLegendre(double(i) / kPlaces, places.size()))));
  if (!(margins.outOfPlane > 0)) margins.sideways = std::numeric_limits<double>::infinity();
  return margins;
}

namespace {

/// How an equilibrium changes with its grips, columns as those of `movesOf`.
struct Changes {
  MatrixXd turned;  ///< the angle at the nodes
  Eigen::Matrix<double, 2, 4> force;
};
Changes changesOf(const Equations& equations) {
  const Modes& modes = equations.modes();
  const Index n = modes.count(), nodes = modes.nodes.size();
  Hold changes[4];
  for (Hold& change : changes) change = 0.0 * change;
  changes[0].chord.x() = changes[1].chord.y() = 1;
  changes[2].startAngle = changes[3].turning = 1;
  changes[2].turning = -1;
  MatrixXd right(n + 2, 4), turned(nodes, 4);
  for (Index k = 0; k < 4; ++k) {
    right.col(k) = -equations.along(changes[k]);
    turned.col(k) = changes[k].startAngle + changes[k].turning * modes.nodes.array();
  }
  const MatrixXd moved = equations.jacobian().partialPivLu().solve(right);
  turned += modes.values.transpose() * moved.topRows(n);
  return {turned, moved.bottomRows<2>()};
}

}  // namespace

MatrixXd movesOf(const Equations& equations) {
  const Modes& modes = equations.modes();
  const Index nodes = modes.nodes.size();
  const MatrixXd turned = changesOf(equations).turned;
  const Sampled& s = equations.sampled();
  MatrixXd result(3 * nodes, 4);
  result << -(modes.integral * (s.sine.matrix().asDiagonal() * turned)),
      modes.integral * (s.cosine.matrix().asDiagonal() * turned), turned;
  return result;
}

MarginSlope marginSlopeOf(const Equations& equations) {
  const Modes& modes = equations.modes();
  const MatrixXd form = equations.hessian();
  const Eigen::MatrixX2d closed = equations.closure();
  VectorXd function;
  MarginSlope slope{smallest(modes, form, closed, &function), {}};
  // φ·(form) φ − μ ∫ φ² is stationary where ∫ φ t' = 0: what holds it there are two multipliers.
  const VectorXd pull =
      form * function -
      4 * kPi * kPi * slope.margin *
          (modes.values * (modes.weights.array() * (modes.values.transpose() * function).array()).matrix());
  const Eigen::Vector2d multipliers = (closed.transpose() * closed).ldlt().solve(closed.transpose() * pull);
  const Changes changes = changesOf(equations);
  const Sampled& s = equations.sampled();
  const ArrayXd phi = modes.values.transpose() * function;
  for (Index k = 0; k < 4; ++k) {
    const ArrayXd turned = changes.turned.col(k);
    const ArrayXd along = changes.force(0, k) * s.cosine + changes.force(1, k) * s.sine + s.across * turned;
    const ArrayXd across = 2 * (multipliers.x() * s.cosine + multipliers.y() * s.sine) * turned * phi;
    slope.byGrips(k) = (modes.weights.array() * (along * phi.square() + across)).sum() / (4 * kPi * kPi);
  }
  return slope;
}

ClampedSensitivity sensitivityOf(const Equations& equations) {
  const MatrixXd moves = movesOf(equations);
  const Modes& modes = equations.modes();
  const Index nodes = modes.nodes.size();
  Eigen::Matrix4d positions = Eigen::Matrix4d::Zero();
  Eigen::Matrix2d angles = Eigen::Matrix2d::Zero();
  for (Index q = 0; q < nodes; ++q) {
    Eigen::Matrix<double, 2, 4> moved;
    moved << moves.row(q), moves.row(nodes + q);
    Eigen::Matrix<double, 2, 4> both;
    both << Eigen::Matrix2d::Identity() - moved.leftCols<2>(), moved.leftCols<2>();
    positions += modes.weights(q) * both.transpose() * both;
    angles += modes.weights(q) * moved.rightCols<2>().transpose() * moved.rightCols<2>();
  }
  const auto largest = [](const auto& gram) {
    if (!gram.allFinite()) return std::numeric_limits<double>::infinity();
    return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<MatrixXd>(gram).eigenvalues().maxCoeff()));
  };
  return {largest(positions), largest(angles)};
}

}  // namespace bw::heavy
