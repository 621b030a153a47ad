// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica_bvp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/work_meter.h"
#include "bw/core/number_text.h"
#include "elastica/bvp_check.h"
#include "elastica/bvp_describe.h"
#include "elastica/bvp_held.h"
#include "elastica/bvp_others.h"
#include "elastica/bvp_search.h"
#include "elastica/bvp_sketch.h"
#include "elastica/bvp_taut.h"

namespace bw {

using namespace detail;

namespace {

/// A sketch's energy is wrong by no more than this factor.
constexpr double kSketchError = 1.01;
/// Energies closer than this part are the same.
constexpr double kSameEnergy = 1e-9;

bool restsIn(const UnitSolution& found, const SampledSolution& sampled) {
  return marginsOf(sampled, {}).inPlane > certainMargin(found);
}

/// True if no shape of the same turning has less energy: the bends are small, rad, or the blade is too taut,
/// √f L, for anything else, and not both bends turn so far that they had better turn the other way.
bool isTautAlone(const TautBends& bends) {
  constexpr double kSmallBend = 1.5, kLargeBend = 3.0, kTaut = 12, kTautAlone = 60;
  const double first = std::abs(bends.first), second = std::abs(bends.second);
  const double larger = std::max(first, second);
  return larger < kSmallBend || (larger < kLargeBend && bends.root > kTaut) ||
         (first + second < 2 * std::numbers::pi && bends.root > kTautAlone);
}

/// A blade of locally least energy, the lowest one that proves stable.
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
    if (workExhausted()) break;
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

/// All stable shapes, slower.
std::vector<UnitSolution> allAtRest(const CheckedProblem& problem, double maxTurning) {
  std::vector<UnitSolution> result;
  for (const double turning : problem.turnings(maxTurning))
    for (const UnitSolution& found : allShapes({problem.end, turning}, kRestInflections)) {
      const SampledSolution sampled = sample(found);
      if (isResolved(found, sampled) && restsIn(found, sampled)) result.push_back(found);
    }
  return result;
}

double energyOfShape(const UnitSolution& shape) { return energyOf(sample(shape)); }

std::optional<UnitSolution> leastOf(const std::vector<UnitSolution>& shapes, const auto& measure) {
  const auto least =
      std::min_element(shapes.begin(), shapes.end(),
                       [&](const UnitSolution& a, const UnitSolution& b) { return measure(a) < measure(b); });
  return least == shapes.end() ? std::nullopt : std::optional(*least);
}

/// Mean square difference of the tangent angles against the chord's frame of the start.
double difference(const UnitSolution& a, const UnitSolution& b) {
  const SampledSolution first = sample(a), second = sample(b);
  constexpr int kPoints = 33;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const auto at = [&](const SampledSolution& s) {
      const Eigen::VectorXd& nodes = s.modes->nodes;
      const double x = double(i) / (kPoints - 1);
      const Eigen::Index k = std::clamp<Eigen::Index>(
          std::lower_bound(nodes.begin(), nodes.end(), x) - nodes.begin(), 1, nodes.size() - 1);
      const double u = (x - nodes(k - 1)) / (nodes(k) - nodes(k - 1));
      return s.samples.angle(k - 1) * (1 - u) + s.samples.angle(k) * u;
    };
    const double d = at(first) - at(second);
    sum += d * d;
  }
  return sum / kPoints;
}

tl::unexpected<Error> noShape(const ClampedProblem& problem, const CheckedProblem& checked,
                              const char* which) {
  const double share = checked.end.norm();
  constexpr double kTautShare = 0.97;
  const bool taut = share > kTautShare;
  return fail(ErrorCode::noSolution,
              std::string("No ") + which + " shape of the blade was found for ends at " +
                  shortText(100 * share) + " % of its length" +
                  (taut ? ": it would be pulled too taut between grips that point away from each other; "
                          "bring them closer "
                          "together, or turn them towards the line between them."
                        : "; move the grips apart, or allow more inflections or turning."),
              "length", problem.length, problem.length * share);
}

/// The blade that `initial` becomes. The answer's solutions stay empty; the shape is returned.
Result<UnitSolution> follow(const ClampedProblem& problem, const CheckedProblem& checked,
                            const ClampedOptions& options, ClampedAnswer& answer) {
  const Elastica& blade = *options.initial;
  const char* const kNotStable =
      "The branch of the initial blade is not stable here; this is the stable blade nearest to it.";
  const std::optional<UnitSolution> held = heldAlready(blade, problem, checked);
  if (held && restsIn(*held, sample(*held))) return *held;
  const Elastica unit = blade.transformed(-blade.startAngle(), 1 / blade.length(), {0, 0});
  UnitSolution initial;
  initial.shape << unit.startCurvature(), unit.force();
  if (unit.anchor()) initial.anchor = *unit.transformed(0, 1, -unit.start()).anchor();
  initial.turning = blade.at(blade.length()).angle - blade.startAngle();
  if (held) {
    answer.message = kNotStable;
  } else if (Result<ClampedBranch> branch = ClampedBranch::from(blade); !branch) {
    answer.message = branch.error().message + " This is the stable blade nearest to it.";
  } else {
    const Result<ClampedBranch::Move> move = branch->moveTo(problem);
    if (!move) return tl::unexpected<Error>(move.error());
    if (!move->snapped) {
      const UnitProblem between{
          checked.end,
          checked.fixedTurning
              ? checked.turning
              : initial.turning + std::remainder(checked.turning - initial.turning, 2 * std::numbers::pi)};
      const std::optional<UnitSolution> found = settle(between, branch->shape(), 4);
      if (found && restsIn(*found, sample(*found))) return *found;
      if (found) answer.message = kNotStable;
    } else {
      answer.snapsAt = move->reached;
      answer.message = "On its way from the initial blade the blade snaps at " +
                       shortText(100 * move->reached) +
                       " % of the way; this is the stable blade nearest to the initial one.";
    }
  }
  const std::optional<UnitSolution> nearest =
      leastOf(allAtRest(checked, std::max(options.maxTurning, std::abs(initial.turning))),
              [&](const UnitSolution& shape) { return difference(shape, initial); });
  if (!nearest) return noShape(problem, checked, "stable");
  return *nearest;
}

ClampedAnswer straightAnswer(const ClampedProblem& problem) {
  ClampedSolution solution;
  solution.elastica = *Elastica::make(problem.start, problem.startAngle, 0, {0, 0}, problem.length);
  solution.stable = true;
  solution.stabilityMargin = solution.outOfPlaneMargin = 1;
  solution.sensitivity = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  solution.endError = (solution.elastica.at(problem.length).point - problem.end).norm();
  return {
      {solution}, ClampedKind::straight, {}, "The blade is as long as its ends are apart: it is straight."};
}

const char* const kBucklingMessage =
    "Pure buckling: both tangents lie along the chord, so that the mirror image of each shape in the chord "
    "is as good.";

const char* const kSlidingMessage =
    "Both grips are in one place and point the same way: shapes with inflections slide along themselves "
    "through "
    "them without resistance, and one of each such family is given.";

/// Shapes of a closed curve with inflections, lowest energy first: of those that turn into each other by
/// sliding through the grips, the one that meets them best. True if there were others.
bool keepOneOfAFamily(std::vector<ClampedSolution>& solutions) {
  constexpr double kSameFamily = 1e-6;  // of the energy
  std::vector<ClampedSolution> kept;
  for (ClampedSolution& solution : solutions) {
    const auto like = std::find_if(kept.begin(), kept.end(), [&](const ClampedSolution& other) {
      return !other.inflections.empty() && other.inflections.size() == solution.inflections.size() &&
             std::abs(other.turning - solution.turning) < kSameFamily &&
             std::abs(other.energy - solution.energy) < kSameFamily * solution.energy;
    });
    if (like == kept.end())
      kept.push_back(std::move(solution));
    else if (solution.endError < like->endError)
      *like = std::move(solution);
  }
  const bool several = kept.size() < solutions.size();
  solutions = std::move(kept);
  return several;
}

}  // namespace

