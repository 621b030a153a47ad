// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/heavy/heavy_bvp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/base/work_meter.h"
#include "bw/core/text/number_text.h"
#include "heavy/heavy_descent.h"
#include "heavy/heavy_margins.h"
#include "heavy/heavy_path.h"

namespace bw {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;
using heavy::Equations;
using heavy::equationsOf;
using heavy::Hold;
using heavy::modesOf;
using heavy::Shape;

namespace {

constexpr double kHeaviest = 2000;     // w L³/EI: a blade that hangs like a chain
constexpr double kSameShape = 1e-4;    // rad: coefficients of the same equilibrium
constexpr Index kModesSearched = 96;   // loops tighter than a fortieth of the length are not searched from
constexpr int kMostFalls = 6;          // of one blade while its weight comes on
constexpr double kPush = 0.02;         // rad: to either side of a shape that is not stable
constexpr double kPastTheFold = 1e-7;  // of the way
constexpr double kBesideSag = 0.1;     // mm: what a blade falls into that may sag by less lies beside it
constexpr double kAsGood = 1e-12;      // of the energy: two mirror images are equally low

/// A problem whose grips have been looked at, with the length and the flexural rigidity as units.
struct Unit {
  const HeavyProblem& problem;
  double torsionRatio;
  Vector2d load;  ///< w L³/EI

