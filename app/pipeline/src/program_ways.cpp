// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "program_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/motion/cell.h"
#include "bw/core/sweep/kerf_table.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/motion/program_plan.h"
#include "cell_ways.h"

namespace bw::pipeline {

namespace {

using Eigen::Vector3d;
using robotio::MoveRole;
using robotio::ProgramMove;
using robotio::ProgramPlan;

constexpr double kStepOnWay = 20;              // mm that an end goes between two instants outside
constexpr double kTurnOnWay = fromDegrees(3);  // that it turns likewise
constexpr double kCarried = 0.02;              // mm by which the ends move alike: joint angles are rounded,
constexpr double kCarriedTurn = fromDegrees(2e-3);  // and that they turn likewise
constexpr double kHardlySlack = 0.5;                // mm of slack below which that bends a blade,
constexpr double kWritten = 5e-4;                   // but not the rounding of written positions
constexpr double kSameShape = 0.5;                  // mm
constexpr double kSlower = 1.1;                     // times the design's time, and
constexpr double kSlowerBy = 0.02;                  // s, that a way may take
constexpr double kStands = 20;                      // times as slow: it stands still
constexpr double kMoves = 0.01;                     // mm/s
constexpr double kMore = 1.001;                     // times as slow: more than another one
constexpr double kStandsFor = 0.1;                  // s
constexpr double kMarginRounded = 1e-3;

using Shape = std::vector<Vector3d>;

std::string timeText(double time) { return shortText(time, 4) + " s"; }

Shape shapeOf(const SimulatedBlade& at) {
  Shape shape;
  shape.reserve(kContactPlaces);
  for (const Elastica::State& state : at.blade.sample(kContactPlaces))
    shape.push_back(at.frame.toWorld(state.point));
  return shape;
}

/// How messages name where a program is: by its targets, whose names the plan has.
class Names {
 public:
  explicit Names(const ProgramPlan& plan) : plan_(plan) {}

  std::string ofMove(std::size_t index) const {
    const ProgramMove& move = plan_.moves[index];
    if (move.role != MoveRole::home) return "\"" + move.names.front() + "\"";
    return move.names.front().empty() ? "the home of the cell" : "the home \"" + move.names.front() + "\"";
  }
  std::string ofInstant(std::size_t instant) const {
    std::size_t last = 0;
    for (std::size_t m = 0; m < plan_.moves.size(); ++m)
      if (plan_.moves[m].instant >= 0 && std::size_t(plan_.moves[m].instant) <= instant) last = m;
    return ofMove(last);
  }

 private:
  const ProgramPlan& plan_;
};

/// A way outside of the cut as one motion, and the move of the plan that goes to each of its instants.
struct Way {
  Motion motion;
  std::vector<std::size_t> moves;

  explicit Way(const Motion& of) {
    motion.block = of.block;
    motion.bladeLength = of.bladeLength;
  }
  void add(std::size_t move, double seconds, std::vector<Pose> poses) {
    const double now = motion.instants.empty() ? 0 : motion.instants.back().time + seconds;
    motion.instants.push_back({now, -1, std::move(poses), 0});
    moves.push_back(move);
  }
  /// In parts so small that nothing is passed over.
  void go(std::size_t index, const ProgramMove& move) {
    const std::vector<Pose> from = motion.instants.back().poses;
    double length = 0, turn = 0;
    for (std::size_t end = 0; end < from.size(); ++end) {
      length = std::max(length, (move.poses[end].position - from[end].position).norm());
      turn = std::max(turn, from[end].rotation.angularDistance(move.poses[end].rotation));
    }
    const double seconds = move.duration > 0 ? move.duration : std::max(1.0, length / 200);
    const int parts =
        int(std::clamp(std::ceil(std::max(length / kStepOnWay, turn / kTurnOnWay)), 1.0, 500.0));
    for (int k = 1; k <= parts; ++k) {
      const double share = double(k) / parts;
      std::vector<Pose> poses;
      for (std::size_t end = 0; end < from.size(); ++end)
        poses.push_back({from[end].position + share * (move.poses[end].position - from[end].position),
                         from[end].rotation.slerp(share, move.poses[end].rotation)});
      add(index, seconds / parts, std::move(poses));
    }
  }
};

/// Looks at what the blade does before the motion and after it. Where it is carried as it lies at the first
/// and the last instant, which is how programs are written, its shape is known; else it is run there.
class AroundJudge {
 public:
  AroundJudge(ProgramRun& run, const ProgramLook& look, const ProgramPlan& plan)
      : run_(run), look_(look), plan_(plan), names_(plan), block_(look.cut.block()) {}

