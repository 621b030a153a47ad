// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_sketch.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "elastica/clamped_modes.h"
#include "optimise/bracketed_root.h"

namespace bw::elastica {

namespace {

constexpr int kModes = kSketchModes;
constexpr int kNodes = 18;
constexpr int kMaxDescents = 25;
/// Work (`WorkMeter`) of one round.
constexpr std::int64_t kRoundWork = 40;
/// A step turns no tangent by more than this, rad.
constexpr double kLargestTurn = 0.8;
/// The descent ends when its step is this small; Newton's method on the curve itself does the rest.
constexpr double kDescended = 1e-4;
/// Relative accuracy of the logarithm of the force with which it begins.
constexpr double kSketched = 1e-8;

using Coefficients = Sketch::Coefficients;
using Hessian = Eigen::Matrix<double, kModes, kModes>;

/// The modes in fixed sizes, with what the sketches need of them.
struct Table {
  Eigen::Matrix<double, kModes, kNodes> values;
  Eigen::Matrix<double, kNodes, 1> nodes, weights;
  Coefficients stiffness, mean, ramp, startSlope;

  Table() {
    const ClampedModes& modes = sketchModes();
    values = modes.values;
    nodes = modes.nodes;
    weights = modes.weights;
    stiffness = modes.stiffness;
    mean = values * weights;
    ramp = values * weights.cwiseProduct(nodes);
    startSlope = modes.startSlope;
  }
};

const Table& table() {
  static const Table result;
  return result;
}

}  // namespace

bool descend(const UnitProblem& problem, Sketch& sketch) {
  const Table& t = table();
  Coefficients& c = sketch.coefficients;
  Eigen::Vector2d& force = sketch.force;
  for (int round = 0; round < kMaxDescents && !detail::workExhausted(); ++round) {
    detail::chargeWork(kRoundWork);
    Eigen::Matrix<double, kNodes, 1> angle = t.values.transpose() * c + problem.turning * t.nodes;
    Eigen::Matrix<double, kNodes, 1> cosine, sine;
    for (int q = 0; q < kNodes; ++q) {
      cosine(q) = t.weights(q) * std::cos(angle(q));
      sine(q) = t.weights(q) * std::sin(angle(q));
    }
    const Eigen::Vector2d miss(cosine.sum() - problem.end.x(), sine.sum() - problem.end.y());
    Eigen::Matrix<double, kModes, 2> constraints;
    constraints.col(0) = -(t.values * sine);
    constraints.col(1) = t.values * cosine;
    // Orthonormal rows of the constraints, for the penalty that makes the Hessian definite off them.
    Eigen::Matrix<double, kModes, 2> unit = constraints;
    unit.col(1) /= std::max(unit.col(1).norm(), 1e-9);
    unit.col(0) -= unit.col(1) * unit.col(1).dot(unit.col(0));
    unit.col(0) /= std::max(unit.col(0).norm(), 1e-9);
    const Coefficients gradient = t.stiffness.cwiseProduct(c);

    Hessian geometric = Hessian::Zero();
    for (int q = 0; q < kNodes; ++q) {
      const Coefficients phi = t.values.col(q);
      const Coefficients scaled = phi * (force.x() * cosine(q) + force.y() * sine(q));
      for (int i = 0; i < kModes; ++i) geometric.col(i) += scaled(i) * phi;
    }
    const double penalty = 40 + 2 * force.norm();
    Eigen::LLT<Hessian> factors;
    bool definite = false;
    for (const double share : {1.0, 0.5, 0.0}) {
      Hessian h = -share * geometric;
      h.diagonal() += t.stiffness;
      h += penalty * unit * unit.transpose();
      factors.compute(h);
      if (factors.info() != Eigen::Success) continue;
      definite = share == 1.0;
      break;
    }
    Eigen::Matrix<double, kModes, 3> right;
    // On the step A p = −r, so the penalty's part of the left side is known.
    const Eigen::Matrix2d inUnit = unit.transpose() * constraints;  // A = inUnitᵀ unitᵀ
    const Eigen::Vector2d alongUnit = -(inUnit.transpose().partialPivLu().solve(miss));
    right.col(0) = -gradient + penalty * (unit * alongUnit);
    right.rightCols<2>() = constraints;
    factors.solveInPlace(right);
    const Eigen::Matrix2d schur = constraints.transpose() * right.rightCols<2>();
    const Eigen::Vector2d multiplier =
        schur.partialPivLu().solve(constraints.transpose() * right.col(0) + miss);
    Coefficients step = right.col(0) - right.rightCols<2>() * multiplier;
    if (!step.allFinite()) return false;
    const double turn = (t.values.transpose() * step).cwiseAbs().maxCoeff();
    const double share = turn > kLargestTurn ? kLargestTurn / turn : 1.0;
    c += share * step;
    force += share * (multiplier - force);
    if (turn < kDescended && miss.norm() < kDescended) {
      sketch.energy = 0.5 * (problem.turning * problem.turning + c.dot(t.stiffness.cwiseProduct(c)));
      return definite;
    }
  }
  return false;
}

UnitShape shapeOf(const UnitProblem& problem, const Sketch& sketch) {
  return {problem.turning + table().startSlope.dot(sketch.coefficients), sketch.force.x(), sketch.force.y()};
}

namespace {

/// The theory of small angles: with the angle against the chord ϑ = l(s) + Σ c_j φ_j, energy ½ Σ μ_j c_j²
/// under ∫ ϑ = 0 and ½ ∫ ϑ² = 1 − d. Stationary for c_j = (ν l_j + η m_j) / (μ_j − ν), ν the compressive
/// force.
struct SmallAngles {
  explicit SmallAngles(const UnitProblem& problem) {
    const Table& t = table();
    const double direction = std::atan2(problem.end.y(), problem.end.x());
    // The chord as seen from the mean tangent: nearest to it of its turns.
    const double middle = 0.5 * problem.turning;
    const double chord = direction + 2 * kPi * std::round((middle - direction) / (2 * kPi));
    line = problem.turning * t.ramp - chord * t.mean;
    offset = middle - chord;
    const double missing = std::max(1 - problem.end.norm(), 1e-9);
    shortening = missing + 0.25 * missing * missing;
    lineSquare = (chord * chord - chord * problem.turning + problem.turning * problem.turning / 3);
    // Without a part in the first buckling mode either side of it is as good: take a trace of it.
    if (std::abs(line(1)) < 1e-5) line(1) = line(1) < 0 ? -1e-5 : 1e-5;
  }

