// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The two entrances to what stands in a program: reading it and checking it.

#include <algorithm>

#include "motion/motion_check.h"
#include "rapid/linked_program.h"
#include "rapid/module_head.h"
#include "rapid/names.h"

namespace bw::robotio {

namespace {

/// s to stand still after each of the synchronised moves of a task; before the first one nothing has moved.
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

}  // namespace

Result<Motion> readRapid(const Program& program) {
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
  std::vector<std::vector<Pose>> poses(moves.size());
  std::vector<double> zones(moves.size(), 0), waits(moves.size(), 0);  // of the ends the larger one
  for (const LinkedTask& task : strip.tasks) {
    const std::vector<const Step*> steps = synchronisedMoves(task);
    if (steps.size() != moves.size() ||
        !std::ranges::all_of(steps, [](const Step* s) { return hasPose(*s); }))
      return fail(ErrorCode::badInput,
                  "the synchronised moves of task " + task.name + " are not " + std::to_string(moves.size()) +
                      " linear ones, as many as those of the first task",
                  task.folder);
    const std::vector<double> stands = waitsOf(task);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      waits[i] = std::max(waits[i], stands[i]);
      poses[i].push_back(poseOf(*steps[i]));
      zones[i] = std::max(zones[i], steps[i]->zone);
    }
  }
  Motion motion;
  motion.bladeLength = checkRuns(strip, breaches);
  const auto way = [&](std::size_t from) -> Eigen::Vector3d {
    return (poses[from + 1][0].position - poses[from][0].position).normalized();
  };
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Statement& s = *moves[i]->statement;
    // In the middle of the path they are targets as any other.
    if (i == 0 && sameName(s.name, kApproachTarget) && moves.size() > 1) {
      motion.approach = way(i);
      continue;
    }
    if (i > 0 && i + 1 == moves.size() && sameName(s.name, kRetreatTarget)) {
      motion.retreat = way(i - 1);
      continue;
    }
    if (motion.instants.empty()) {
      motion.instants.push_back({0, -1, poses[i], 0});
    } else {
      const double seconds = s.duration.value_or(farthest(poses[i - 1], poses[i]) / moves[i]->speed);
      motion.cuttingSpeed = std::max(motion.cuttingSpeed, moves[i]->speed);
      motion.instants.push_back(
          {motion.instants.back().time + seconds, -1, poses[i], waits[i] > 0 ? 0 : zones[i]});
    }
    if (waits[i] > 0) motion.instants.push_back({motion.instants.back().time + waits[i], -1, poses[i], 0});
  }
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  return motion;
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
