// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "rapid_program.h"

namespace bw::robotio {

/// Kind of the finding that stands for a mark.
inline constexpr const char* kMarkKind = "rapid-marked";

/// Comment lines for the head of a module that must not run as it is, one "! NOT SAFE TO RUN: " for each of
/// `errors`, continued on lines that begin with "!   ". ASCII, at most 76 characters each, at most a score of
/// errors, and their number if there are more.
std::vector<std::string> unsafeMark(const std::vector<std::string>& errors);

/// Reports each mark in the program once, at the first module that bears it.
void checkMarks(const LinkedProgram& program, Breaches& breaches);

}  // namespace bw::robotio
