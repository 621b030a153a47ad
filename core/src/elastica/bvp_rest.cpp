// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "elastica/bvp_search.h"
#include "elastica/bvp_sketch.h"
#include "elastica/bvp_taut.h"

namespace bw::elastica {

bool restsIn(const UnitSolution& found, const SampledSolution& sampled) {
  return !sampled.loop && marginsOf(sampled, {}).inPlane > certainMargin(found);
}

namespace {

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