  double length() const { return problem.grips.length; }
  Hold hold(double turning, double share = 1) const {
    return {(problem.grips.end - problem.grips.start) / length(), *problem.grips.startAngle, turning,
            share * load};
  }
  heavy::Way weighing(double turning) const { return {hold(turning, 0), hold(turning, 1)}; }
  /// N mm: the unit of energies.
  double energy() const { return problem.stiffness / length(); }
};

Result<Unit> check(const HeavyProblem& problem, const ClampedOptions& options) {
  if (!(problem.stiffness > 0 && std::isfinite(problem.stiffness)))
    return fail(ErrorCode::badInput,
                "The blade's stiffness is " + shortText(problem.stiffness) +
                    "; give its flexural rigidity EI in N mm², above 0.",
                "stiffness", problem.stiffness, 0);
  if (!problem.weight.allFinite())
    return fail(ErrorCode::badInput, "The blade's weight is not a number; give N/mm.", "weight");
  if (!problem.grips.startAngle || !problem.grips.endAngle)
    return fail(
        ErrorCode::badInput,
        "A blade with weight is held at both ends here; give the angle of the hinged end or leave out "
        "the weight.",
        problem.grips.startAngle ? "end_angle" : "start_angle");
  const double length = problem.grips.length;
  Unit unit{problem, options.torsionRatio, problem.weight * (length * length * length / problem.stiffness)};
  if (!(unit.load.norm() <= kHeaviest))
    return fail(ErrorCode::badInput,
                "The blade's weight times its length cubed is " + shortText(unit.load.norm()) +
                    " of its stiffness; it hangs like a chain. Take a stiffer or shorter blade.",
                "weight", unit.load.norm(), kHeaviest);
  return unit;
}

/// A weightless blade in as many modes as it needs, `most` at most.
std::optional<Shape> shapeOf(const Unit& unit, const Elastica& blade, double turning, Index most) {
  const Hold hold = unit.hold(turning, 0);
  for (const Index count : heavy::kModeCounts) {
    if (count > most) break;
    const heavy::Modes& modes = modesOf(count);
    std::vector<double> arcs(std::size_t(modes.nodes.size()));
    for (Index q = 0; q < modes.nodes.size(); ++q) arcs[std::size_t(q)] = unit.length() * modes.nodes(q);
    std::vector<Elastica::State> states(arcs.size());
    blade.at(arcs, states);
    VectorXd curvature(modes.nodes.size());
    for (Index q = 0; q < modes.nodes.size(); ++q)
      curvature(q) = modes.weights(q) * states[std::size_t(q)].curvature * unit.length();
    // A mode's slopes are orthonormal; the force of the start on the blade, as of its end, is −λ.
    const Shape shape{modes.slopes * curvature, -blade.force() * (unit.length() * unit.length())};
    if (shape.coefficients.tail(3).lpNorm<Eigen::Infinity>() > heavy::kResolved) continue;
    if (std::optional<Shape> settled = heavy::settle(hold, shape, 8)) return settled;
  }
  return {};
}

tl::unexpected<Error> lost(const char* what) {
  return fail(ErrorCode::noSolution,
              std::string("The blade cannot be followed ") + what +
                  ": it is too taut, or bends too tightly. Take a longer blade, or grips closer together.",
              "weight");
}

HeavyBlade placed(const Unit& unit, double turning, const Shape& shape) {
  const double squared = unit.length() * unit.length();
  return HeavyBlade({unit.problem.grips.start, *unit.problem.grips.startAngle, unit.length(), turning,
                     shape.coefficients, shape.force / squared, unit.load / (squared * unit.length())});
}

/// An equilibrium with all that is said about it.
Result<HeavySolution> describe(const Unit& unit, double turning, const Shape& found) {
  const std::optional<Shape> shape = heavy::refined(unit.hold(turning), found, heavy::kExact);
  if (!shape) return lost("in finer modes");
  const Equations equations(modesOf(shape->count()), unit.hold(turning), *shape);
  HeavySolution solution{placed(unit, turning, *shape)};
  solution.energy = equations.energy() * unit.energy();
  solution.turning = turning;
  const heavy::Margins margins = heavy::marginsOf(equations, unit.torsionRatio);
  solution.stabilityMargin = margins.inPlane;
  solution.outOfPlaneMargin = margins.outOfPlane;
  solution.stable = margins.inPlane > 0;
  solution.sensitivity = heavy::sensitivityOf(equations);
  solution.sensitivity.perDegree *= unit.length() * kDegree;
  solution.endError = (solution.blade.at(unit.length()).point - unit.problem.grips.end).norm();
  return solution;
}

/// Of the two stable shapes to either side of one that is not, empty where a fall ends nowhere.
struct Sides {
  std::optional<Shape> first, second;
};
Sides fallFrom(const Hold& hold, const Shape& shape) {
  const VectorXd soft = heavy::softest(Equations(modesOf(shape.count()), hold, shape));
  return {heavy::fall(hold, shape, kPush * soft), heavy::fall(hold, shape, -kPush * soft)};
}

double energyOf(const Hold& hold, const Shape& shape) {
  return Equations(modesOf(shape.count()), hold, shape).energy();
}

/// The mirror image in the chord of a shape without turning whose grips point along the chord.
Shape mirrored(const Unit& unit, const Shape& shape) {
  const Vector2d along = (unit.problem.grips.end - unit.problem.grips.start).stableNormalized();
  return {-shape.coefficients, 2 * along.dot(shape.force) * along - shape.force};
}

/// The weightless shape with its weight on, and at which share it fell first.
struct Weighed {
  Shape shape;
  std::optional<double> snapsAt = std::nullopt;
};
Result<Weighed> weigh(const Unit& unit, double turning, Shape shape) {
  const heavy::Way whole = unit.weighing(turning);
  Weighed result{shape};
  double share = 0;
  for (int falls = 0; falls < kMostFalls; ++falls) {
    const heavy::Way left{whole.at(share), whole.to};
    auto rests = std::make_shared<const Equations>(modesOf(result.shape.count()), left.from, result.shape);
    std::optional<heavy::Followed> followed;
    if (heavy::isStable(*rests)) followed = heavy::atOnce(left, result.shape, std::move(rests));
    if (!followed) followed = heavy::follow(left, result.shape);
    if (!followed) return lost("while its weight comes on");
    result.shape = followed->end.shape;
    if (!followed->snapped) return result;
    share += followed->end.part * (1 - share);
    if (!result.snapsAt) result.snapsAt = share;
    share = std::min(1.0, share + kPastTheFold);
    const Hold there = whole.at(share);
    const Sides sides = fallFrom(there, result.shape);
    if (!sides.first && !sides.second) return lost("as it falls into another shape");
    const bool first =
        sides.first && (!sides.second || energyOf(there, *sides.first) <= energyOf(there, *sides.second));
    result.shape = first ? *sides.first : *sides.second;
    if (share == 1) return result;
  }
  return lost("while its weight comes on");
}

/// What a shape at rest falls into from its mirror image in the chord, its ends being held as they are.
std::optional<Shape> fallFromAcross(const Hold& hold, const Shape& own) {
  constexpr int kAbrupt = 8;  // how soon after its ends, which stay, the image is that of the chord
  const heavy::Modes& modes = modesOf(1);
  const Eigen::ArrayXd evenly = hold.startAngle + hold.turning * modes.nodes.array();
  const double middle = hold.startAngle + 0.5 * hold.turning;
  const double chord = middle + std::remainder(std::atan2(hold.chord.y(), hold.chord.x()) - middle, 2 * kPi);
  const Eigen::ArrayXd within = 1 - (2 * modes.nodes.array() - 1).pow(kAbrupt);
  const VectorXd turned = modes.values * (modes.weights.array() * 2 * within * (chord - evenly)).matrix();
  const Shape image{modes.squares.llt().solve(turned) - own.coefficients.head(modes.count()), own.force};
  return heavy::fall(hold, image, VectorXd::Zero(modes.count()));
}

/// A shape with its turning, whatever the number of modes.
struct Found {
  double turning;
  Shape shape;
  bool stable;
  bool followed = false;  ///< as the weight changes
};

bool same(const Found& a, double turning, const Shape& shape) {
  const Index common = std::min(a.shape.count(), shape.count());
  return std::abs(a.turning - turning) < kSameShape &&
         (a.shape.coefficients.head(common) - shape.coefficients.head(common)).norm() < kSameShape;
}

/// All equilibria, found from the weightless ones, and the barriers of the stable ones.
class Search {
 public:
  Search(const Unit& unit, const ClampedAnswer& weightless) : unit_(unit) {
    for (const ClampedSolution& solution : weightless.solutions) {
      const std::optional<Shape> start = shapeOf(unit, solution.elastica, solution.turning, kModesSearched);
      if (!start) continue;
      bool led = false;
      heavy::allAlong(unit.weighing(solution.turning), *start, [&](const Shape& shape) {
        found_[add(solution.turning, shape)].followed = true;
        led = true;
      });
      if (!led) fallInto(solution.turning, *start);
    }
    goOn();
  }