  Coefficients at(double nu) const {
    const Table& t = table();
    const Coefficients inverse = (t.stiffness.array() - nu).inverse();
    const double top = -offset - nu * (line.cwiseProduct(t.mean)).dot(inverse);
    const double eta = top / (t.mean.cwiseProduct(t.mean)).dot(inverse);
    return (nu * line + eta * t.mean).cwiseProduct(inverse);
  }
  /// ½ ∫ ϑ² over what the length asks for, minus 1.
  double excess(const Coefficients& c) const {
    return (0.5 * lineSquare + line.dot(c) + 0.5 * c.squaredNorm()) / shortening - 1;
  }

  Coefficients line;
  double offset = 0, shortening = 0, lineSquare = 0;
};

}  // namespace

std::vector<Sketch> firstSketches(const UnitProblem& problem) {
  const Table& t = table();
  std::vector<Sketch> result;
  const SmallAngles theory(problem);
  const double buckling = t.stiffness(1);
  const double direction = std::atan2(problem.end.y(), problem.end.x());
  const auto add = [&](double nu) {
    Sketch sketch;
    sketch.coefficients = theory.at(nu);
    sketch.force = nu * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    sketch.energy = 0.5 * (problem.turning * problem.turning +
                           sketch.coefficients.dot(t.stiffness.cwiseProduct(sketch.coefficients)));
    result.push_back(sketch);
  };
  // Below the buckling force ½ ∫ ϑ² grows with the force; ν = buckling − e^x.
  const auto solve = [&](double sign, double from, double to) {
    const auto force = [&](double x) { return buckling + sign * std::exp(x); };
    const auto excess = [&](double x) { return theory.excess(theory.at(force(x))); };
    return force(optimise::bracketedRoot(excess, from, to, kSketched).low);
  };
  add(solve(-1, -12, 9));
  add(solve(1, -12, std::log(20.0)));
  return result;
}

}  // namespace bw::elastica
