// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/files/file_set.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"

namespace bw::robotio {

/// The text of one file of a program, path relative to the program's folder ("T_ROB1/BladeLeft.mod").
struct ProgramFile {
  std::string path;
  std::string bytes;
};
using Program = std::vector<ProgramFile>;

struct RapidOptions {
  std::string programName = "Blade";  ///< identifiers and file names are made from it
  bool robotWare7 = false;            ///< .modx and UTF-8 instead of .mod and ASCII
  /// Errors of the design that the program is written despite. The head of each module then lists them as "!
  /// NOT SAFE TO RUN: …".
  std::vector<std::string> errors = {};
  /// What else the head of the main modules warns of: "! WARNING: …".
  std::vector<std::string> warnings = {};
  /// Names the run that the program is of, 16 hexadecimal digits; stands in the head of each module. Empty if
  /// there is none.
  std::string run = {};
};

/// ABB RAPID MultiMove program of a motion in a cell: one folder a task, one .mod (or .modx) and one .pgf
/// each, by the rules in docs/robots.md. Checked by the project's own reader before it is returned: a program
/// that breaks a rule is an error that lists it; what the check only warns of is added to `warnings`, once
/// for all tasks.
Result<Program> writeRapid(const Motion& motion, const Cell& cell, const RapidOptions& options = {},
                           Findings* warnings = nullptr);

/// What can be said without the robots' kinematics about how a motion lies in a cell: `WrongSide`, a warning
/// for an end of the blade that is nearer to another robot than to its own, at the first or the
/// last instant. Empty if motion and cell do not fit each other in their number of ends (`writeRapid` refuses
/// those).
Findings checkPlacement(const Motion& motion, const Cell& cell);

/// CSV: header with units, one row an instant, positions and quaternions of every end.
Result<Program> writeCsv(const Motion& motion);
/// JSON with a schema version; numbers round-trip.
Result<Program> writeJson(const Motion& motion, const Cell& cell);

/// Reads back what the writers emit.
Result<Motion> readCsv(std::string_view text);
Result<Motion> readJson(std::string_view text);

/// One target of a program as read back.
struct RapidMove {
  int id = 0;
  std::string instruction;  ///< "MoveL", "MoveAbsJ"
  Pose pose;                ///< in the work object
  double duration = 0;      ///< \T in s, 0 if absent
  double speed = 0;         ///< v_tcp, mm/s
  double zone = -1;         ///< mm, −1 = fine
  int line = 0;
};

/// One task of a RAPID program as read back.
struct RapidTask {
  std::string name;  ///< from the folder
  std::vector<std::string> modules;
  Pose tool, workObject;
  double toolMass = 0;
  std::vector<RapidMove> moves;  ///< inside the synchronised block, in order
};

/// The strict reader of the RAPID subset that we write: any construct outside the subset is an error with
/// file, line and text. `files` are the .mod/.modx files by folder.
Result<std::vector<RapidTask>> readRapid(const Program& program);

/// Applies every rule that needs no robot kinematics (names, files, line ends, task lists, syncidents, IDs,
/// durations, quaternions, zones, data) and reports each `ProgramBreach` with file and line. Files that
/// cannot be parsed are a finding too, never a crash. A mark of `RapidOptions::errors` is an error of kind
/// "rapid-marked"; modules of different runs are one of kind "rapid-run".
Findings checkRapid(const Program& program);

/// The run that the head of a module names, or empty.
std::string runOfModule(std::string_view module);

/// Reads a program folder (…/T_ROB1/*.mod, *.pgf, …) or a single file. What a writer has under way, or left
/// when it was ended, is no part of a program.
Result<Program> loadProgram(const std::filesystem::path& path);

}  // namespace bw::robotio
