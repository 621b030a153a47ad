// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/elastica/elastica_bvp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "elastica/bvp_check.h"
#include "elastica/bvp_describe.h"
#include "elastica/bvp_rest.h"
#include "elastica/bvp_search.h"
#include "elastica/bvp_taut.h"

namespace bw {

using namespace elastica;

namespace {

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

/// Part of the work of a case that following a branch may take: what is left finds the shapes at rest.
constexpr double kWalk = 0.4;
/// A blade whose branch ends has no margin left there; above this one, it was only lost.
constexpr double kLostMargin = 0.05;

Result<ClampedBranch::Move> walk(ClampedBranch& branch, const ClampedProblem& problem) {
  const WorkMeter share = WorkMeter::share(kWalk);
  return branch.moveTo(problem);
}

bool isLost(const ClampedBranch& branch, HeldEnds ends) {
  const UnitSolution stopped{.shape = branch.shape(), .ends = ends};
  return marginsOf(sample(stopped), {}).inPlane > kLostMargin;
}

/// A blade is between its grips if it misses them by no more than this, in lengths and rad; at hinges, of the
/// curvature against its size.
constexpr double kBetween = 1e-7;
/// A shape that moved by more than this, in parts of its size, is another one.
constexpr double kSameShape = 1e-4;

bool sameShape(const UnitShape& a, const UnitShape& b) {
  return (a - b).norm() <= kSameShape * (1 + a.norm());
}

/// A blade that lies between the grips of `problem` already, as their solution; empty if it misses them, or
/// has a curvature at a hinge. So an answer is its own start, however taut it is.
std::optional<UnitSolution> heldAlready(const Elastica& blade, const ClampedProblem& problem,
                                        const CheckedProblem& checked) {
  const double length = blade.length();
  const Elastica::State end = blade.at(length);
  const double turning = end.angle - blade.startAngle();
  const double turns = turning - checked.turning;
  const double size = 1 / length + std::sqrt(blade.force().norm());
  const double misses[] = {length / problem.length - 1, (blade.start() - problem.start).norm() / length,
                           (end.point - problem.end).norm() / length,
                           problem.startAngle
                               ? std::remainder(blade.startAngle() - *problem.startAngle, 2 * kPi)
                               : blade.at(0).curvature / size,
                           !problem.endAngle      ? end.curvature / size
                           : checked.fixedTurning ? turns
                                                  : std::remainder(turns, 2 * kPi)};
  for (const double miss : misses)
    if (!(std::abs(miss) <= kBetween)) return std::nullopt;

  const double whole = 2 * kPi * std::round((turning - checked.turning) / (2 * kPi));
  const bool both = checked.ends == HeldEnds::both;
  const UnitProblem unit{checked.end, both ? checked.turning + whole : 0, checked.ends};
  const Elastica scaled = blade.transformed(-blade.startAngle(), 1 / length, {0, 0});
  UnitSolution own;
  own.shape << scaled.startCurvature(), scaled.force();
  own.turning = both ? unit.turning : turning;
  own.ends = checked.ends;
  if (!blade.anchor()) return settle(unit, own.shape, 6);
  for (const TautBends& bends : checked.ends == HeldEnds::none ? std::vector<TautBends>() : tautBends(unit))
    if (const std::optional<UnitSolution> taut = tautShape(unit, bends);
        taut && sameShape(taut->shape, own.shape))
      return taut;
  const Elastica moved = scaled.transformed(0, 1, -scaled.start());
  own.anchor = *moved.anchor();
  own.error = (moved.at(1).point - unit.end).norm();
  return own;
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
  // A grip that is released may have held it.
  UnitSolution released = initial;
  released.ends = checked.ends;
  if (held) {
    answer.snapsAt = 0;
    answer.message = kNotStable;
  } else if (!restsIn(released, sample(released))) {
    answer.snapsAt = 0;
    answer.message =
        "The initial blade does not rest between ends that are held like these, so that it snaps at once; "
        "this "
        "is the stable blade nearest to it.";
  } else if (Result<ClampedBranch> branch = ClampedBranch::from(blade); !branch) {
    answer.message = branch.error().message + " This is the stable blade nearest to it.";
  } else {
    const Result<ClampedBranch::Move> move = walk(*branch, problem);
    if (!move) return tl::unexpected<Error>(move.error());
    if (move->snapped && isLost(*branch, checked.ends)) {
      answer.message =
          "The blade could not be followed all the way, because its shape hangs too finely on its start "
          "there. "
          "This is the stable blade nearest to the initial one.";
    } else if (!move->snapped) {
      const UnitProblem between{
          checked.end,
          checked.fixedTurning ? checked.turning
                               : initial.turning + std::remainder(checked.turning - initial.turning, 2 * kPi),
          checked.ends};
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
      leastAtRest(checked, std::max(options.maxTurning, std::abs(initial.turning)),
                  [&](const UnitSolution& shape) { return difference(shape, initial); });
  if (!nearest) return noShape(problem, checked, "stable");
  return *nearest;
}

ClampedAnswer straightAnswer(const ClampedProblem& problem) {
  ClampedSolution solution;
  const Eigen::Vector2d chord = problem.end - problem.start;
  const double angle = problem.startAngle.value_or(std::atan2(chord.y(), chord.x()));
  solution.elastica = *Elastica::make(problem.start, angle, 0, {0, 0}, problem.length);
  solution.stable = true;
  solution.stabilityMargin = solution.outOfPlaneMargin = 1;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  solution.sensitivity = {kInfinity, problem.startAngle || problem.endAngle ? kInfinity : 0};
  solution.endError = (solution.elastica.at(problem.length).point - problem.end).norm();
  return {
      {solution}, ClampedKind::straight, {}, "The blade is as long as its ends are apart: it is straight."};
}

/// By what ends hold their tangents.
constexpr std::array kBucklingMessages = {
    "Pure buckling: both tangents lie along the chord, so that the mirror image of each shape in the chord "
    "is "
    "as good.",
    "Pure buckling: the tangent that is held lies along the chord, so that the mirror image of each shape in "
    "the chord is as good.",
    "Pure buckling: no tangent is held, so that the mirror image of each shape in the chord is as good."};

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

Result<ClampedAnswer> solveOne(const ClampedProblem& problem, const CheckedProblem& checked,
                               const ClampedOptions& options) {
  ClampedAnswer answer;
  answer.kind = checked.kind;
  std::optional<UnitSolution> found;
  if (options.initial) {
    const Result<UnitSolution> followed = follow(problem, checked, options, answer);
    if (!followed) return tl::unexpected<Error>(followed.error());
    found = *followed;
  } else {
    found = atRest(checked, options.maxTurning);
    if (!found) return noShape(problem, checked, "stable");
    if (answer.kind == ClampedKind::buckling) answer.message = kBucklingMessages[std::size_t(checked.ends)];
  }
  const Result<ClampedSolution> solution = describe(problem, *found, sample(*found), options.torsionRatio);
  if (!solution) return tl::unexpected<Error>(solution.error());
  answer.solutions.push_back(*solution);
  if (options.others) {
    const Result<ClampedOthers> others = othersBeside(answer.solutions[0], problem, checked, options);
    if (!others) return tl::unexpected<Error>(others.error());
    answer.others = *others;
  }
  return answer;
}

Result<ClampedAnswer> solveAll(const ClampedProblem& problem, const CheckedProblem& checked,
                               const ClampedOptions& options) {
  ClampedAnswer answer;
  answer.kind = checked.kind;
  if (answer.kind == ClampedKind::buckling) answer.message = kBucklingMessages[std::size_t(checked.ends)];
  for (const UnitSolution& found : shapesOf(checked, options.maxTurning, options.maxInflections)) {
    const SampledSolution sampled = sample(found);
    if (!isResolved(found, sampled)) continue;
    const Result<ClampedSolution> solution = describe(problem, found, sampled, options.torsionRatio);
    if (!solution) return tl::unexpected<Error>(solution.error());
    if (int(solution->inflections.size()) > options.maxInflections) continue;
    answer.solutions.push_back(*solution);
  }
  if (answer.solutions.empty()) return noShape(problem, checked, "resting");
  std::stable_sort(answer.solutions.begin(), answer.solutions.end(),
                   [](const ClampedSolution& a, const ClampedSolution& b) { return a.energy < b.energy; });
  if (isClosed({checked.end, checked.turning, checked.ends}) && keepOneOfAFamily(answer.solutions))
    answer.message = kSlidingMessage;
  const auto rests = std::find_if(answer.solutions.begin(), answer.solutions.end(),
                                  [](const ClampedSolution& solution) { return solution.stable; });
  answer.others = othersAmong(answer.solutions, std::size_t(rests - answer.solutions.begin()));
  return answer;
}

/// The answer about the blade run backwards as one about the blade itself, between the grips of `problem`.
void runBackwards(ClampedAnswer& answer, const ClampedProblem& problem) {
  for (ClampedSolution& solution : answer.solutions) {
    const double length = solution.elastica.length();
    solution.elastica = solution.elastica.reversed();
    solution.turning = -solution.turning;
    std::reverse(solution.inflections.begin(), solution.inflections.end());
    for (double& s : solution.inflections) s = length - s;
    solution.endError = std::max((solution.elastica.start() - problem.start).norm(),
                                 (solution.elastica.at(length).point - problem.end).norm());
  }
  answer.others.turning = -answer.others.turning;
}

/// By `solve` on the problem, run backwards if its start alone is hinged.
Result<ClampedAnswer> answerBy(const auto& solve, const ClampedProblem& problem,
                               const ClampedOptions& options) {
  if (Result<void> ok = check(options); !ok) return tl::unexpected<Error>(ok.error());
  const Result<CheckedProblem> checked = check(problem);
  if (!checked) return tl::unexpected<Error>(checked.error());
  if (checked->kind == ClampedKind::straight) return straightAnswer(problem);
  if (!checked->backwards) return solve(problem, *checked, options);
  ClampedOptions turned = options;
  if (turned.initial) turned.initial = turned.initial->reversed();
  Result<ClampedAnswer> answer = solve(reversed(problem), *checked, turned);
  if (answer) runBackwards(*answer, problem);
  return answer;
}

}  // namespace

const char* clampedKindName(ClampedKind kind) {
  return std::array{"general", "straight", "buckling"}[std::size_t(kind)];
}

Result<ClampedAnswer> solveClamped(const ClampedProblem& problem, const ClampedOptions& options) {
  return answerBy(solveOne, problem, options);
}

Result<ClampedAnswer> solveAllClamped(const ClampedProblem& problem, const ClampedOptions& options) {
  return answerBy(solveAll, problem, options);
}

}  // namespace bw