const char* clampedKindName(ClampedKind kind) {
  switch (kind) {
    case ClampedKind::general:
      return "general";
    case ClampedKind::straight:
      return "straight";
    case ClampedKind::buckling:
      return "buckling";
  }
  return "general";
}

Result<ClampedAnswer> solveClamped(const ClampedProblem& problem, const ClampedOptions& options) {
  if (Result<void> ok = check(options); !ok) return tl::unexpected<Error>(ok.error());
  const Result<CheckedProblem> checked = check(problem);
  if (!checked) return tl::unexpected<Error>(checked.error());
  if (checked->kind == ClampedKind::straight) return straightAnswer(problem);
  ClampedAnswer answer;
  answer.kind = checked->kind;
  std::optional<UnitSolution> found;
  if (options.initial) {
    const Result<UnitSolution> followed = follow(problem, *checked, options, answer);
    if (!followed) return tl::unexpected<Error>(followed.error());
    found = *followed;
  } else {
    Rest rest = restFromSketches(*checked, options.maxTurning);
    found = rest.shape;
    if (!found || !rest.sure) {
      std::vector<UnitSolution> shapes = allAtRest(*checked, options.maxTurning);
      if (found) shapes.push_back(*found);
      found = leastOf(shapes, energyOfShape);
    }
    if (!found) return noShape(problem, *checked, "stable");
    if (answer.kind == ClampedKind::buckling) answer.message = kBucklingMessage;
  }
  const Result<ClampedSolution> solution = describe(problem, *found, sample(*found), options.torsionRatio);
  if (!solution) return tl::unexpected<Error>(solution.error());
  answer.solutions.push_back(*solution);
  if (options.others) {
    const Result<ClampedOthers> others = othersBeside(answer.solutions[0], problem, *checked, options);
    if (!others) return tl::unexpected<Error>(others.error());
    answer.others = *others;
  }
  return answer;
}

