// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The two entrances to what stands in a program: reading it and checking it.

#include <algorithm>

#include "bw/core/base/units.h"
#include "motion/motion_check.h"
#include "rapid/linked_program.h"
#include "rapid/module_head.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

/// What a text is read to.
struct ReadText {
  ProgramPlan plan;
  Motion motion;
};

/// "irb1600-pair" of "…, for irb1600-10-1.45 in the cell irb1600-pair."; empty where it is not told.
std::string cellOfHead(std::string_view module) {
  constexpr std::string_view kBefore = " in the cell ";
  const std::string_view head = module.substr(0, 4096);
  const std::size_t line = head.find("! Bladewright: ");
  if (line == std::string_view::npos) return {};
  const std::string_view text = head.substr(line, head.find_first_of("\r\n", line) - line);
  const std::size_t at = text.find(kBefore);
  if (at == std::string_view::npos || !text.ends_with('.')) return {};
  return std::string(text.substr(at + kBefore.size(), text.size() - at - kBefore.size() - 1));
}

/// What a task brings to the cell: its tool, its work object and its home.
CellTask cellTaskOf(const LinkedTask& task, Pose& workObject) {
  CellTask known;
  known.name = task.name;
  for (const Step& step : task.steps) {
    if (!step.isMove()) continue;
    if (step.tool) {
      known.tool = poseAt(*step.tool, kToolPosition, kToolRotation);
      known.toolName = step.tool->name;
    }
    if (step.workObject && step.isLinear()) {
      const Pose user = poseAt(*step.workObject, kObjectPosition, kObjectRotation),
                 object = poseAt(*step.workObject, kObjectInnerPosition, kObjectInnerRotation);
      workObject = {user.position + user.rotation * object.position, user.rotation * object.rotation};
    }
    // The last one before the block.
    if (!step.synchronised && !step.isLinear() && step.target) {
      known.home.clear();
      for (std::size_t axis = 0; axis < kJointExternal; ++axis)
        known.home.push_back(fromDegrees(step.target->numbers[axis]));
    }
    if (step.synchronised && step.tool && step.workObject) break;
  }
  return known;
}

/// What heats the blade before the synchronised block, and how long: the last signal that is set.
void readHeat(const LinkedTask& task, Cell& cell) {
  for (const Step& step : task.steps) {
    const Statement& s = *step.statement;
    if (s.kind == StatementKind::syncMoveOn) return;
    if (s.kind == StatementKind::setSignal) {
      cell.heatSignal = s.name;
      cell.heatDwell = 0;
    } else if (s.kind == StatementKind::resetSignal && sameName(s.name, cell.heatSignal)) {
      cell.heatSignal.clear();
    } else if (s.kind == StatementKind::waitTime && !cell.heatSignal.empty()) {
      cell.heatDwell += s.duration.value_or(0);
    }
  }
}

/// s to stand still after each of the synchronised moves of a task; before the first ones nothing moves.
std::vector<double> waitsOf(const LinkedTask& task) {
  std::vector<double> waits;
  for (const Step& step : task.steps) {
    if (!step.synchronised) continue;
    if (step.isMove()) waits.push_back(0);
    if (step.statement->kind == StatementKind::waitTime && !waits.empty())
      waits.back() += step.statement->duration.value_or(0);
  }
  return waits;
}

