// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/motion/cell.h"
#include "bw/core/motion/motion.h"

namespace bw::robotio {

/// The text of one file of a program, path relative to the program's folder ("T_ROB1/BladeLeft.mod").
struct ProgramFile {
  std::string path;
  std::string bytes;
};
using Program = std::vector<ProgramFile>;

/// What the text of a program says beside the motion.
struct ProgramNotes {
  std::string name = "Blade";  ///< identifiers and file names are made from it
  /// Errors of the design that the program is written despite. The head of each of its files then lists them,
  /// and says that it is not safe to run.
  std::vector<std::string> errors = {};
  /// What else the head of the main files warns of.
  std::vector<std::string> warnings = {};
  /// What is to be done before it runs; likewise.
  std::vector<std::string> before = {};
  /// Names the run that the program is of, 16 hexadecimal digits; stands in the head of each file. Empty if
  /// there is none.
  std::string run = {};
};

/// CSV, "motion.csv": header with units, one row an instant, positions and quaternions of every end. The
/// directions of approach and retreat are not in it.
Result<Program> writeCsv(const Motion& motion, const ProgramNotes& notes = {});
/// JSON with a schema version, "motion.json"; numbers round-trip. Errors of the design stand in both: in
/// lines before the header that begin with "# NOT SAFE TO RUN: ", and as the list "not_safe_to_run".
Result<Program> writeJson(const Motion& motion, const Cell& cell, const ProgramNotes& notes = {});

/// Reads back what the writers emit. An older JSON text has no approach and retreat; its motion tells none.
Result<Motion> readCsv(std::string_view text);
Result<Motion> readJson(std::string_view text);

}  // namespace bw::robotio