  /// The place among `found` of one that is known. What hangs together with it is found, too, if it is new.
  std::size_t with(double turning, const Shape& shape) {
    const std::size_t place = add(turning, shape);
    goOn();
    return place;
  }

  const std::vector<Found>& found() const { return found_; }
  /// Of one that is stable, N mm.
  std::optional<double> barrier(std::size_t of) const {
    const std::vector<std::size_t> passes = passesOf(of);
    if (passes.empty()) return {};
    return (energyAt(passes.front()) - energyAt(of)) * unit_.energy();
  }
  /// The places among `found` of the unstable shapes between one that is stable and others, lowest first.
  std::vector<std::size_t> passesOf(std::size_t of) const {
    std::vector<std::size_t> passes;
    for (const Pass& pass : passes_)
      if (of == pass.one || of == pass.other) passes.push_back(pass.top);
    std::ranges::stable_sort(passes, {}, [this](std::size_t i) { return energyAt(i); });
    return passes;
  }

 private:
  /// An unstable shape between two stable ones.
  struct Pass {
    std::size_t top, one, other;
  };

  /// Its place among `found`, added if it is new.
  std::size_t add(double turning, const Shape& shape) {
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (same(found_[i], turning, shape)) return i;
    const Hold hold = unit_.hold(turning);
    found_.push_back({turning, shape, heavy::isStable(Equations(modesOf(shape.count()), hold, shape))});
    return found_.size() - 1;
  }

  /// What its weight makes of a shape that cannot be followed as it comes on, as where branches fork.
  void fallInto(double turning, const Shape& shape) {
    const Sides sides = fallFrom(unit_.hold(turning), shape);
    if (sides.first) add(turning, *sides.first);
    if (sides.second) add(turning, *sides.second);
  }

  /// What those found lead to: unstable ones to what they fall into, on the way to barriers; stable ones to
  /// what lies across; and those on no branch of the weightless to what is on theirs.
  void goOn() {
    for (; next_ < found_.size() && !WorkMeter::exhausted(); ++next_) {
      const Found one = found_[next_];
      const Hold hold = unit_.hold(one.turning);
      if (!one.stable)
        passOver(next_);
      else if (const std::optional<Shape> across = fallFromAcross(hold, one.shape))
        add(one.turning, *across);
      if (one.followed) continue;
      for (const double share : {0.0, 2.0})
        if (const std::optional<Shape> other =
                heavy::overFold({hold, unit_.hold(one.turning, share)}, one.shape))
          found_[add(one.turning, *other)].followed = true;
    }
  }