  Result<void> judge(const RunContext& context) {
    const std::vector<SimulatedBlade>& blades = run_.simulation.blades;
    if (blades.empty()) return {};
    std::vector<std::size_t> in, out;
    for (std::size_t m = 0; m < plan_.moves.size(); ++m) {
      const ProgramMove& move = plan_.moves[m];
      if (move.poses.size() != 2 || move.role == MoveRole::cut) continue;
      (move.role == MoveRole::retreat ? out : in).push_back(m);
    }
    if (!in.empty() && plan_.moves[in.back()].instant == 0) {
      if (isCarried(in, run_.motion.instants.front())) {
        carry(in, blades.front());
      } else if (Result<void> ok = runIn(in, context); !ok) {
        return ok;
      }
    }
    // Of a blade that is halted before it is not known what would come after.
    if (out.empty() || run_.simulation.halt) return {};
    if (!isCarried(out, run_.motion.instants.back())) return runOut(out, context);
    out.insert(out.begin(), lastOfCut());
    carry(out, blades.back());
    return {};
  }

 private:
  const std::vector<Pose>& posesOf(std::size_t move) const { return plan_.moves[move].poses; }
  std::size_t lastOfCut() const {
    std::size_t last = 0;
    for (std::size_t m = 0; m < plan_.moves.size(); ++m)
      if (plan_.moves[m].instant >= 0) last = m;
    return last;
  }

  /// True if both ends are moved alike from where they are at an instant, without a turn.
  bool isCarried(const std::vector<std::size_t>& moves, const MotionInstant& at) const {
    const std::vector<Pose>& held = at.poses;
    const double slack = run_.motion.bladeLength - (held[1].position - held[0].position).norm(),
                 off = slack < kHardlySlack ? kWritten : kCarried;
    return std::ranges::all_of(moves, [&](std::size_t m) {
      const std::vector<Pose>& poses = posesOf(m);
      return (poses[0].position - held[0].position - (poses[1].position - held[1].position)).norm() <= off &&
             poses[0].rotation.angularDistance(held[0].rotation) <= kCarriedTurn &&
             poses[1].rotation.angularDistance(held[1].rotation) <= kCarriedTurn;
    });
  }

  void carry(const std::vector<std::size_t>& moves, const SimulatedBlade& held) {
    const Shape shape = shapeOf(held);
    const Frame& f = run_.motion.block.frame;
    const Vector3d left = held.frame.toWorld(held.blade.sample(2).front().point);
    const auto carried = [&](std::size_t move) {
      const Vector3d& at = posesOf(move).front().position;
      const Vector3d by = f.toWorld(at.head<2>(), at.z()) - left;
      Shape there = shape;
      for (Vector3d& point : there) point += by;
      return there;
    };
    bool inBlock = false;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      if (k == 0 && plan_.moves[moves[k]].role == MoveRole::cut) continue;
      std::vector<Shape> shapes;
      if (k > 0) shapes.push_back(carried(moves[k - 1]));
      shapes.push_back(carried(moves[k]));
      judgeShapes(moves[k], shapes, inBlock);
    }
  }

