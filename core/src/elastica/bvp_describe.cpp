// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_describe.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bw/core/base/units.h"
#include "elastica/bvp_taut.h"

namespace bw::elastica {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// True if the modes resolve the bends of a taut blade: up to √f L = 400, less for bends that turn so far
/// that they are strongest away from the grip, at ln tan ¼α/√f.
bool resolves(const TautBends& bends) {
  constexpr double kLargestResolved = 400;
  const double larger = std::max(std::abs(bends.first), std::abs(bends.second));
  return bends.root * (1 + std::max(0.0, std::log(std::tan(0.25 * larger)))) <= kLargestResolved;
}

/// Of a blade in its unit frame, at ascending arc lengths.
ClampedSamples samplesOf(const UnitShape& q, const VectorXd& arcs) {
  auto [flow, unit] = flowOf<0>(q);
  ClampedSamples samples{VectorXd(arcs.size()), VectorXd(arcs.size()), q.tail<2>()};
  for (Index i = 0; i < arcs.size(); ++i) {
    flow.advanceTo(arcs(i) / unit);
    const auto block = flow.at(arcs(i) / unit);
    samples.angle(i) = block(2, 0);
    samples.curvature(i) = block(3, 0) / unit;
  }
  return samples;
}

/// Arc lengths; the curvature vanishes at a hinge too, but there the blade ends.
std::vector<double> inflectionsOf(const Elastica& blade, HeldEnds ends) {
  constexpr double kAtHinge = 1e-3;
  const double first = ends == HeldEnds::none ? kAtHinge : 0, last = ends == HeldEnds::both ? 0 : kAtHinge;
  std::vector<double> result = blade.inflections();
  std::erase_if(result,
                [&](double s) { return s < first * blade.length() || s > (1 - last) * blade.length(); });
  return result;
}

/// True if a blade near the single loop holds a whole loop: what lies between two places, hinges among them,
/// where it is nearest to rest against the force.
bool holdsLoop(const Elastica& blade, HeldEnds ends) {
  const int inflections = int(inflectionsOf(blade, ends).size()) + hingesOf(ends);
  if (inflections > 0) return inflections > 1;
  const double force = std::atan2(blade.force().y(), blade.force().x());
  const auto turns = [&](double s) { return std::floor((blade.at(s).angle - force - kPi) / (2 * kPi)); };
  return std::abs(turns(blade.length()) - turns(0)) > 1;
}

}  // namespace

SampledSolution sample(const UnitSolution& solution) {
  SampledSolution result;
  const double phase = phaseOf(solution.shape);
  result.modes = &clampedModesFor(phase, solution.ends);
  result.clamped = &clampedModesFor(phase);
  if (solution.bends && !resolves(*solution.bends)) result.bends = solution.bends;
  const VectorXd& nodes = result.modes->nodes;
  if (solution.anchor) {
    if (const Result<Elastica> held = Elastica::makeAnchored(*solution.anchor, 1)) {
      if (!solution.bends && holdsLoop(*held, solution.ends)) {
        const Elastica::Anchor& rest = *held->anchor();
        const double f = rest.force.norm();
        result.loop = std::max(std::abs(rest.force.y()) / f, std::abs(rest.curvature) / std::sqrt(f));
      }
      result.samples = samplesOf(*held, nodes);
      result.samples.force = solution.shape.tail<2>();
      return result;
    }
  }
  result.samples = samplesOf(solution.shape, nodes);
  return result;
}

bool isResolved(const UnitSolution& solution, const SampledSolution& sampled) {
  constexpr double kSameEnergy = 1e-6;
  if (!solution.anchor || solution.bends) return true;
  const Result<Elastica> held = Elastica::makeAnchored(*solution.anchor, 1);
  return held && std::abs(energyOf(sampled) - held->energy()) <= kSameEnergy * held->energy();
}

double energyOf(const SampledSolution& sampled) {
  if (sampled.bends) return tautEnergy(*sampled.bends);
  return 0.5 * sampled.modes->weights.dot(sampled.samples.curvature.cwiseAbs2());
}

bool isClosed(const UnitProblem& problem) {
  constexpr double kClosed = 1e-9;  // lengths, rad
  return problem.ends == HeldEnds::both && problem.end.norm() < kClosed &&
         std::abs(std::remainder(problem.turning, 2 * kPi)) < kClosed;
}

