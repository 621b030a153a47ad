// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rapid/linked_program.h"

namespace bw::robotio {

/// Printable ASCII, for comments and strings: any other character is a question mark.
std::string ascii(std::string_view text);

/// Kind of the finding that tells of files from different runs.
inline constexpr const char* kRunKind = "rapid-run";

/// The comment line in the head of each module that tells which run wrote it, the task and the blade it is
/// for: "! Run 0123456789abcdef, task T_ROB1, free blade length 800.0000 mm". "none" stands for an empty
/// `run`; a length of 0 (mm, between the two TCP origins) is left out.
std::string runLine(const std::string& run, const std::string& task, double bladeLength);

/// What the head of a module tells.
struct RunHead {
  bool ours = false;       ///< its head names Bladewright
  int line = 0;            ///< of the line below, 0 if there is none
  bool damaged = false;    ///< the line is there but not as we write it
  std::string run;         ///< empty if not told
  std::string task;        ///< empty if not told
  double bladeLength = 0;  ///< mm, 0 if not told
};

/// Reads the comments that follow the first line of a module; of somebody else's they tell nothing.
RunHead readRunHead(std::string_view module);

/// All modules of a strip are of one run and for one blade, and each lies in the folder of its task. Reports
/// those that do not; returns the blade's length in mm, 0 where no module tells it.
double checkRuns(const LinkedProgram& program, Breaches& breaches);

/// Kind of the finding that stands for a mark.
inline constexpr const char* kMarkKind = "rapid-marked";

/// Comment lines for the head of a module that must not run as it is, one "! NOT SAFE TO RUN: " for each of
/// `errors`, continued on lines that begin with "!   ". ASCII, at most 76 characters each, at most a score of
/// errors, and their number if there are more.
std::vector<std::string> unsafeMark(const std::vector<std::string>& errors);

/// Reports each mark in the program once, at the first module that bears it.
void checkMarks(const LinkedProgram& program, Breaches& breaches);

}  // namespace bw::robotio