  double energyAt(std::size_t i) const { return energyOf(unit_.hold(found_[i].turning), found_[i].shape); }

  /// What an unstable shape falls into to either side. One that gives way in several directions is no pass:
  /// along the ridges that meet there lower ones are found, which do in one alone.
  void passOver(std::size_t i) {
    const double turning = found_[i].turning;
    const Hold hold = unit_.hold(turning);
    const Shape top = found_[i].shape;
    const std::vector<VectorXd> ways = heavy::givingWay(Equations(modesOf(top.count()), hold, top));
    if (ways.empty()) return;
    std::vector<std::size_t> into;
    for (const double push : {kPush, -kPush})
      if (const std::optional<Shape> side = heavy::fallBeside(hold, top, push * ways[0]))
        into.push_back(add(turning, *side));
    if (ways.size() == 1 && into.size() == 2 && into[0] != into[1]) passes_.push_back({i, into[0], into[1]});
    if (ways.size() == 1) return;
    for (const std::size_t up : {0u, 1u})
      for (const double push : {kPush, -kPush})
        if (const std::optional<Shape> pass = heavy::passBeside(hold, top, ways[up], push * ways[1 - up]))
          add(turning, *pass);
  }

  const Unit& unit_;
  std::vector<Found> found_;
  std::vector<Pass> passes_;
  std::size_t next_ = 0;  ///< of `found_`, to be gone on from
};

/// What else the blade may rest in, besides the one at `self`.
void tellOthers(HeavyAnswer& answer, const Unit& unit, const std::vector<Found>& found, std::size_t self) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i == self || !found[i].stable) continue;
    ++answer.otherStable;
    const double energy = energyOf(unit.hold(found[i].turning), found[i].shape) * unit.energy();
    if (answer.nextEnergy && *answer.nextEnergy <= energy) continue;
    answer.nextEnergy = energy;
    answer.nextTurning = found[i].turning;
  }
}

/// A blade as long as its grips are apart: its weight does not move it.
HeavyAnswer straightAnswer(const HeavyProblem& problem, const ClampedAnswer& weightless) {
  const ClampedSolution& straight = weightless.solutions.front();
  HeavyBlade::Numbers numbers;
  numbers.start = problem.grips.start;
  numbers.startAngle = straight.elastica.startAngle();
  numbers.length = problem.grips.length;
  numbers.coefficients = VectorXd::Zero(heavy::kModeCounts[0]);
  numbers.load = problem.weight / problem.stiffness;
  HeavySolution solution{HeavyBlade(std::move(numbers))};
  // The start's height is zero.
  solution.energy = -0.5 * problem.grips.length * problem.weight.dot(problem.grips.end - problem.grips.start);
  solution.stable = true;
  solution.stabilityMargin = straight.stabilityMargin;
  solution.outOfPlaneMargin = straight.outOfPlaneMargin;
  solution.sensitivity = straight.sensitivity;
  solution.endError = straight.endError;
  HeavyAnswer answer{{std::move(solution)}};
  answer.kind = weightless.kind;
  answer.message = weightless.message;
  return answer;
}

}  // namespace

