// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_describe.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/units.h"
#include "elastica/elastica_flow.h"

namespace bw::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// Calls visit(index, ψ, κ) at ascending arc lengths in the unit frame.
template <class Visit>
void walk(const UnitShape& q, const VectorXd& arcs, Visit&& visit) {
  const double rate = std::max({std::abs(q(0)), std::sqrt(std::hypot(q(1), q(2))), 1.0});
  const double unit = std::ldexp(1.0, -std::ilogb(rate) - 1);
  const FlowParameters parameters{q(0) * unit, q(1) * unit * unit, q(2) * unit * unit};
  ElasticaFlow<0> flow(parameters, invariants(parameters.curvature, parameters.tangential, parameters.normal),
                       1);
  for (Index i = 0; i < arcs.size(); ++i) {
    flow.advanceTo(arcs(i) / unit);
    const auto block = flow.at(arcs(i) / unit);
    visit(i, block(2, 0), block(3, 0) / unit);
  }
}

}  // namespace

SampledSolution sample(const UnitSolution& solution) {
  SampledSolution result;
  result.modes = &clampedModesFor(std::min(phaseOf(solution.shape), phaseOf(solution.back)));
  const VectorXd& nodes = result.modes->nodes;
  const Index count = nodes.size(), front = count / 2;  // the nodes are symmetric and none is in the middle
  result.samples.angle.resize(count);
  result.samples.curvature.resize(count);
  result.samples.force = solution.shape.tail<2>();
  // Beyond this many decay lengths from its grips a taut blade is straight to 1e-10; what a walk finds there
  // is rounding.
  constexpr double kDecayed = 23;
  const double root = std::sqrt(result.samples.force.norm());
  const auto straight = [&](double arc) { return solution.straightAngle && arc * root > kDecayed; };
  const VectorXd fromStart = nodes.head(front);
  const VectorXd fromEnd = (1 - nodes.tail(count - front).array()).reverse();
  const auto bent = [&](const VectorXd& arcs) {
    return VectorXd(
        arcs.head(std::count_if(arcs.begin(), arcs.end(), [&](double arc) { return !straight(arc); })));
  };
  if (solution.straightAngle) {
    result.samples.angle.setConstant(*solution.straightAngle);
    result.samples.curvature.setZero();
  }
  walk(solution.shape, bent(fromStart), [&](Index i, double angle, double curvature) {
    result.samples.angle(i) = angle;
    result.samples.curvature(i) = curvature;
  });
  walk(solution.back, bent(fromEnd), [&](Index i, double angle, double curvature) {
    result.samples.angle(count - 1 - i) = solution.turning + angle;
    result.samples.curvature(count - 1 - i) = -curvature;
  });
  return result;
}

double energyOf(const SampledSolution& sampled) {
  return 0.5 * sampled.modes->weights.dot(sampled.samples.curvature.cwiseAbs2());
}