  /// What a way that is run does with the blade; `done` are the shapes that lead there.
  void judgeRun(const Simulation& run, const Way& way, std::size_t first) {
    const auto towards = [&](const SimulatedBlade& at) {
      return way.moves[std::min(at.instant + (at.atInstant ? 0 : 1), way.moves.size() - 1)];
    };
    bool inBlock = false;
    std::size_t r = first;
    while (r < run.blades.size()) {
      const std::size_t move = towards(run.blades[r]);
      std::vector<Shape> shapes;
      if (r > 0) shapes.push_back(shapeOf(run.blades[r - 1]));
      double margin = 1;
      bool crosses = false;
      for (; r < run.blades.size() && towards(run.blades[r]) == move; ++r) {
        shapes.push_back(shapeOf(run.blades[r]));
        margin = std::min(margin, run.blades[r].margin);
        crosses = crosses || run.blades[r].crossesItself;
      }
      judgeShapes(move, shapes, inBlock);
      const double asked = look_.design.process.margin;
      if (margin < asked - kMarginRounded && margin < run_.simulation.marginMin - kMarginRounded)
        tell(onTheWay(move) + " the stability margin falls to " + shortText(margin, 2) +
             " (asked for: " + shortText(asked, 2) + ")");
      if (crosses) tell(onTheWay(move) + " the blade crosses itself, which no blade between two robots can");
    }
    if (const std::optional<Halt>& halt = run.halt) {
      const std::size_t at = std::min(halt->instant + (run.blades.empty() ? 0 : 1), way.moves.size() - 1);
      const std::string where =
          run.blades.empty() ? "at " + names_.ofMove(way.moves[at]) : onTheWay(way.moves[at]);
      switch (halt->why) {
        case Halt::Why::tears:
          tell(where + (run.blades.empty() ? " the grips are " : " the grips come ") +
               shortText(halt->apart, 7) + " mm apart, more than the blade of " +
               shortText(run_.motion.bladeLength, 7) + " mm is long; it would tear");
          break;
        case Halt::Why::offPlane:
          tell(where + " the ends of the blade are not in one plane: " + shortText(halt->off) + " mm off, " +
               shortText(toDegrees(halt->twist)) + "° twisted");
          break;
        case Halt::Why::lost:
          tell(where + " the blade cannot be followed: " + halt->reason);
          break;
      }
    }
    for (const Simulation::Snap& snap : run.snaps)
      if (snap.instant + 1 < way.moves.size() && (first == 0 || snap.time > run.blades[first - 1].time))
        tell(onTheWay(way.moves[snap.instant + 1]) + " the blade leaves its shape and snaps into another");
  }

  Result<void> runIn(const std::vector<std::size_t>& moves, const RunContext& context) {
    Way way(run_.motion);
    way.add(moves.front(), 0, posesOf(moves.front()));
    for (std::size_t k = 1; k < moves.size(); ++k) way.go(moves[k], plan_.moves[moves[k]]);
    if (way.motion.instants.size() < 2) return {};
    const Result<Simulation> run = simulate(way.motion, look_.blade, look_.weight, context);
    if (!run) return tl::unexpected<Error>(run.error());
    judgeRun(*run, way, 0);
    if (!run->decided)
      tell("between the grips of " + names_.ofMove(moves.front()) +
           " the blade rests in two shapes that are about as low");
    if (run->halt || run->blades.empty()) return {};
    // The run of the motion begins in the lowest shape.
    const Shape came = shapeOf(run->blades.back()), lowest = shapeOf(run_.simulation.blades.front());
    double apart = 0;
    for (std::size_t k = 0; k < came.size(); ++k) apart = std::max(apart, (came[k] - lowest[k]).norm());
    if (apart > kSameShape)
      tell("from " + names_.ofMove(moves.front()) + " the blade comes to " + names_.ofMove(moves.back()) +
           " in another shape than the lowest there, up to " + shortText(apart) +
           " mm beside it; what is told of the cut is told of the lowest");
    return {};
  }

  /// As far as the end of the motion the blade is brought again, into the shape that it has there.
  Result<void> runOut(const std::vector<std::size_t>& moves, const RunContext& context) {
    Way way(run_.motion);
    way.motion = run_.motion;
    way.moves.assign(way.motion.instants.size(), lastOfCut());
    for (const std::size_t m : moves) way.go(m, plan_.moves[m]);
    // The run of the motion does not bend round its last target.
    way.motion.instants[run_.motion.instants.size() - 1].zone = 0;
    const Result<Simulation> run = simulate(way.motion, look_.blade, look_.weight, context);
    if (!run) return tl::unexpected<Error>(run.error());
    judgeRun(*run, way, run_.simulation.blades.size());
    return {};
  }