Result<HeavyAnswer> solveHeavy(const HeavyProblem& problem, const ClampedOptions& options) {
  const Result<Unit> unit = check(problem, options);
  if (!unit) return tl::unexpected<Error>(unit.error());
  ClampedOptions alone = options;
  alone.others = false;
  const Result<ClampedAnswer> weightless = solveClamped(problem.grips, alone);
  if (!weightless) return tl::unexpected<Error>(weightless.error());
  if (weightless->kind == ClampedKind::straight) return straightAnswer(problem, *weightless);
  const ClampedSolution& start = weightless->solutions.front();
  const double turning = start.turning;
  std::optional<Shape> shape = shapeOf(*unit, start.elastica, turning, heavy::kMostModes);
  if (!shape) return lost("without its weight");
  HeavyAnswer answer;
  answer.message = weightless->message;
  if (weightless->kind == ClampedKind::buckling && turning == 0 && !options.initial) {
    const Shape other = mirrored(*unit, *shape);
    const double here = energyOf(unit->hold(turning), *shape), there = energyOf(unit->hold(turning), other);
    if (there < here) shape = other;
    // What it says of mirror images holds where the weight pulls along the chord alone.
    if (std::abs(there - here) > kAsGood * (1 + std::abs(here))) answer.message.clear();
  }
  Result<Weighed> weighed = weigh(*unit, turning, *shape);
  if (!weighed) return tl::unexpected<Error>(weighed.error());
  Result<HeavySolution> solution = describe(*unit, turning, weighed->shape);
  if (!solution) return tl::unexpected<Error>(solution.error());
  solution->snapsAt = weighed->snapsAt;
  answer.kind = weightless->kind;
  answer.movingSnapsAt = weightless->snapsAt;
  if (options.others) {
    const Result<ClampedAnswer> all = solveAllClamped(problem.grips, options);
    if (!all) return tl::unexpected<Error>(all.error());
    Search search(*unit, *all);
    const std::size_t self = search.with(turning, weighed->shape);
    solution->barrier = search.barrier(self);
    tellOthers(answer, *unit, search.found(), self);
  }
  answer.solutions.push_back(std::move(*solution));
  return answer;
}

Result<HeavyAnswer> solveAllHeavy(const HeavyProblem& problem, const ClampedOptions& options) {
  const Result<Unit> unit = check(problem, options);
  if (!unit) return tl::unexpected<Error>(unit.error());
  const Result<ClampedAnswer> weightless = solveAllClamped(problem.grips, options);
  if (!weightless) return tl::unexpected<Error>(weightless.error());
  if (weightless->kind == ClampedKind::straight) return straightAnswer(problem, *weightless);
  const Search search(*unit, *weightless);
  HeavyAnswer answer;
  answer.kind = weightless->kind;
  answer.message = weightless->message;
  std::optional<std::size_t> lowest;
  for (std::size_t i = 0; i < search.found().size(); ++i) {
    const Found& found = search.found()[i];
    Result<HeavySolution> solution = describe(*unit, found.turning, found.shape);
    if (!solution) return tl::unexpected<Error>(solution.error());
    if (found.stable) solution->barrier = search.barrier(i);
    const auto energy = [&](std::size_t k) {
      return energyOf(unit->hold(search.found()[k].turning), search.found()[k].shape);
    };
    if (found.stable && (!lowest || energy(i) < energy(*lowest))) lowest = i;
    answer.solutions.push_back(std::move(*solution));
  }
  if (answer.solutions.empty()) return lost("while its weight comes on");
  std::ranges::stable_sort(answer.solutions, {}, &HeavySolution::energy);
  if (lowest) tellOthers(answer, *unit, search.found(), *lowest);
  return answer;
}

HeavyProblem holdOf(const HeavyBlade& blade, double stiffness) {
  const HeavyBlade::Numbers& n = blade.numbers();
  HeavyProblem problem{{}, stiffness, stiffness * n.load};
  problem.grips.start = n.start;
  problem.grips.end = blade.at(n.length).point;
  problem.grips.startAngle = n.startAngle;
  problem.grips.endAngle = n.startAngle + n.turning;
  problem.grips.turning = n.turning;
  problem.grips.length = n.length;
  return problem;
}

/// True of a blade that lies along its chord: between its grips there is one other stable shape at most
/// (docs/mathematics.md, heavy blades).
static bool isShallow(const HeavyBlade& blade) {
  constexpr double kSlopes = 0.2;  // rad from the chord
  constexpr int kPlaces = 33;
  const std::vector<HeavyBlade::State> states = blade.sample(kPlaces);
  const Vector2d chord = states.back().point - states.front().point;
  const double along = std::atan2(chord.y(), chord.x());
  return std::ranges::all_of(states, [along](const HeavyBlade::State& state) {
    return std::abs(std::remainder(state.angle - along, 2 * kPi)) < kSlopes;
  });
}

