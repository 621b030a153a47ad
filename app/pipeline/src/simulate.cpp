// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/simulate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <variant>

#include "bw/core/base/box_distance.h"
#include "bw/core/base/units.h"
#include "bw/core/simulation/run_findings.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/pipeline.h"
#include "bw/robotio/dialects.h"
#include "bw/words/findings.h"
#include "cut_stages.h"
#include "make_files.h"
#include "program_ways.h"

namespace bw::pipeline {

using nlohmann::ordered_json;

namespace {

constexpr double kSameLength = 1e-3;  // mm
constexpr double kAll = 0.999;        // of the travel of a surface
constexpr double kRounded = 1e-3;     // of a radius

/// A program as it is read.
struct ReadProgram {
  const robotio::Dialect* dialect = nullptr;
  robotio::Program files;
  Motion motion;
};

/// `broken` gets what breaks the rules of its dialect.
Result<ReadProgram> readProgram(const robotio::Program& program, std::vector<std::string>& broken) {
  for (const robotio::Dialect& dialect : robotio::dialects()) {
    robotio::Program files = robotio::filesOf(dialect, program);
    if (files.empty()) continue;
    if (dialect.check)
      for (const Finding& finding : dialect.check(files))
        if (finding.severity == Severity::error)
          broken.push_back(words::placeText(finding) + ": " +
                           words::sentence(finding, words::Reader::commandLine) + " [" +
                           words::kindWord(finding) + "]");
    Result<Motion> motion = dialect.read(files);
    if (!motion) return tl::unexpected<Error>(motion.error());
    return ReadProgram{&dialect, std::move(files), std::move(*motion)};
  }
  // Other tables and lists are refused by their names: what they tell is not known.
  return fail(ErrorCode::badInput, (program.empty() ? "there" : program.front().path) +
                                       " is no robot program or motion by its name; give the folder of a "
                                       "program, or a motion in a file that is named motion.csv or "
                                       "motion.json");
}

/// The cut that a program is of: the one whose motion begins, goes on and ends most nearly as it does.
std::pair<const BlockEvaluation*, const CutEvaluation*> cutOf(const Evaluation& e, const Motion& motion) {
  constexpr int kPlaces = 9;
  const auto apart = [&](const Motion& own) {
    if (own.instants.empty() || motion.instants.empty()) return 1e300;
    double sum = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const auto at = [&](const Motion& of) -> const MotionInstant& {
        return of.instants[(of.instants.size() - 1) * std::size_t(k) / (kPlaces - 1)];
      };
      const std::vector<Pose>&a = at(own).poses, &b = at(motion).poses;
      for (std::size_t end = 0; end < std::min(a.size(), b.size()); ++end)
        sum += (a[end].position - b[end].position).squaredNorm();
    }
    return sum + std::pow(own.duration() - motion.duration(), 2);
  };
  std::pair nearest(&e.blocks.front(), &e.cut());
  double least = 1e300;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (const double off = apart(*cut.motion.value); off < least) {
        least = off;
        nearest = {&block, &cut};
      }
  return nearest;
}

/// What of the blade halts it, in words.
std::string haltText(const Halt& halt, double length) {
  const std::string when = "at " + shortText(halt.time, 4) + " s ";
  switch (halt.why) {
    case Halt::Why::tears:
      return when + "the grips are " + shortText(halt.apart, 7) + " mm apart, more than the blade of " +
             shortText(length, 7) + " mm is long; it would tear";
    case Halt::Why::offPlane:
      return when + "the ends of the blade are not in one plane: " + shortText(halt.off) + " mm off, " +
             shortText(toDegrees(halt.twist)) + "° twisted";
    case Halt::Why::lost:
      break;
  }
  return when + "the blade cannot be followed: " + halt.reason;
}

/// True if the ends of the blade stand the other way round than those of the motion designed; without one,
/// than all ends stand: the left one first in the planes across the travel.
bool gripsExchanged(const Motion& motion, const Motion* designed) {
  using Eigen::Vector3d;
  constexpr double kClear = 0.05;  // of the chord
  const auto chord = [](const Motion& of) -> Vector3d {
    const std::vector<Pose>& poses = of.instants.front().poses;
    return poses[1].position - poses[0].position;
  };
  if (designed) return chord(motion).dot(chord(*designed)) < 0;
  if (motion.block.size.isZero()) return false;
  const Frame& f = motion.block.frame;
  const auto toFile = [&f](const Vector3d& v) -> Vector3d {
    return v.x() * f.x + v.y() * f.y + v.z() * f.normal;
  };
  const Vector3d travel = toFile(motion.instants.front().poses.front().rotation * Vector3d::UnitZ());
  const PlaneFamily planes = PlaneFamily::across(motion.block, travel.normalized());
  return toFile(chord(motion)).dot(planes.frame.x) < -kClear * chord(motion).norm();
}

/// Where little brings the blade out of its shape.
void judgeBarriers(const std::vector<BarrierLook>& looks, std::vector<std::string>& exceeded) {
  const auto unknown =
      std::ranges::find_if(looks, [](const BarrierLook& look) { return look.unsure && !look.barrier; });
  if (const BarrierLook* least = leastBarrier(looks); least && *least->barrier < kLeastBarrier)
    exceeded.push_back("at " + shortText(least->time, 4) + " s a push of " + shortText(*least->barrier, 2) +
                       " N mm brings the blade into another shape, which is about as low or lower (least: " +
                       shortText(kLeastBarrier) + " N mm)");
  if (unknown != looks.end())
    exceeded.push_back(
        "at " + shortText(unknown->time, 4) +
        " s the blade may rest in another shape, and how little brings it over could not be found");
}

/// Where the whole blade comes below the floor of a block that is given, or beyond what the motion tolerance
/// leaves of it.
void judgeFloor(const Simulation& simulation, const CutEvaluation& cut, double motionTolerance,
                std::vector<std::string>& exceeded) {
  const std::optional<double> floor = cut.check.request.floor;
  if (!floor || simulation.blades.empty()) return;
  constexpr int kPlaces = 101;
  double least = std::numeric_limits<double>::infinity(), time = 0;
  const SurfaceGrid swept = simulation.swept(kPlaces);
  for (std::size_t r = 0; r < simulation.blades.size(); ++r) {
    const std::span points(&swept.points[r * kPlaces], std::size_t(kPlaces));
    const double height = lowestPlace(cut.block(), points).height;
    if (height >= least) continue;
    least = height;
    time = simulation.blades[r].time;
  }
  if (least < *floor - motionTolerance)
    exceeded.push_back("at " + shortText(time, 4) + " s the blade is " + shortText(std::abs(least)) +
                       (least < 0 ? " mm below" : " mm above") +
                       " the face that the block lies on (floor: " + shortText(*floor) + " mm)");
}

/// Where a grip comes into the block, or, while any of the blade is in it, nearer than the clearance and what
/// the motion tolerance leaves of it.
void judgeGrips(const Simulation& simulation, const CutEvaluation& cut, double motionTolerance,
                std::vector<std::string>& exceeded) {
  if (simulation.blades.empty()) return;
  constexpr int kPlaces = 101;
  const SurfaceGrid swept = simulation.swept(kPlaces);
  const Box& block = cut.block();
  const double clearance = cut.sweep.value->request.clearance;
  double least = std::numeric_limits<double>::infinity(), time = 0;
  for (std::size_t r = 0; r < simulation.blades.size(); ++r) {
    const std::span points(&swept.points[r * kPlaces], std::size_t(kPlaces));
    const double distance = std::min(boxDistance(block, points.front()), boxDistance(block, points.back()));
    const bool cuts = std::ranges::any_of(
        points, [&](const Eigen::Vector3d& place) { return boxDistance(block, place) < 0; });
    if ((!cuts && distance >= 0) || distance >= least) continue;
    least = distance;
    time = simulation.blades[r].time;
  }
  if (least < clearance - motionTolerance)
    exceeded.push_back("at " + shortText(time, 4) + " s a grip is " + shortText(std::abs(least)) +
                       (least < 0 ? " mm inside the block" : " mm from the block") +
                       " (clearance: " + shortText(clearance) + " mm)");
}

/// When a stretch of a run is.
std::string whenText(const Simulation& simulation, const RunStretch& at) {
  const double from = simulation.blades[at.first].time, to = simulation.blades[at.last].time;
  return at.first == at.last ? "at " + shortText(from, 4) + " s "
                             : "from " + shortText(from, 4) + " s to " + shortText(to, 4) + " s ";
}

std::vector<std::string> judge(const Design& design, const Simulation& simulation,
                               const SimulatedSurface& surface) {
  std::vector<std::string> exceeded;
  const auto above = [&](double value, const RunSpot& at, double limit, const std::string& what,
                         const std::string& of) {
    if (value > limit)
      exceeded.push_back(what + " " + shortText(value) + " mm (" + of + " " + shortText(limit) + " mm), at " +
                         shortText(at.time, 4) + " s at (" + shortText(at.place.x(), 4) + ", " +
                         shortText(at.place.y(), 4) + ", " + shortText(at.place.z(), 4) + ")");
  };
  above(surface.toDesignMax, surface.toDesignAt, design.process.motionTolerance + simulation.straightWithin,
        "from the surface shown the blade lies up to", "motion tolerance");
  above(surface.toTargetMax, surface.toTargetAt, design.process.tolerance,
        "from the target the blade lies up to", "tolerance");
  if (surface.covered <= 0 && !simulation.halt)
    exceeded.push_back("no part of the blade comes over the surface shown");
  else if (surface.covered > 0 && surface.covered < kAll)
    exceeded.push_back("the program cuts " + shortText(100 * surface.covered, 3) +
                       " % of the travel of the surface shown");
  if (simulation.marginMin < design.process.margin - kMarginRounded)
    exceeded.push_back("the stability margin falls to " + shortText(simulation.marginMin, 2) +
                       " (asked for: " + shortText(design.process.margin, 2) + ")");
  if (const std::optional<RunSpeeds>& speeds = simulation.speeds;
      speeds && speeds->max > kFaster * design.process.cuttingSpeed)
    exceeded.push_back("at " + shortText(speeds->maxAt.time, 4) +
                       " s the fastest point of the blade goes at " + shortText(speeds->max) +
                       " mm/s (cutting speed " + shortText(design.process.cuttingSpeed) + " mm/s)");
  const double least = 1 / design.blade.maxCurvature();
  if (simulation.minRadius > 0 && simulation.minRadius < least * (1 - kRounded))
    exceeded.push_back("the blade bends to a radius of " + shortText(simulation.minRadius) +
                       " mm (least: " + shortText(least) + " mm)");
  for (const RunStretch& at : simulation.twists())
    exceeded.push_back(whenText(simulation, at) +
                       "the round blade would twist out of its plane rather than rest in its shape");
  return exceeded;
}

ordered_json placeJson(const Eigen::Vector3d& place) { return {place.x(), place.y(), place.z()}; }

ordered_json spotJson(const RunSpot& spot) {
  return {{"instant", spot.instant}, {"time", spot.time}, {"at", placeJson(spot.place)}};
}

/// The slowest and the fastest point, and where they are; null where nothing moves.
void addSpeeds(ordered_json& object, const std::optional<RunSpeeds>& speeds) {
  object["speed_min_mm_s"] = speeds ? ordered_json(speeds->min) : ordered_json(nullptr);
  object["speed_min_at"] = speeds ? spotJson(speeds->minAt) : ordered_json(nullptr);
  object["speed_max_mm_s"] = speeds ? ordered_json(speeds->max) : ordered_json(nullptr);
  object["speed_max_at"] = speeds ? spotJson(speeds->maxAt) : ordered_json(nullptr);
}

}  // namespace

