// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "elastica/bvp_search.h"
#include "elastica/bvp_taut.h"
#include "elastica/clamped_modes.h"
#include "optimise/bracketed_root.h"

namespace bw::elastica {

namespace {

constexpr int kModes = 10;
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

/// A blade between its grips in few unknowns: tangent angle turning · s + Σ c_j φ_j(s).
/// docs/mathematics.md, 6.
struct Sketch {
  using Coefficients = Eigen::Matrix<double, kModes, 1>;
  Coefficients coefficients = Coefficients::Zero();
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  double energy = 0;
};

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

/// Descends from a sketch to a blade of locally least energy that ends where it should. False if it finds
/// none.
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

/// The sketch as a start for Newton's method.
UnitShape shapeOf(const UnitProblem& problem, const Sketch& sketch) {
  return {problem.turning + table().startSlope.dot(sketch.coefficients), sketch.force.x(), sketch.force.y()};
}

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

/// Where descents start: the two stable blades of the theory of small angles first, then shapes of two modes,
/// by energy.
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

/// A sketch's energy is wrong by no more than this factor.
constexpr double kSketchError = 1.01;
/// Energies closer than this part are the same.
constexpr double kSameEnergy = 1e-9;

/// True if no shape of the same turning has less energy: the bends are small, rad, or the blade is too taut,
/// √f L, for anything else, and not both bends turn so far that they had better turn the other way.
bool isTautAlone(const TautBends& bends) {
  constexpr double kSmallBend = 1.5, kLargeBend = 3.0, kTaut = 12, kTautAlone = 60;
  const double first = std::abs(bends.first), second = std::abs(bends.second);
  const double larger = std::max(first, second);
  return larger < kSmallBend || (larger < kLargeBend && bends.root > kTaut) ||
         (first + second < 2 * kPi && bends.root > kTautAlone);
}

/// A blade of locally least energy, the lowest one that proves stable. Both ends hold their tangents.
struct Rest {
  std::optional<UnitSolution> shape;
  double energy = std::numeric_limits<double>::infinity();
  bool sure = true;  ///< false if it is taut, where the sketches of a smaller turning failed
};

/// From the bends of a taut blade, or each first sketch.
Rest restFromSketches(const CheckedProblem& problem, double maxTurning) {
  Rest best;
  bool missed = false;
  const auto consider = [&](const UnitSolution& found) {
    const SampledSolution sampled = sample(found);
    const double energy = energyOf(sampled);
    if (energy >= best.energy * (1 - kSameEnergy)) return;
    if (!restsIn(found, sampled)) return;
    best = {found, energy, !(missed && found.bends)};
  };
  const auto considerSketches = [&](const UnitProblem& unit) {
    std::vector<Sketch> sketches = firstSketches(unit);
    std::erase_if(sketches, [&](Sketch& sketch) {
      return !descend(unit, sketch) || sketch.energy > kSketchError * best.energy;
    });
    std::sort(sketches.begin(), sketches.end(),
              [](const Sketch& a, const Sketch& b) { return a.energy < b.energy; });
    for (const Sketch& sketch : sketches) {
      if (sketch.energy > kSketchError * best.energy) break;
      const std::optional<UnitSolution> found = settle(unit, shapeOf(unit, sketch), 12);
      if (!found) continue;
      consider(*found);
    }
  };
  for (const double turning : problem.turnings(maxTurning)) {
    if (detail::workExhausted()) break;
    // No blade turns so far with less energy than the circle.
    if (0.5 * turning * turning >= best.energy) continue;
    const UnitProblem unit{problem.end, turning};
    const std::vector<TautBends> bends = tautBends(unit);
    const bool taut = !bends.empty() && isTautAlone(bends.front());
    if (!taut) {
      considerSketches(unit);
      missed = missed || !best.shape;
    }
    for (const TautBends& pair : bends) {
      if (tautEnergy(pair) > kSketchError * best.energy) break;
      if (const std::optional<UnitSolution> found = tautShape(unit, pair)) consider(*found);
    }
    if (taut && !best.shape) considerSketches(unit);
  }
  return best;
}

double energyOfShape(const UnitSolution& shape) { return energyOf(sample(shape)); }

/// Two blades between the same grips are one if no point is farther from its counterpart, in lengths.
constexpr double kSameBlade = 1e-5;

bool sameBlade(const Elastica& a, const Elastica& b) {
  constexpr int kPoints = 17;
  const std::vector<Eigen::Vector2d> first = a.sample(kPoints), second = b.sample(kPoints);
  for (std::size_t i = 0; i < first.size(); ++i)
    if ((first[i] - second[i]).norm() > kSameBlade * a.length()) return false;
  return true;
}

void add(ClampedOthers& others, double energy, double turning) {
  ++others.stable;
  if (others.stable > 1 && energy >= others.energy) return;
  others.energy = energy;
  others.turning = turning;
}

}  // namespace

bool restsIn(const UnitSolution& found, const SampledSolution& sampled) {
  return !sampled.loop && marginsOf(sampled, {}).inPlane > certainMargin(found);
}

std::optional<UnitSolution> leastAtRest(const CheckedProblem& problem, double maxTurning,
                                        const std::function<double(const UnitSolution&)>& measure) {
  const std::vector<UnitSolution> shapes =
      shapesOf(problem, maxTurning, kRestInflections - hingesOf(problem.ends));
  std::vector<std::pair<double, const UnitSolution*>> order;
  for (const UnitSolution& shape : shapes) order.emplace_back(measure(shape), &shape);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  // Margins cost far more than measures.
  for (const auto& [value, shape] : order) {
    const SampledSolution sampled = sample(*shape);
    if (isResolved(*shape, sampled) && restsIn(*shape, sampled)) return *shape;
  }
  return std::nullopt;
}

std::optional<UnitSolution> atRest(const CheckedProblem& problem, double maxTurning) {
  Rest rest;
  if (problem.ends == HeldEnds::both) rest = restFromSketches(problem, maxTurning);
  if (rest.shape && rest.sure) return rest.shape;
  const std::optional<UnitSolution> found = leastAtRest(problem, maxTurning, energyOfShape);
  const bool lower = found && !(energyOfShape(*found) >= rest.energy);
  return lower ? found : rest.shape;
}

ClampedOthers othersAmong(const std::vector<ClampedSolution>& solutions, std::size_t answer) {
  ClampedOthers others;
  for (std::size_t i = 0; i < solutions.size(); ++i)
    if (i != answer && solutions[i].stable) add(others, solutions[i].energy, solutions[i].turning);
  return others;
}

Result<ClampedOthers> othersBeside(const ClampedSolution& answer, const ClampedProblem& problem,
                                   const CheckedProblem& checked, const ClampedOptions& options) {
  ClampedOthers others;
  const int inflections = kRestInflections - hingesOf(checked.ends);
  const double turning = std::max(options.maxTurning, std::abs(answer.turning));
  for (const UnitSolution& found : shapesOf(checked, turning, inflections)) {
    const SampledSolution sampled = sample(found);
    if (!isResolved(found, sampled) || !restsIn(found, sampled)) continue;
    const Result<Elastica> blade = place(problem, found);
    if (!blade) return tl::unexpected<Error>(blade.error());
    if (sameBlade(*blade, answer.elastica)) continue;
    add(others, blade->energy(), found.turning);
  }
  return others;
}

}  // namespace bw::elastica
