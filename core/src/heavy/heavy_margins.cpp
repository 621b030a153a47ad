// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "heavy/heavy_margins.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/base/units.h"

namespace bw::heavy {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Total |κ| L below which the blade counts as straight, as of the weightless one.
constexpr double kStraight = 1e-3;

/// The smallest eigenvalue of a form against ∫ φ² where ∫ φ times some functions vanishes, over 4π². Where it
/// is less than `below` its function, ∫ φ² = 1, is put into `function`; where it is not, it is told as
/// `below`, which a factorisation shows in a fraction of the time.
double smallest(const Modes& modes, const MatrixXd& form, const MatrixXd& constraints,
                double below = std::numeric_limits<double>::infinity(), VectorXd* function = nullptr) {
  constexpr double kUnit = 4 * kPi * kPi;
  if (std::isfinite(below) && surelyPositive(form - kUnit * below * modes.squares, constraints)) return below;
  const Eigen::HouseholderQR<MatrixXd> qr(constraints);
  const Index free = modes.count() - constraints.cols();
  const auto reduced = [&](MatrixXd matrix) -> MatrixXd {
    matrix.applyOnTheLeft(qr.householderQ().adjoint());
    matrix.applyOnTheRight(qr.householderQ());
    return matrix.bottomRightCorner(free, free);
  };
  const MatrixXd squares = reduced(modes.squares), reducedForm = reduced(form);
  {
    // Mostly it lies a little below what is asked for, or is the one nearest to 0: inverse iteration there,
    // Newton's method from what that finds (Rayleigh quotients), and a factorisation that shows that no other
    // one is smaller. What is left is of the third power of what a step changes.
    constexpr double kSettled = 1e-7, kSure = 1e-7;
    constexpr int kFirst = 3, kSteps = 8;
    VectorXd shape = VectorXd::LinSpaced(free, 2, 1);
    double value = std::isfinite(below) ? kUnit * below : 0;
    for (int i = 0; i < kSteps; ++i) {
      const Eigen::PartialPivLU<MatrixXd> factors(reducedForm - value * squares);
      for (int k = 0; k < (i == 0 ? kFirst : 1); ++k) {
        shape = factors.solve(squares * shape);
        shape /= std::sqrt(shape.dot(squares * shape));
      }
      const double next = shape.dot(reducedForm * shape);
      const bool settled = i > 0 && std::abs(next - value) <= kSettled * kUnit;
      value = next;
      if (!shape.allFinite() || !std::isfinite(value)) break;
      if (!settled) continue;
      if (value >= kUnit * below ||
          Eigen::LLT<MatrixXd>(reducedForm - (value - kSure * kUnit) * squares).info() != Eigen::Success)
        break;
      if (!function) return value / kUnit;
      *function = VectorXd::Zero(modes.count());
      function->tail(free) = shape;
      function->applyOnTheLeft(qr.householderQ());
      return value / kUnit;
    }
  }
  if (std::isfinite(below) &&
      Eigen::LLT<MatrixXd>(reducedForm - kUnit * below * squares).info() == Eigen::Success)
    return below;
  // 1/λ are the largest: they keep their digits, those of the stiff modes need none.
  const double shift = kUnit * 64;
  const MatrixXd stiff = reducedForm + shift * squares;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(squares, stiff,
                                                                  Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  const double largest = solver.eigenvalues()(free - 1);
  if (function) {
    // Its function by inverse iteration, which takes a fraction of what all of them do.
    constexpr double kBeside = 1e-9;
    constexpr int kIterations = 3;
    const Eigen::PartialPivLU<MatrixXd> beside(squares - (1 + kBeside) * largest * stiff);
    VectorXd shape = VectorXd::LinSpaced(free, 1, 2);
    for (int i = 0; i < kIterations; ++i) {
      shape = beside.solve(stiff * shape);
      shape /= std::sqrt(shape.dot(squares * shape));
    }
    *function = VectorXd::Zero(modes.count());
    function->tail(free) = shape;
    function->applyOnTheLeft(qr.householderQ());
  }
  return std::min(below, (1 / largest - shift) / kUnit);
}

/// ∫ f times each mode, of f at the nodes.
VectorXd moments(const Modes& modes, const ArrayXd& f) {
  return modes.values * (modes.weights.array() * f).matrix();
}

/// True if the smallest eigenvalue of ∫ φ'² + ∫ f φ² against ∫ φ², over 4π², is above `below` whatever else
/// holds φ.
bool surelyAbove(const ArrayXd& f, double below) {
  return std::isfinite(below) && f.minCoeff() - 4 * kPi * kPi * below > -kSurelyPositive;
}

/// κ L at the nodes.
ArrayXd curvatureOf(const Equations& equations) {
  return (equations.modes().slopes.transpose() * equations.shape().coefficients).array() +
         equations.hold().turning;
}

/// A blade that leaves its plane by the angles φ: twice its energy, and ∫ φ, which vanishes.
struct OutOfPlane {
  OutOfPlane(const Equations& equations, const ArrayXd& curvature, double torsionRatio)
      : closed(moments(equations.modes(), ArrayXd::Ones(curvature.size()))) {
    const Modes& modes = equations.modes();
    const ArrayXd along = equations.sampled().along - curvature.square();
    // Charged like the form in the plane, from which it differs by the square of the curvature.
    detail::chargeWork(modes.count() * modes.count() * modes.nodes.size() / 400);
    form = MatrixXd::Identity(modes.count(), modes.count());
    form.triangularView<Eigen::Lower>() +=
        (modes.values * (modes.weights.array() * along).matrix().asDiagonal()) * modes.values.transpose();
    form.triangularView<Eigen::StrictlyUpper>() = form.transpose();
    const VectorXd coupling = moments(modes, curvature);
    form += torsionRatio * coupling * coupling.transpose();
  }
  MatrixXd form;
  VectorXd closed;
};

}  // namespace

Margins marginsOf(const Equations& equations, double torsionRatio, double across) {
  const Modes& modes = equations.modes();
  const ArrayXd curvature = curvatureOf(equations);
  const auto [outOfPlane, closed] = OutOfPlane(equations, curvature, torsionRatio);
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
  load << across * moments(modes, 1 - modes.nodes.array()), 0.0;
  const VectorXd angles = modes.values.transpose() * system.partialPivLu().solve(load).head(n);
  const VectorXd places = modes.polynomials * (modes.integral * angles);
  constexpr int kPlaces = 50;
  const ArrayXd evenly = ArrayXd::LinSpaced(kPlaces + 1, 0, 1);
  margins.sideways = (legendreAt(evenly, places.size()).values * places).cwiseAbs().maxCoeff();
  if (!(margins.outOfPlane > 0)) margins.sideways = std::numeric_limits<double>::infinity();
  return margins;
}

namespace {

/// By how much the ends alone turn the tangent with the angle of the start (2) or the end (3).
ArrayXd turnedWith(Index k, const ArrayXd& places) {
  if (k < 2) return ArrayXd::Zero(places.size());
  return k == 2 ? ArrayXd(1 - places) : places;
}

}  // namespace

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
    turned.col(k) = turnedWith(k, modes.nodes.array());
  }
  const MatrixXd moved = equations.factors().solve(right);
  turned.noalias() += modes.values.transpose() * moved.topRows(n);
  return {moved.topRows(n), moved.bottomRows<2>(), std::move(turned)};
}