Result<ClampedAnswer> solveAllClamped(const ClampedProblem& problem, const ClampedOptions& options) {
  if (Result<void> ok = check(options); !ok) return tl::unexpected<Error>(ok.error());
  const Result<CheckedProblem> checked = check(problem);
  if (!checked) return tl::unexpected<Error>(checked.error());
  if (checked->kind == ClampedKind::straight) return straightAnswer(problem);
  ClampedAnswer answer;
  answer.kind = checked->kind;
  if (answer.kind == ClampedKind::buckling) answer.message = kBucklingMessage;
  for (const double turning : checked->turnings(options.maxTurning))
    for (const UnitSolution& found : allShapes({checked->end, turning}, options.maxInflections)) {
      const SampledSolution sampled = sample(found);
      if (!isResolved(found, sampled)) continue;
      const Result<ClampedSolution> solution = describe(problem, found, sampled, options.torsionRatio);
      if (!solution) return tl::unexpected<Error>(solution.error());
      if (int(solution->inflections.size()) > options.maxInflections) continue;
      answer.solutions.push_back(*solution);
    }
  if (answer.solutions.empty()) return noShape(problem, *checked, "resting");
  std::stable_sort(answer.solutions.begin(), answer.solutions.end(),
                   [](const ClampedSolution& a, const ClampedSolution& b) { return a.energy < b.energy; });
  if (isClosed({checked->end, checked->turning}) && keepOneOfAFamily(answer.solutions))
    answer.message = kSlidingMessage;
  const auto rests = std::find_if(answer.solutions.begin(), answer.solutions.end(),
                                  [](const ClampedSolution& solution) { return solution.stable; });
  answer.others = othersAmong(answer.solutions, std::size_t(rests - answer.solutions.begin()));
  return answer;
}

}  // namespace bw