double certainMargin(const UnitSolution& solution) {
  constexpr double kUncertain = 1e-3;  // of f, the margin of a taut blade without loops
  // On a fold, or in a family of shapes: numerically neither stable nor unstable.
  constexpr double kOnTheFold = 1e-7;
  return solution.anchor && !solution.bends
             ? kUncertain * solution.shape.tail<2>().norm() / straightEigenvalue(solution.ends)
             : kOnTheFold;
}

ClampedMargins marginsOf(const SampledSolution& sampled, std::optional<double> torsionRatio) {
  if (sampled.bends) return tautMargins(*sampled.bends, sampled.modes->ends);
  ClampedMargins margins = clampedMargins(*sampled.modes, *sampled.clamped, sampled.samples, torsionRatio);
  // κ on a whole loop alone changes the energy by no more than what is left of it at its ends, and nothing
  // else lies lower; modes that do not resolve it say otherwise.
  constexpr double kNothingLeft = 1e-3;
  if (sampled.loop) margins.inPlane = *sampled.loop < kNothingLeft ? 0 : std::min(margins.inPlane, 0.0);
  return margins;
}

namespace {

/// What a turned grip adds to the tangent angle before the blade settles, one column a grip that holds its
/// tangent: 1 − s and s, or a turn of the whole where the other end is hinged. Neither has a part in
/// ∫ φ_j' φ'.
MatrixXd liftsOf(const ClampedModes& modes) {
  const Index nodes = modes.nodes.size();
  if (modes.ends != HeldEnds::both) return MatrixXd::Ones(nodes, modes.ends == HeldEnds::start ? 1 : 0);
  MatrixXd lifts(nodes, 2);
  lifts.col(0) = (1 - modes.nodes.array());
  lifts.col(1) = modes.nodes;
  return lifts;
}

}  // namespace

ClampedSensitivity sensitivityOf(const SampledSolution& sampled) {
  if (sampled.bends) return tautSensitivity(*sampled.bends, sampled.modes->ends);
  const ClampedModes& modes = *sampled.modes;
  const ClampedSamples& samples = sampled.samples;
  const MatrixXd lifts = liftsOf(modes);
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
    turned.row(0) = moved.row(q).rightCols(grips);
    turned.row(1) = moved.row(nodes + q).rightCols(grips);
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
  const UnitShape& q = solution.shape;
  const Result<Elastica> unit = solution.anchor ? Elastica::makeAnchored(*solution.anchor, 1)
                                                : Elastica::make(Vector2d::Zero(), 0, q(0), q.tail<2>(), 1);
  if (!unit) return unit;
  double angle = 0;
  if (problem.startAngle) {
    angle = *problem.startAngle;
  } else {
    // Turned until its chord is that of the hinges.
    const Vector2d chord = problem.end - problem.start, own = unit->at(1).point - unit->start();
    angle = unit->startAngle() +
            std::remainder(std::atan2(chord.y(), chord.x()) - std::atan2(own.y(), own.x()), 2 * kPi);
  }
  if (solution.anchor) {
    // Its start, which followed from the anchor, into the grip.
    const Elastica turned = unit->transformed(angle - unit->startAngle(), length, Vector2d::Zero());
    const Elastica moved = turned.transformed(0, 1, problem.start - turned.start());
    return Elastica::makeAnchored(*moved.anchor(), length);
  }
  return Elastica::make(problem.start, angle, q(0) / length,
                        Eigen::Rotation2Dd(angle) * q.tail<2>() / length / length, length);
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
  const Vector2d chord = (problem.end - problem.start) / problem.length;
  result.sliding = std::abs(margins.inPlane) <= certain &&
                   (sampled.loop || isClosed({chord, solution.turning, solution.ends}));
  const ClampedSensitivity sensitivity = sensitivityOf(sampled);
  result.sensitivity.perMm = sensitivity.perMm;
  result.sensitivity.perDegree = sensitivity.perDegree * problem.length * kDegree;
  result.inflections = inflectionsOf(*blade, solution.ends);
  result.selfIntersects = blade->selfIntersects();
  result.endError = (blade->at(problem.length).point - problem.end).norm();
  return result;
}

}  // namespace bw::elastica