MatrixXd movesOf(const Equations& equations, const Changes& changes, const ArrayXd& places) {
  const Modes& modes = equations.modes();
  const Index n = modes.count(), nodes = modes.nodes.size(), count = places.size();
  const Sampled& s = equations.sampled();
  MatrixXd moved(nodes, 8);  // dt/ds, x and y by the four
  moved << (-s.sine).matrix().asDiagonal() * changes.turned, s.cosine.matrix().asDiagonal() * changes.turned;
  const Legendre at = legendreAt(places, nodes);
  const MatrixXd series = modes.polynomials * moved, both = at.integrals * series;
  MatrixXd result(3 * count, 4);
  result.topRows(count) = both.leftCols<4>();
  result.middleRows(count, count) = both.rightCols<4>();
  result.bottomRows(count).noalias() = at.integrals.middleCols(1, n) * changes.coefficients;
  for (Index k = 2; k < 4; ++k) result.col(k).tail(count) += turnedWith(k, places).matrix();
  return result;
}

MarginSlope marginSlopeOf(const Equations& equations, double below,
                          const std::function<const Changes&()>& changesBy) {
  const Modes& modes = equations.modes();
  if (surelyAbove(equations.sampled().along, below)) return {below};
  const MatrixXd& form = equations.hessian();
  const Eigen::MatrixX2d closed = equations.closure();
  VectorXd function;
  MarginSlope slope{smallest(modes, form, closed, below, &function)};
  if (function.size() == 0) return slope;
  // φ·(form) φ − μ ∫ φ² is stationary where ∫ φ t' = 0: what holds it there are two multipliers.
  const VectorXd pull = form * function - 4 * kPi * kPi * slope.margin * (modes.squares * function);
  const Eigen::Vector2d multipliers = (closed.transpose() * closed).ldlt().solve(closed.transpose() * pull);
  const Changes& changes = changesBy();
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

MarginSlope outOfPlaneSlopeOf(const Equations& equations, double torsionRatio, double below,
                              const std::function<const Changes&()>& changesBy) {
  const Modes& modes = equations.modes();
  const ArrayXd curvature = curvatureOf(equations);
  if (curvature.abs().maxCoeff() < kStraight) return {};
  if (surelyAbove(equations.sampled().along - curvature.square(), below)) return {below};
  const auto [form, closed] = OutOfPlane(equations, curvature, torsionRatio);
  VectorXd function;
  MarginSlope slope{smallest(modes, form, closed, below, &function)};
  if (function.size() == 0) return slope;
  const Changes& changes = changesBy();
  const Sampled& s = equations.sampled();
  const ArrayXd phi = modes.values.transpose() * function, weights = modes.weights.array();
  const double twisted = (weights * curvature * phi).sum();
  for (Index k = 0; k < 4; ++k) {
    // Of what `turnedWith` tells, the slope.
    const ArrayXd bent = (modes.slopes.transpose() * changes.coefficients.col(k)).array() + (k < 2    ? 0.0
                                                                                             : k == 2 ? -1.0
                                                                                                      : 1.0);
    const ArrayXd along = changes.force(0, k) * s.cosine + changes.force(1, k) * s.sine +
                          s.across * changes.turned.col(k).array() - 2 * curvature * bent;
    slope.byGrips(k) =
        ((weights * along * phi.square()).sum() + 2 * torsionRatio * twisted * (weights * bent * phi).sum()) /
        (4 * kPi * kPi);
  }
  return slope;
}

ClampedSensitivity sensitivityOf(const Equations& equations) {
  const Modes& modes = equations.modes();
  const MatrixXd moves = movesOf(equations, changesOf(equations), modes.nodes.array());
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
