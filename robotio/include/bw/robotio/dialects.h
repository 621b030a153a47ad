// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"
#include "bw/robotio/motion/program_plan.h"
#include "bw/robotio/text/program_text.h"

namespace bw::robotio {

/// A form of text in which a motion leaves the program. The row of the same word in `programFormats` tells
/// people of it. What robots run has a check, and lies in one folder a task.
struct Dialect {
  const char* word;  ///< "rapid"
  /// Names of its files; those that begin with a dot are suffixes, in any case.
  std::span<const char* const> files;
  /// The text of a motion in a cell; what its check warns of is added to `warnings`.
  Result<Program> (*write)(const Motion& motion, const Cell& cell, const ProgramNotes& notes,
                           Findings* warnings);
  Result<Motion> (*read)(const Program& program);
  Findings (*check)(const Program& program);  ///< null where no robot runs it
  /// What the text tells beside the motion: home, approach, retreat and the names of its targets; null where
  /// it tells none.
  Result<ProgramPlan> (*readPlan)(const Program& program);
  /// Those of the files of one folder that we wrote, as the heads of their texts (4 KB) tell.
  Program (*own)(const Program& heads);
};

/// All dialects, in the order of `programFormats`.
std::span<const Dialect> dialects();
/// That of a word, or null.
const Dialect* dialect(std::string_view word);
/// That which a file belongs to by its name, or null.
const Dialect* dialectOfFile(const std::string& path);

/// Those of some files that belong to a dialect by their names.
Program filesOf(const Dialect& dialect, const Program& files);

/// Checks each file of a program by the rules of its dialect; where none belongs to any, the first dialect
/// says what is missing.
Findings checkProgram(const Program& program);

/// Reads a program folder (…/T_ROB1/*.mod, *.pgf, …) in any dialect that robots run, or a single file. What a
/// writer has under way, or left when it was ended, is no part of a program.
Result<Program> loadProgram(const std::filesystem::path& path);

}  // namespace bw::robotio
