// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_describe.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bw/core/units.h"
#include "elastica/bvp_taut.h"
#include "elastica/elastica_flow.h"

namespace bw::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// √f L up to which the modes resolve the bends of a taut blade.
constexpr double kLargestResolved = 400;

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
  result.modes = &clampedModesFor(phaseOf(solution.shape));
  if (solution.bends && solution.bends->root > kLargestResolved) result.bends = solution.bends;
  const VectorXd& nodes = result.modes->nodes;
  result.samples.angle.resize(nodes.size());
  result.samples.curvature.resize(nodes.size());
  result.samples.force = solution.shape.tail<2>();
  if (solution.anchor) {
    if (const Result<Elastica> held = Elastica::makeAnchored(*solution.anchor, 1)) {
      std::vector<Elastica::State> states(std::size_t(nodes.size()));
      held->at({nodes.data(), states.size()}, states);
      for (Index i = 0; i < nodes.size(); ++i) {
        result.samples.angle(i) = states[std::size_t(i)].angle;
        result.samples.curvature(i) = states[std::size_t(i)].curvature;
      }
      return result;
    }
  }
  walk(solution.shape, nodes, [&](Index i, double angle, double curvature) {
    result.samples.angle(i) = angle;
    result.samples.curvature(i) = curvature;
  });
  return result;
}

bool isResolved(const UnitSolution& solution, const SampledSolution& sampled) {
  constexpr double kSameEnergy = 1e-6;
  if (!solution.anchor || sampled.bends) return true;
  const Result<Elastica> held = Elastica::makeAnchored(*solution.anchor, 1);
  return held && std::abs(energyOf(sampled) - held->energy()) <= kSameEnergy * held->energy();
}

double energyOf(const SampledSolution& sampled) {
  if (sampled.bends) return tautEnergy(*sampled.bends);
  return 0.5 * sampled.modes->weights.dot(sampled.samples.curvature.cwiseAbs2());
}

bool isClosed(const UnitProblem& problem) {
  constexpr double kClosed = 1e-9;  // lengths, rad
  return problem.end.norm() < kClosed && std::abs(std::remainder(problem.turning, 2 * kPi)) < kClosed;
}

double certainMargin(const UnitSolution& solution) {
  constexpr double kUncertain = 1e-3;  // of f, the margin of a taut blade without loops
  // On a fold, or in a family of shapes: numerically neither stable nor unstable.
  constexpr double kOnTheFold = 1e-7;
  return solution.anchor && !solution.bends ? kUncertain * solution.shape.tail<2>().norm() / (4 * kPi * kPi)
                                            : kOnTheFold;
}

ClampedMargins marginsOf(const SampledSolution& sampled, std::optional<double> torsionRatio) {
  if (sampled.bends) return tautMargins(*sampled.bends);
  return clampedMargins(*sampled.modes, sampled.samples, torsionRatio);
}

ClampedSensitivity sensitivityOf(const SampledSolution& sampled) {
  if (sampled.bends) return tautSensitivity(*sampled.bends);
  // What a turned grip adds to the tangent angle before the blade settles: 1 − s and s.
  MatrixXd lifts(sampled.modes->nodes.size(), 2);
  lifts.col(0) = (1 - sampled.modes->nodes.array());
  lifts.col(1) = sampled.modes->nodes;
  return sensitivityOf(*sampled.modes, sampled.samples, lifts);
}