ClampedSensitivity sensitivityOf(const SampledSolution& sampled) {
  const ClampedModes& modes = *sampled.modes;
  const Index n = modes.count(), nodes = modes.nodes.size();
  const VectorXd cosine = sampled.samples.angle.array().cos(), sine = sampled.samples.angle.array().sin();
  const VectorXd& w = modes.weights;
  const VectorXd potential =
      w.cwiseProduct(sampled.samples.force.x() * cosine + sampled.samples.force.y() * sine);
  // What a turned grip adds to the tangent angle before the blade settles: 1 − s and s.
  MatrixXd lifts(nodes, 2);
  lifts.col(0) = (1 - modes.nodes.array());
  lifts.col(1) = modes.nodes;

  MatrixXd system = MatrixXd::Zero(n + 2, n + 2), right = MatrixXd::Zero(n + 2, 4);
  const MatrixXd weighted = modes.values * potential.asDiagonal();
  system.topLeftCorner(n, n).noalias() -= weighted * modes.values.transpose();
  system.diagonal().head(n) += modes.stiffness;
  system.block(0, n, n, 1) = -(modes.values * w.cwiseProduct(sine));
  system.block(0, n + 1, n, 1) = modes.values * w.cwiseProduct(cosine);
  system.bottomLeftCorner(2, n) = system.topRightCorner(n, 2).transpose();
  right(n, 0) = 1;
  right(n + 1, 1) = 1;
  right.topRightCorner(n, 2) = weighted * lifts;
  for (Index k = 0; k < 2; ++k) {
    right(n, 2 + k) = w.cwiseProduct(sine).dot(lifts.col(k));
    right(n + 1, 2 + k) = -w.cwiseProduct(cosine).dot(lifts.col(k));
  }
  const MatrixXd solved = system.partialPivLu().solve(right);
  MatrixXd turn = modes.values.transpose() * solved.topRows(n);
  turn.rightCols<2>() += lifts;
  MatrixXd moved(2 * nodes, 4);
  moved.topRows(nodes) = -(modes.integral * (sine.asDiagonal() * turn));
  moved.bottomRows(nodes) = modes.integral * (cosine.asDiagonal() * turn);

  Eigen::Matrix4d positions = Eigen::Matrix4d::Zero();
  Eigen::Matrix2d angles = Eigen::Matrix2d::Zero();
  for (Index q = 0; q < nodes; ++q) {
    Eigen::Matrix<double, 2, 4> both;
    both.rightCols<2>() << moved.row(q).leftCols<2>(), moved.row(nodes + q).leftCols<2>();
    both.leftCols<2>() = Eigen::Matrix2d::Identity() - both.rightCols<2>();
    Eigen::Matrix2d turned;
    turned << moved.row(q).rightCols<2>(), moved.row(nodes + q).rightCols<2>();
    positions += w(q) * both.transpose() * both;
    angles += w(q) * turned.transpose() * turned;
  }
  const auto largest = [](const auto& gram) {
    if (!gram.allFinite()) return std::numeric_limits<double>::infinity();
    using Matrix = std::decay_t<decltype(gram)>;
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(gram, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
  };
  return {largest(positions), largest(angles)};
}

Result<Elastica> place(const ClampedProblem& problem, const UnitSolution& solution) {
  const double length = problem.length;
  const double c = std::cos(problem.startAngle), s = std::sin(problem.startAngle);
  const UnitShape& q = solution.shape;
  return Elastica::make(problem.start, problem.startAngle, q(0) / length,
                        Vector2d(c * q(1) - s * q(2), s * q(1) + c * q(2)) / length / length, length);
}

Result<ClampedSolution> describe(const ClampedProblem& problem, const UnitSolution& solution,
                                 const SampledSolution& sampled, double torsionRatio) {
  const Result<Elastica> blade = place(problem, solution);
  if (!blade) return tl::unexpected<Error>(blade.error());
  ClampedSolution result;
  result.elastica = *blade;
  result.turning = solution.turning;
  result.energy = energyOf(sampled) / problem.length;
  const ClampedMargins margins = clampedMargins(*sampled.modes, sampled.samples, torsionRatio);
  result.stabilityMargin = margins.inPlane;
  result.outOfPlaneMargin = margins.outOfPlane;
  result.stable = margins.inPlane > 0;
  const ClampedSensitivity sensitivity = sensitivityOf(sampled);
  result.sensitivity.perMm = sensitivity.perMm;
  result.sensitivity.perDegree = sensitivity.perDegree * problem.length * kDegree;
  result.selfIntersects = !solution.straightAngle && blade->selfIntersects();
  if (solution.straightAngle) {
    // The bends decay like tan ¼α exp(−√f s) from either grip; bent opposite ways, their curvatures cancel
    // where they are equal.
    if (solution.shape(0) * solution.back(0) > 0) {
      const double first = std::tan(0.25 * std::abs(*solution.straightAngle));
      const double second = std::tan(0.25 * std::abs(solution.turning - *solution.straightAngle));
      const double root = std::sqrt(solution.shape.tail<2>().norm());
      result.inflections = {problem.length * (0.5 + std::log(first / second) / (2 * root))};
    }
    result.endError = (blade->at(problem.length).point - problem.end).norm();
    return result;
  }
  // Each half from its own end.
  const Result<Elastica> front = Elastica::make({0, 0}, 0, solution.shape(0), solution.shape.tail<2>(), 0.5);
  const Result<Elastica> back = Elastica::make({0, 0}, 0, solution.back(0), solution.back.tail<2>(), 0.5);
  if (!front || !back) return tl::unexpected<Error>((front ? back : front).error());
  for (const double s : front->inflections()) result.inflections.push_back(s * problem.length);
  std::vector<double> fromEnd = back->inflections();
  std::reverse(fromEnd.begin(), fromEnd.end());
  // One in the middle is seen from both sides.
  constexpr double kSameInflection = 1e-3;
  for (const double s : fromEnd)
    if (result.inflections.empty() || s < 0.5 - kSameInflection ||
        (1 - s) * problem.length > result.inflections.back() + kSameInflection * problem.length)
      result.inflections.push_back((1 - s) * problem.length);
  result.endError = (blade->at(problem.length).point - problem.end).norm();
  return result;
}

}  // namespace bw::detail