Result<ProgramRun> runProgram(const robotio::Program& program, const Design* design,
                              const RunContext& context, const CutLengths& lengths,
                              const std::function<void(const ProgramRun&)>& seen) {
  std::vector<std::string> broken;
  Result<ReadProgram> read = readProgram(program, broken);
  if (!read) return tl::unexpected<Error>(read.error());
  ProgramRun run{std::move(read->motion), {}};
  Outcome outcome;
  const CutEvaluation* cut = nullptr;
  Blade blade;
  blade.length = run.motion.bladeLength;
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();
  if (design) {
    CutLengths known = lengths;
    if (run.motion.bladeLength > 0 && run.motion.bladeLength <= Blade::kLongest)
      for (const Cut& each : design->cuts) known.try_emplace(each.id, run.motion.bladeLength);
    outcome = evaluate(*design, nullptr, context, Purpose::comparison, known);
    if (outcome.error && outcome.error->code != ErrorCode::cancelled && known != lengths)
      outcome = evaluate(*design, nullptr, context, Purpose::comparison, lengths);
    if (outcome.error) return tl::unexpected<Error>(*outcome.error);
    const Evaluation& e = outcome.evaluation;
    const auto [block, nearest] = cutOf(e, run.motion);
    cut = nearest;
    run.block = block->id;
    run.cut = cut->id;
    run.kerf = cut->middle.request;
    run.alone = e.blocks.size() == 1 && block->cuts.size() == 1;
    blade = cut->sweep.value->request.blade;
    weight = cut->sweep.value->request.weight;
    if (run.motion.bladeLength > 0 && std::abs(run.motion.bladeLength - blade.length) > kSameLength)
      return fail(ErrorCode::badInput,
                  "the program is for a blade of " + shortText(run.motion.bladeLength, 7) +
                      " mm, the design has one of " + shortText(blade.length, 7) +
                      " mm; give the design that the program is of",
                  "blade", run.motion.bladeLength, blade.length);
    run.motion.bladeLength = blade.length;
    // What robots run tells no block.
    if (run.motion.block.size.isZero()) run.motion.block = cut->block();
  } else if (!(run.motion.bladeLength > 0)) {
    return fail(ErrorCode::badInput, "the program does not tell how long its blade is; give its design",
                "blade");
  }
  Result<Simulation> simulation = simulate(run.motion, blade, weight, context);
  if (!simulation) return tl::unexpected<Error>(simulation.error());
  run.simulation = std::move(*simulation);
  if (design) {
    // Neither needs the other.
    std::future<Result<std::vector<BarrierLook>>> looks =
        std::async(context.threads == 1 ? std::launch::deferred : std::launch::async,
                   [&] { return barriersAlong(run.simulation, blade.flexuralRigidity(), context); });
    const Result<SimulatedSurface> surface =
        cutBy(run.simulation, *cut, context, &run.melted, &run.compared.cut);
    if (surface) {
      run.surface = *surface;
      run.compared.target = cut->targetMesh.value;
      run.compared.tolerance = design->process.tolerance;
      run.compared.motionTolerance = design->process.motionTolerance;
      if (seen) seen(run);
    }
    Result<std::vector<BarrierLook>> barriers = looks.get();
    if (!surface) return tl::unexpected<Error>(surface.error());
    if (!barriers) return tl::unexpected<Error>(barriers.error());
    run.barriers = std::move(*barriers);
    run.exceeded = judge(*design, run.simulation, *surface);
    judgeBarriers(run.barriers, run.exceeded);
    judgeFloor(run.simulation, *cut, design->process.motionTolerance, run.exceeded);
    judgeGrips(run.simulation, *cut, design->process.motionTolerance, run.exceeded);
    const Result<Cell> cell = loadCell(design->output.cell);
    const bool exchanged = gripsExchanged(run.motion, cut->motion.value.get());
    const ProgramLook look{*read->dialect,          read->files, *design, *cut,
                           cell ? &*cell : nullptr, exchanged,   blade,   weight};
    if (Result<void> ok = judgeAround(run, look, context); !ok) return tl::unexpected<Error>(ok.error());
    // What would help is not sought here: a length is advised by the design alone, which tries it.
    Findings findings = outcome.evaluation.findings();
    std::erase_if(findings, [&run](const Finding& finding) {
      return !finding.where.block.empty() && finding.where.block != run.block;
    });
    for (Finding& finding : findings)
      std::erase_if(finding.remedies,
                    [](const Remedy& remedy) { return std::holds_alternative<OtherLength>(remedy); });
    // How the block lies in its cell decides which way the weight pulls.
    for (const Finding& finding : findings)
      if (std::holds_alternative<WeightElsewhere>(finding.cause) &&
          (finding.where.cut.empty() || finding.where.cut == run.cut))
        run.warnings.push_back(words::sentence(finding, words::Reader::commandLine));
    const std::vector<std::string> errors = words::errorsOf(findings, words::Reader::commandLine);
    if (!errors.empty())
      run.exceeded.push_back(
          "the design has " +
          (errors.size() == 1 ? "an error: " : std::to_string(errors.size()) + " errors: ") + errors.front());
  } else if (seen) {
    seen(run);
  }
  if (gripsExchanged(run.motion, cut ? cut->motion.value.get() : nullptr))
    run.exceeded.push_back(
        "the grips are exchanged: the poses of the left end of the blade hold its right one, and those of "
        "the "
        "right end its left one, so that each robot would have to reach across the other; exchange both "
        "poses "
        "of every instant");
  run.exceeded.insert(run.exceeded.begin(), broken.begin(), broken.end());
  run.broken = broken.size();
  if (const std::optional<Halt>& halt = run.simulation.halt)
    run.exceeded.push_back(haltText(*halt, run.motion.bladeLength));
  for (const RunStretch& at : run.simulation.crossings())
    run.exceeded.push_back(whenText(run.simulation, at) +
                           "the blade crosses itself, which no blade between two robots can");
  for (const Simulation::Snap& snap : run.simulation.snaps)
    run.exceeded.push_back("at " + shortText(snap.time, 4) +
                           " s the blade leaves its shape and snaps into another");
  if (!run.simulation.decided)
    run.exceeded.push_back(
        "between the grips of its first target the blade rests in two shapes that are about as low");
  return run;
}