Result<ReadText> readText(const Program& program) {
  Breaches breaches;
  const std::vector<LinkedProgram> linked = linkProgram(program, breaches);
  if (linked.empty())
    return fail(ErrorCode::badInput,
                "there is no RAPID module (.mod or .modx) to read; give the folder of a program");
  if (linked.size() > 1)
    return fail(ErrorCode::badInput,
                "the files are of " + std::to_string(linked.size()) + " programs (\"" + linked[0].folder +
                    "\", \"" + linked[1].folder + "\", ...); read one at a time",
                linked[1].folder);
  const Findings findings = breaches.take();
  if (!findings.empty()) {
    const auto& first = std::get<ProgramBreach>(findings.front().cause);
    return fail(ErrorCode::badInput, first.place + ": " + first.text, first.place);
  }
  const LinkedProgram& strip = linked.front();
  const std::vector<const Step*> moves = synchronisedMoves(strip.tasks.front());
  ReadText text;
  Cell& cell = text.plan.cell;
  std::vector<ProgramMove>& read = text.plan.moves;
  read.resize(moves.size());
  for (const LinkedTask& task : strip.tasks) {
    const std::vector<const Step*> steps = synchronisedMoves(task);
    if (steps.size() != moves.size() ||
        !std::ranges::all_of(steps, [](const Step* s) { return hasPose(*s); }))
      return fail(ErrorCode::badInput,
                  "the synchronised moves of task " + task.name + " are not " + std::to_string(moves.size()) +
                      " linear ones, as many as those of the first task",
                  task.folder);
    const std::vector<double> waits = waitsOf(task);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      read[i].poses.push_back(poseOf(*steps[i]));
      read[i].zone = std::max(read[i].zone, steps[i]->zone);
      read[i].names.emplace_back(steps[i]->statement->name);
      read[i].wait = std::max(read[i].wait, waits[i]);
    }
    Pose workObject;
    cell.tasks.push_back(cellTaskOf(task, workObject));
    if (cell.heatSignal.empty()) readHeat(task, cell);
    if (&task == &strip.tasks.front()) cell.workObject = workObject;
  }
  for (const ProgramFile& file : program)
    if (cell.name.empty()) cell.name = cellOfHead(file.bytes);
  Motion& motion = text.motion;
  motion.bladeLength = checkRuns(strip, breaches);
  const auto way = [&](std::size_t from) -> Eigen::Vector3d {
    return (read[from + 1].poses[0].position - read[from].poses[0].position).normalized();
  };
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Statement& s = *moves[i]->statement;
    ProgramMove& move = read[i];
    move.speed = moves[i]->speed;
    move.duration = i == 0 ? s.duration.value_or(0)
                           : s.duration.value_or(farthest(read[i - 1].poses, move.poses) / move.speed);
    if (i == 0 && sameName(s.name, kApproachTarget) && i + 1 < moves.size()) {
      move.role = MoveRole::approach;
      motion.approach = way(i);
      continue;
    }
    if (i + 1 == moves.size() && sameName(s.name, kRetreatTarget) && i > 0) {
      move.role = MoveRole::retreat;
      motion.retreat = way(i - 1);
      continue;
    }
    if (motion.instants.empty()) {
      move.role = MoveRole::approach;
      motion.instants.push_back({0, -1, move.poses, 0});
    } else {
      motion.cuttingSpeed = std::max(motion.cuttingSpeed, move.speed);
      motion.instants.push_back(
          {motion.instants.back().time + move.duration, -1, move.poses, move.wait > 0 ? 0 : move.zone});
    }
    move.instant = int(motion.instants.size()) - 1;
    if (move.wait > 0)
      motion.instants.push_back({motion.instants.back().time + move.wait, -1, move.poses, 0});
  }
  text.plan.bladeLength = motion.bladeLength;
  ProgramMove home;
  home.role = MoveRole::home;
  for (const LinkedTask& task : strip.tasks) {
    std::string name;
    for (const Step& step : task.steps)
      if (step.isMove() && !step.synchronised && !step.isLinear()) name = step.statement->name;
    home.names.push_back(name);
  }
  read.insert(read.begin(), std::move(home));
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  text.plan.cuttingTime = motion.cuttingTime();
  return text;
}

}  // namespace

Result<Motion> readRapid(const Program& program) {
  Result<ReadText> text = readText(program);
  if (!text) return tl::unexpected<Error>(text.error());
  return std::move(text->motion);
}

Result<ProgramPlan> readRapidPlan(const Program& program) {
  Result<ReadText> text = readText(program);
  if (!text) return tl::unexpected<Error>(text.error());
  return std::move(text->plan);
}

std::string runOfModule(std::string_view module) { return readRunHead(module).run; }

Program ownRapid(const Program& heads) {
  const auto stemOf = [](const ProgramFile& file) { return file.path.substr(0, file.path.rfind('.')); };
  // A copy that somebody saved under another name is theirs.
  const auto bearsItsName = [&](const ProgramFile& file) {
    return isModuleFile(file.path) && file.bytes.starts_with("MODULE " + stemOf(file) + "\r\n");
  };
  std::vector<std::string> ours;  // stems of modules
  for (const ProgramFile& file : heads)
    if (bearsItsName(file) && file.bytes.find("! Bladewright: ") != std::string::npos)
      ours.push_back(stemOf(file));
  // "Left_001" is the first part of "Left".
  const auto isOurs = [&](const std::string& stem) {
    return std::ranges::any_of(ours, [&](const std::string& own) {
      return stem == own || (stem.starts_with(own + "_") && stem.size() > own.size() + 1 &&
                             stem.find_first_not_of("0123456789", own.size() + 1) == std::string::npos);
    });
  };
  Program own;
  for (const ProgramFile& file : heads) {
    const std::string stem = stemOf(file);
    const bool lists =
        isProgramFile(file.path) && file.bytes.find("<Module>" + stem + ".mod") != std::string::npos;
    if ((bearsItsName(file) || lists) && isOurs(stem)) own.push_back(file);
  }
  return own;
}

Findings checkRapid(const Program& program) {
  Breaches breaches;
  const std::vector<LinkedProgram> linked = linkProgram(program, breaches);
  if (linked.empty())
    breaches.add("rapid-rule-2", "program", 0,
                 "there is no RAPID module (.mod or .modx) to check; give the folder of a program");
  for (const LinkedProgram& strip : linked) {
    checkMarks(strip, breaches);
    const double bladeLength = checkRuns(strip, breaches);
    checkFiles(strip, breaches);
    bool readable = true;
    for (const LinkedTask& task : strip.tasks) {
      readable = readable && task.readable;
      checkDeclarations(task, breaches);
      checkSteps(task, breaches);
      checkLeaps(task, breaches);
    }
    if (!readable) continue;
    checkAcrossTasks(strip, breaches);
    checkGrips(strip, bladeLength, breaches);
    checkCarried(strip, breaches);
  }
  return breaches.take();
}

}  // namespace bw::robotio