Result<HeavyRivals> rivalsOf(const HeavyBlade& blade, double stiffness, std::int64_t work) {
  const WorkMeter meter(work);
  const HeavyBlade::Numbers& n = blade.numbers();
  const HeavyProblem problem = holdOf(blade, stiffness);
  const Result<Unit> unit = check(problem, {});
  if (!unit) return tl::unexpected<Error>(unit.error());
  const Result<ClampedAnswer> weightless = solveAllClamped(problem.grips, {});
  HeavyRivals rivals{stiffness * blade.energy()};
  if (!weightless && !isShallow(blade)) return tl::unexpected<Error>(weightless.error());
  if (weightless && weightless->kind == ClampedKind::straight) return rivals;
  // Grips that are turned away from each other pull a weightless one too taut, which tells nothing then of
  // the one that hangs: what lies across from that is found all the same.
  Search search(*unit, weightless ? *weightless : ClampedAnswer());
  const std::size_t self = search.with(n.turning, {n.coefficients, n.endForce * (n.length * n.length)});
  if (meter.stopped())
    return fail(ErrorCode::noSolution, "What else the blade may rest in is not found within bounds.",
                "blade");
  for (const std::size_t pass : search.passesOf(self))
    rivals.passes.push_back(placed(*unit, search.found()[pass].turning, search.found()[pass].shape));
  rivals.barrier = search.barrier(self);
  for (std::size_t i = 0; i < search.found().size(); ++i) {
    const Found& found = search.found()[i];
    if (i == self || !found.stable) continue;
    HeavyBlade other = placed(*unit, found.turning, found.shape);
    const double energy = stiffness * other.energy();
    if (rivals.next && rivals.nextEnergy <= energy) continue;
    rivals.next = std::move(other);
    rivals.nextEnergy = energy;
  }
  return rivals;
}

namespace {

/// A blade between the same grips that turns by more is clearly higher, and so it is where grips are by which
/// this one has twice its energy: one of length L that turns by τ takes τ²/2L to bend, and its weight lets it
/// down by what its ends allow at most.
double turningOfHigher(const HeavyBlade& blade) {
  const HeavyBlade::Numbers& n = blade.numbers();
  const double length = n.length, taken = (blade.at(length).point - n.start).norm() / length;
  // A point of the blade is within the circles about both grips that it reaches.
  const double off = length * std::hypot(1 - taken, 0.5 * std::sqrt(std::max(0.0, 1 - taken * taken)));
  const double lift = n.load.norm() * length * off;
  return std::sqrt(2 * length * std::max(0.0, 2 * (blade.energy() + blade.clearGap()) + lift));
}

}  // namespace

Result<HeavyRests> restsOf(const HeavyProblem& problem, const HeavyBlade* own) {
  const Result<Unit> unit = check(problem, {});
  if (!unit) return tl::unexpected<Error>(unit.error());
  ClampedOptions options;
  if (own) options.maxTurning = std::min(options.maxTurning, turningOfHigher(*own));
  const Result<ClampedAnswer> weightless = solveAllClamped(problem.grips, options);
  if (!weightless) return tl::unexpected<Error>(weightless.error());
  HeavyRests rests;
  if (weightless->kind == ClampedKind::straight) {
    rests.stable.push_back(straightAnswer(problem, *weightless).solutions.front().blade);
    return rests;
  }
  Search search(*unit, *weightless);
  if (search.found().empty()) return lost("while its weight comes on");
  if (own) {
    const HeavyBlade::Numbers& n = own->numbers();
    const std::size_t self = search.with(n.turning, {n.coefficients, n.endForce * (n.length * n.length)});
    for (const std::size_t pass : search.passesOf(self))
      rests.passes.push_back(placed(*unit, search.found()[pass].turning, search.found()[pass].shape));
    rests.barrier = search.barrier(self);
  }
  for (const Found& found : search.found()) {
    if (!found.stable) continue;
    const std::optional<Shape> shape = heavy::refined(unit->hold(found.turning), found.shape, heavy::kExact);
    if (!shape) return lost("in finer modes");
    rests.stable.push_back(placed(*unit, found.turning, *shape));
  }
  return rests;
}

std::optional<HeavyBlade> acrossFrom(const HeavyBlade& blade) {
  const HeavyBlade::Numbers& n = blade.numbers();
  const Hold hold = equationsOf(blade).hold();
  const Shape own{n.coefficients, n.endForce * (n.length * n.length)};
  std::optional<Shape> shape = fallFromAcross(hold, own);
  if (!shape || same({n.turning, own, true}, n.turning, *shape)) return {};
  shape = heavy::refined(hold, *shape, heavy::kExact);
  if (!shape) return {};
  HeavyBlade::Numbers other = n;
  other.coefficients = shape->coefficients;
  other.endForce = shape->force / (n.length * n.length);
  return HeavyBlade(std::move(other));
}