ClampedSensitivity sensitivityOf(const ClampedModes& modes, const ClampedSamples& samples,
                                 const MatrixXd& lifts) {
  const Index n = modes.count(), nodes = modes.nodes.size(), grips = lifts.cols();
  const VectorXd cosine = samples.angle.array().cos(), sine = samples.angle.array().sin();
  const VectorXd& w = modes.weights;
  const VectorXd potential = w.cwiseProduct(samples.force.x() * cosine + samples.force.y() * sine);

  MatrixXd system = MatrixXd::Zero(n + 2, n + 2), right = MatrixXd::Zero(n + 2, 2 + grips);
  const MatrixXd weighted = modes.values * potential.asDiagonal();
  system.topLeftCorner(n, n).noalias() -= weighted * modes.values.transpose();
  system.diagonal().head(n) += modes.stiffness;
  system.block(0, n, n, 1) = -(modes.values * w.cwiseProduct(sine));
  system.block(0, n + 1, n, 1) = modes.values * w.cwiseProduct(cosine);
  system.bottomLeftCorner(2, n) = system.topRightCorner(n, 2).transpose();
  right(n, 0) = 1;
  right(n + 1, 1) = 1;
  right.topRightCorner(n, grips) = weighted * lifts;
  for (Index k = 0; k < grips; ++k) {
    right(n, 2 + k) = w.cwiseProduct(sine).dot(lifts.col(k));
    right(n + 1, 2 + k) = -w.cwiseProduct(cosine).dot(lifts.col(k));
  }
  const MatrixXd solved = system.partialPivLu().solve(right);
  MatrixXd turn = modes.values.transpose() * solved.topRows(n);
  turn.rightCols(grips) += lifts;
  MatrixXd moved(2 * nodes, 2 + grips);
  moved.topRows(nodes) = -(modes.integral * (sine.asDiagonal() * turn));
  moved.bottomRows(nodes) = modes.integral * (cosine.asDiagonal() * turn);

  Eigen::Matrix4d positions = Eigen::Matrix4d::Zero();
  MatrixXd angles = MatrixXd::Zero(grips, grips);
  for (Index q = 0; q < nodes; ++q) {
    Eigen::Matrix<double, 2, 4> both;
    both.rightCols<2>() << moved.row(q).leftCols<2>(), moved.row(nodes + q).leftCols<2>();
    both.leftCols<2>() = Eigen::Matrix2d::Identity() - both.rightCols<2>();
    MatrixXd turned(2, grips);
    turned << moved.row(q).rightCols(grips), moved.row(nodes + q).rightCols(grips);
    positions += w(q) * both.transpose() * both;
    angles += w(q) * turned.transpose() * turned;
  }
  const auto largest = [](const auto& gram) {
    if (gram.rows() == 0) return 0.0;
    if (!gram.allFinite()) return std::numeric_limits<double>::infinity();
    using Matrix = std::decay_t<decltype(gram)>;
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(gram, Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
  };
  return {largest(positions), largest(angles)};
}

Result<Elastica> place(const ClampedProblem& problem, const UnitSolution& solution) {
  const double length = problem.length;
  if (solution.anchor) {
    const Result<Elastica> held = Elastica::makeAnchored(*solution.anchor, 1);
    if (!held) return held;
    // Its start, which followed from the anchor, into the grip.
    const Elastica turned =
        held->transformed(problem.startAngle - held->startAngle(), length, Vector2d::Zero());
    const Elastica moved = turned.transformed(0, 1, problem.start - turned.start());
    return Elastica::makeAnchored(*moved.anchor(), length);
  }
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
  result.energy = blade->energy();
  const ClampedMargins margins = marginsOf(sampled, torsionRatio);
  result.stabilityMargin = margins.inPlane;
  result.outOfPlaneMargin = margins.outOfPlane;
  const double certain = certainMargin(solution);
  result.stable = margins.inPlane > certain;
  const bool loop = solution.anchor && !solution.bends;
  const Vector2d chord = (problem.end - problem.start) / problem.length;
  result.sliding = std::abs(margins.inPlane) <= certain && (loop || isClosed({chord, solution.turning}));
  const ClampedSensitivity sensitivity = sensitivityOf(sampled);
  result.sensitivity.perMm = sensitivity.perMm;
  result.sensitivity.perDegree = sensitivity.perDegree * problem.length * kDegree;
  result.inflections = blade->inflections();
  result.selfIntersects = blade->selfIntersects();
  result.endError = (blade->at(problem.length).point - problem.end).norm();
  return result;
}

}  // namespace bw::detail