  void judgeShapes(std::size_t move, const std::vector<Shape>& shapes, bool& inBlock) {
    std::optional<BlockContact> met;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const Shape& from = shapes[k > 0 ? k - 1 : 0];
      const std::optional<BlockContact> contact = contactOnWay(block_, from, shapes[k]);
      if (!contact) continue;
      if (!met)
        met = contact;
      else
        met->depth = std::max(met->depth, contact->depth);
    }
    // Where a way goes on in the block, the one before has told it.
    if (met && !inBlock)
      tell((plan_.moves[move].role == MoveRole::home
                ? "at " + names_.ofMove(move) + " the blade lies in the block \""
                : onTheWay(move) + " the blade meets the block \"") +
           run_.block + "\", where nothing is to be cut: at " + contactText(*met) +
           (plan_.moves[move].role == MoveRole::home
                ? "; move the home of the cell or its work object"
                : "; take the targets of the design, or lead the blade round the block"));
    inBlock = met.has_value();
    const std::optional<double> floor = look_.cut.check.request.floor;
    const bool leaves = plan_.moves[move].role == MoveRole::retreat;
    // Home is told of by the design.
    if (!floor || !(leaves || plan_.moves[move].instant == 0)) return;
    double least = std::numeric_limits<double>::infinity();
    for (const Shape& shape : shapes) least = std::min(least, lowestPlace(block_, shape).height);
    // What is as low on the motion is told of it.
    const double known = lowestPlace(block_, leaves ? shapes.front() : shapes.back()).height;
    if (least < std::min(*floor - look_.design.process.motionTolerance, known - kFloorRounded))
      tell(onTheWay(move) + " the blade is " + shortText(std::abs(least)) +
           (least < 0 ? " mm below" : " mm above") +
           " the face that the block lies on (floor: " + shortText(*floor) + " mm)");
  }

  std::string onTheWay(std::size_t move) const { return "on the way to " + names_.ofMove(move); }
  void tell(std::string clause) { run_.exceeded.push_back(std::move(clause)); }

  ProgramRun& run_;
  const ProgramLook& look_;
  const ProgramPlan& plan_;
  Names names_;
  const Box& block_;
};

/// The level of the blade's plane at each instant.
std::vector<std::pair<double, double>> levelsOf(const Motion& motion, const PlaneFamily& planes) {
  const Frame& f = motion.block.frame;
  std::vector<std::pair<double, double>> levels;  // and times
  for (const MotionInstant& at : motion.instants) {
    const Eigen::Vector3d p = 0.5 * (at.poses[0].position + at.poses[1].position);
    levels.emplace_back(planes.level(f.toWorld(p.head<2>(), p.z())), at.time);
  }
  return levels;
}

/// When the design's motion is at a level; none outside of it.
std::optional<double> timeAtLevel(const std::vector<std::pair<double, double>>& design, double level) {
  for (std::size_t i = 1; i < design.size(); ++i) {
    const auto& [from, began] = design[i - 1];
    const auto& [to, ended] = design[i];
    if (to > from && level >= from && level <= to)
      return std::lerp(began, ended, (level - from) / (to - from));
  }
  return {};
}

/// mm/s of the fastest point of the blade on the way to an instant, in the middle of the move, where no
/// corner is cut; 0 where nothing moves.
double fastestTo(const Simulation& simulation, std::size_t instant) {
  std::vector<const SimulatedBlade*> between;
  for (const SimulatedBlade& at : simulation.blades)
    if (!at.atInstant && at.instant + 1 == instant) between.push_back(&at);
  if (between.size() < 2 || !(between.back()->time > between.front()->time)) return 0;
  std::vector<double> ways(kContactPlaces, 0);
  Shape before = shapeOf(*between.front());
  for (std::size_t k = 1; k < between.size(); ++k) {
    const Shape now = shapeOf(*between[k]);
    for (std::size_t c = 0; c < ways.size(); ++c) ways[c] += (now[c] - before[c]).norm();
    before = now;
  }
  return std::ranges::max(ways) / (between.back()->time - between.front()->time);
}