double largestSag(double length, double chord) {
  return std::sqrt(0.375 * std::max(0.0, length - chord) * length);
}

Result<Hanging> hang(const Elastica& blade, double stiffness, const Vector2d& weight, std::int64_t work) {
  const WorkMeter meter(work);
  const double length = blade.length();
  const Elastica::State end = blade.at(length);
  HeavyProblem problem{{}, stiffness, weight};
  problem.grips.start = blade.start();
  problem.grips.end = end.point;
  problem.grips.startAngle = blade.startAngle();
  problem.grips.endAngle = end.angle;
  problem.grips.length = length;
  const Result<Unit> unit = check(problem, {});
  if (!unit) return tl::unexpected<Error>(unit.error());
  const double turning = end.angle - blade.startAngle();
  std::optional<Shape> shape = shapeOf(*unit, blade, turning, heavy::kMostModes);
  if (!shape) return lost("without its weight");
  const double sag = largestSag(length, (end.point - blade.start()).norm());
  if (sag < kNoSag) return Hanging{placed(*unit, turning, *shape)};
  const Result<Weighed> weighed = weigh(*unit, turning, *shape);
  if (!weighed) return tl::unexpected<Error>(weighed.error());
  shape = heavy::refined(unit->hold(turning), weighed->shape, heavy::kExact);
  if (!shape) return lost("in finer modes");
  return Hanging{placed(*unit, turning, *shape), sag < kBesideSag ? std::nullopt : weighed->snapsAt};
}

HeavyMargins marginsOf(const HeavyBlade& blade, double across, double torsionRatio) {
  const double length = blade.length();
  const heavy::Margins margins =
      heavy::marginsOf(equationsOf(blade), torsionRatio, across * length * length * length);
  return {margins.inPlane, margins.outOfPlane, margins.sideways * length};
}

Result<HeavyBranch> HeavyBranch::from(const HeavyBlade& blade, double stiffness) {
  if (!heavy::isStable(equationsOf(blade)))
    return fail(ErrorCode::badInput, "The blade is not stable in this shape: it has no branch to stay on.",
                "solution");
  HeavyBranch branch(blade.numbers());
  branch.end_ = blade.at(blade.length()).point;
  branch.stiffness_ = stiffness;
  return branch;
}

Result<ClampedBranch::Move> HeavyBranch::moveTo(const HeavyProblem& next, std::int64_t work) {
  const WorkMeter meter(work);
  const Result<Unit> unit = check(next, {});
  if (!unit) return tl::unexpected<Error>(unit.error());
  if (next.grips.length != numbers_.length || next.stiffness != stiffness_)
    return fail(ErrorCode::badInput, "The blade's length and stiffness do not change on its way.", "length",
                next.grips.length, numbers_.length);
  const double length = numbers_.length, squared = length * length;
  const double turns = *next.grips.endAngle - *next.grips.startAngle;
  const double turning =
      next.grips.turning.value_or(turns + 2 * kPi * std::round((numbers_.turning - turns) / (2 * kPi)));
  // The start tangent, too, by the shorter way.
  const double startAngle = *next.grips.startAngle +
                            2 * kPi * std::round((numbers_.startAngle - *next.grips.startAngle) / (2 * kPi));
  heavy::Way way{{(end_ - numbers_.start) / length, numbers_.startAngle, numbers_.turning,
                  numbers_.load * (squared * length)},
                 unit->hold(turning)};
  way.to.startAngle = startAngle;
  Shape before{numbers_.coefficients, numbers_.endForce * squared};
  std::optional<heavy::Followed> followed = heavy::atOnce(way, before, rests_);
  std::optional<Shape> there;
  ClampedBranch::Move move;
  Hold hold;
  while (!there) {
    if (!followed) followed = heavy::follow(way, before);
    if (!followed) return lost("to its new grips");
    move = {followed->snapped, followed->end.part};
    hold = way.at(followed->end.part);
    there = heavy::refined(hold, followed->end.shape, heavy::kExact);
    if (there) break;
    // In finer modes the branch ends a little earlier: once more in those.
    const std::optional<Shape> finer = heavy::finer(way.from, before);
    if (!finer) return lost("in finer modes");
    before = *finer;
    followed.reset();
  }
  const bool told = followed->rests && there->count() == followed->rests->shape().count();
  rests_ = told ? std::move(followed->rests) : nullptr;
  numbers_.start += move.reached * (next.grips.start - numbers_.start);
  end_ = numbers_.start + length * hold.chord;
  numbers_.startAngle = hold.startAngle;
  numbers_.turning = hold.turning;
  numbers_.load = hold.load / (squared * length);
  numbers_.coefficients = there->coefficients;
  numbers_.endForce = there->force / squared;
  return move;
}

