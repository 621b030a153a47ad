// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The two entrances to what stands in a program: reading it and checking it.

#include <algorithm>

#include "bw/robotio/program.h"
#include "rapid_program.h"
#include "run_head.h"
#include "unsafe_mark.h"

namespace bw::robotio {

namespace {

RapidMove moveOf(const Step& step) {
  RapidMove move;
  move.id = int(std::clamp(step.statement->id.value_or(0), 0.0, 2e9));
  move.instruction = statementName(step.statement->kind);
  if (step.isLinear()) move.pose = poseAt(*step.target, kTargetPosition, kTargetRotation);
  move.duration = step.statement->duration.value_or(0);
  move.speed = step.speed;
  move.zone = step.zone;
  move.line = step.statement->line;
  return move;
}

RapidTask taskOf(const LinkedTask& linked) {
  RapidTask task;
  task.name = linked.name;
  for (const Module& module : linked.modules) task.modules.emplace_back(module.name);
  bool hasTool = false, hasObject = false;
  for (const Step& step : linked.steps) {
    if (!step.synchronised || !step.isMove()) continue;
    task.moves.push_back(moveOf(step));
    if (step.tool && !hasTool) {
      hasTool = true;
      task.tool = poseAt(*step.tool, kToolPosition, kToolRotation);
      task.toolMass = step.tool->numbers[kToolMass];
    }
    if (step.workObject && !hasObject) {
      hasObject = true;
      const Pose outer = poseAt(*step.workObject, kObjectPosition, kObjectRotation);
      const Pose inner = poseAt(*step.workObject, kObjectInnerPosition, kObjectInnerRotation);
      task.workObject.position = outer.position + outer.rotation * inner.position;
      task.workObject.rotation = outer.rotation * inner.rotation;
    }
  }
  return task;
}

}  // namespace

Result<std::vector<RapidTask>> readRapid(const Program& program) {
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
  std::vector<RapidTask> tasks;
  for (const LinkedTask& task : linked.front().tasks) tasks.push_back(taskOf(task));
  return tasks;
}

std::string runOfModule(std::string_view module) { return readRunHead(module).run; }

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
  }
  return breaches.take();
}

}  // namespace bw::robotio