/// Where the program is slower in the block than its design.
void judgePace(ProgramRun& run, const ProgramLook& look, const Names& names) {
  const PlaneFamily& planes = look.cut.setup->planes;
  const auto own = levelsOf(run.motion, planes), design = levelsOf(*look.cut.motion.value, planes);
  struct Slow {
    std::size_t first, last, worst;
    double factor, seconds, planned;
  };
  std::vector<Slow> stretches;
  for (std::size_t i = 1; i < own.size(); ++i) {
    const auto [least, most] = std::minmax(own[i - 1].first, own[i].first);
    if (most < planes.entry || least > planes.exit) continue;
    const std::optional<double> from = timeAtLevel(design, own[i - 1].first),
                                to = timeAtLevel(design, own[i].first);
    const double seconds = own[i].second - own[i - 1].second;
    const double planned = from && to ? std::abs(*to - *from) : 0;
    if (!from || !to || seconds <= kSlower * planned + kSlowerBy) continue;
    if (seconds > kStands * planned && seconds - planned > kStandsFor) {
      // Where it goes aside instead, it leaves the surface, which is told.
      const double speed = fastestTo(run.simulation, i);
      if (speed <= look.design.process.cuttingSpeed / kStands)
        run.exceeded.push_back(
            "at " + names.ofInstant(i) + " the hot blade " + (speed < kMoves ? "" : "all but ") +
            "stands still in the block \"" + run.block + "\" for " + timeText(seconds - planned) + " from " +
            timeText(own[i - 1].second) + " on, and melts what is around it; let it stand before the block");
      continue;
    }
    if (!(planned > 0)) continue;
    const double factor = seconds / planned;
    if (stretches.empty() || stretches.back().last + 1 != i) {
      stretches.push_back({i, i, i, factor, seconds, planned});
      continue;
    }
    Slow& at = stretches.back();
    at.last = i;
    // Of those that are alike, the first.
    if (factor > kMore * at.factor) at = {at.first, i, i, factor, seconds, planned};
  }
  constexpr std::size_t kTold = 5;
  std::ranges::stable_sort(stretches, [](const Slow& a, const Slow& b) { return a.factor > b.factor; });
  for (std::size_t k = 0; k < std::min(kTold, stretches.size()); ++k) {
    const Slow& at = stretches[k];
    const double speed = fastestTo(run.simulation, at.worst);
    std::string text = "from " + names.ofInstant(at.first - 1) + " to " + names.ofInstant(at.last) +
                       ", through the block \"" + run.block +
                       "\", the program is slower than its design: to " + names.ofInstant(at.worst) +
                       " the fastest point of the blade goes at " + shortText(speed) +
                       " mm/s, in the time of the design at " + shortText(speed * at.factor) + " mm/s; ";
    const KerfTable& table = look.cut.middle.request.table;
    text += table.empty() ? "a slower blade melts more, and no kerf over speed tells how much"
                          : "it melts " + shortText(kerfAt(table, speed)) + " mm there instead of " +
                                shortText(kerfAt(table, speed * at.factor)) + " mm";
    run.warnings.push_back(std::move(text));
  }
  if (stretches.size() > kTold)
    run.warnings.push_back(std::to_string(stretches.size() - kTold) +
                           " more stretches of the program are slower than its design");
}

/// A program as a plan, each move with the names of its targets.
struct KnownPlan {
  ProgramPlan plan;
  bool ofText = false;         ///< with the homes, tools and names of its text
  bool hasWays = true;         ///< it tells how the blade comes to the block and leaves it
  const Cell* cell = {};       ///< that it is for, where that is known
  std::string otherCell = {};  ///< where it is not that of the design: a clause
  std::string unknown = {};    ///< why nothing is known of what lies before its first target
};

/// As the text has it.
Result<KnownPlan> planOfText(const ProgramLook& look, std::optional<Cell>& named) {
  Result<ProgramPlan> plan = look.dialect.readPlan(look.files);
  if (!plan) return tl::unexpected<Error>(plan.error());
  KnownPlan known{std::move(*plan), true, true, look.cell};
  if (look.cell && !known.plan.cell.name.empty() && known.plan.cell.name != look.cell->name) {
    // Where its own is not known, it is held against the design's.
    Result<Cell> other = loadCell(known.plan.cell.name);
    if (other) named = std::move(*other);
    if (named) known.cell = &*named;
    known.otherCell = "the program: it is for the cell \"" + known.plan.cell.name +
                      "\", the design is for \"" + look.cell->name + "\"" +
                      (named ? "" : "; that one is not known, so that it is held against this");
  }
  if (!known.cell || known.cell->tasks.size() != known.plan.cell.tasks.size()) {
    known.unknown = "its cell is not known, or has another number of robots";
    return known;
  }
  for (std::size_t end = 0; end < known.cell->tasks.size(); ++end) {
    known.plan.cell.tasks[end].base = known.cell->tasks[end].base;
    known.plan.cell.tasks[end].arm = known.cell->tasks[end].arm;
  }
  if (std::optional<std::vector<Pose>> grips = robotio::gripsAtHome(known.plan.cell))
    known.plan.moves.front().poses = std::move(*grips);
  else
    known.unknown = "how its robots move is not known (resources/robots)";
  return known;
}

