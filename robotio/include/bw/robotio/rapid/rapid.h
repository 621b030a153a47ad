// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/robotio/motion/program_plan.h"
#include "bw/robotio/text/program_text.h"

namespace bw::robotio {

/// ABB RAPID MultiMove program of a plan: one folder a task, one .mod and one .pgf each, by the rules in
/// docs/robots.md; for `robotWare7` .modx in UTF-8 instead of .mod in ASCII. Checked by the project's own
/// reader before it is returned: a program that breaks a rule is an error that lists it; what the check only
/// warns of is added to `warnings`, once for all tasks.
Result<Program> writeRapid(const ProgramPlan& plan, const ProgramNotes& notes = {},
                           Findings* warnings = nullptr, bool robotWare7 = false);

/// The strict reader of the RAPID subset that we write: any construct outside the subset is an error with
/// file, line and text. `program` are the .mod/.modx files by folder. The motion is that of the moves in the
/// synchronised block, its cutting speed one that none of them exceeds; where the blade stands still between
/// them (WaitTime) the instant stands there twice. No program tells the block and the stations: they stay at
/// their defaults.
Result<Motion> readRapid(const Program& program);

/// The same text as a plan, with the names of its targets and what stands still in the synchronised block: of
/// its cell the name (where the head tells it), names, tools and homes of the tasks, the work object and the
/// heat. `instant` of a move is that of the motion that `readRapid` gives.
Result<ProgramPlan> readRapidPlan(const Program& program);

/// Applies every rule that needs no robot kinematics (names, files, line ends, task lists, syncidents, IDs,
/// durations, quaternions, zones, data) and reports each `ProgramBreach` with file and line. Files that
/// cannot be parsed are a finding too, never a crash. A mark of `ProgramNotes::errors` is an error of kind
/// "rapid-marked"; modules of different runs are one of kind "rapid-run".
Findings checkRapid(const Program& program);

/// Those of the files of one folder that we wrote, as the heads of their texts (4 KB) tell.
Program ownRapid(const Program& heads);

/// True for the path of a .mod or .modx file, in any case.
bool isModuleFile(std::string_view path);

/// The run that the head of a module names, or empty.
std::string runOfModule(std::string_view module);

}  // namespace bw::robotio