std::string simulationText(const ProgramRun& run) {
  const Simulation& simulation = run.simulation;
  ordered_json object;
  object["bladewright_simulation"] = 1;
  object["unit"] = "mm";
  object["instants"] = run.motion.instants.size();
  object["moments"] = simulation.blades.size();
  object["seconds"] = run.motion.duration();
  object["blade_length"] = run.motion.bladeLength;
  object["block"] = run.block.empty() ? ordered_json(nullptr) : ordered_json(run.block);
  object["cut"] = run.cut.empty() ? ordered_json(nullptr) : ordered_json(run.cut);
  const bool ran = !simulation.blades.empty();
  object["entry"] = !ran                 ? ordered_json(nullptr)
                    : simulation.decided ? ordered_json("decided")
                                         : ordered_json("undecided");
  object["halted"] = nullptr;
  if (const std::optional<Halt>& halt = simulation.halt)
    object["halted"] = {{"why", haltName(halt->why)},
                        {"instant", halt->instant},
                        {"time", halt->time},
                        {"at", placeJson(halt->place)}};
  object["margin_min"] = ran ? ordered_json(simulation.marginMin) : ordered_json(nullptr);
  const BarrierLook* least = leastBarrier(run.barriers);
  object["barrier_min_Nmm"] = least ? ordered_json(*least->barrier) : ordered_json(nullptr);
  object["barrier_min_at"] =
      least ? ordered_json({{"instant", least->instant}, {"time", least->time}}) : ordered_json(nullptr);
  object["barriers"] = ordered_json::array();
  for (const BarrierLook& look : run.barriers)
    object["barriers"].push_back(
        {{"instant", look.instant},
         {"time", look.time},
         {"sure", !look.unsure},
         {"barrier_Nmm", look.barrier ? ordered_json(*look.barrier) : ordered_json(nullptr)}});
  object["min_radius_mm"] =
      simulation.minRadius > 0 ? ordered_json(simulation.minRadius) : ordered_json(nullptr);
  object["straight_within_mm"] = simulation.straightWithin;
  addSpeeds(object, simulation.speeds);
  object["snaps"] = ordered_json::array();
  for (const Simulation::Snap& snap : simulation.snaps)
    object["snaps"].push_back({{"instant", snap.instant}, {"time", snap.time}});
  object["surface"] = nullptr;
  if (run.surface && run.surface->covered > 0) {
    const SimulatedSurface& s = *run.surface;
    object["surface"] = {{"deviation_to_design_max_mm", s.toDesignMax},
                         {"deviation_to_design_at_targets_max_mm", s.toDesignAtTargets},
                         {"deviation_to_design_mean_mm", s.toDesignMean},
                         {"deviation_to_design_at", placeJson(s.toDesignAt.place)},
                         {"deviation_to_design_max_at", spotJson(s.toDesignAt)},
                         {"deviation_to_target_max_mm", s.toTargetMax},
                         {"deviation_to_target_mean_mm", s.toTargetMean},
                         {"deviation_to_target_max_at", spotJson(s.toTargetAt)},
                         {"covered_percent", 100 * s.covered}};
    addSpeeds(object["surface"], s.speeds);
  }
  object["exceeded"] = run.exceeded;
  object["warnings"] = run.warnings;
  return object.dump(2) + "\n";
}

SurfaceGrid standing(const ProgramRun& run, SurfaceGrid swept) {
  return run.melted ? standingBeside(std::move(swept), run.kerf, *run.melted)
                    : standingBeside(std::move(swept), run.kerf);
}

std::string cutText(const ProgramRun& run) {
  const SurfaceGrid cut = standing(run, run.simulation.swept());
  return objText({{"cut_surface", &cut}});
}

}  // namespace bw::pipeline