/// As it would be made of a motion; of one that tells no ways, with those of the design, for its cut alone.
Result<KnownPlan> planOfMotion(const ProgramRun& run, const ProgramLook& look) {
  if (!look.cell) return fail(ErrorCode::badInput, "the cell of the design cannot be read");
  Motion motion = run.motion;
  const bool hasWays = motion.approach && motion.retreat;
  if (!hasWays) {
    motion.approach = look.cut.motion.value->approach;
    motion.retreat = look.cut.motion.value->retreat;
  }
  Result<ProgramPlan> plan = robotio::planProgram(motion, *look.cell);
  if (!plan) return tl::unexpected<Error>(plan.error());
  KnownPlan known{std::move(*plan), false, hasWays, look.cell};
  const bool isTable = look.dialect.word == std::string_view("csv");
  for (ProgramMove& move : known.plan.moves) {
    const std::string name = move.role == MoveRole::home    ? ""
                             : move.instant >= 0 && isTable ? "line " + std::to_string(move.instant + 2)
                             : move.instant >= 0            ? "instants[" + std::to_string(move.instant) + "]"
                             : move.role == MoveRole::approach ? "approach"
                                                               : "retreat";
    move.names.assign(known.plan.cell.tasks.size(), name);
  }
  if (known.plan.moves.front().poses.empty())
    known.unknown = "how its robots hold the blade there is not known";
  return known;
}

/// The directions that a motion as text tells.
void compareDirections(ProgramRun& run, const Motion& designed) {
  constexpr double kSameWay = 1e-5;
  for (const auto& [own, planned, word] : {std::tuple(run.motion.approach, designed.approach, "approach"),
                                           std::tuple(run.motion.retreat, designed.retreat, "retreat")}) {
    if (!own || !planned || (*own - *planned).norm() <= kSameWay) continue;
    run.exceeded.push_back(
        "the " + std::string(word) + " is not the one that the design planned: its direction is " +
        shortText(toDegrees(std::acos(std::clamp(own->dot(*planned), -1.0, 1.0))), 4) + "° off");
  }
}

}  // namespace

Result<void> judgeAround(ProgramRun& run, const ProgramLook& look, const RunContext& context) {
  std::optional<Cell> named;
  const Result<KnownPlan> known = look.dialect.readPlan ? planOfText(look, named) : planOfMotion(run, look);
  if (!known) {
    run.warnings.push_back(
        "home, the ways around the cut, and how fast the blade passes the block are not looked at: " +
        known.error().message);
    return {};
  }
  const Names names(known->plan);
  judgePace(run, look, names);
  const std::size_t before = run.exceeded.size();
  if (!known->otherCell.empty()) run.warnings.push_back(known->otherCell);
  if (known->cell && !look.exchanged)
    if (const Result<ProgramPlan> planned = robotio::planProgram(*look.cut.motion.value, *known->cell))
      for (const Finding& finding : robotio::planDifferences(known->plan, *planned, known->ofText))
        if (const auto* breach = std::get_if<ProgramBreach>(&finding.cause))
          (finding.severity == Severity::error ? run.exceeded : run.warnings)
              .push_back(breach->place + ": " + breach->text);
  run.around = run.exceeded.size() - before;
  if (!known->hasWays) {
    run.warnings.push_back(
        "the way to the block and the way from it are not looked at: this text does not tell them");
    return {};
  }
  if (!known->ofText) compareDirections(run, *look.cut.motion.value);
  if (!known->unknown.empty())
    run.warnings.push_back("home and the way from there are not looked at: " + known->unknown);
  const Result<void> ok = AroundJudge(run, look, known->plan).judge(context);
  run.around = run.exceeded.size() - before;
  return ok;
}

}  // namespace bw::pipeline