HeavyBlade HeavyBranch::blade() const { return HeavyBlade(numbers_); }

namespace {

HeavyMarginSlope inLengths(const heavy::MarginSlope& slope, double length) {
  const Eigen::RowVector2d byEnd = slope.byGrips.head<2>() / length;
  HeavyMarginSlope result{slope.margin, {}};
  result.byGrips << -byEnd, slope.byGrips(2), byEnd, slope.byGrips(3);
  return result;
}

}  // namespace

struct HeavySlopes::Work {
  double length;
  std::shared_ptr<const Equations> equations;
  std::optional<heavy::Changes> changes = std::nullopt;

  const heavy::Changes& change() {
    if (!changes) changes = heavy::changesOf(*equations);
    return *changes;
  }
};

HeavySlopes::HeavySlopes(const HeavyBlade& blade)
    : work_(std::make_unique<Work>(
          Work{blade.length(), std::make_shared<const Equations>(equationsOf(blade))})) {}
HeavySlopes::HeavySlopes(const HeavyBranch& branch)
    : work_(std::make_unique<Work>(Work{
          branch.numbers_.length,
          branch.rests_ ? branch.rests_ : std::make_shared<const Equations>(equationsOf(branch.blade()))})) {}
HeavySlopes::HeavySlopes(HeavySlopes&& other) noexcept = default;
HeavySlopes& HeavySlopes::operator=(HeavySlopes&& other) noexcept = default;
HeavySlopes::~HeavySlopes() = default;

HeavyMarginSlope HeavySlopes::margin(double below) const {
  return inLengths(heavy::marginSlopeOf(*work_->equations, below,
                                        [this]() -> const heavy::Changes& { return work_->change(); }),
                   work_->length);
}

HeavyMarginSlope HeavySlopes::outOfPlane(double below, double torsionRatio) const {
  return inLengths(heavy::outOfPlaneSlopeOf(*work_->equations, torsionRatio, below,
                                            [this]() -> const heavy::Changes& { return work_->change(); }),
                   work_->length);
}

HeavyMarginSlope marginByGrips(const HeavyBlade& blade, double below) {
  return HeavySlopes(blade).margin(below);
}

HeavyMarginSlope outOfPlaneByGrips(const HeavyBlade& blade, double below, double torsionRatio) {
  return HeavySlopes(blade).outOfPlane(below, torsionRatio);
}

Result<HeavyDerivatives> derivativesByGrips(const HeavyBlade& blade, std::span<const double> s) {
  return HeavySlopes(blade).at(s);
}

Result<HeavyDerivatives> HeavySlopes::at(std::span<const double> s) const {
  const double length = work_->length;
  const Equations& equations = *work_->equations;
  const Index places = Index(s.size());
  const Eigen::MatrixXd moves =
      heavy::movesOf(equations, work_->change(), Eigen::ArrayXd::Map(s.data(), places) / length);
  if (!moves.allFinite())
    return fail(ErrorCode::noSolution, "The blade is about to snap: it does not follow its grips.", "blade");
  HeavyDerivatives result;
  result.byGrips.reserve(s.size());
  for (Index k = 0; k < places; ++k) {
    Eigen::Matrix<double, 3, 4> moved;
    for (int row = 0; row < 3; ++row) moved.row(row) = moves.row(row * places + k);
    // Lengths: x and y by mm are as they are, by rad times the length; angles by mm over it.
    moved.topRightCorner<2, 2>() *= length;
    moved.row(2).head<2>() /= length;
    Eigen::Matrix<double, 3, 6>& byGrips = result.byGrips.emplace_back();
    byGrips << -moved.leftCols<2>(), moved.col(2), moved.leftCols<2>(), moved.col(3);
    byGrips(0, 0) += 1;
    byGrips(1, 1) += 1;
  }
  return result;
}

}  // namespace bw
